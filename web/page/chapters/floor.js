// SPDX-License-Identifier: MIT
// A floor of two triangles, its texture coordinates found in three ways.
import { choice } from '../controls.js';
import { showDerivation, termsOf } from '../derivation.js';
import { METHOD, PATTERN } from '../stage.js';
import { numbersIn, numbersText } from '../state.js';
import { chapterTerms } from '../tips.js';
import { clamp } from '../vector.js';
import { View } from '../view.js';

const white = [1, 1, 1];
const CORNERS = [
  { at: [-1, 0, -1], color: white, uv: [0, 0] },
  { at: [-1, 0, 1], color: white, uv: [0, 1] },
  { at: [1, 0, 1], color: white, uv: [1, 1] },
  { at: [1, 0, -1], color: white, uv: [1, 0] },
];
const TRIANGLES = [
  [CORNERS[0], CORNERS[1], CORNERS[2]],
  [CORNERS[0], CORNERS[2], CORNERS[3]],
];
const METHODS = [METHOD.naive, METHOD.world, METHOD.correct];

// From (0, 1.5, 1.5) at the start; turned around the middle of the floor.
function eyeAt(azimuth, elevation) {
  const [distance, a, e] = [1.5 * Math.SQRT2, (azimuth * Math.PI) / 180, (elevation * Math.PI) / 180];
  return [distance * Math.sin(a) * Math.cos(e), distance * Math.sin(e), distance * Math.cos(a) * Math.cos(e)];
}

export function start(section, stage) {
  const angles = { azimuth: 0, elevation: 45 };
  const scene = {
    camera: { eye: [0, 1.5, 1.5], target: [0, 0, 0], yfov: 50, near: 0.1, far: 20 },
    corners: [],
    triangleOf: (draw) => TRIANGLES[draw % 2],
    turn(dx, dy) {
      this.look(angles.azimuth - 0.4 * dx, angles.elevation + 0.3 * dy);
    },
    look(azimuth, elevation) {
      angles.azimuth = azimuth % 360;
      angles.elevation = clamp(elevation, 8, 88);
      this.camera.eye = eyeAt(angles.azimuth, angles.elevation);
    },
    draw(to, { canvas }) {
      const methods = this.method === 'all' ? METHODS : [METHOD[this.method]];
      methods.forEach((method, i) => {
        const [first, end] = [i, i + 1].map((part) => Math.round((part * canvas.width) / methods.length));
        TRIANGLES.forEach((triangle) => to.triangle(triangle, method, PATTERN.floor, first, end));
      });
    },
  };
  const panel = section.querySelector('.derivation');
  const view = new View(stage, section.querySelector('.view'), scene, (numbers, pixel, size) => {
    if (view.writes) {
      showDerivation(panel, numbers, pixel, size);
    }
  });
  choice(section, 'method', (value) => {
    scene.method = value;
    section.querySelector('.bands').hidden = value !== 'all';
    view.update();
  });
  chapterTerms(section, () => view.numbers && termsOf(view.numbers), [view]);
  const [save, restore] = [view.save.bind(view), view.restore.bind(view)];
  Object.assign(view, {
    save: () => ({ ...save(), from: numbersText([angles.azimuth, angles.elevation]) }),
    restore(values) {
      scene.look(...(numbersIn(values, 'from', 2) ?? [angles.azimuth, angles.elevation]));
      restore(values);
    },
  });
  view.pick([0.2, 0.6]);
  return view;
}
