// SPDX-License-Identifier: MIT
// The formulas as a program, in three languages: the same ten lines, whose names are terms as in the formulas, and what each
// line gives for the pixel that is explained.
import { choice } from './controls.js';
import { say } from './language.js';
import { short } from './math.js';

// A line: what it computes, how, and the term whose value stands behind it. In $..$ stand terms.
const LINES = [
  { term: 'r', how: '$e_A$ / ($e_A$ + $e_B$ + $e_C$)' },
  { term: 's', how: '$e_B$ / ($e_A$ + $e_B$ + $e_C$)' },
  { term: 't', how: '$e_C$ / ($e_A$ + $e_B$ + $e_C$)' },
  { term: 'naive', how: '$r$ * $u_A$ + $s$ * $u_B$ + $t$ * $u_C$', note: { en: 'naive: wrong', zh: '未校正：错误' }, kind: 'wrong' },
  { term: 'i_P', how: '$r$ / $W_A$ + $s$ / $W_B$ + $t$ / $W_C$', note: { en: '1/W is linear on the screen', zh: '1/W 在屏幕上是线性的' } },
  { term: 'W_P', how: '1 / $i_P$', note: { en: 'the one division', zh: '唯一的一次除法' } },
  { term: 'a', how: '$r$ * $W_P$ / $W_A$' },
  { term: 'b', how: '$s$ * $W_P$ / $W_B$' },
  { term: 'c', how: '$t$ * $W_P$ / $W_C$' },
  { term: 'u_P', how: '$a$ * $u_A$ + $b$ * $u_B$ + $c$ * $u_C$', note: { en: 'corrected', zh: '校正后' }, kind: 'right' },
];

const LANGUAGES = {
  c: { declare: 'float ', end: ';', comment: '//' },
  python: { declare: '', end: '', comment: '#' },
  glsl: { declare: 'float ', end: ';', comment: '//' },
};

// In C and Python a corner's values are fields; a GLSL program would have them in vectors.
const WRITTEN = {
  c: (term) => term.replace(/^([uW])_([ABC])$/, '$2.$1'),
  python: (term) => term.replace(/^([uW])_([ABC])$/, '$2.$1'),
  glsl: (term) => term.replace(/^([euW])_([ABC])$/, (_, name, corner) => `${name}.${'xyz'['ABC'.indexOf(corner)]}`),
};
const NAMED = { naive: 'u_naive', i_P: 'inverse_W', W_P: 'W', u_P: 'u' };

function nameOf(term, language) {
  return NAMED[term] ?? WRITTEN[language](term);
}

function termNode(term, language) {
  const node = document.createElement('span');
  node.dataset.term = term;
  node.setAttribute('tabindex', '-1');
  node.textContent = nameOf(term, language);
  return node;
}

function lineNode({ term, how, kind = '' }, language) {
  const { declare, end } = LANGUAGES[language];
  const row = document.createElement('div');
  row.className = `code-line ${kind}`;
  const text = row.appendChild(document.createElement('code'));
  text.append(declare, termNode(term, language), ' = ');
  how.split('$').forEach((part, i) => text.append(i % 2 ? termNode(part, language) : part));
  text.append(end);
  row.appendChild(document.createElement('code')).className = 'said';
  return row;
}

// What stands behind a line: its value and a note.
function saidOf({ term, note }, language, terms) {
  const said = [terms && short(terms[term]), note && say(note)].filter(Boolean).join('  ');
  return said ? `${LANGUAGES[language].comment} ${said}` : '';
}

/** The terms of the lines, of an explained pixel's terms. */
export const codeTerms = (terms) => ({
  ...terms,
  i_P: 1 / terms.W_P,
  naive: terms.r * terms.u_A + terms.s * terms.u_B + terms.t * terms.u_C,
});

export class Code {
  #language = 'c';
  #terms = null;

  /** In `section`, whose row of buttons "code" chooses the language. */
  constructor(section) {
    this.room = section.querySelector('.code');
    choice(section, 'code', (language) => {
      this.#language = language;
      this.room.replaceChildren(...LINES.map((line) => lineNode(line, language)));
      this.show(this.#terms);
    });
  }

  /** `terms`: those of codeTerms, or null: the lines without values. */
  show(terms) {
    this.#terms = terms;
    LINES.forEach((line, i) => (this.room.children[i].lastChild.textContent = saidOf(line, this.#language, terms)));
  }
}
