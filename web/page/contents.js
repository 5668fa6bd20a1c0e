// SPDX-License-Identifier: MIT
// The list of chapters, made of their headings, and a mark beside each heading that has the address of its chapter.
import { say, whenLanguage } from './language.js';

const headings = (section) => [...section.querySelectorAll(':scope > :is(h1, h2)')];

function anchorOf(section) {
  const anchor = document.createElement('a');
  anchor.className = 'anchor';
  anchor.href = `#${section.id}`;
  anchor.textContent = '#';
  whenLanguage(() => anchor.setAttribute('aria-label', say({ en: 'link to this chapter as it is', zh: '指向本章当前状态的链接' })));
  return anchor;
}

/** Fills `list`, an <ol>, and marks the headings. */
export function startContents(list) {
  for (const section of document.querySelectorAll('section.chapter')) {
    const item = list.appendChild(document.createElement('li'));
    for (const heading of headings(section)) {
      const link = item.appendChild(document.createElement('a'));
      link.href = `#${section.id}`;
      link.lang = heading.lang;
      link.innerHTML = heading.innerHTML;
    }
    headings(section)[0].before(anchorOf(section));
  }
  list.addEventListener('click', () => list.closest('details').removeAttribute('open'));
}
