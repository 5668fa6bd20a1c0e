// SPDX-License-Identifier: MIT
// How a pixel of a model got its value, in the page's words: what scene.explain of the npm package tells, as formulas and tables.
import { headingOf, weightSections } from './derivation.js';
import { say } from './language.js';
import { formula, long, short } from './math.js';
import { fill, slot } from './slots.js';

const BACKGROUND = -1;
const GROUND = -2;
const STEP = 256; // places on the screen are told in 1/256 pixel
const CORNERS = ['A', 'B', 'C'];

const TITLES = {
  history: { en: 'What came to this pixel, in the order of drawing', zh: '依绘制顺序到达此像素的片元' },
  corners: { en: 'The triangle that is seen', zh: '可见的三角形' },
  values: { en: '4. Every value three ways', zh: '4. 每个值的三种算法' },
  textures: { en: '5. Its textures there', zh: '5. 此处的纹理' },
};

const FATES = {
  failed_early: { en: 'behind what was there', zh: '被已有内容遮挡' },
  discarded: { en: 'discarded by its shader', zh: '被着色器丢弃' },
  failed_late: { en: 'behind what was there, as told after its shader', zh: '着色之后判定被遮挡' },
  written: { en: 'written', zh: '写入' },
};

// The words of the library's names (scene/draw/explain_sample.c) in Chinese, and in English where the page spells them otherwise.
const WORDS = {
  position: '位置',
  normal: '法线',
  tangent: '切线',
  plane: '切平面',
  color: '颜色',
  disc: '圆点',
  component: '分量',
  'base color': '基色',
  'metallic-roughness': '金属度与粗糙度',
  'normal map': '法线贴图',
  occlusion: '遮蔽',
  emission: '自发光',
  'a layer': '附加层',
  nothing: '无',
};

const SPELLED = { color: 'colour', 'base color': 'base colour' };

const wordOf = (name) => ({ en: SPELLED[name] ?? name, zh: WORDS[name] ?? name });

// "position x", "uv of base color u", "component 3"
function valueName(name) {
  const [, slot, axis] = /^uv of (.+) ([uv])$/.exec(name) ?? [];
  if (slot) {
    const { en, zh } = wordOf(slot);
    return { en: `${axis} of ${en}`, zh: `${zh}的 ${axis}` };
  }
  const [word, part] = name.split(' ');
  const { en, zh } = wordOf(word);
  return { en: `${en} ${part}`, zh: `${zh} ${part}` };
}

/** The fragment of an explanation that is seen; undefined where nothing of the model is. */
export const seenIn = ({ fragments }) =>
  fragments.findLast(({ fate, screen, instance }) => fate === 'written' && screen && instance !== BACKGROUND);

/** Its numbers, by the names that a stage has for them. */
export function numbersOf(fragment) {
  const [r, s, t] = fragment.screen;
  const [a, b, c] = fragment.space;
  const n = { r, s, t, a, b, c, inverse_w: fragment.inverse_w[0], depth: fragment.depth };
  fragment.clip.forEach((corner, i) => ['X', 'Y', 'Z', 'W'].forEach((axis, k) => (n[`${axis}_${i}`] = corner[k])));
  CORNERS.forEach((_, i) => (n[`e_${i}`] = fragment.edges?.[i] ?? NaN));
  return n;
}

/** [u, v] of its corners by the first texture's coordinates; undefined where it has none. */
export function uvsOf({ varyings }) {
  const named = (axis) => varyings?.find(({ name }) => name.startsWith('uv of ') && name.endsWith(` ${axis}`))?.vertices;
  const [us, vs] = [named('u'), named('v')];
  return us && vs && us.map((u, i) => [u, vs[i]]);
}

// Parts ------------------------------------------------------------------------------------------------

function add(parent, tag, content = [], kind = '') {
  const node = parent.appendChild(document.createElement(tag));
  node.className = kind;
  node.append(...[content].flat());
  return node;
}

function section(parent, title, why) {
  const block = add(parent, 'section');
  block.append(headingOf(parent.closest('.chapter'), title, why));
  return block;
}

function note(parent, texts) {
  add(parent, 'p', say(texts), 'note');
}

// Numbers, as texts or formulas, have their last digits below each other; words, {en, zh}, and colours their beginnings.
const isWord = (cell) => typeof cell === 'object' && !(cell instanceof MathMLElement);

