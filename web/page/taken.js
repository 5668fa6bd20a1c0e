// SPDX-License-Identifier: MIT
// The triangle of a pixel of the reader's model in a chapter, in place of the chapter's own: with its W and its texture coordinates.
// It is moved and enlarged on the screen, which no share sees.
import { say, whenLanguage } from './language.js';
import { sizeOf } from './size.js';
import { numbersIn, numbersText } from './state.js';
import { add, basis, dot, within } from './vector.js';

const ACROSS = 1.5; // of the 2 that a picture is wide, and high

const TRIANGLE = { en: 'This is the triangle of the pixel of your model.', zh: '这是你的模型中那个像素所在的三角形。' };

/** What says, {en, zh}, that a chapter has such a triangle: the way back to the model, and to the chapter's own (`giveBack()`). */
export function takenNote(section, giveBack, texts = TRIANGLE) {
  const note = document.createElement('p');
  note.className = 'taken note';
  const [text, back, own] = ['span', 'a', 'button'].map((tag) => note.appendChild(document.createElement(tag)));
  back.href = '#model';
  own.type = 'button';
  own.addEventListener('click', giveBack);
  whenLanguage(() => {
    text.textContent = say(texts);
    back.textContent = say({ en: 'Back to the model', zh: '回到模型' });
    own.textContent = say({ en: 'restore this chapter’s own figure', zh: '恢复本章原来的图形' });
  });
  note.hidden = true;
  section.querySelector(':scope > :is(.stage, .pair)').before(note);
  return note;
}

const distances = ({ camera, corners }) => corners.map(({ at }) => dot(add(at, camera.eye, -1), basis(camera).forward));

// Room for corners that are so far away.
function makeRoom(scene, nearer) {
  const ws = distances(scene);
  const near = Math.min(...ws.filter((w) => w > 0));
  const far = Math.max(...ws.map(Math.abs));
  Object.assign(scene.camera, { near: near * nearer, far: far * 5 });
  const reach = [4 * far, 4 * far, 4 * far];
  const { eye } = scene.camera;
  const behind = Math.min(...ws) > 0 ? -near / 4 : 4 * far; // what was in front of the eye stays there
  scene.limit = within(add(eye, reach, -1), add(eye, [4 * far, 4 * far, behind]));
}

// Puts the corners where they have these clip coordinates, but for the middle and the size of what is seen. Returns P's place by
// parts of the picture.
function place(view, { clips, space, uvs }) {
  const { camera, corners } = view.scene;
  const [width, height] = sizeOf(view.figure);
  const seen = clips.filter((clip) => clip[3] > 0).map(([x, y, , w]) => [x / w, y / w]);
  const p = [0, 1, 3].map((axis) => clips.reduce((sum, clip, i) => sum + space[i] * clip[axis], 0));
  const [low, high] = [Math.min, Math.max].map((of) => [0, 1].map((k) => of(p[k] / p[2], ...seen.map((at) => at[k]))));
  const middle = [0, 1].map((k) => (low[k] + high[k]) / 2);
  const scale = ACROSS / Math.max(high[0] - low[0], high[1] - low[1], 1e-9);
  const { right, up, forward } = basis(camera);
  const tall = Math.tan((camera.yfov * Math.PI) / 360);
  clips.forEach(([x, y, , w], i) => {
    const [across, above] = [(x - middle[0] * w) * scale, (y - middle[1] * w) * scale];
    corners[i].at = add(add(add(camera.eye, forward, w), right, (across * tall * width) / height), up, above * tall);
    corners[i].uv = uvs?.[i] ?? corners[i].uv;
  });
  const [x, y] = [0, 1].map((k) => (p[k] / p[2] - middle[k]) * scale);
  return [(x + 1) / 2, (1 - y) / 2];
}

/**
 * Lets the chapter of `view` take a triangle: view.take({clips: [X, Y, Z, W] of its corners, space: P's a, b, c, uvs: [u, v] of the
 * corners, or none}). The near plane stands at `nearer` times the nearest W. `changed(taken)` is called when the triangle was
 * exchanged.
 */
export function takeable(section, view, { nearer = 0.1, changed = () => {} } = {}) {
  const { scene } = view;
  const own = { ats: scene.corners.map(({ at }) => at), uvs: scene.corners.map(({ uv }) => uv), camera: { ...scene.camera }, limit: scene.limit };
  const use = (taken) => {
    scene.taken = taken;
    note.hidden = !taken;
    changed(taken);
    view.update();
  };
  const giveCornersBack = () => scene.corners.forEach((corner, i) => Object.assign(corner, { at: own.ats[i], uv: own.uvs[i] }));
  const giveBack = () => {
    giveCornersBack();
    Object.assign(scene.camera, own.camera);
    scene.limit = own.limit;
    use(false);
    view.pick(own.pixel);
  };
  const note = takenNote(section, giveBack);
  view.take = (triangle) => {
    own.pixel ??= view.pixel;
    const pixel = place(view, triangle);
    makeRoom(scene, nearer);
    use(true);
    view.pick(pixel);
  };
  const [save, restore] = [view.save.bind(view), view.restore.bind(view)];
  view.save = () => ({ ...save(), ...(scene.taken ? { taken: numbersText(scene.corners.flatMap(({ uv }) => uv)) } : {}) });
  view.restore = (values) => {
    const uvs = numbersIn(values, 'taken', 6);
    const ats = ['A', 'B', 'C'].map((name) => numbersIn(values, name, 3));
    own.pixel ??= view.pixel;
    if (!uvs && scene.taken && [...values.keys()].some((name) => 'ABC'.includes(name))) {
      giveBack();
    }
    if (uvs && ats.every(Boolean)) {
      scene.corners.forEach((corner, i) => Object.assign(corner, { at: ats[i], uv: uvs.slice(2 * i, 2 * i + 2) }));
      if (distances(scene).some((w) => w > 1e-30)) {
        makeRoom(scene, nearer);
        use(true);
      } else {
        giveCornersBack();
      }
    }
    restore(values);
  };
}
