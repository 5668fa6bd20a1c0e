// SPDX-License-Identifier: MIT
// A picture of the page: a canvas that a stage draws into, what lies over it (corners to drag, a line between two ways of
// drawing, the pixel that is explained and what a term means there), and the pointer.
import { nextFrame } from './frame.js';
import { say, whenLanguage } from './language.js';
import { nameCorner, namePicture } from './naming.js';
import { onScreen, Overlay } from './overlay.js';
import { measure, sizeOf } from './size.js';
import { script } from './stage.js';
import { numbersIn, numbersText } from './state.js';
import { draggable, set, stepsOf, svg } from './svg.js';
import { add, basis, clamp, dot, normalize } from './vector.js';

const MAX_PIXELS = 1280; // across
const LAST = 0.999999; // of a picture's width or height
const REST = 160; // ms without a change until the picture is refined
const TAP = 4; // CSS pixels that a pointer may go and still have tapped
const WORDS = 3; // pictures that move, until numbers are written again: nobody reads faster

// How far the line between two ways of drawing is, for those who do not see it.
function sliderAt(split) {
  const percent = Math.round(100 * split);
  const text = say({ en: `left ${percent} % naive, right divided by w`, zh: `左 ${percent} % 未校正，右边除以 w` });
  return { 'aria-valuemin': 0, 'aria-valuemax': 100, 'aria-valuenow': percent, 'aria-valuetext': text };
}

export class View {
  /**
   * `figure` has room for it. `scene` is {camera, corners: [{at, color, uv}..], split: 0..1 or undefined, draw(stage, view),
   * samples, width, quiet: true where no pixel is explained, alongRays: true where corners are pushed away from the eye}; `changed(numbers)` is called when the picture or the pixel did.
   */
  constructor(stage, figure, scene, changed = () => {}) {
    this.stage = stage;
    this.scene = scene;
    this.changed = changed;
    this.figure = figure;
    this.canvas = document.createElement('canvas');
    this.canvas.tabIndex = scene.quiet ? -1 : 0;
    this.canvas.setAttribute('role', scene.quiet ? 'img' : 'application');
    namePicture(this.canvas, figure);
    this.context = this.canvas.getContext('2d', { alpha: false });
    this.overlay = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
    figure.prepend(this.canvas, this.overlay);
    this.moved = 0; // pictures since it began to move
    this.pixel = null; // by parts of the picture, so that it stays where it was when the size changes
    this.#build();
    if (!scene.quiet) {
      this.#listen();
    }
    new ResizeObserver(() => this.update()).observe(figure);
    new IntersectionObserver((entries) => {
      this.seen = entries.at(-1).isIntersecting; // there may be several since the last call
      this.update();
    }).observe(figure);
  }

  // What lies over the picture ----------------------------------------------------------------------

  #build() {
    this.explained = new Overlay(this.overlay);
    if (this.scene.split !== undefined) {
      this.#buildSplit();
    }
    this.handles = this.scene.corners.map((corner, i) => this.#buildHandle(corner, 'ABC'[i]));
  }

