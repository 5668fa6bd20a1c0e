// SPDX-License-Identifier: MIT
// Rows of buttons of which one is chosen: <div class="choice" data-name="pattern"><button value="colors">..</div>; and sliders.
import { say, whenLanguage } from './language.js';
import { short } from './math.js';

const NAMES = {
  curve: { en: 'what is plotted', zh: '绘制的曲线' },
  code: { en: 'programming language', zh: '编程语言' },
  pattern: { en: 'what the triangle shows', zh: '三角形上显示的内容' },
  method: { en: 'way of computing', zh: '算法' },
  picture: { en: 'what the picture shows', zh: '图像显示的内容' },
  interpolate: { en: 'way of mixing', zh: '插值方式' },
};

/** Calls `chosen(value)` for the row of that name; the first button is chosen at the start. */
export function choice(section, name, chosen) {
  const row = section.querySelector(`[data-name="${name}"]`);
  const buttons = [...row.querySelectorAll('button')];
  row.setAttribute('role', 'group');
  whenLanguage(() => row.setAttribute('aria-label', say(NAMES[name])));
  const choose = (button) => {
    buttons.forEach((other) => other.setAttribute('aria-pressed', other === button));
    chosen(button.value);
  };
  buttons.forEach((button) => button.addEventListener('click', () => choose(button)));
  choose(buttons[0]);
}

const TIMES = 2.3; // as near and as far as a slider goes that names no range

/** The section's slider for the distance W of a corner of the view. Returns what shows the distance of now on it. */
export function distanceSlider(section, view, corner) {
  const slider = section.querySelector('[name="distance"]');
  const ranged = slider.hasAttribute('max');
  slider.addEventListener('input', () => view.moveTo(corner, Number(slider.value)));
  return () => {
    const w = view.stageClip(corner.at)[3];
    if (!ranged && !(slider.dataset.around / TIMES <= w && w <= slider.dataset.around * TIMES)) {
      slider.dataset.around = w;
      [slider.min, slider.max] = [w / TIMES, w * TIMES];
    }
    slider.value = w;
    slider.setAttribute('aria-valuetext', short(w));
  };
}
