// SPDX-License-Identifier: MIT
// The formulas as a program that runs, in three languages: a fragment function in the library's one-at-a-time form, a function of
// Python, and a fragment shader of GLSL. Ten lines are the same in all three. Their names are terms as in the formulas, and
// behind each line stands what it gives for the pixel that is explained.
import { choice } from './controls.js';
import { say } from './language.js';
import { short } from './math.js';
import { write } from './slots.js';

// A line: what it computes, how, and the term whose value stands behind it. In $..$ stand terms.
const LINES = [
  { term: 'r', share: 'A', note: { en: 'share of A on the screen', zh: 'A 在屏幕上的份额' } },
  { term: 's', share: 'B', note: { en: 'share of B on the screen', zh: 'B 在屏幕上的份额' } },
  { term: 't', share: 'C', note: { en: 'share of C on the screen', zh: 'C 在屏幕上的份额' } },
  { term: 'naive', how: '$r$ * $u_A$ + $s$ * $u_B$ + $t$ * $u_C$', note: { en: 'naive: wrong', zh: '未校正：错误' }, kind: 'wrong' },
  { term: 'i_P', how: '$r$ / $W_A$ + $s$ / $W_B$ + $t$ / $W_C$', note: { en: 'linear on the screen', zh: '在屏幕上是线性的' } },
  { term: 'W_P', how: '1 / $i_P$', note: { en: 'one division per pixel', zh: '每像素一次除法' } },
  { term: 'a', how: '$r$ * $W_P$ / $W_A$', note: { en: '1/W_A: once per triangle', zh: '1/W_A 每个三角形只算一次' } },
  { term: 'b', how: '$s$ * $W_P$ / $W_B$', note: { en: '1/W_B: once per triangle', zh: '1/W_B 每个三角形只算一次' } },
  { term: 'c', how: '$t$ * $W_P$ / $W_C$', note: { en: '1/W_C: once per triangle', zh: '1/W_C 每个三角形只算一次' } },
  { term: 'u_P', how: '$a$ * $u_A$ + $b$ * $u_B$ + $c$ * $u_C$', note: { en: 'corrected', zh: '校正后' }, kind: 'right' },
];

// `before` and `after`: what stands around the ten lines; `share`: how one comes by a share on the screen; `named`: how a corner's
// value is written.
const LANGUAGES = {
  c: {
    before: [
      '#include <rhw/shader.h>',
      'struct corner { float W, u; };',
      'static void paint1(struct rhw_fragment1 *f)',
      '{',
      '    const struct corner *A = f->uniforms, *B = A + 1, *C = A + 2;',
    ],
    after: ['    f->color[0][0] = naive;', '    f->color[0][1] = u;', '}'],
    share: (corner) => `f->barycentric_noperspective[${'ABC'.indexOf(corner)}]`,
    named: (name, corner) => `${corner}->${name}`,
    declare: '    const float ',
    end: ';',
    comment: '//',
  },
  python: {
    before: ['def paint(A, B, C, e_A, e_B, e_C):'],
    after: ['    return naive, u'],
    share: (corner) => `$e_${corner}$ / ($e_A$ + $e_B$ + $e_C$)`,
    named: (name, corner) => (name === 'e' ? `e_${corner}` : `${corner}.${name}`),
    declare: '    ',
    end: '',
    comment: '#',
  },
  glsl: {
    before: ['#version 330', 'noperspective in vec3 share; // (1, 0, 0) in A, (0, 1, 0) in B, (0, 0, 1) in C', 'uniform vec3 W_of, u_of;', 'out vec4 color;', 'void main()', '{'],
    after: ['    color = vec4(naive, u, 0, 1);', '}'],
    share: (corner) => `share.${'xyz'['ABC'.indexOf(corner)]}`,
    named: (name, corner) => `${name}_of.${'xyz'['ABC'.indexOf(corner)]}`,
    declare: '    float ',
    end: ';',
    comment: '//',
  },
};

const NAMED = { i_P: 'inverse_W', W_P: 'W', u_P: 'u' };

function nameOf(term, { named }) {
  const [, name, corner] = /^([euW])_([ABC])$/.exec(term) ?? [];
  return corner ? named(name, corner) : (NAMED[term] ?? term);
}

function termNode(term, language) {
  const node = document.createElement('span');
  node.dataset.term = term;
  node.setAttribute('tabindex', '-1');
  node.textContent = nameOf(term, language);
  return node;
}

function rowOf(kind) {
  const row = document.createElement('div');
  row.className = `code-line ${kind}`;
  row.appendChild(document.createElement('code'));
  return row;
}

// A text of the program: a narrow room breaks no name at the hyphen of its arrow.
const piecesOf = (text) =>
  text.split(/(\S*->\S*)/).map((piece, i) => (i % 2 ? Object.assign(document.createElement('span'), { className: 'whole', textContent: piece }) : piece));

function frameNode(line) {
  const row = rowOf('frame');
  row.firstChild.append(...piecesOf(line));
  return row;
}

function lineNode({ term, how, share, kind = '' }, language) {
  const row = rowOf(kind);
  row.firstChild.append(language.declare, termNode(term, language), ' = ');
  (how ?? language.share(share)).split('$').forEach((part, i) => row.firstChild.append(...(i % 2 ? [termNode(part, language)] : piecesOf(part))));
  row.firstChild.append(language.end);
  row.appendChild(document.createElement('code')).className = 'said';
  return row;
}

// What stands behind a line: its value and a note.
function saidOf({ term, note }, { comment }, terms) {
  const said = [terms && short(terms[term]), note && say(note)].filter(Boolean).join('  ');
  return said ? `${comment} ${said}` : '';
}

/** The terms of the lines, of an explained pixel's terms. */
export const codeTerms = (terms) => ({
  ...terms,
  i_P: 1 / terms.W_P,
  naive: terms.r * terms.u_A + terms.s * terms.u_B + terms.t * terms.u_C,
});

export class Code {
  #language = LANGUAGES.c;
  #terms = null;
  #said = []; // the nodes behind the lines

  /** In `section`, whose row of buttons "code" chooses the language. */
  constructor(section) {
    const room = section.querySelector('.code');
    choice(section, 'code', (name) => {
      this.#language = LANGUAGES[name];
      const lines = LINES.map((line) => lineNode(line, this.#language));
      this.#said = lines.map((line) => line.lastChild);
      room.replaceChildren(...this.#language.before.map(frameNode), ...lines, ...this.#language.after.map(frameNode));
      this.show(this.#terms);
    });
  }

  /** `terms`: those of codeTerms, or null: the lines without values. */
  show(terms) {
    this.#terms = terms;
    LINES.forEach((line, i) => write(this.#said[i], saidOf(line, this.#language, terms)));
  }
}
