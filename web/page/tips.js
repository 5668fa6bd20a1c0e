// SPDX-License-Identifier: MIT
// Pointing at a term of a formula: its value with all digits and what it means in a small box, the same term elsewhere in
// the chapter marked, and its place in the chapter's pictures.
import { meaningOf } from './derivation.js';
import { say } from './language.js';
import { formula, long } from './math.js';

const chapters = new Map(); // section → {terms(), views}

/**
 * A chapter's terms ({term: number} or null, asked when needed), the views that can point at them, and what they mean where
 * that is not the usual ({"Z": {en, zh}}).
 */
export function chapterTerms(section, terms, views, meanings = {}) {
  chapters.set(section, { terms, views, meanings });
  new MutationObserver(() => refresh(section)).observe(section, { childList: true, characterData: true, subtree: true });
  refresh(section);
}

let box;
let pointed = null; // {section, term}

function markAlike(section, term) {
  section.querySelectorAll('.alike').forEach((node) => node.classList.remove('alike'));
  if (term) {
    section.querySelectorAll(`[data-term="${CSS.escape(term)}"]`).forEach((node) => node.classList.add('alike'));
  }
}

function tell(section, term) {
  const { terms, meanings } = chapters.get(section);
  const value = terms()?.[term];
  box.replaceChildren(formula(term));
  if (Number.isFinite(value)) {
    box.append(` = ${long(value)}`);
  }
  const own = meanings[term.split('_')[0]];
  const meaning = document.createElement('small');
  meaning.textContent = own ? say(own) : meaningOf(term);
  box.append(meaning);
}

function placeAt(node) {
  const at = node.getBoundingClientRect();
  const left = Math.min(Math.max(8, at.left), innerWidth - box.offsetWidth - 8);
  const above = at.top - box.offsetHeight - 8;
  box.style.left = `${left + scrollX}px`;
  box.style.top = `${(above > 0 ? above : at.bottom + 8) + scrollY}px`;
}

// The term that is pointed at, or none.
function show(section, term) {
  pointed = term ? { section, term } : null;
  for (const [other, { views }] of chapters) {
    const here = other === section ? term : null;
    markAlike(other, here);
    views.forEach((view) => view.point(here));
  }
  box.hidden = !pointed;
  if (pointed) {
    tell(section, term);
  }
}

function point(event) {
  const node = event.target.closest?.('[data-term]');
  const section = node?.closest('section.chapter');
  show(section, chapters.has(section) ? node.dataset.term : null);
  if (pointed) {
    placeAt(node);
  }
}

// A panel was written anew: its terms are marked again, with the values of now.
function refresh(section) {
  section.querySelector('[data-term]')?.setAttribute('tabindex', '0');
  if (pointed?.section === section) {
    markAlike(section, pointed.term);
    tell(section, pointed.term);
  }
}

// Terms are one stop of the tab key for each chapter, its first; arrows go on from there.
function step(event) {
  const section = event.target.closest?.('section.chapter');
  const way = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
  if (event.key === 'Escape') {
    show(section, null);
  } else if (way && event.target.dataset?.term) {
    event.preventDefault();
    const terms = [...section.querySelectorAll('[data-term]')];
    terms[terms.indexOf(event.target) + way]?.focus();
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
  document.addEventListener('keydown', step);
}
