// The panel of settings, which change the state of the page.
import { canHaveLines, hasLines, mapOf, mapsFor } from './choices.js';
import { hasColumns, isTinted } from './fields.js';
import { number } from './format.js';
import { button, check, choice, element, select, slider } from './ui.js';

const get = (id) => document.getElementById(id);

function fieldSection({ state, scene, maps, field }, { set }) {
  if (scene.fields.length === 0) return '';
  const names = [...scene.fields.map(({ name }, i) => [i, name || `field ${i + 1}`]), [-1, 'none']];
  const parts = [select('field', 'Field', names, state.field, (value) => set({ field: Number(value) }))];
  if (!field) return element('section', {}, ...parts);
  const has_values = !isTinted(field);
  if (hasColumns(field))
    parts.push(slider('column', 'Column', { least: 1, most: field.columns.length, step: 1, value: state.column + 1,
                      text: (value) => `${value} of ${field.columns.length}` }, (value) => set({ column: value - 1 })));
  if (field.kind !== 'color' && field.kind !== 'direction' && mapsFor(field, maps).length > 1)
    parts.push(select('map', 'Colours', mapsFor(field, maps).map(({ name }) => [name, name.replaceAll('_', ' ')]), mapOf(field, state, maps).name,
                      (value) => set({ map: { ...state.map, [state.field]: value } })));
  if (has_values)
    parts.push(select('range', 'Range', [['usual', 'without outliers'], ['all', 'all values'], ['middle', 'middle 98 %']], state.range,
                      (value) => set({ range: value })));
  if (field.kind === 'vector') parts.push(check('arrows', 'Arrows', state.arrows, (value) => set({ arrows: value })));
  else if (canHaveLines(field)) {
    parts.push(check('lines', field.kind === 'coordinates' ? 'Grid' : 'Isolines', hasLines(field, state),
                     (value) => set({ lines: { ...state.lines, [state.field]: value } })));
    if (hasLines(field, state))
      parts.push(slider('line-step', 'Spacing', { least: -3, most: 3, step: 1, value: -state.line_step,
                        text: (value) => ['finest', 'finer', 'fine', 'usual', 'wide', 'wider', 'widest'][value + 3] },
                        (value) => set({ line_step: -value })));
  }
  return element('section', {}, ...parts);
}

export function fillPanel(page, { set, toggleTheme, reset, save }) {
  const { state, stage } = page;
  const focused = document.activeElement?.id;
  const panel = get('panel');
  const is_dark = document.documentElement.dataset.theme === 'dark';
  const fold = element('button', { type: 'button', class: 'plain fold', id: 'fold', onclick: () => {
    panel.classList.toggle('folded');
    fold.textContent = panel.classList.contains('folded') ? '▴ Settings' : '▾ Settings';
  } }, panel.classList.contains('folded') ? '▴ Settings' : '▾ Settings');
  const shown = [['points', 'Points'], ['triangles', 'Triangles'], ['both', 'Both']];
  panel.replaceChildren(
    element('div', { class: 'bar' }, fold, element('span', { class: 'name' }, 'Settings'),
            button('theme', is_dark ? '☀' : '☾', is_dark ? 'Light page (t)' : 'Dark page (t)', toggleTheme),
            button('reset', '⟲', 'The view as it was (f)', reset), button('save', '⤓', 'Save a picture (s)', save),
            button('help-button', '?', 'Mouse, touch and keys (h)', () => get('help').showModal())),
    fieldSection(page, { set }),
    element('section', {},
      stage.triangles ? choice('shown', 'Show', shown, state.shown, (value) => set({ shown: value })) : '',
      slider('size', 'Point size', { least: -2, most: 3, step: 0.25, value: state.size, text: (value) => `${number(2 ** value, 2)} ×` },
             (value) => set({ size: value })),
      check('light', 'Light', state.is_lit, (value) => set({ is_lit: value }))),
    element('section', {},
      choice('clip', 'Cut', [['off', 'Off'], ['x', 'x'], ['y', 'y'], ['z', 'z'], ['view', 'View']], state.clip,
             (value) => set({ clip: value })),
      ...(state.clip === 'off' ? [] : [
        slider('clip-at', 'At', { least: 0, most: 1, step: 0.005, value: state.clip_at, text: (value) => `${Math.round(100 * value)} %` },
               (value) => set({ clip_at: value })),
        check('flip', 'Other side', state.is_flipped, (value) => set({ is_flipped: value })),
      ])));
  if (focused) get(focused)?.focus();
}
