// SPDX-License-Identifier: MIT
// Along a line of pixels over a slanted plane: depth and 1/W are straight, W is a hyperbola, and W mixed naively is wrong.
import { choice } from '../controls.js';
import { termsOf } from '../derivation.js';
import { hear } from '../heard.js';
import { formulaIn, short } from '../math.js';
import { legend, Plot } from '../plot.js';
import { fill, text } from '../slots.js';
import { METHOD, PATTERN } from '../stage.js';
import { takeable } from '../taken.js';
import { chapterTerms } from '../tips.js';
import { within } from '../vector.js';
import { View } from '../view.js';

const SAMPLES = 48; // of the plot
const ROWS = 27; // of the small picture that they are taken from

const CURVES = [
  { name: { en: 'depth Z/W: straight', zh: '深度 Z/W：直线' }, kind: 'depth', scale: 'depth', of: (n) => n.depth },
  { name: { en: '1/W: straight', zh: '1/W：直线' }, kind: 'inverse', scale: 'inverse', of: (n) => n.inverse_w },
  { name: { en: 'W: curved', zh: 'W：曲线' }, kind: 'w', scale: 'w', of: (n) => 1 / n.inverse_w },
  {
    name: { en: 'W mixed naively: wrong', zh: '直接插值的 W：错误' },
    kind: 'naive',
    scale: 'w',
    of: (n) => n.r * n.W_0 + n.s * n.W_1 + n.t * n.W_2,
  },
];

const AXES = { x: { en: 'place on the screen', zh: '屏幕位置' }, y: { en: 'each from 0 to the number beside its name', zh: '各曲线的纵轴从 0 到名称旁所标的值' } };

// A curve's name with its scale.
function named(plot, curve) {
  const most = short(Number(plot.largest(curve).toPrecision(3)));
  return { ...curve, name: { en: `${curve.name.en}, 0 to ${most}`, zh: `${curve.name.zh}，0 到 ${most}` } };
}

export function start(section, stage) {
  const corners = [
    { at: [-1.25, -0.72, -1.8], color: [1, 1, 1], uv: [0, 1] },
    { at: [4.4, -1, -6.5], color: [1, 1, 1], uv: [1, 1] },
    { at: [-1.1, 0.9, -2.2], color: [1, 1, 1], uv: [0, 0] },
  ];
  const scene = {
    camera: { eye: [0, 0, 0], target: [0, 0, -1], yfov: 50, near: 1, far: 12 },
    corners,
    limit: within([-4, -2, -9], [6, 2, -1.2]),
    triangleOf: () => corners,
    draw(to) {
      to.triangle(corners, METHOD.correct, this.pattern);
    },
  };
  const plot = new Plot(section.querySelector('.plot-room'), { axes: AXES });
  const line = section.querySelector('.values');
  // A picture of few pixels tells the same as a large one.
  const sample = (part) => {
    stage.resize(SAMPLES, ROWS, 1);
    stage.camera(scene.camera);
    stage.clear([0, 0, 0]);
    scene.draw(stage);
    const row = Math.floor(part * ROWS);
    return Array.from({ length: SAMPLES }, (_, x) => stage.explain(x, row));
  };
  const names = section.querySelector('.legend');
  const view = new View(stage, section.querySelector('.view'), scene, (numbers) => {
    const along = sample(view.pixel?.[1] ?? 0.5);
    const curves = CURVES.map((curve) => ({ ...curve, values: along.map((n) => (n ? curve.of(n) : NaN)) }));
    plot.show(curves, view.pixel?.[0] ?? null);
    legend(names, curves.map((curve) => named(plot, curve)));
    fill(line, () => {
      if (numbers) {
        const terms = termsOf(numbers);
        const values = { d_P: short(terms.d_P), W_P: short(terms.W_P) };
        hear(line, `Z/W ${values.d_P}, W ${values.W_P}`);
        for (const term of ['d_P', 'W_P']) {
          formulaIn(line, term);
          formulaIn(line, `= ${term}`, values);
          text(line, '\u2003');
        }
      }
    });
  });
  choice(section, 'pattern', (value) => {
    scene.pattern = PATTERN[value];
    view.update();
  });
  chapterTerms(section, () => view.numbers && termsOf(view.numbers), [view]);
  takeable(section, view, { nearer: 0.7 });
  view.pick([0.45, 0.55]);
  return view;
}
