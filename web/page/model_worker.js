// SPDX-License-Identifier: MIT
// Reads and draws a model beside the page, so that the page stays quick: a worker of chapters/model.js. It answers every
// message {id, call, ...} with {id, result} or {id, error}. The first message has `turn`, memory that the page counts up to give
// up what is drawn, or null.
import { load } from './rhw/index.js';

let scene;
let turn;

const bytes = (count, fill) => {
  const pixels = new Uint8ClampedArray(4 * count);
  for (let i = 0; i < count; i++) {
    pixels.set([...fill(i), 255], 4 * i);
  }
  return pixels;
};

// A number as a colour that differs from its neighbours': steps of the golden angle round the hues.
function colorOf(id) {
  const hue = (id * 137.508) % 360;
  const wave = (shift) => 140 + 95 * Math.cos(((hue + shift) * Math.PI) / 180);
  return id === 0 ? [24, 28, 34] : [wave(0), wave(240), wave(120)];
}

const PICTURES = {
  color: { output: 'color', pixels: ({ color }) => color },
  normal: {
    output: 'normal',
    pixels: ({ normal: n, width, height }) =>
      bytes(width * height, (i) => (n[4 * i + 3] ? [0, 1, 2].map((k) => 127.5 + 127.5 * n[4 * i + k]) : [24, 28, 34])),
  },
  depth: {
    output: 'distance',
    pixels({ distance, width, height }) {
      const [near, far] = distance.reduce(([a, b], d) => (d < Infinity ? [Math.min(a, d), Math.max(b, d)] : [a, b]), [Infinity, 0]);
      return bytes(width * height, (i) => Array(3).fill(distance[i] < Infinity ? 235 - (190 * (distance[i] - near)) / (far - near || 1) : 0));
    },
  },
  uv: {
    output: 'uv',
    pixels: ({ uv, width, height }) =>
      bytes(width * height, (i) =>
        uv[4 * i + 3] ? [255 * (uv[4 * i] - Math.floor(uv[4 * i])), 255 * (uv[4 * i + 1] - Math.floor(uv[4 * i + 1])), 0] : [24, 28, 34],
      ),
  },
  triangle: {
    output: 'triangle',
    pixels: ({ triangle, width, height }) => bytes(width * height, (i) => colorOf(triangle[i])),
  },
};

const CALLS = {
  async open({ model, name, files }) {
    const next = await load(model, { name, files, maxTexture: 2048 });
    scene?.close();
    scene = next;
    return { info: scene.info(), warnings: scene.warnings };
  },
  view: ({ options }) => scene.view(options).camera,
  draw({ picture, options, mine }) {
    const { output, pixels } = PICTURES[picture];
    const goesOn = turn ? () => Atomics.load(turn, 0) === mine : undefined;
    try {
      const drawn = scene.render({ ...options, outputs: [output], goesOn });
      const image = new Uint8ClampedArray(pixels(drawn));
      return { image, width: drawn.width, height: drawn.height, warnings: drawn.warnings };
    } catch (error) {
      if (goesOn?.() === false) {
        return null;
      }
      throw error;
    }
  },
  explain: ({ x, y, options }) => scene.explain(x, y, options),
};

self.onmessage = async ({ data: { id, call, ...what } }) => {
  if (call === undefined) {
    turn = what.turn;
    return;
  }
  try {
    const result = await CALLS[call](what);
    self.postMessage({ id, result }, result?.image ? [result.image.buffer] : []);
  } catch (error) {
    self.postMessage({ id, error: error.message });
  }
};
