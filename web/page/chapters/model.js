// SPDX-License-Identifier: MIT
// A model of one's own: dropped in, looked at from all sides, and explained pixel by pixel. The work is done in a worker.
import { choice } from '../controls.js';
import { say, whenLanguage } from '../language.js';
import { draggable } from '../svg.js';
import { add, basis, clamp, cross, dot, normalize } from '../vector.js';

const SAMPLE = 'models/box.glb';
const AGREEABLE = 40; // ms for a picture while it moves
const REST = 180; // ms until it is refined

// Calls of the worker, answered in turn.
class Library {
  #worker = new Worker(new URL('../model_worker.js', import.meta.url), { type: 'module' });
  #waiting = new Map();
  #count = 0;

  constructor() {
    this.#worker.onmessage = ({ data: { id, result, error } }) => {
      const { done, fail } = this.#waiting.get(id);
      this.#waiting.delete(id);
      error === undefined ? done(result) : fail(new Error(error));
    };
    this.#worker.onerror = (event) => {
      event.preventDefault();
      const error = new Error(event.message || 'the library could not be loaded');
      this.#waiting.forEach(({ fail }) => fail(error));
      this.#waiting.clear();
    };
  }

  ask(call, what = {}) {
    const id = ++this.#count;
    return new Promise((done, fail) => {
      this.#waiting.set(id, { done, fail });
      this.#worker.postMessage({ id, call, ...what });
    });
  }
}

// Turns around the target about the camera's own right and the world's up.
function turned(camera, dx, dy) {
  const { right } = basis(camera);
  const rotate = (v, axis, angle) => {
    const [c, s] = [Math.cos(angle), Math.sin(angle)];
    const k = dot(axis, v) * (1 - c);
    return v.map((value, i) => value * c + cross(axis, v)[i] * s + axis[i] * k);
  };
  const from = add(camera.eye, camera.target, -1);
  const lifted = rotate(from, right, -dy * 0.006);
  const steep = Math.abs(dot(normalize(lifted), camera.up)) > 0.995;
  return { ...camera, eye: add(camera.target, rotate(steep ? from : lifted, camera.up, -dx * 0.006)) };
}

