// SPDX-License-Identifier: MIT
// The derivation of one pixel with its numbers: formulas whose terms can be pointed at, each with its value.
import { exactWeights, threeWays } from './exact.js';
import { hear } from './heard.js';
import { language, say } from './language.js';
import { formulaIn, long, short } from './math.js';
import { element, fill, slot, text, write } from './slots.js';
import { METHOD } from './stage.js';

const NAMES = ['A', 'B', 'C'];

const MEANINGS = {
  e: {
    en: 'edge function: twice the area of the part of the triangle opposite to the corner, an integer, in 1/65536 pixel²',
    zh: '边函数：与该顶点相对的小三角形面积的两倍，是整数，单位 1/65536 像素²',
  },
  r: { en: 'share of A on the screen', zh: 'A 在屏幕上的份额' },
  s: { en: 'share of B on the screen', zh: 'B 在屏幕上的份额' },
  t: { en: 'share of C on the screen', zh: 'C 在屏幕上的份额' },
  a: { en: 'share of A in space', zh: 'A 在空间中的份额' },
  b: { en: 'share of B in space', zh: 'B 在空间中的份额' },
  c: { en: 'share of C in space', zh: 'C 在空间中的份额' },
  W: { en: 'distance from the eye, measured straight ahead', zh: '到眼睛的距离，沿正前方量' },
  X: { en: 'clip coordinate', zh: '裁剪坐标' },
  Y: { en: 'clip coordinate', zh: '裁剪坐标' },
  Z: { en: 'clip coordinate', zh: '裁剪坐标' },
  u: { en: 'texture coordinate', zh: '纹理坐标' },
  v: { en: 'texture coordinate', zh: '纹理坐标' },
  I: { en: 'green, of the three colour values', zh: '颜色中的绿色分量' },
  d: { en: 'depth: Z/W', zh: '深度：Z/W' },
  x: { en: 'X/W: place on the screen, −1 to 1', zh: 'X/W：屏幕位置，−1 到 1' },
  y: { en: 'Y/W: place on the screen, −1 to 1', zh: 'Y/W：屏幕位置，−1 到 1' },
  i: { en: '1/W', zh: '1/W' },
  q: { en: 'u/W', zh: 'u/W' },
  naive: { en: 'u mixed by areas on the screen', zh: '按屏幕面积插值的 u' },
  column: { en: 'pixels from the left', zh: '距左边的像素数' },
  row: { en: 'pixels from the top', zh: '距上边的像素数' },
  PBC: { en: 'area of this triangle in the world', zh: '该三角形在世界空间中的面积' },
  PCA: { en: 'area of this triangle in the world', zh: '该三角形在世界空间中的面积' },
  PAB: { en: 'area of this triangle in the world', zh: '该三角形在世界空间中的面积' },
  ABC: { en: 'area of the whole triangle in the world', zh: '整个三角形在世界空间中的面积' },
};

/** What a term means, in words. */
export const meaningOf = (term) => say(MEANINGS[term] ?? MEANINGS[term.split('_')[0]] ?? '');

/** {term: number} of an explained pixel; terms as in the formulas. */
export function termsOf(n) {
  const terms = { r: n.r, s: n.s, t: n.t, a: n.a, b: n.b, c: n.c, W_P: 1 / n.inverse_w, d_P: n.depth };
  NAMES.forEach((name, i) => {
    for (const axis of ['X', 'Y', 'Z', 'W', 'e', 'u', 'v']) {
      terms[`${axis}_${name}`] = n[`${axis}_${i}`];
    }
    terms[`I_${name}`] = n[`green_${i}`];
  });
  for (const axis of ['X', 'Y', 'Z']) {
    terms[`${axis}_P`] = n.a * terms[`${axis}_A`] + n.b * terms[`${axis}_B`] + n.c * terms[`${axis}_C`];
  }
  terms.u_P = n.u;
  if (n.method === METHOD.world) {
    Object.assign(terms, { a: n.world_a, b: n.world_b, c: n.world_c });
    terms.x_P = terms.X_P / terms.W_P;
    terms.y_P = terms.Y_P / terms.W_P;
  }
  return terms;
}

// A formula on a line of its own, and behind it what its right side is: with numbers, or as one number.
function line(parent, formula, behind, kind = 'line') {
  fill(element(parent, 'div', kind), (row) => {
    formulaIn(row, formula);
    if (behind) {
      formulaIn(row, `= ${behind.text}`, behind.values);
    }
  });
}

const number = (term, terms) => ({ text: term, values: { [term]: short(terms[term]) } });

