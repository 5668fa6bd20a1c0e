// SPDX-License-Identifier: MIT
// Begins: loads the library, starts each chapter when it comes near, and the two switches.
import { language, setLanguage, whenLanguage } from './language.js';
import { typeset } from './math.js';
import { Stage } from './stage.js';
import { startTips } from './tips.js';

const compiled = WebAssembly.compileStreaming(fetch('stage.wasm'));

function keep(name, value) {
  try {
    localStorage.setItem(name, value);
  } catch {
    // A page from a file, or one that may keep nothing, forgets.
  }
}

function kept(name) {
  try {
    return localStorage.getItem(name);
  } catch {
    return null;
  }
}

function startLanguage() {
  const button = document.querySelector('#language');
  button.addEventListener('click', () => {
    setLanguage(language() === 'en' ? 'zh' : 'en');
    keep('language', language());
  });
  whenLanguage(() => {
    button.textContent = language() === 'en' ? '中文' : 'English';
  });
  setLanguage(kept('language') ?? (navigator.language.startsWith('zh') ? 'zh' : 'en'));
}

function startTheme() {
  const dark = matchMedia('(prefers-color-scheme: dark)');
  const set = (theme) => {
    document.documentElement.dataset.theme = theme;
  };
  set(kept('theme') ?? (dark.matches ? 'dark' : 'light'));
  document.querySelector('#theme').addEventListener('click', () => {
    set(document.documentElement.dataset.theme === 'dark' ? 'light' : 'dark');
    keep('theme', document.documentElement.dataset.theme);
  });
}

/** The pictures of the page by name, and the stage that draws them, for tests and the curious. */
window.rhw = { views: {} };

const MOST_THREADS = 4; // pictures are small, and the page has other work

// The first picture does not wait for threads; nor need there be any.
function tryThreads(stage) {
  const threads = Math.min(navigator.hardwareConcurrency, MOST_THREADS);
  if (globalThis.crossOriginIsolated && threads > 1) {
    stage.tryThreads(threads).catch((error) => console.warn(error));
  }
}

function startChapter(section, stage) {
  const name = section.id;
  import(`./chapters/${name}.js`)
    .then(({ start }) => {
      const view = start(section, stage);
      window.rhw.views[name] = view;
      whenLanguage(() => view?.retell());
      if (name === 'first') {
        whenDrawn(view, () => tryThreads(stage));
      }
    })
    .catch((error) => fail(section, error));
}

function fail(section, error) {
  const note = section.querySelector('.view') ?? section.appendChild(document.createElement('figure'));
  note.classList.add('view');
  note.dataset.error = error.message;
  console.error(error);
}

function whenDrawn({ figure }, callback) {
  const seen = new MutationObserver(() => {
    if (figure.dataset.drawn) {
      seen.disconnect();
      callback();
    }
  });
  seen.observe(figure, { attributeFilter: ['data-drawn'] });
}

function startChapters(stage) {
  window.rhw.stage = stage;
  const near = new IntersectionObserver(
    (entries) => {
      for (const { isIntersecting, target } of entries) {
        if (isIntersecting) {
          near.unobserve(target);
          startChapter(target, stage);
        }
      }
    },
    { rootMargin: '600px' },
  );
  document.querySelectorAll('section.chapter').forEach((section) => near.observe(section));
}

startLanguage();
startTheme();
typeset(document);
startTips();
compiled
  .then(Stage.create)
  .then(startChapters)
  .catch((error) => fail(document.querySelector('#first'), error));
