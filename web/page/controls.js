// SPDX-License-Identifier: MIT
// Rows of buttons of which one is chosen: <div class="choice" data-name="pattern"><button value="colors">..</div>.

/** Calls `chosen(value)` for the row of that name; the first button is chosen at the start. */
export function choice(section, name, chosen) {
  const buttons = [...section.querySelectorAll(`[data-name="${name}"] button`)];
  const choose = (button) => {
    buttons.forEach((other) => other.setAttribute('aria-pressed', other === button));
    chosen(button.value);
  };
  buttons.forEach((button) => button.addEventListener('click', () => choose(button)));
  choose(buttons[0]);
}