/** A heading, {en, zh}, of a part of a derivation in `chapter`; `why`: the chapter that explains it, where that is another one. */
export function headingOf(chapter, title, why) {
  const head = document.createElement(chapter.querySelector('h1') ? 'h2' : 'h3'); // one below that of the chapter
  head.textContent = say(title);
  if (why && why !== chapter.id) {
    const link = document.createElement('a');
    head.append(' ', link); // who hears it hears two words
    link.className = 'why';
    link.href = `#${why}`;
    link.textContent = say({ en: 'why?', zh: '为什么？' });
  }
  return head;
}

function section(parent, title, why, writeRest) {
  fill(element(parent, 'section'), (block) => {
    slot(block, `${language()} ${title.en}`, () => headingOf(parent.closest('.chapter'), title, why));
    writeRest(block);
  });
}

const TITLES = {
  screen: { en: '1. On the screen: areas', zh: '1. 屏幕上：面积之比' },
  divide: { en: '2. What is linear there is 1/W', zh: '2. 在屏幕上线性的是 1/W' },
  space: { en: '3. In space: divide', zh: '3. 回到空间：除以 W' },
  back: { en: '1. Where the pixel is on the screen', zh: '1. 像素在屏幕上的位置' },
  point: { en: '2. Back to the world', zh: '2. 变回世界空间' },
  areas: { en: '3. There: areas', zh: '3. 在世界空间中：面积之比' },
  u: { en: '4. The texture coordinate u', zh: '4. 纹理坐标 u' },
  green: { en: '4. The green of its colour', zh: '4. 颜色的绿色分量' },
};

const SPACE = [
  ['a = r·[W_P|W_A]', 'a'],
  ['b = s·[W_P|W_B]', 'b'],
  ['c = t·[W_P|W_C]', 'c'],
];
const INVERSE = '[1|W_P] = [r|W_A] + [s|W_B] + [t|W_C]';

function screenSection(parent, n, terms) {
  section(parent, TITLES.screen, 'weights', (block) => {
    if (!Number.isNaN(n.e_0)) {
      line(block, 'r : s : t = e_A : e_B : e_C');
    }
    for (const term of ['r', 's', 't']) {
      line(block, term, number(term, terms), 'line beside');
    }
  });
}

function divideSection(parent, terms) {
  const names = ['r', 's', 't', 'W_A', 'W_B', 'W_C'];
  const values = Object.fromEntries(names.map((term) => [term, short(terms[term])]));
  section(parent, TITLES.divide, 'inverse', (block) => {
    line(block, INVERSE);
    line(block, '', { text: INVERSE.split(' = ')[1], values });
    line(block, 'W_P', number('W_P', terms));
  });
}

function spaceSection(parent, terms) {
  section(parent, TITLES.space, 'clip', (block) => SPACE.forEach(([formula, term]) => line(block, formula, number(term, terms))));
}

/** On the screen, 1/W, and in space: the steps that every perspective picture has. */
export function weightSections(parent, n) {
  const terms = termsOf(n);
  screenSection(parent, n, terms);
  divideSection(parent, terms);
  spaceSection(parent, terms);
}

const AREAS = [
  ['a = [PBC|ABC]', 'a'],
  ['b = [PCA|ABC]', 'b'],
  ['c = [PAB|ABC]', 'c'],
];

// The other way to a, b, c: the numbers of the fragment function that went it.
function worldSections(parent, n) {
  const terms = termsOf(n);
  section(parent, TITLES.back, undefined, (block) => {
    for (const term of ['x_P', 'y_P', 'd_P']) {
      line(block, term, number(term, terms), 'line beside');
    }
  });
  section(parent, TITLES.point, undefined, (block) => {
    write(element(block, 'p', 'note'), say({
      en: '(x, y, d, 1) times the inverse of projection × view, then all divided by the fourth coordinate. That is a point of the world:',
      zh: '把 (x, y, d, 1) 乘以“投影 × 视图”矩阵的逆，再除以第四个坐标，得到世界空间中的一点：',
    }));
    const digits = (value) => short(Number(value.toFixed(4))); // floats went there and back: more would be noise
    write(element(block, 'div', 'line world'), `P = (${[n.world_x, n.world_y, n.world_z].map(digits).join(', ')})`);
  });
  section(parent, TITLES.areas, 'weights', (block) => AREAS.forEach(([formula, term]) => line(block, formula, number(term, terms))));
}

function tableRow(table, name, how, value, kind) {
  fill(element(table, 'tr', kind), (row) => {
    write(element(row, 'td'), say(name));
    fill(element(row, 'td', 'how'), how);
    write(element(row, 'td', 'value'), value);
  });
}

