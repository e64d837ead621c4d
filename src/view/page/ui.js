// The controls of the panel. Each one reads and changes an entry of the state.

/** An element of HTML; texts become text, never HTML. */
export function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes))
    if (name.startsWith('on')) made.addEventListener(name.slice(2), value);
    else if (value !== null && value !== undefined && value !== false) made.setAttribute(name, value === true ? '' : value);
  made.append(...children);
  return made;
}

export const row = (name, ...content) => element('label', { class: 'row' }, element('span', {}, name), element('div', {}, ...content));
// Not a <label>, because a click on the name must not press a button.
const groupRow = (name, ...content) =>
  element('div', { class: 'row', role: 'group', 'aria-label': name }, element('span', {}, name), element('div', {}, ...content));

export function select(id, name, options, value, changed) {
  const box = element('select', { id, onchange: () => changed(box.value) },
                      ...options.map(([key, text]) => element('option', { value: key }, text)));
  box.value = value;
  return row(name, box);
}

export function slider(id, name, { least, most, step, value, text }, changed) {
  const shown = element('output', {}, text(value));
  const input = element('input', {
    id, type: 'range', min: least, max: most, step,
    oninput: () => { shown.textContent = text(Number(input.value)); changed(Number(input.value)); },
  });
  input.value = value;
  return row(name, input, shown);
}

export function check(id, name, value, changed) {
  const box = element('input', { id, type: 'checkbox', onchange: () => changed(box.checked) });
  box.checked = value;
  return row(name, box);
}

export function choice(id, name, options, value, changed) {
  const buttons = options.map(([key, text]) =>
    element('button', { type: 'button', id: `${id}-${key}`, 'aria-pressed': String(key === value), onclick: () => {
      buttons.forEach((button) => button.setAttribute('aria-pressed', String(button.id === `${id}-${key}`)));
      changed(key);
    } }, text));
  return groupRow(name, element('div', { class: 'group' }, ...buttons));
}

export const button = (id, text, title, clicked) =>
  element('button', { type: 'button', class: 'plain', id, title, 'aria-label': title, onclick: clicked }, text);

const keys = [
  ['Drag, one finger, arrow keys', 'turn'],
  ['Right button, two fingers, Shift with any of these', 'move'],
  ['Wheel, pinch, + and −', 'zoom'],
  ['Click or tap', 'keep the index, position and value of a point'],
  ['1 2 3', 'look along x, y, z; with Shift from the other side'],
  [', and .', 'the column before and after'],
  ['[ and ]', 'the field before and after'],
  ['i', 'isolines'],
  ['l', 'light'],
  ['t', 'light or dark page'],
  ['f, double click, double tap', 'the view as it was'],
  ['s', 'save a picture (PNG)'],
  ['Esc', 'let the point go'],
];

export function fillHelp(dialog) {
  dialog.append(
    element('h2', {}, 'Mouse, touch and keys'),
    element('table', {}, ...keys.map(([key, what]) => element('tr', {}, element('td', {}, key), element('td', {}, what)))),
    element('form', { method: 'dialog' }, element('button', {}, 'Close')));
}