// Cells are texts, {en, zh} or nodes.
function table(parent, heads, rows) {
  const node = add(add(parent, 'div', [], 'scroll'), 'table', [], 'numbers');
  const kinds = heads.map((_, column) => (rows.some((cells) => isWord(cells[column])) ? 'word' : ''));
  for (const [i, cells] of [heads, ...rows].entries()) {
    const row = node.insertRow();
    cells.forEach((cell, column) => add(row, i === 0 ? 'th' : 'td', cell instanceof Node ? cell : say(cell), kinds[column]));
  }
}

// A linear colour as the picture shows it.
function swatch(color) {
  const encoded = color.slice(0, 3).map((part) => {
    const light = Math.min(Math.max(part, 0), 1);
    return Math.round(255 * (light <= 0.0031308 ? 12.92 * light : 1.055 * light ** (1 / 2.4) - 0.055));
  });
  const node = document.createElement('span');
  node.className = 'swatch';
  node.style.background = `rgb(${encoded})`;
  const all = document.createElement('span');
  all.append(node, color.map(short).join(', '));
  return all;
}

function subjectOf({ instance, node, triangle, front_facing: front }) {
  if (instance === BACKGROUND) {
    return { en: 'the background', zh: '背景' };
  }
  const name = instance === GROUND ? { en: 'ground', zh: '地面' } : { en: node, zh: node };
  const [before, joint] = [say(name), say({ en: ', ', zh: '，' })];
  return {
    en: `${before}${before && joint}triangle ${triangle}, ${front ? 'front' : 'back'}`,
    zh: `${before}${before && joint}三角形 ${triangle}，${front ? '正面' : '背面'}`,
  };
}

function showHistory(parent, { fragments, orthographic }) {
  const block = section(parent, TITLES.history, 'depth');
  const rows = fragments.map((fragment, i) => [
    String(i + 1),
    subjectOf(fragment),
    fragment.instance === BACKGROUND ? '' : long(fragment.depth),
    FATES[fragment.fate],
    fragment.fate === 'written' ? swatch(fragment.color_after) : '',
  ]);
  table(block, [{ en: 'no.', zh: '序号' }, { en: 'what', zh: '内容' }, { en: 'depth', zh: '深度' }, { en: 'what became of it', zh: '结果' },
                { en: 'colour then', zh: '之后的颜色' }], rows);
  note(block, {
    en: `Depth is reversed: 1 at the near plane, 0 at ${orthographic ? 'the far one' : 'infinity'}, and the greater one is seen. Colours are linear: red, green, blue, alpha.`,
    zh: `深度是反向的：近平面为 1，${orthographic ? '远平面' : '无穷远'}为 0，较大者可见。颜色为线性值：红、绿、蓝、alpha。`,
  });
}

function showCorners(parent, fragment) {
  const block = section(parent, TITLES.corners, 'motion');
  const { snapped, clipped } = fragment;
  const heads = ['X', 'Y', 'Z', 'W'].map((axis) => formula(axis));
  const rows = fragment.clip.map((corner, i) => [
    CORNERS[i],
    ...corner.map((value, k) => formula(`${'XYZW'[k]}_${CORNERS[i]}`, { [`${'XYZW'[k]}_${CORNERS[i]}`]: short(value) })),
    ...(snapped?.[i] ?? []).map((place) => long(Number((place / STEP).toFixed(2)))),
  ]);
  const places = snapped ? [{ en: 'column', zh: '列' }, { en: 'row', zh: '行' }] : [];
  table(block, [{ en: 'corner', zh: '顶点' }, ...heads, ...places], rows);
  if (clipped) {
    note(block, {
      en: 'It is clipped: what it covers is the polygon that the view leaves of it.',
      zh: '它被裁剪过：实际覆盖的是视锥内剩下的多边形。',
    });
  }
}

