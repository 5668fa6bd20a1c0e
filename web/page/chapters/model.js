// SPDX-License-Identifier: MIT
// A model of one's own: dropped in, looked at from all sides, and explained pixel by pixel. The work is done in a worker.
import { choice } from '../controls.js';
import { termsOf } from '../derivation.js';
import { chosenFiles, droppedFiles, modelOf } from '../dropped.js';
import { hearNumbers } from '../heard.js';
import { say } from '../language.js';
import { Library } from '../library.js';
import { namePicture } from '../naming.js';
import { numbersOf, seenIn, showModelDerivation, uvsOf } from '../model_derivation.js';
import { cornersOf, Overlay } from '../overlay.js';
import { centered, moved, panned, turned } from '../orbit.js';
import { draggable, svg } from '../svg.js';
import { chapterTerms } from '../tips.js';
import { add, clamp } from '../vector.js';

const SAMPLE = 'models/box.glb';
const AGREEABLE = 40; // ms for a picture while it moves
const REST = 180; // ms until it is refined
const CLICK = 4; // CSS pixels that a pointer may go and still have clicked

class ModelView {
  #library = new Library();
  #scale = 1; // of the picture's size while it moves
  #moving = false;
  #drawing = false;
  #again = false; // what is being drawn has become old
  #givesWay = false; // what is being drawn, to what moves
  #opened = 0; // how many models were asked for
  #asked = 0; // how many explanations
  #told = ''; // {en, zh} or a line of the library's

  still = { samples: 4 }; // how pictures are drawn that do not move
  givenUp = 0; // such pictures that gave way to one that moves

  constructor(section) {
    this.figure = section.querySelector('.view');
    this.canvas = section.querySelector('canvas');
    namePicture(this.canvas, this.figure);
    this.note = section.querySelector('.state');
    this.warnings = section.querySelector('.warnings');
    this.warnings.querySelector('button').addEventListener('click', () => this.#warn([]));
    this.info = section.querySelector('.info');
    this.takes = section.querySelector('.takes');
    this.steps = section.querySelector('.derivation');
    this.tables = section.querySelector('.explained');
    this.overlay = new Overlay(svg(this.figure, 'svg'));
    this.explanation = null;
    this.pixel = null; // by parts of the picture
    new ResizeObserver(() => {
      if (this.figure.clientWidth > 0) { // it has a place on the page
        this.#place();
        this.draw();
      }
    }).observe(this.figure);
    const meaning = { I: { en: 'value of the corner', zh: '顶点处的值' }, d: { en: 'depth, reversed: 1 near', zh: '深度（反向：近处为 1）' } };
    chapterTerms(section, () => this.#numbers() && termsOf(this.#numbers()), [this.overlay], meaning);
  }

  /** What was told, in the language of now. */
  retell() {
    this.#tell(this.#told);
    this.#describe();
    this.#show();
  }

  #tell(text) {
    this.#told = text;
    this.note.textContent = say(text);
    this.note.hidden = text === '';
  }

  // Warnings of reading stay until they are closed, or another model comes.
  #warn(lines) {
    this.warnings.hidden = lines.length === 0;
    const items = lines.map((line) => Object.assign(document.createElement('li'), { textContent: line }));
    this.warnings.querySelector('ul').replaceChildren(...items);
  }

