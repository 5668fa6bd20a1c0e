// SPDX-License-Identifier: MIT
// Pointing at a term of a formula: its value with all digits and what it means in a small box, the same term elsewhere in
// the chapter marked, and its place in the chapter's pictures.
import { meaningOf } from './derivation.js';
import { formula, long } from './math.js';

const chapters = new Map(); // section → {terms(), views}

/** A chapter's terms ({term: number} or null, asked when needed) and the views that can point at them. */
export function chapterTerms(section, terms, views) {
  chapters.set(section, { terms, views });
}

let box;

function markAlike(section, term) {
  section.querySelectorAll('.alike').forEach((node) => node.classList.remove('alike'));
  if (term) {
    section.querySelectorAll(`[data-term="${CSS.escape(term)}"]`).forEach((node) => node.classList.add('alike'));
  }
}

function show(node, section, term) {
  const value = chapters.get(section).terms()?.[term];
  box.replaceChildren(formula(term));
  if (Number.isFinite(value)) {
    box.append(` = ${long(value)}`);
  }
  const meaning = document.createElement('small');
  meaning.textContent = meaningOf(term);
  box.append(meaning);
  box.hidden = false;
  const at = node.getBoundingClientRect();
  const left = Math.min(Math.max(8, at.left), innerWidth - box.offsetWidth - 8);
  const above = at.top - box.offsetHeight - 8;
  box.style.left = `${left + scrollX}px`;
  box.style.top = `${(above > 0 ? above : at.bottom + 8) + scrollY}px`;
}

function point(event) {
  const node = event.target.closest?.('[data-term]');
  const section = node?.closest('section.chapter');
  for (const [other, { views }] of chapters) {
    const term = other === section ? node.dataset.term : null;
    markAlike(other, term);
    views.forEach((view) => view.point(term));
  }
  if (section && chapters.has(section)) {
    show(node, section, node.dataset.term);
  } else {
    box.hidden = true;
  }
}

/** Listens on the whole page. */
export function startTips() {
  box = document.body.appendChild(document.createElement('div'));
  box.className = 'tip';
  box.hidden = true;
  box.setAttribute('role', 'status');
  for (const kind of ['pointerover', 'focusin', 'pointerdown']) {
    document.addEventListener(kind, point);
  }
}
