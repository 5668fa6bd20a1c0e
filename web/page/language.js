// SPDX-License-Identifier: MIT
// The page's two languages: what stands in index.html is shown or hidden by its lang attribute, what scripts write comes
// from here as {en, zh}.

const listeners = [];

export const language = () => document.documentElement.lang;

/** One of {en, zh}; a string is the same in both. */
export const say = (texts) => (typeof texts === 'string' ? texts : texts[language()]);

/** Calls back now and whenever the language changes. */
export function whenLanguage(callback) {
  listeners.push(callback);
  callback();
}

export function setLanguage(name) {
  document.documentElement.lang = name;
  document.title = say({ en: 'rhw: why divide by w?', zh: 'rhw：为什么要除以 w？' });
  listeners.forEach((callback) => callback());
}