  #numbers() {
    const seen = this.explanation && seenIn(this.explanation);
    return seen ? numbersOf(seen) : null;
  }

  #show() {
    showModelDerivation(this.steps, this.tables, this.explanation);
    const numbers = this.#numbers();
    hearNumbers(this.steps, numbers);
    this.takes.hidden = !numbers;
    const someBehind = numbers && cornersOf(numbers).some((clip) => !(clip[3] > 0));
    this.takes.querySelectorAll('button').forEach((button) => (button.hidden = someBehind && button.value !== 'clip'));
    this.#place();
  }

  /** Shows the triangle of the pixel in another chapter, by its view there. */
  takeTo(other) {
    const seen = seenIn(this.explanation);
    other?.take({ clips: seen.clip, space: seen.space, screen: seen.screen, uvs: uvsOf(seen) });
    (other?.figure ?? other?.root).closest('section').scrollIntoView();
  }

  #place() {
    const { clientWidth, clientHeight } = this.figure;
    this.overlay.place({ size: [clientWidth, clientHeight], pixel: this.pixel, numbers: this.#numbers() });
  }

  #describe() {
    if (this.model) {
      const { format, triangles_drawn: triangles, materials } = this.model;
      this.info.textContent = say({
        en: `${this.name}: ${format}; triangles: ${triangles}; materials: ${materials.length}.`,
        zh: `${this.name}：${format}，${triangles} 个三角形，${materials.length} 种材质。`,
      });
    }
  }

  // Reading ------------------------------------------------------------------------------------------

  /** Takes the place of what was shown, if it can be read. `files`: those that it names, by paths that count from where `path` does. */
  async open(bytes, path, files = {}) {
    const turn = ++this.#opened;
    const name = path.split('/').at(-1);
    this.#tell({ en: `Reading ${name} …`, zh: `正在读取 ${name}……` });
    this.figure.dataset.drawn = '';
    try {
      const { info, warnings } = await this.#library.ask('open', { model: bytes, name: path, files });
      const { eye, target, up, fovy = 30 } = await this.#library.ask('view', { options: { size: this.#size(1) } });
      if (turn !== this.#opened) {
        return; // another was chosen meanwhile
      }
      const camera = { eye, target, up, fovy }; // in perspective, also where the file's is without
      Object.assign(this, { model: info, name });
      this.middle = info.frame.empty ? camera.target : info.frame.min.map((low, i) => (low + info.frame.max[i]) / 2);
      this.camera = centered(camera, this.middle, info.up);
      this.far = Math.hypot(...add(this.camera.eye, this.camera.target, -1));
      this.#forget();
      this.#describe();
      this.#tell('');
      this.#warn(warnings);
    } catch (error) {
      if (turn === this.#opened) {
        this.#tell(error.message);
      }
    }
    this.draw();
  }

  /** Opens the model of a promised list of [path, File]. */
  async openFiles(list) {
    let model, problem;
    const turn = ++this.#opened;
    try {
      model = await modelOf(await list);
    } catch ({ message }) {
      problem = {
        en: `${message}: cannot be read. Drop the folder of the model, or all of its files.`,
        zh: `${message}：无法读取。请拖入模型所在的文件夹，或其全部文件。`,
      };
    }
    if (turn !== this.#opened) {
      return; // another was chosen meanwhile
    }
    if (problem) {
      this.#tell(problem);
    } else if (model) {
      await this.open(model.bytes, model.name, model.files);
    } else {
      this.#tell({ en: 'There is no file in this folder.', zh: '此文件夹中没有文件。' });
    }
  }

  /** Opens a file of the page's. */
  async openSample(path) {
    try {
      const response = await fetch(path);
      if (!response.ok) {
        throw new Error(`${response.status} ${response.statusText}`);
      }
      await this.open(await response.arrayBuffer(), path.split('/').at(-1));
    } catch (error) {
      this.#tell(`${path}: ${error.message}`);
    }
  }

  // Drawing ------------------------------------------------------------------------------------------

  #size(scale) {
    const { clientWidth: width, clientHeight: height } = this.figure;
    const across = Math.min(Math.round(width * Math.min(devicePixelRatio, 2)), 1280) * scale;
    return [Math.max(1, Math.round(across)), Math.max(1, Math.round((across * height) / width))];
  }

  #options(moving) {
    const coarse = moving ? { samples: 1, ambientOcclusion: false } : this.still;
    return { size: this.#size(moving ? this.#scale : 1), camera: this.camera, interpolate: this.interpolate, ...coarse };
  }

  // Pictures that move are as large as can be drawn in time.
  async #drawOnce(moving) {
    const started = performance.now();
    const asked = this.#library.ask('draw', { picture: this.picture, options: this.#options(moving) });
    this.#givesWay = !moving;
    const drawn = await asked;
    this.#givesWay = false;
    if (!drawn) {
      this.givenUp++;
      return;
    }
    const { image, width, height } = drawn;
    this.canvas.width = width;
    this.canvas.height = height;
    this.canvas.getContext('2d').putImageData(new ImageData(image, width, height), 0, 0);
    this.figure.dataset.drawn = moving ? 'moving' : 'still';
    if (moving) {
      this.#scale = clamp(this.#scale * Math.sqrt(AGREEABLE / (performance.now() - started)), 0.2, 1);
    }
  }

  /** Draws what is asked for now, once what is being drawn is done. */
  async draw() {
    this.#again = this.#drawing;
    if (!this.camera || this.#drawing) {
      return;
    }
    this.#drawing = true;
    const moving = this.#moving;
    try {
      await this.#drawOnce(moving);
    } catch (error) {
      this.#tell(error.message);
    }
    this.#drawing = false;
    if (moving) { // what moved was seen at least once
      clearTimeout(this.timer);
      this.timer = setTimeout(() => {
        this.#moving = false;
        this.draw();
      }, REST);
    }
    if (this.#again) {
      this.draw();
    }
  }

  // What was told of a pixel of another picture.
  #forget() {
    this.#asked++;
    this.explanation = null;
    this.pixel = null;
    this.#show();
  }

  /** Draws from another camera, or with other settings, those of a choice. */
  set(changes) {
    Object.assign(this, changes);
    this.#forget();
    this.draw();
  }

  #change(camera) {
    this.camera = camera;
    this.#forget();
    this.#moving = true;
    if (this.#givesWay) { // pictures of what moves do not: each would give way to the next
      this.#givesWay = false;
      this.#library.giveUp();
    }
    clearTimeout(this.timer);
    this.draw();
  }

  turn(dx, dy) {
    this.#change(turned(this.camera, this.middle, dx, dy));
  }

  pan(dx, dy) {
    this.#change(panned(this.camera, dx / this.figure.clientHeight, dy / this.figure.clientHeight));
  }

  zoom(factor) {
    const { eye, target } = this.camera;
    const far = Math.hypot(...add(eye, target, -1));
    this.#change(moved(this.camera, clamp(far * factor, this.far / 1000, this.far * 1000) / far));
  }

  /** The pixel at these parts of the picture's width and height. */
  async explain(x, y) {
    const options = this.#options(false);
    this.#forget();
    const turn = this.#asked;
    this.pixel = [x, y];
    this.#place();
    this.#tell({ en: 'Explaining …', zh: '正在计算……' });
    try {
      const at = { x: Math.floor(x * options.size[0]), y: Math.floor(y * options.size[1]) };
      const explanation = await this.#library.ask('explain', { ...at, options });
      this.#tell('');
      if (turn === this.#asked) {
        this.explanation = explanation;
        this.#show();
      }
    } catch (error) {
      this.#tell(error.message);
    }
  }
}

