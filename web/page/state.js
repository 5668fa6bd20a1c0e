// SPDX-License-Identifier: MIT
// What is shown, in the page's address, so that it can be sent: #chapter?lang=en&theme=dark&P=0.57,0.5&A=-0.9,0.15,0.75&pattern=checker
// The chapter that was touched last stands there with its corners, its pixel and its choices.
import { language } from './language.js';

const REST = 300; // ms after a touch until the address follows

/** {chapter, values: URLSearchParams} of an address's part behind #. */
export function parse(hash) {
  const [chapter, query = ''] = hash.replace(/^#/, '').split('?');
  return { chapter, values: new URLSearchParams(query) };
}

/** `count` finite numbers of a value, or null. */
export function numbersIn(values, name, count) {
  const list = (values.get(name) ?? '').split(',').map((part) => (part.trim() ? Number(part) : NaN));
  return list.length === count && list.every((number) => Math.abs(number) < 1e30) ? list : null;
}

export const numbersText = (numbers) => numbers.map((number) => Number(number.toPrecision(6))).join(',');

/** Says `name` anew in an address that says more than a chapter. */
export function noteInAddress(name, value) {
  const { chapter, values } = parse(location.hash);
  if ([...values].length > 0) {
    values.set(name, value);
    history.replaceState(null, '', `#${chapter}?${values.toString().replaceAll('%2C', ',')}`);
  }
}

const choices = (section) => [...section.querySelectorAll('[data-name]')];

function choicesOf(section) {
  const pressed = choices(section).map((row) => [row.dataset.name, row.querySelector('[aria-pressed="true"]')?.value]);
  const ranges = [...section.querySelectorAll('input[type="range"]')].map((input) => [input.name, input.value]);
  return Object.fromEntries([...pressed, ...ranges].filter(([, value]) => value !== undefined));
}

function restoreChoices(section, values) {
  for (const row of choices(section)) {
    [...row.querySelectorAll('button')].find(({ value }) => value === values.get(row.dataset.name))?.click();
  }
  for (const input of section.querySelectorAll('input[type="range"]')) {
    const [value] = numbersIn(values, input.name, 1) ?? [];
    if (value !== undefined) {
      input.value = value;
      input.dispatchEvent(new Event('input'));
    }
  }
}

/** The address of a chapter as it is, behind #. `view` may save what else there is: {name: text}. */
export function addressOf(section, view) {
  const values = { lang: language(), theme: document.documentElement.dataset.theme, ...choicesOf(section), ...view?.save?.() };
  const query = Object.entries(values).map(([name, value]) => `${name}=${String(value).replace(/[^\w.,-]/g, encodeURIComponent)}`);
  return `${section.id}?${query.join('&')}`;
}

function restore(section, view, { chapter, values }) {
  if (chapter === section.id && [...values].length > 0) {
    restoreChoices(section, values);
    view?.restore?.(values);
  }
}

/** Shows what the address says of a chapter that has begun, and says there what is done with it. */
export function keepState(section, view) {
  let timer;
  const write = () => history.replaceState(null, '', `#${addressOf(section, view)}`);
  const later = () => {
    clearTimeout(timer);
    timer = setTimeout(write, REST);
  };
  for (const kind of ['pointerup', 'keyup', 'input']) {
    section.addEventListener(kind, later);
  }
  section.querySelector('.anchor').addEventListener('click', (event) => {
    event.preventDefault();
    write();
    section.scrollIntoView();
  });
  restore(section, view, parse(location.hash));
  addEventListener('hashchange', () => restore(section, view, parse(location.hash)));
}