export function start(section) {
  const library = new Library();
  const [figure, canvas, note] = ['.view', '.view canvas', '.state'].map((name) => section.querySelector(name));
  const [info, text] = [section.querySelector('.info'), section.querySelector('.explained')];
  const state = { camera: null, picture: 'color', interpolate: 'smooth', scale: 1, moving: false, busy: false, again: false };

  const tell = (texts) => {
    note.textContent = say(texts);
    note.hidden = note.textContent === '';
  };
  const fail = (error) => tell(error.message);

  const size = (scale) => {
    const across = Math.min(Math.round(figure.clientWidth * Math.min(devicePixelRatio, 2)), 1280) * scale;
    return [Math.max(1, Math.round(across)), Math.max(1, Math.round((across * figure.clientHeight) / figure.clientWidth))];
  };
  const options = (moving) => ({
    size: size(moving ? state.scale : 1),
    samples: moving ? 1 : 4,
    camera: state.camera,
    interpolate: state.interpolate,
    ambientOcclusion: !moving,
  });

  async function draw() {
    if (!state.camera || state.busy) {
      state.again = state.busy;
      return;
    }
    state.busy = true;
    const started = performance.now();
    const moving = state.moving;
    try {
      const drawn = await library.ask('draw', { picture: state.picture, options: options(moving) });
      canvas.width = drawn.width;
      canvas.height = drawn.height;
      canvas.getContext('2d').putImageData(new ImageData(drawn.image, drawn.width, drawn.height), 0, 0);
      figure.dataset.drawn = moving ? 'moving' : 'still';
      if (moving) {
        state.scale = clamp(state.scale * Math.sqrt(AGREEABLE / (performance.now() - started)), 0.2, 1);
      }
    } catch (error) {
      fail(error);
    }
    state.busy = false;
    if (state.again) {
      state.again = false;
      draw();
    }
  }

  function change(camera) {
    state.camera = camera;
    state.moving = true;
    clearTimeout(state.timer);
    state.timer = setTimeout(() => {
      state.moving = false;
      draw();
    }, REST);
    draw();
  }

  function describe() {
    if (state.model) {
      const { format, triangles_drawn: triangles, materials } = state.model.info;
      info.textContent = say({
        en: `${state.name}: ${format}, ${triangles} triangles, ${materials.length} materials.`,
        zh: `${state.name}：${format}，${triangles} 个三角形，${materials.length} 种材质。`,
      });
    }
  }

  async function open(model, name, files = {}) {
    tell({ en: `Reading ${name} …`, zh: `正在读取 ${name} …` });
    figure.dataset.drawn = '';
    try {
      state.model = await library.ask('open', { model, name, files });
      state.name = name;
      state.camera = await library.ask('view', { options: { size: size(1) } });
      state.moving = false;
      text.textContent = '';
      describe();
      tell(state.model.warnings.join('\n'));
      draw();
    } catch (error) {
      fail(error);
    }
  }

  // Of several files one is the model; the others are those that it names.
  async function openFiles(list) {
    const read = await Promise.all([...list].map(async (file) => [file.name, await file.arrayBuffer()]));
    const main = read.find(([name]) => /\.(gl[bt]f?|obj|ply|stl|3mf)$/i.test(name)) ?? read[0];
    if (main) {
      open(main[1], main[0], Object.fromEntries(read.filter((file) => file !== main)));
    }
  }

  async function explain(x, y) {
    const wanted = options(false);
    const at = [Math.floor(x * wanted.size[0]), Math.floor(y * wanted.size[1])];
    try {
      text.textContent = await library.ask('explain', { x: at[0], y: at[1], options: wanted });
    } catch (error) {
      fail(error);
    }
  }

  const input = section.querySelector('input[type="file"]');
  input.addEventListener('change', () => openFiles(input.files));
  section.querySelector('.choose').addEventListener('click', () => input.click());
  section.querySelector('.sample').addEventListener('click', async () => {
    const response = await fetch(SAMPLE);
    open(await response.arrayBuffer(), 'box.glb');
  });
  for (const kind of ['dragover', 'drop']) {
    section.addEventListener(kind, (event) => {
      event.preventDefault();
      if (kind === 'drop') {
        openFiles(event.dataTransfer.files);
      }
    });
  }

  let moved = 0;
  canvas.addEventListener('pointerdown', () => (moved = 0));
  canvas.addEventListener('pointerup', (event) => {
    const box = canvas.getBoundingClientRect();
    if (moved < 4 && state.camera) {
      explain((event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height);
    }
  });
  const pan = (dx, dy) => {
    const { right, up } = basis(state.camera);
    const from = add(state.camera.eye, state.camera.target, -1);
    const unit = Math.sqrt(dot(from, from)) / figure.clientHeight / 1.8;
    const shift = add(add([0, 0, 0], right, -dx * unit), up, dy * unit);
    change({ ...state.camera, eye: add(state.camera.eye, shift), target: add(state.camera.target, shift) });
  };
  const zoom = (factor) => {
    const from = add(state.camera.eye, state.camera.target, -1);
    change({ ...state.camera, eye: add(state.camera.target, from, factor) });
  };
  draggable(canvas, {
    move(dx, dy, event) {
      moved += Math.abs(dx) + Math.abs(dy);
      if (state.camera) {
        event.shiftKey ? pan(dx, dy) : change(turned(state.camera, dx, dy));
      }
    },
    step: (dx, dy, deeper) => state.camera && (deeper ? zoom(1 - 0.1 * deeper) : change(turned(state.camera, 12 * dx, 12 * dy))),
  });
  canvas.addEventListener('wheel', (event) => {
    if (state.camera) {
      event.preventDefault();
      zoom(Math.exp(event.deltaY * 0.001));
    }
  });
  for (const name of ['picture', 'interpolate']) {
    choice(section, name, (value) => {
      state[name] = value;
      draw();
    });
  }
  new ResizeObserver(() => draw()).observe(figure);
  whenLanguage(describe);
}