function listenForFiles(section, view) {
  const input = section.querySelector('input[type="file"]');
  input.addEventListener('change', async () => {
    await view.openFiles(chosenFiles(input.files));
    input.value = ''; // the same file may have been mended
  });
  section.querySelector('.choose').addEventListener('click', () => input.click());
  section.querySelector('.sample').addEventListener('click', () => view.openSample(SAMPLE));
  // Wherever on the page: a browser would leave it for the file.
  for (const kind of ['dragover', 'dragleave', 'drop']) {
    document.addEventListener(kind, (event) => {
      event.preventDefault();
      view.figure.classList.toggle('over', kind === 'dragover');
      if (kind === 'drop' && event.dataTransfer.files.length > 0) {
        section.scrollIntoView();
        view.openFiles(droppedFiles(event.dataTransfer));
      }
    });
  }
}

// Two fingers: what lies between them moves with their middle, and grows with their distance.
function listenForPinch(view) {
  const { canvas } = view;
  const fingers = new Map();
  const of = () => {
    const [a, b] = [...fingers.values()];
    return { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, apart: Math.hypot(a.x - b.x, a.y - b.y) };
  };
  canvas.addEventListener('pointerdown', (event) => fingers.set(event.pointerId, { x: event.clientX, y: event.clientY }));
  canvas.addEventListener('pointermove', (event) => {
    if (fingers.size !== 2 || !fingers.has(event.pointerId) || !view.camera) {
      return;
    }
    const before = of();
    fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    const after = of();
    view.pan(after.x - before.x, after.y - before.y);
    view.zoom(Math.max(before.apart, 1) / Math.max(after.apart, 1));
  });
  for (const kind of ['pointerup', 'pointercancel']) {
    canvas.addEventListener(kind, (event) => fingers.delete(event.pointerId));
  }
  return () => fingers.size > 1;
}

function listenForHands(view) {
  const { canvas } = view;
  const pinches = listenForPinch(view);
  let way = 0; // of the pointer since it went down
  canvas.addEventListener('pointerdown', ({ button }) => (way = pinches() || button !== 0 ? Infinity : 0));
  canvas.addEventListener('pointerup', (event) => {
    const box = canvas.getBoundingClientRect();
    if (way < CLICK && view.camera) {
      view.explain((event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height);
    }
  });
  draggable(canvas, {
    move(dx, dy, event) {
      way += Math.abs(dx) + Math.abs(dy);
      if (view.camera && !pinches()) {
        event.shiftKey ? view.pan(dx, dy) : view.turn(dx, dy);
      }
    },
    step: (dx, dy, deeper) => view.camera && (deeper ? view.zoom(0.9 ** deeper) : view.turn(12 * dx, 12 * dy)),
    scrolls: true, // until there is a model, which page.css sees to
  });
  canvas.addEventListener('wheel', (event) => {
    if (view.camera && canvas === document.activeElement) {
      event.preventDefault();
      view.zoom(Math.exp(event.deltaY * 0.001));
    }
  });
}

export function start(section, _stage, views) {
  const view = new ModelView(section);
  section.querySelectorAll('.takes button').forEach((button) => button.addEventListener('click', () => view.takeTo(views[button.value])));
  for (const name of ['picture', 'interpolate']) {
    choice(section, name, (value) => view.set({ [name]: value }));
  }
  listenForFiles(section, view);
  listenForHands(view);
  return view;
}
