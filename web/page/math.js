// SPDX-License-Identifier: MIT
// Formulas as MathML, from a notation for just what this page needs: names with one subscript (W_A, r), numbers, operators,
// fractions [1|W_P], and spaces that are ignored. Every name is a term that can be pointed at: it carries data-term.
import { slot, write } from './slots.js';

const MATHML = 'http://www.w3.org/1998/Math/MathML';

function element(name, children = [], term) {
  const node = document.createElementNS(MATHML, name);
  node.append(...children);
  if (term) {
    node.dataset.term = term;
    node.setAttribute('tabindex', '-1');
  }
  return node;
}

// A function name or a word is upright, a single letter slanted, as is usual.
function nameOf(term) {
  const [name, below] = term.split('_');
  const letter = element('mi', [name]);
  return below === undefined ? letter : element('msub', [letter, element('mi', [below])]);
}

// A negative number behind a sign stands in parentheses.
function termNode(term, values, before) {
  if (values && term in values) {
    const node = element('mn', [values[term]], term);
    const signs = before?.localName === 'mo' && before.textContent !== '=' && values[term].startsWith('−');
    return signs ? element('mrow', [element('mo', ['(']), node, element('mo', [')'])]) : node;
  }
  const node = nameOf(term);
  node.dataset.term = term;
  node.setAttribute('tabindex', '-1');
  return node;
}

const TOKEN = /\s*(?:([A-Za-z]+(?:_[A-Za-z]+)?′?)|([0-9.]+)|(.))/gu;

function parse(text, values) {
  const rows = [[]]; // the open fractions' parts
  for (const [, name, number, sign] of text.matchAll(TOKEN)) {
    const row = rows.at(-1);
    if (name) {
      row.push(termNode(name, values, row.at(-1)));
    } else if (number) {
      row.push(element('mn', [number]));
    } else if (sign === '[' || sign === '|') {
      rows.push([]);
    } else if (sign === ']') {
      const below = rows.pop();
      const above = rows.pop();
      rows.at(-1).push(element('mfrac', [element('mrow', above), element('mrow', below)]));
    } else {
      row.push(element('mo', [sign]));
    }
  }
  return rows[0];
}

/** A formula; with `values` ({term: text}) the terms that have one stand as numbers. */
export function formula(text, values) {
  const math = element('math', parse(text, values));
  math.setAttribute('displaystyle', 'true');
  return math;
}

const names = new Map(); // formula → the terms in it

function namesIn(text) {
  if (!names.has(text)) {
    names.set(text, [...text.matchAll(TOKEN)].map(([, name]) => name).filter(Boolean));
  }
  return names.get(text);
}

const numbers = new WeakMap(); // <math> → its numbers that stand for terms

/** A formula as the next child of a parent that is being filled (slots.js). */
export function formulaIn(parent, text, values = {}) {
  // A number that gets a sign may get parentheses.
  const shape = namesIn(text).map((name) => (name in values ? (values[name].startsWith('−') ? '-' : '+') : ''));
  const math = slot(parent, `${text} ${shape}`, () => formula(text, values));
  if (!numbers.has(math)) {
    numbers.set(math, [...math.querySelectorAll('mn[data-term]')]);
  }
  numbers.get(math).forEach((node) => write(node, values[node.dataset.term]));
}

// Keeps the sign behind a formula on its line.
function keepSign(node) {
  const sign = /^[.,;:)，。；：、）]/u.exec(node.nextSibling?.data ?? '')?.[0];
  if (sign) {
    const whole = Object.assign(document.createElement('span'), { className: 'equation' });
    node.nextSibling.data = node.nextSibling.data.slice(sign.length);
    node.before(whole);
    whole.append(node, sign);
  }
}

/** Fills every <rhw-math> of the page. */
export function typeset(root) {
  for (const node of root.querySelectorAll('rhw-math')) {
    node.replaceChildren(formula(node.textContent));
    keepSign(node);
  }
}

/** A number for a line: four or five digits, a true minus. */
export function short(value) {
  if (!Number.isFinite(value)) {
    return '–';
  }
  const text = Math.abs(value) >= 1e-3 || value === 0 ? String(Number(value.toPrecision(4))) : value.toExponential(2);
  return text.replace('-', '−');
}

/** All digits that tell a number from its neighbours. */
export const long = (value) => String(value).replace('-', '−');
