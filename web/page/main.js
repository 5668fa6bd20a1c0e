// SPDX-License-Identifier: MIT
// Begins: loads the library, starts each chapter when it comes near, and the two switches.
import { language, setLanguage, whenLanguage } from './language.js';
import { typeset } from './math.js';
import { Stage } from './stage.js';
import { startTips } from './tips.js';

// Of a server that does not know the type of the file, too.
async function compile(path) {
  const response = await fetch(path);
  if (!response.ok) {
    throw new Error(`${path}: ${response.status} ${response.statusText}`);
  }
  const isKnown = response.headers.get('content-type') === 'application/wasm';
  return isKnown ? WebAssembly.compileStreaming(response) : WebAssembly.compile(await response.arrayBuffer());
}

const compiled = compile('stage.wasm');

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

const begun = new Set(); // names of chapters

/** Starts a chapter, once. What could not be fetched is tried again when the network is back. */
function startChapter(section, stage, tries = 0) {
  const name = section.id;
  if (begun.has(name) && tries === 0) {
    return;
  }
  begun.add(name);
  import(`./chapters/${name}.js${tries > 0 ? `?${tries}` : ''}`) // a browser may keep what failed
    .then(({ start }) => {
      delete viewOf(section).dataset.error;
      const view = start(section, stage);
      window.rhw.views[name] = view;
      whenLanguage(() => view?.retell());
      if (name === 'first') {
        whenDrawn(view, () => {
          tryThreads(stage);
          startOthers(stage);
        });
      }
    })
    .catch((error) => {
      fail(section, error);
      addEventListener('online', () => startChapter(section, stage, tries + 1), { once: true });
    });
}

// The chapters further down, one after the other when there is nothing else to do: the network may go before they are come to.
function startOthers(stage) {
  const next = window.requestIdleCallback ?? ((callback) => setTimeout(callback, 50));
  const waiting = [...document.querySelectorAll('section.chapter')];
  const startNext = () => {
    startChapter(waiting.shift(), stage);
    if (waiting.length > 0) {
      next(startNext);
    }
  };
  next(startNext);
}

const viewOf = (section) => section.querySelector('.view') ?? section.appendChild(document.createElement('figure'));

function fail(section, error) {
  const note = viewOf(section);
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
