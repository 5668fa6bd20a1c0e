// SPDX-License-Identifier: MIT
// Begins: loads the library, starts each chapter when it comes near, and the three switches.
import { startContents } from './contents.js';
import { startHearing } from './heard.js';
import { language, say, setLanguage, whenLanguage } from './language.js';
import { typeset } from './math.js';
import { Stage } from './stage.js';
import { keepState, noteInAddress, parse } from './state.js';
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
    noteInAddress('lang', language());
  });
  whenLanguage(() => {
    button.textContent = language() === 'en' ? '中文' : 'English';
  });
  const told = () => ['en', 'zh'].find((name) => name === parse(location.hash).values.get('lang'));
  setLanguage(told() ?? kept('language') ?? (navigator.language.startsWith('zh') ? 'zh' : 'en'));
  addEventListener('hashchange', () => told() && setLanguage(told()));
}

function startTheme() {
  const dark = matchMedia('(prefers-color-scheme: dark)');
  const set = (theme) => {
    document.documentElement.dataset.theme = theme;
  };
  const told = () => ['dark', 'light'].find((name) => name === parse(location.hash).values.get('theme'));
  set(told() ?? kept('theme') ?? (dark.matches ? 'dark' : 'light'));
  addEventListener('hashchange', () => told() && set(told()));
  const button = document.querySelector('#theme');
  whenLanguage(() => button.setAttribute('aria-label', say({ en: 'dark or light', zh: '深色或浅色' })));
  button.addEventListener('click', () => {
    set(document.documentElement.dataset.theme === 'dark' ? 'light' : 'dark');
    keep('theme', document.documentElement.dataset.theme);
    noteInAddress('theme', document.documentElement.dataset.theme);
  });
}

// The mathematics beside the text, folded away or not, all at once. Paper has all of it.
function startNotes() {
  const button = document.querySelector('#notes');
  const notes = [...document.querySelectorAll('details.notes')];
  const set = (open) => {
    button.setAttribute('aria-pressed', open);
    notes.forEach((note) => (note.open = open));
  };
  set(kept('notes') ? kept('notes') === 'open' : innerWidth >= 720); // on a phone they would come before the picture
  button.addEventListener('click', () => {
    set(button.getAttribute('aria-pressed') !== 'true');
    keep('notes', button.getAttribute('aria-pressed') === 'true' ? 'open' : 'closed');
  });
  addEventListener('beforeprint', () => set(true));
}

// Paper has every picture, also those that nobody has come to.
function startPrinting() {
  const views = () => Object.values(window.rhw.views).filter((view) => view?.drawForPaper);
  addEventListener('beforeprint', () => views().forEach((view) => view.drawForPaper()));
}

// A browser finds no chapter by an address that says more than its name.
function showAddressed() {
  const { chapter, values } = parse(location.hash);
  if (chapter && [...values].length > 0) {
    document.getElementById(chapter)?.scrollIntoView();
  }
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

// Each is fetched when it is wanted. Written out, so that one file can be made of all of them (web/single.py).
const CHAPTERS = {
  first: () => import('./chapters/first.js'),
  weights: () => import('./chapters/weights.js'),
  inverse: () => import('./chapters/inverse.js'),
  pixel: () => import('./chapters/pixel.js'),
  triangle: () => import('./chapters/triangle.js'),
  floor: () => import('./chapters/floor.js'),
  clip: () => import('./chapters/clip.js'),
  motion: () => import('./chapters/motion.js'),
  depth: () => import('./chapters/depth.js'),
  exercises: () => import('./chapters/exercises.js'),
  model: () => import('./chapters/model.js'),
};
// A browser may keep what failed: the same by another address.
const chapterOf = (name, tries) => (tries === 0 ? CHAPTERS[name]() : import(`./chapters/${name}.js?${tries}`));

const chapters = () => [...document.querySelectorAll('section.chapter')].filter(({ id }) => id in CHAPTERS);

const begun = new Set(); // names of chapters

let isFirst = true;

// Once there is a picture, whichever chapter was asked for, the rest begins.
function afterFirst(view, stage) {
  const begin = () => {
    if (isFirst) {
      isFirst = false;
      tryThreads(stage);
      startOthers(stage);
    }
  };
  if (isFirst) {
    view?.scene ? whenDrawn(view, begin) : setTimeout(begin, 1000); // what draws nothing yet waits for no picture
  }
}

/** Starts a chapter, once. What could not be fetched is tried again when the network is back. */
function startChapter(section, stage, tries = 0) {
  const name = section.id;
  if (begun.has(name) && tries === 0) {
    return;
  }
  begun.add(name);
  chapterOf(name, tries)
    .then(({ start }) => {
      delete viewOf(section).dataset.error;
      const view = start(section, stage, window.rhw.views);
      window.rhw.views[name] = view;
      whenLanguage(() => view?.retell());
      keepState(section, view);
      afterFirst(view, stage);
    })
    .catch((error) => {
      fail(section, error);
      addEventListener('online', () => startChapter(section, stage, tries + 1), { once: true });
    });
}

// The chapters further down, one after the other when there is nothing else to do: the network may go before they are come to.
function startOthers(stage) {
  const next = window.requestIdleCallback ?? ((callback) => setTimeout(callback, 50));
  const waiting = chapters();
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
  chapters().forEach((section) => near.observe(section));
}

startLanguage();
startTheme();
startNotes();
startPrinting();
startContents(document.querySelector('.contents ol'));
typeset(document);
startTips();
startHearing();
showAddressed();
addEventListener('hashchange', showAddressed);
compiled
  .then(Stage.create)
  .then(startChapters)
  .catch((error) => fail(document.querySelector('#first'), error));
