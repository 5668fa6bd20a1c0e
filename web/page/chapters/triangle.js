// SPDX-License-Identifier: MIT
// One triangle with its corners 82, 44 and 114 units away: colours and a checkerboard, naive and correct, its depth, and the
// picture as a PPM file.
import { choice } from '../controls.js';
import { showDerivation, termsOf } from '../derivation.js';
import { METHOD, PATTERN } from '../stage.js';
import { chapterTerms } from '../tips.js';
import { within } from '../vector.js';
import { View } from '../view.js';

const SIZE = 512;

/** A binary PPM of the picture as it is. */
export function ppm(rgba, width, height) {
  const head = new TextEncoder().encode(`P6\n${width} ${height}\n255\n`);
  const file = new Uint8Array(head.length + 3 * width * height);
  file.set(head);
  for (let i = 0, to = head.length; i < rgba.length; i += 4) {
    file[to++] = rgba[i];
    file[to++] = rgba[i + 1];
    file[to++] = rgba[i + 2];
  }
  return file;
}

function save(file, name) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([file]));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

export function start(section, stage) {
  const corners = [
    { at: [-48, 10, -82], color: [1, 0, 0], uv: [0, 1] },
    { at: [29, 15, -44], color: [0, 1, 0], uv: [1, 1] },
    { at: [13, -34, -114], color: [0, 0, 1], uv: [0.5, 0] },
  ];
  const paper = corners.map((corner) => ({ ...corner, color: [1, 1, 1] }));
  const scene = {
    camera: { eye: [0, 0, 0], target: [0, 0, -1], yfov: 90, near: 40, far: 200 },
    corners,
    width: SIZE,
    samples: 1,
    background: [0, 0, 0],
    split: 0.5,
    limit: within([-100, -100, -190], [100, 100, -41]),
    triangleOf: () => corners,
    draw(to, { canvas }) {
      const middle = Math.round(this.split * canvas.width);
      paper.forEach((corner, i) => (corner.at = corners[i].at));
      const drawn = this.pattern === PATTERN.checker ? paper : corners;
      to.triangle(drawn, METHOD.naive, this.pattern, 0, middle);
      to.triangle(drawn, METHOD.correct, this.pattern, middle, canvas.width);
    },
  };
  const panel = section.querySelector('.derivation');
  const view = new View(stage, section.querySelector('.view'), scene, (numbers, pixel, size) => {
    if (view.writes) {
      showDerivation(panel, numbers, pixel, size, scene.pattern === PATTERN.colors ? 'green' : 'u');
    }
  });
  choice(section, 'pattern', (value) => {
    scene.pattern = PATTERN[value];
    view.update();
  });
  section.querySelector('.save').addEventListener('click', () => {
    const image = view.canvas.getContext('2d').getImageData(0, 0, SIZE, SIZE);
    save(ppm(image.data, SIZE, SIZE), 'triangle.ppm');
  });
  chapterTerms(section, () => view.numbers && termsOf(view.numbers), [view]);
  view.pick([0.508, 0.469]);
  return view;
}
