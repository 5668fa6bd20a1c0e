// SPDX-License-Identifier: MIT
// Names for those who hear the page.
import { say, whenLanguage } from './language.js';

/** Names a drawing with parts to drag, {en, zh}, as a group. */
export function nameDrawing(root, name) {
  root.setAttribute('role', 'group');
  whenLanguage(() => root.setAttribute('aria-label', say(name)));
}

/** Names a corner to drag, and says its keys. */
export function nameCorner(node, name) {
  whenLanguage(() => node.setAttribute('aria-label', say({ en: `corner ${name}: arrow keys, page up and down`, zh: `顶点 ${name}：方向键与翻页键移动` })));
}

/** What makes a slider of a part of a drawing, at a part of its way. */
export const percentOf = (part) => ({ role: 'slider', 'aria-valuemin': 0, 'aria-valuemax': 100, 'aria-valuenow': Math.round(100 * part) });

/** Names a picture after its caption, or the heading of its chapter where it has none, and says its keys. */
export function namePicture(canvas, figure) {
  whenLanguage(() => {
    const lang = say({ en: 'en', zh: 'zh' });
    const caption = figure.dataset[lang] ?? figure.closest('section').querySelector(`:is(h1, h2)[lang="${lang}"]`).textContent;
    const keys = canvas.tabIndex < 0 ? '' : say({ en: ' (arrow keys)', zh: '（方向键）' });
    canvas.setAttribute('aria-label', say({ en: `Picture: ${caption}${keys}`, zh: `图像：${caption}${keys}` }));
  });
}
