// SPDX-License-Identifier: MIT
// The library's stage (web/stage/stage.h) as an object of JavaScript. It remembers what it was told, line by line: a file of
// such lines draws the same bytes natively (tests/web).

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
  #functions;
  #names;
  #lines = new Map(); // by what they set, in the order of setting

  /** `module` is a compiled stage.wasm. */
  static async create(module) {
    const stage = new Stage();
    const imports = surroundings(() => stage.#functions.memory);
    stage.#functions = (await WebAssembly.instantiate(module, imports)).exports;
    stage.#functions._initialize();
    stage.#check(stage.#functions.stage_open(1));
    stage.#names = stage.#text(stage.#functions.stage_number_names()).split(',');
    return stage;
  }

  #text(address) {
    const bytes = new Uint8Array(this.#functions.memory.buffer, address);
    return new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)));
  }

  #check(success) {
    if (!success) {
      throw new Error(this.#text(this.#functions.stage_error()));
    }
  }

  #call(name, numbers) {
    return this.#functions[`stage_${name}`](...numbers);
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

  /** [height][width] RGBA; the module's memory, until the next call. */
  draw() {
    const address = this.#functions.stage_draw();
    this.#check(address);
    return new Uint8ClampedArray(this.#functions.memory.buffer, address, 4 * this.width * this.height);
  }

  /** X, Y, Z, W of a point of the world. */
  clip(point) {
    return Array.from(new Float64Array(this.#functions.memory.buffer, this.#call('clip', point), 4));
  }

  /** The numbers of what is seen at a pixel, by their names in stage_number_names; null where nothing is. */
  explain(x, y) {
    const address = this.#functions.stage_explain(x, y);
    if (!address) {
      return null;
    }
    const numbers = new Float64Array(this.#functions.memory.buffer, address, this.#names.length);
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
