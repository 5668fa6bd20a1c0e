// SPDX-License-Identifier: MIT
// The library's stage (web/stage/stage.h) as an object of JavaScript. It remembers what it was told, line by line: a file of
// such lines draws the same bytes natively (tests/web). Where pages may share memory it goes on with threads once the first
// picture is there, which needs none.

const no = () => 0;

// What the module asks of its surroundings: a clock, and a place for messages that the library never writes here.
function surroundings(memory) {
  const view = () => new DataView(memory().buffer);
  return {
    env: { emscripten_notify_memory_growth: no, __call_sighandler: no },
    wasi_snapshot_preview1: {
      clock_time_get(_clock, _precision, result) {
        view().setBigUint64(result, BigInt(Math.round(performance.now() * 1e6)), true);
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

export class Stage {
  #functions; // of the module, without "stage_" before their names
  #buffer; // () => its memory
  #names;
  #lines = new Map(); // by what they set, in the order of setting

  /** `module` is a compiled stage.wasm. */
  static async create(module) {
    const stage = new Stage();
    let exports;
    exports = (await WebAssembly.instantiate(module, surroundings(() => exports.memory))).exports;
    exports._initialize();
    stage.#take((name) => exports[`stage_${name}`], () => exports.memory.buffer, 1);
    stage.#names = stage.#text(stage.#call('number_names')).split(',');
    return stage;
  }

  /** Goes on with so many threads: those of the page's own and workers. */
  async useThreads(threads) {
    const { default: create } = await import('./stage-threads.js');
    const module = await create({ helpThreads: threads - 1 });
    this.#take((name) => module[`_stage_${name}`], () => module.HEAPU8.buffer, threads);
    if (this.width) {
      this.#call('resize', this.#lines.get('resize').slice(1)); // all else is told anew for every picture
    }
  }

  #take(functions, buffer, threads) {
    this.#functions = functions;
    this.#buffer = buffer;
    this.#check(this.#call('open', [threads]));
    this.threads = threads;
  }

  // A copy, as text cannot be made of memory that is shared.
  #read(Type, address, count) {
    return new Type(this.#buffer(), address, count).slice();
  }

  #text(address) {
    const all = new Uint8Array(this.#buffer());
    return new TextDecoder().decode(all.slice(address, all.indexOf(0, address)));
  }

  #check(success) {
    if (!success) {
      throw new Error(this.#text(this.#call('error')));
    }
  }

  #call(name, numbers = []) {
    return this.#functions(name)(...numbers);
  }

  /** Pixels; 1, 2, 4, 8 or 16 samples of each. */
  resize(width, height, samples) {
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
    const address = this.#call('draw');
    this.#check(address);
    const pixels = new Uint8ClampedArray(this.#buffer(), address, 4 * this.width * this.height);
    return pixels.buffer instanceof ArrayBuffer ? pixels : pixels.slice(); // no image takes memory that is shared
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

  /** What this stage was told, a call a line. */
  script() {
    const lines = [];
    for (const [key, line] of this.#lines) {
      lines.push(...(key === 'triangles' ? line : [line]));
    }
    return lines.map((line) => `${line.join(' ')}\n`).join('');
  }
}