/** A value three ways, by its name in the numbers ("u", "green"), in a picture of [width, height]; `written`: what was made of it. */
export function threeWaysOf(n, name, size, written = n[name]) {
  const weights = exactWeights({
    edges: [n.e_0, n.e_1, n.e_2],
    corners: [0, 1, 2].map((i) => ['X', 'Y', 'Z', 'W'].map((axis) => n[`${axis}_${i}`])),
    place: [n.x_P, n.y_P],
    size,
  });
  const values = [n[`${name}_0`], n[`${name}_1`], n[`${name}_2`]];
  return threeWays(weights, values, written, n.smooth === 1);
}

const digits = (value) => long(Number(value.toPrecision(9)));

const ULP = {
  en: 'A ULP is the step between neighbouring floats at the largest corner value.',
  zh: 'ULP 是顶点最大值处相邻浮点数的间距。',
};

// By way of the world floats lose more on their way than the pipeline does.
const notes = {
  world: (error, direct) => ({
    en: `Naive and correct are computed in exact arithmetic. The last row is what rhw, the library that draws this page, put into the picture: by way of the world rhw is ${error.toFixed(2)} ULP from the correct one, by r/W, s/W, t/W it is ${direct.toFixed(2)} (see “pipeline”). ${ULP.en}`,
    zh: `前两行用精确有理数算出，最后一行是绘制本页的库 rhw 实际写入图像的值：经世界空间的结果与正确值相差 ${error.toFixed(2)} ULP，由 r/W、s/W、t/W 求得的（见“管线”）相差 ${direct.toFixed(2)}。${ULP.zh}`,
  }),
  direct: (error, asked) => ({
    en: `Naive and correct are computed in exact arithmetic. The last row is what rhw, the library that draws this page, put into the picture: rhw is ${error.toFixed(2)} ULP from the ${asked.en} one. ${ULP.en}`,
    zh: `前两行用精确有理数算出，最后一行是绘制本页的库 rhw 实际写入图像的值，与“${asked.zh}”那一行相差 ${error.toFixed(2)} ULP。${ULP.zh}`,
  }),
};

const ROWS = {
  naive: { en: 'naive', zh: '未校正' },
  correct: { en: 'correct', zh: '正确' },
  written: { en: 'rhw wrote', zh: 'rhw 的结果' },
};

// `name`: which value, "u" or "green"
function valueSection(parent, n, name, size) {
  const byWorld = n.method === METHOD.world;
  const written = byWorld ? n[`world_${name}`] : n[name];
  const { naive, exact, error } = threeWaysOf(n, name, size, written);
  const symbol = name === 'u' ? 'u' : 'I';
  const sum = (weights) => (cell) => formulaIn(cell, weights.map((weight, i) => `${weight}·${symbol}_${NAMES[i]}`).join(' + '));
  const how = byWorld ? { en: 'by the world', zh: '经世界空间' } : n.smooth === 1 ? { en: 'divided by W', zh: '除以 W' } : ROWS.naive;
  section(parent, TITLES[name], undefined, (block) => {
    fill(element(block, 'table'), (table) => {
      tableRow(table, ROWS.naive, sum(['r', 's', 't']), digits(naive), 'naive');
      tableRow(table, ROWS.correct, sum(['a', 'b', 'c']), digits(exact), 'correct');
      tableRow(table, ROWS.written, (cell) => text(cell, say(how)), digits(written), 'written');
    });
    const note = byWorld ? notes.world(error, threeWaysOf(n, name, size).error) : notes.direct(error, n.smooth === 1 ? ROWS.correct : ROWS.naive);
    write(element(block, 'p', 'note'), say(note));
  });
  const values = [[ROWS.naive, naive], [ROWS.correct, exact], [ROWS.written, written]];
  hear(parent, `${symbol}: ${values.map(([title, value]) => `${say(title)} ${digits(value)}`).join(', ')}`);
}

/** Fills `panel` with the derivation of a pixel's value `name`, u or green; numbers null: says what to do. `size`: the picture's. */
export function showDerivation(panel, n, pixel, size, name = 'u') {
  const head = n
    ? { en: `Pixel P = (${pixel})`, zh: `像素 P = (${pixel})` }
    : {
        en: pixel ? 'No triangle here.' : 'Point at a pixel to see how it got its value.',
        zh: pixel ? '这里没有三角形。' : '指向一个像素，看它的值从何而来。',
      };
  fill(panel, () => {
    write(element(panel, 'p', 'pixel'), say(head));
    if (n) {
      (n.method === METHOD.world ? worldSections : weightSections)(panel, n);
      valueSection(panel, n, name, size);
    } else if (pixel) {
      hear(panel, say(head));
    }
  });
}