function showValues(parent, { varyings }) {
  const block = section(parent, TITLES.values, 'pixel');
  const number = (value) => (value === null ? '–' : long(Number(value.toPrecision(6))));
  const rows = varyings.map(({ name, vertices, naive, exact, pipeline, error_ulp: error }) => [
    valueName(name),
    ...[naive, exact, pipeline].map(number),
    error === null ? '–' : error.toFixed(2),
    ...vertices.map(number), // last, as a phone has room for the others alone
  ]);
  table(block, [{ en: 'value', zh: '值' }, { en: 'naive', zh: '未校正' }, { en: 'correct', zh: '正确' }, { en: 'rhw wrote', zh: 'rhw 的结果' }, 'ULP',
                ...CORNERS.map((name) => formula(`I_${name}`))], rows);
  note(block, {
    en: 'Naive is r, s, t times the corners’ values, correct a, b, c times them, in exact arithmetic. ULP is the error of what rhw wrote, in units of the last place of the largest corner value; it promises 8 at most.',
    zh: '“未校正”是顶点值按 r、s、t 的加权和，“正确”是按 a、b、c 的加权和（用精确有理数算出）。ULP 是 rhw 结果的误差，以顶点最大值的末位为单位；保证不超过 8。',
  });
}

// The shares of the four texels around a place in a level; `next`: the level below the one told.
function sharesIn({ uv, level_size: size }, next) {
  const parts = uv.map((value, i) => {
    const side = next && size[i] > 1 ? Math.floor(size[i] / 2) : size[i];
    const place = value * side - 0.5;
    return place - Math.floor(place);
  });
  return [0, 1, 2, 3].map((i) => (i & 1 ? parts[0] : 1 - parts[0]) * (i > 1 ? parts[1] : 1 - parts[1]));
}

function showTexture(parent, look) {
  const { slot, level, level_size: size, place, texel, texels } = look;
  const whole = Math.floor(level);
  const head = add(parent, 'p');
  const at = place.map((value) => short(value)).join(', ');
  head.append(say({
    en: `${say(wordOf(slot))}: level ${short(level)}; level ${whole} has ${size.join('×')} texels, and the place is (${at}). It gives `,
    zh: `${say(wordOf(slot))}：层级 ${short(level)}；第 ${whole} 级有 ${size.join('×')} 个纹素，位置为 (${at})。结果：`,
  }), swatch(texel));
  const rows = texels.flatMap((four, next) =>
    four.map((color, i) => [String(whole + next), sharesIn(look, next === 1)[i].toFixed(4), swatch(color)]),
  );
  table(parent, [{ en: 'level', zh: '层级' }, { en: 'weight', zh: '权重' }, { en: 'texel', zh: '纹素' }], rows);
}

function showTextures(parent, { textures }) {
  if (textures.length === 0) {
    return;
  }
  const block = section(parent, TITLES.textures);
  note(block, {
    en: 'The level follows from how far u and v go from pixel to pixel. Around a place lie the four texels that are mixed, in this level and, by its fraction, in the next.',
    zh: '层级取决于 u、v 在相邻像素间变化多少。位置周围的四个纹素按权重混合；层级有小数时，再与下一级混合。',
  });
  textures.forEach((look) => showTexture(block, look));
}

// The whole --------------------------------------------------------------------------------------------

function showHead(parent, { pixel, size, sample, samples, color }) {
  const head = add(parent, 'p', [], 'pixel');
  const node = add(head, 'span', [], 'swatch');
  node.style.background = color;
  const of = samples > 1 ? { en: `, sample ${sample + 1} of ${samples}`, zh: `，第 ${sample + 1} 个采样（共 ${samples} 个）` } : { en: '', zh: '' };
  head.append(say({
    en: `Pixel P = (${pixel}) of ${size.join('×')}${of.en}, is ${color}`,
    zh: `像素 P = (${pixel})，图像 ${size.join('×')}${of.zh}，颜色 ${color}`,
  }));
}

/** Fills `steps` with the way to the weights, as the other chapters have it, and `tables` with everything else. */
export function showModelDerivation(steps, tables, explanation) {
  const seen = explanation && seenIn(explanation);
  fill(steps, () => {
    if (explanation) {
      const head = document.createElement('div');
      showHead(head, explanation);
      if (!seen) {
        note(head, { en: 'Nothing of the model is seen here.', zh: '此处看不到模型。' });
      }
      slot(steps, head, () => head);
    }
    if (seen) {
      weightSections(steps, numbersOf(seen));
    }
  });
  tables.replaceChildren();
  if (seen) {
    showCorners(tables, seen);
  }
  if (seen?.varyings) {
    showValues(tables, seen);
    showTextures(tables, seen);
  }
  if (explanation) {
    showHistory(tables, explanation);
  }
}
