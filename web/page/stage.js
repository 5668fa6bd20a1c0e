// SPDX-License-Identifier: MIT
// The library's stage (web/stage/stage.h) as an object of JavaScript. It remembers what it was told, line by line: a file of
// such lines draws the same bytes natively (tests/web). Where pages may share memory there is a second module with threads, once
// the first picture is drawn, which needs none. The two draw a few pictures in turn, and the quicker one goes on: on a machine
// that is busy a picture waits for the last of its threads, and one thread is quicker.

const no = () => 0;

// What the module asks of its surroundings: a clock, and a place for messages that the library never writes here.
function surroundings(memory) {
  const view = () => new DataView(memory().buffer);
  return {
    env: { emscripten_notify_memory_growth: no, __call_sighandler: no },
    wasi_snapshot_preview1: {
      clock_time_get(_clock, _precision, result) {
        const nanoseconds = Math.round(performance.now() * 1e6);
        const at = view();
        at.setUint32(result, nanoseconds % 2 ** 32, true);
        at.setUint32(result + 4, nanoseconds / 2 ** 32, true);
        return 0;
      },
      proc_exit(code) {
        throw new Error(`stage.wasm ended with ${code}`);
      },
      fd_write(_file, _parts, _count, written) {
        view().setUint32(written, 0, true);
        return 0;
      },
      fd_close: no,
      fd_seek: no,
    },
  };
}

export const METHOD = { naive: 0, correct: 1, world: 2 };
export const PATTERN = { colors: 0, checker: 1, floor: 2, depth: 3, inverseW: 4, uv: 5, uvOverW: 6 };

const TRIAL = 7; // pictures of each

const middle = (times) => [...times].sort((a, b) => a - b)[times.length >> 1];

export class Stage {
  #modules = []; // {functions: name without "stage_" → function, buffer: () => its memory, threads, times}
  #module; // of them, the one that is told and asked
  #settled; // the one that goes on when the next picture begins
  #trying = false;
  #names;
  #lines = new Map(); // by what they set, in the order of setting

  /** `module` is a compiled stage.wasm. */
  static async create(module) {
    const stage = new Stage();
    let exports;
    exports = (await WebAssembly.instantiate(module, surroundings(() => exports.memory))).exports;
    exports._initialize();
    stage.#open((name) => exports[`stage_${name}`], () => exports.memory.buffer, 1);
    stage.#modules.push(stage.#module);
    stage.#names = stage.#text(stage.#call('number_names')).split(',');
    return stage;
  }

  /** Tries so many threads: the page's own and workers. */
  async tryThreads(threads) {
    const { default: create } = await import('./stage-threads.js');
    const module = await create({ helpThreads: threads - 1 });
    const before = this.#module;
    try {
      this.#open((name) => module[`_stage_${name}`], () => module.HEAPU8.buffer, threads);
      const [, ...size] = this.#lines.get('resize') ?? ['resize', 1, 1, 1]; // nothing has been drawn yet
      this.#check(this.#call('resize', size)); // all else is told anew for every picture
      this.#modules.push(this.#module);
    } finally {
      this.#module = before;
    }
    this.#trying = true;
  }

  #open(functions, buffer, threads) {
    this.#module = { functions, buffer, threads, times: [] };
    this.#check(this.#call('open', [threads]));
  }

  get threads() {
    return this.#module.threads;
  }

  get mostThreads() {
    return Math.max(...this.#modules.map(({ threads }) => threads));
  }

  /** Goes on with so many threads, one or the most, from the next picture on: only this module knows the one that is shown. */
  settle(threads) {
    this.#trying = false;
    this.#settled = this.#modules.find((module) => module.threads === threads);
  }

  // After a picture that took so long.
  #compare(time) {
    this.#module.times.push(time);
    if (this.#modules.every(({ times }) => times.length >= TRIAL)) {
      const [one, several] = this.#modules.map(({ times }) => middle(times));
      this.settle(several < one ? this.mostThreads : 1);
    }
  }

  // A copy, as text cannot be made of memory that is shared.
  #read(Type, address, count) {
    return new Type(this.#module.buffer(), address, count).slice();
  }

  #text(address) {
    const all = new Uint8Array(this.#module.buffer());
    return new TextDecoder().decode(all.slice(address, all.indexOf(0, address)));
  }

  #check(success) {
    if (!success) {
      throw new Error(this.#text(this.#call('error')));
    }
  }

  #call(name, numbers = []) {
    return this.#module.functions(name)(...numbers);
  }

  /** Pixels; 1, 2, 4, 8 or 16 samples of each. */
  resize(width, height, samples) {
    if (this.#trying) { // a picture begins: the turn of the one that drew less
      this.#module = [...this.#modules].sort((a, b) => a.times.length - b.times.length)[0];
    } else if (this.#settled) {
      this.#module = this.#settled;
    }
    this.#lines.set('resize', ['resize', width, height, samples]);
    this.width = width;
    this.height = height;
    this.#check(this.#call('resize', [width, height, samples]));
  }

  /** `eye` and `target` are points of the world, `yfov` degrees. */
  camera({ eye, target, yfov, near, far }) {
    const numbers = [...eye, ...target, yfov, near, far];
    this.#lines.set('camera', ['camera', ...numbers]);
    this.#check(this.#call('camera', numbers));
  }

  /** Nothing but a colour, 0..1. */
  clear(color) {
    this.#lines.delete('triangles');
    this.#lines.set('clear', ['clear', ...color]);
    this.#lines.set('triangles', []);
    this.#call('clear', color);
  }

  /** Three corners {at: [x, y, z], color: [r, g, b], uv: [u, v]}, drawn by a METHOD with a PATTERN, in the given columns. */
  triangle(corners, method, pattern, first = 0, end = this.width) {
    const lines = this.#lines.get('triangles');
    corners.forEach((corner, i) => {
      const numbers = [i, ...corner.at, ...corner.color, ...corner.uv];
      lines.push(['corner', ...numbers]);
      this.#check(this.#call('corner', numbers));
    });
    lines.push(['triangle', method, pattern, first, end]);
    this.#check(this.#call('triangle', [method, pattern, first, end]));
  }

  /** [height][width] RGBA, until the next call. */
  draw() {
    const started = performance.now();
    const address = this.#call('draw');
    this.#check(address);
    const shown = new Uint8ClampedArray(this.#module.buffer(), address, 4 * this.width * this.height);
    const pixels = shown.buffer instanceof ArrayBuffer ? shown : shown.slice(); // no image takes memory that is shared
    if (this.#trying) {
      this.#compare(performance.now() - started);
    }
    return pixels;
  }

  /** X, Y, Z, W of a point of the world. */
  clip(point) {
    return Array.from(this.#read(Float64Array, this.#call('clip', point), 4));
  }

  /** The numbers of what is seen at a pixel, by their names in stage_number_names; null where nothing is. */
  explain(x, y) {
    const address = this.#call('explain', [x, y]);
    if (!address) {
      return null;
    }
    const numbers = this.#read(Float64Array, address, this.#names.length);
    return Object.fromEntries(this.#names.map((name, i) => [name, numbers[i]]));
  }

  /** What this stage was told, a call in each: script() makes a text of them. */
  lines() {
    return [...this.#lines].flatMap(([key, line]) => (key === 'triangles' ? [...line] : [line]));
  }
}

/** What a stage was told, a call a line: a file that draws the same bytes natively. */
export const script = (lines) => lines.map((line) => `${line.join(' ')}\n`).join('');