  #buildSplit() {
    this.divider = svg(this.overlay, 'g', { class: 'divider', tabindex: 0, role: 'slider' });
    svg(this.divider, 'line', { class: 'wide' });
    svg(this.divider, 'line', { class: 'thin' });
    svg(this.divider, 'rect', { x: -15, width: 30, height: 30, rx: 15 });
    svg(this.divider, 'path', { d: 'M-4,-5 L-9,0 L-4,5 M4,-5 L9,0 L4,5' });
    this.names = ['naive', 'correct'].map((name) => svg(this.overlay, 'text', { class: `name ${name}`, y: 24 }));
    whenLanguage(() => {
      this.names[0].textContent = say({ en: 'naive', zh: '未校正' });
      this.names[1].textContent = say({ en: 'divided by w', zh: '除以 w' });
      this.divider.setAttribute('aria-label', say({ en: 'between naive and correct', zh: '未校正与校正的分界' }));
    });
    const to = (part) => {
      this.scene.split = clamp(part, 0, 1);
      this.update(true);
    };
    draggable(this.divider, {
      move: (dx) => to(this.scene.split + dx / sizeOf(this.figure)[0]),
      step: (dx, dy, deeper) => to(this.scene.split + (dx - dy) / 50 + deeper / 10),
      ends: (part) => to(part),
    });
  }

  #buildHandle(corner, name) {
    const node = svg(this.overlay, 'g', { class: `handle corner${name}`, tabindex: 0, role: 'button' });
    svg(node, 'circle', { class: 'reach', r: 22 });
    svg(node, 'circle', { class: 'dot', r: 8 });
    svg(node, 'text', { x: 12, y: 5 }, name);
    nameCorner(node, name);
    draggable(node, {
      move: (dx, dy, event) => (event.shiftKey ? this.#push(corner, -dy) : this.#shift(corner, dx, dy)),
      step: (dx, dy, deeper) => (deeper ? this.#push(corner, 10 * deeper) : this.#shift(corner, 4 * dx, 4 * dy)),
    });
    node.addEventListener('wheel', (event) => {
      if (node === document.activeElement) {
        event.preventDefault(); // of what was not taken hold of the page scrolls
        this.#push(corner, clamp(-event.deltaY, -40, 40) / 4);
      }
    });
    return node;
  }

  // Moves a corner across the view, so that it stays under the pointer.
  #shift(corner, dx, dy) {
    const high = sizeOf(this.figure)[1];
    if (high === 0) {
      return; // there is no picture to drag in
    }
    const { right, up } = basis(this.scene.camera);
    const w = Math.abs(this.stageClip(corner.at)[3]);
    const scale = (2 * Math.tan((this.scene.camera.yfov * Math.PI) / 360) * w) / high;
    this.moveCorner(corner, add(add(corner.at, right, dx * scale), up, -dy * scale));
  }

  // Moves it along the view, or its ray.
  #push(corner, distance) {
    const { camera, alongRays } = this.scene;
    const way = alongRays ? normalize(add(corner.at, camera.eye, -1)) : basis(camera).forward;
    this.#moveDeeper(corner, add(corner.at, way, distance / 100));
  }

  /** Moves it along the view, or its ray, to this W. */
  moveTo(corner, w) {
    const { camera, alongRays } = this.scene;
    const { forward } = basis(camera);
    const from = add(corner.at, camera.eye, -1);
    const now = dot(from, forward);
    this.#moveDeeper(corner, alongRays ? add(camera.eye, from, w / now) : add(corner.at, forward, w - now));
  }

  // Along its ray it goes as far as it may: a limit would push it off the ray.
  #moveDeeper(corner, at) {
    const limited = this.scene.limit?.(at) ?? at;
    if (!this.scene.alongRays || limited.every((value, i) => Math.abs(value - at[i]) < 1e-9)) {
      this.moveCorner(corner, at);
    }
  }

  moveCorner(corner, at) {
    corner.at = this.scene.limit ? this.scene.limit(at) : at;
    this.update(true);
  }

  // The pointer ----------------------------------------------------------------------------------------

  #listen() {
    const at = (event) => {
      const box = this.canvas.getBoundingClientRect();
      return [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height];
    };
    this.canvas.addEventListener('pointermove', (event) => {
      if (event.pointerType === 'mouse' ? event.buttons === 0 : !this.scene.turn) {
        this.pick(at(event)); // a finger slides across; up and down it scrolls
      }
    });
    this.canvas.addEventListener('pointerdown', (event) => this.pick(at(event)));
    if (this.divider) {
      this.#listenOnDivider(at);
    }
    if (this.scene.turn) {
      draggable(this.canvas, {
        move: (dx, dy, event) => {
          this.scene.turn(dx, dy);
          this.pixel = at(event).map((part) => clamp(part, 0, LAST));
          this.update(true);
        },
        step: (dx, dy) => this.#stepPixel(dx, dy),
        ends: (part) => this.#toEnd(part),
        scrolls: true,
      });
    } else {
      this.canvas.addEventListener('keydown', (event) => this.#onKey(event));
    }
  }

  // What lies under the line between two ways of drawing is pointed at by who passes over it, or taps and does not drag.
  #listenOnDivider(at) {
    let down = [0, 0];
    this.divider.addEventListener('pointerdown', ({ clientX, clientY }) => (down = [clientX, clientY]));
    this.divider.addEventListener('pointermove', (event) => event.buttons === 0 && this.pick(at(event)));
    this.divider.addEventListener('pointerup', (event) => {
      if (Math.hypot(event.clientX - down[0], event.clientY - down[1]) < TAP) {
        this.pick(at(event));
      }
    });
  }

  #onKey(event) {
    const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (step) {
      event.preventDefault();
      this.#stepPixel(...step.map((part) => part * stepsOf(event)));
    } else if (event.key === 'Home' || event.key === 'End') {
      event.preventDefault();
      this.#toEnd(event.key === 'Home' ? 0 : 1);
    }
  }

  // The first pixel of the row, or the last.
  #toEnd(part) {
    this.pick([part, this.pixel?.[1] ?? 0.5]);
  }

  #stepPixel(dx, dy) {
    const [x, y] = this.pixel ?? [0.5, 0.5];
    this.pick([x + dx / this.canvas.width, y + dy / this.canvas.height]);
  }

  /** Explains the pixel at these parts of the picture's width and height. */
  pick([x, y]) {
    this.pixel = [clamp(x, 0, LAST), clamp(y, 0, LAST)];
    nextFrame(this.explain);
  }

  explain = () => {
    if (this.pixel && (this.clips || this.#fit())) { // what nobody has seen yet has no size of its own
      this.#prepare(); // others may have used the stage
      this.#tell();
      this.#place();
    }
  };

  // What the stage knows of the pixel, once it was told of this picture.
  #tell() {
    const [x, y] = [Math.floor(this.pixel[0] * this.canvas.width), Math.floor(this.pixel[1] * this.canvas.height)];
    this.numbers = this.stage.explain(x, y);
    this.place = [x, y];
    this.size = [this.canvas.width, this.canvas.height];
    this.changed(this.numbers, this.place, this.size);
  }

  /** Whether numbers are to be written for this picture: all that is still, and some of what moves. */
  get writes() {
    return !this.moving || this.moved % WORDS === 1;
  }

  /** What was told, in the language of now. */
  retell() {
    if (this.clips) {
      this.changed(this.numbers ?? null, this.place ?? null, this.size);
    }
    this.update();
  }

  // Drawing --------------------------------------------------------------------------------------------

  /** Something changed; `moving`: and may go on changing, so speed counts. */
  update(moving = false) {
    this.moved = moving ? this.moved : 0;
    this.moving = moving;
    nextFrame(this.#frame);
    clearTimeout(this.timer);
    if (moving) {
      this.timer = setTimeout(() => this.update(), REST);
    }
  }

  // Tells the stage everything, as others use it too.
  #prepare() {
    const { scene, stage, canvas } = this;
    stage.resize(canvas.width, canvas.height, this.moving ? 1 : (scene.samples ?? 4));
    stage.camera(scene.camera);
    stage.clear(scene.background ?? [0.09, 0.11, 0.14]);
    scene.draw(stage, this);
  }

  // Gives the canvas its pixels. Returns false where there is no room.
  #fit() {
    const [width, high] = sizeOf(this.figure);
    if (width === 0) {
      return false;
    }
    const across = this.scene.width ?? Math.min(Math.round(width * Math.min(devicePixelRatio, 2)), MAX_PIXELS);
    const height = Math.round((across * high) / width);
    if (this.canvas.width !== across || this.canvas.height !== height) {
      this.canvas.width = across;
      this.canvas.height = height;
    }
    return true;
  }

  #frame = () => {
    if (!this.seen || !this.#fit()) {
      return;
    }
    this.moved += this.moving;
    this.#prepare();
    const image = new ImageData(this.stage.draw(), this.canvas.width, this.canvas.height);
    this.context.putImageData(image, 0, 0);
    this.lines = this.stage.lines();
    this.drawnAt ??= performance.now();
    const drawn = this.moving ? 'moving' : 'still';
    if (this.figure.dataset.drawn !== drawn) {
      this.figure.dataset.drawn = drawn;
    }
    this.clips = this.scene.corners.map((corner) => this.stage.clip(corner.at));
    if (this.pixel) {
      this.#tell();
    } else {
      this.changed(null, null);
    }
    this.#place();
  };

  /** What the stage was told for this picture, a call a line. */
  get script() {
    return script(this.lines);
  }

  /** Draws at once, seen or not. */
  drawForPaper() {
    const { seen } = this;
    this.seen = true;
    this.moving = false;
    measure(this.figure);
    this.#frame();
    this.seen = seen;
  }

  /** The clip coordinates of a point, in this picture: the stage may have drawn another, of another shape. */
  stageClip(point) {
    const { stage, canvas } = this;
    if (this.clips && (stage.width !== canvas.width || stage.height !== canvas.height)) {
      stage.resize(canvas.width, canvas.height, 1);
    }
    this.stage.camera(this.scene.camera);
    return this.stage.clip(point);
  }

  #place() {
    const [width, height] = sizeOf(this.figure);
    this.handles.forEach((handle, i) => {
      const at = this.clips && onScreen(this.clips[i], [width, height]);
      handle.toggleAttribute('hidden', !at);
      if (at) {
        const seen = [clamp(at[0], 10, width - 10), clamp(at[1], 10, height - 10)];
        set(handle, { transform: `translate(${seen})` });
        const side = seen[0] > width - 34 ? { x: -12, 'text-anchor': 'end' } : { x: 12, 'text-anchor': 'start' };
        set(handle.querySelector('text'), side);
        handle.classList.toggle('away', seen[0] !== at[0] || seen[1] !== at[1]);
      }
    });
    if (this.divider) {
      const x = this.scene.split * width;
      set(this.divider, { transform: `translate(${x},0)`, ...sliderAt(this.scene.split) });
      this.divider.querySelectorAll('line').forEach((line) => set(line, { y2: height }));
      set(this.divider.querySelector('rect'), { y: height - 48 });
      set(this.divider.querySelector('path'), { transform: `translate(0,${height - 33})` });
      set(this.names[0], { x: x - 12, 'text-anchor': 'end' });
      set(this.names[1], { x: x + 12 });
    }
    this.explained.place({
      size: [width, height],
      pixel: this.pixel,
      numbers: this.numbers,
      named: this.scene.triangleOf?.(this.numbers?.triangle) === this.scene.corners,
      polygon: this.scene.outline?.(this.numbers),
    });
  }

  /** {name: text} for the page's address: the corners, the pixel and the line between. */
  save() {
    const corners = this.scene.corners.map(({ at }, i) => ['ABC'[i], numbersText(at)]);
    const others = { P: this.pixel, split: this.scene.split === undefined ? null : [this.scene.split] };
    const lists = Object.entries(others).filter(([, list]) => list);
    return Object.fromEntries([...corners, ...lists.map(([name, list]) => [name, numbersText(list)])]);
  }

  /** What was saved, as URLSearchParams; what is not there stays. */
  restore(values) {
    this.scene.corners.forEach((corner, i) => {
      const at = numbersIn(values, 'ABC'[i], 3);
      corner.at = at ? (this.scene.limit?.(at) ?? at) : corner.at;
    });
    const [split] = numbersIn(values, 'split', 1) ?? [];
    if (split !== undefined && this.scene.split !== undefined) {
      this.scene.split = clamp(split, 0, 1);
    }
    const pixel = numbersIn(values, 'P', 2);
    if (pixel) {
      this.pick(pixel);
    }
    this.update();
  }

  /** Shows where a term is in the picture; null: none. */
  point(term) {
    this.explained.point(term);
  }
}
