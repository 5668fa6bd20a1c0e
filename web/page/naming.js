// SPDX-License-Identifier: MIT
// Names for those who hear the page.
import { say, whenLanguage } from './language.js';

/** Names the picture of a chapter after its heading, and says its keys. */
export function namePicture(canvas, section) {
  whenLanguage(() => {
    const heading = section.querySelector(`:is(h1, h2)[lang="${say({ en: 'en', zh: 'zh' })}"]`).textContent;
    const keys = say({ en: 'arrow keys', zh: '方向键' });
    canvas.setAttribute('aria-label', say({ en: `Picture: ${heading} (${keys})`, zh: `图像：${heading}（${keys}）` }));
  });
}
