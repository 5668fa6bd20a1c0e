// SPDX-License-Identifier: MIT
// Cameras {eye, target, up, fovy} that are moved around a model: each function gives another one.
import { add, basis, cross, dot, normalize } from './vector.js';

const RADIANS = 0.006; // for each CSS pixel of a drag

const axisOf = (name) => ['x', 'y', 'z'].map((axis) => (name.at(-1) !== axis ? 0 : name[0] === '-' ? -1 : 1));

/** The same view, its target beside the middle of the model, to come nearer to, and its up that of the world ("y", "-z", ..). */
export function centered(camera, middle, up) {
  const { forward } = basis(camera);
  const distance = dot(add(middle, camera.eye, -1), forward);
  const target = distance > 0 ? add(camera.eye, forward, distance) : camera.target;
  const steep = Math.abs(dot(forward, axisOf(up))) > 0.995;
  return { ...camera, target, up: steep ? camera.up : axisOf(up) };
}

// Rodrigues' rotation.
function rotate(v, axis, angle) {
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  const along = dot(axis, v) * (1 - c);
  const across = cross(axis, v);
  return v.map((value, i) => value * c + across[i] * s + axis[i] * along);
}

/** Turned about a point by a drag: around the camera's own right, not beyond looking straight down, and the world's up. */
export function turned(camera, middle, dx, dy) {
  const { right, forward } = basis(camera);
  const lift = (v) => rotate(v, right, -dy * RADIANS);
  const steep = Math.abs(dot(normalize(lift(forward)), camera.up)) > 0.995;
  const turn = (point) => {
    const from = add(point, middle, -1);
    return add(middle, rotate(steep ? from : lift(from), camera.up, -dx * RADIANS));
  };
  return { ...camera, eye: turn(camera.eye), target: turn(camera.target) };
}

/** Moved along the picture by parts of its height. */
export function panned(camera, right, down) {
  const directions = basis(camera);
  const from = add(camera.eye, camera.target, -1);
  const height = 2 * Math.sqrt(dot(from, from)) * Math.tan((camera.fovy * Math.PI) / 360);
  const shift = add(add([0, 0, 0], directions.right, -right * height), directions.up, down * height);
  return { ...camera, eye: add(camera.eye, shift), target: add(camera.target, shift) };
}

/** As many times as far from the target. */
export const moved = (camera, factor) => ({
  ...camera,
  eye: add(camera.target, add(camera.eye, camera.target, -1), factor),
});
