// Reads the scene of the page, draws it, and connects the panel, the keys and the pointer with it.
//
// `window.tufted` is for tests and for the console of the browser: `ready` once the first picture is drawn,
// `first_picture` (milliseconds since the navigation), `state`, `stage`, `pick(x, y)` and `place(index)`, with places in
// pixels of the canvas, and `set(changes)`, which changes the state as the panel does.
import { Color, Vector3 } from 'three';
import { colorMaps, colorRange, cssColor, mapTexture } from './color.js';
import { integers, positions } from './data.js';
import { hasColumns, legendOf, pairsOf, tintsOf, unpacked, valueText } from './fields.js';
import { count, number, roundUp, stepped, withUnit } from './format.js';
import { drawLegend, legendSize, showLegend } from './legend.js';
import { pickPoint, pickTriangle, placeOf } from './picking.js';
import { Stage } from './stage.js';
import { button, check, choice, element, fillHelp, select, slider } from './ui.js';

const get = (id) => document.getElementById(id);
const state = {
  field: 0, column: 0, map: {}, is_middle: false, lines: {}, line_step: 0, arrows: true, shown: 'points', size: 0,
  is_lit: true, clip: 'off', clip_at: 0.5, is_flipped: false, theme: null,
};
let scene, stage, maps, current, legend, picked = null, pinned = null;

class Plain extends Error {}

function tell(text) {
  get('message').textContent = text;
  get('message').hidden = !text;
}

function themeColors() {
  const style = getComputedStyle(document.documentElement);
  const of = (name) => style.getPropertyValue(`--${name}`).trim();
  return { ink: of('ink'), soft: of('soft'), back: of('back'), plain: of('plain'), line: of('line') };
}

function applyTheme() {
  const is_dark = state.theme ? state.theme === 'dark' : matchMedia('(prefers-color-scheme: dark)').matches;
  document.documentElement.dataset.theme = is_dark ? 'dark' : 'light';
  const colors = themeColors();
  stage.scene.background = new Color(colors.back);
  stage.set({ plain: new Color(colors.plain), line_color: new Color(colors.line),
              no_value: new Color(...scene.noValue.map((channel) => channel / 255)) });
}

const field = () => scene.fields[state.field];

/** The colour maps that suit a field. */
function mapsFor({ kind }) {
  if (kind === 'label') return maps.filter((map) => map.use === 'categorical');
  return maps.filter((map) => map.use !== 'categorical');
}

function mapOf(one) {
  const name = state.map[state.field] ?? one.map;
  return maps.find((map) => map.name === name) ?? maps[0];
}

const hasLines = (one) => state.lines[state.field] ?? (one.kind === 'distance' || one.kind === 'coordinates');

/** The interval of isolines: a round number, finer or coarser by the slider. */
function intervalOf(one, [low, high]) {
  if (!hasLines(one) || ['label', 'color', 'vector'].includes(one.kind) || !(high > low)) return 0;
  // Lines of points are as wide as these, so at least this far apart; distances have the unit of positions.
  const points = state.shown === 'points' && one.kind !== 'scalar' && one.kind !== 'diverging' ? 4.5 * stage.spacing * stage.positions.unit : 0;
  return roundUp(Math.max((high - low) / (one.kind === 'coordinates' ? 8 : 16), Math.min(points, (high - low) / 3)) * 2 ** -state.line_step);
}

let wanted = 0;
/** Shows the field and column of the state. Where another one is asked for meanwhile, that one wins. */
async function showField() {
  const turn = ++wanted;
  if (!field()) {
    stage.show({});
    stage.set({ mode: 0 });
    legend = null;
    return refresh();
  }
  const values = await unpacked(scene, state.field, state.column);
  if (turn !== wanted) return;
  current = values;
  const one = field();
  const map = mapOf(one);
  if (one.kind === 'label' || one.kind === 'color') {
    stage.show({ tints: tintsOf(one, values, map) });
    stage.set({ mode: 2, is_flat: one.kind === 'label' });
  } else {
    stage.show({ scaled: values.scaled, known: values.known, pairs: one.kind === 'coordinates' ? pairsOf(values) : null });
  }
  applyColors();
}

function applyColors() {
  const one = field();
  const map = mapOf(one);
  stage.uniforms.map.value?.dispose();
  stage.set({ map: mapTexture(map), interval: 0, grid: 0 });
  stage.showArrows(null);
  let range = [0, 1];
  let interval = 0;
  if (one.kind !== 'label' && one.kind !== 'color') {
    range = colorRange(current, one.kind, state.is_middle);
    interval = intervalOf(one, range);
    const low = current.toScaled(range[0]);
    const width = current.toScaled(range[1]) - low;
    // All values equal: the middle colour.
    stage.uniforms.range.value.set(width > 0 ? low : low - 0.5, width > 0 ? 1 / width : 1);
    stage.set({ mode: 1, start: current.toScaled(0) });
    // Distances and coordinates have the unit of positions: their lines are as wide as a point.
    const width_of_point = (0.65 * stage.spacing * stage.positions.unit) / interval;
    const is_length = one.kind === 'distance' || one.kind === 'coordinates';
    stage.set({ thickness: is_length ? Math.min(Math.max(width_of_point, 0.03), 0.11) : 0.08 });
    if (one.kind === 'coordinates') stage.set({ grid: interval });
    else stage.set({ interval: interval > 0 ? interval / 2 / current.half_span : 0 });
    if (one.kind === 'vector' && state.arrows) {
      const [from, scale] = stage.uniforms.range.value.toArray();
      stage.set({ mode: 0 });
      stage.showArrows(current, (row) => {
        const t = Math.min(Math.max((current.scaled[row] - from) * scale, 0), 1);
        return map.colors[Math.round(t * (map.colors.length - 1))].map((channel) => channel / 255);
      });
    }
  }
  legend = legendOf(one, state.column, current, map, { range, interval, no_value: scene.noValue });
  refresh();
}

function applyClip() {
  const axes = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1], view: new Vector3(0, 0, 1).applyQuaternion(stage.camera.quaternion).toArray() };
  const axis = axes[state.clip];
  if (!axis) return stage.uniforms.clip.value.set(0, 0, 0, 1);
  const sign = state.is_flipped ? -1 : 1;
  const half = axis.reduce((sum, part, i) => sum + Math.abs(part) * stage.positions.sides[i], 0) / 2;
  stage.uniforms.clip.value.set(...axis.map((part) => sign * part), sign * (2 * state.clip_at - 1) * half * 1.001);
}

/** Draws what has changed but for the values. */
function refresh() {
  applyTheme();
  stage.is_lit = state.is_lit;
  stage.size_factor = 2 ** state.size;
  stage.points.visible = state.shown !== 'triangles';
  if (stage.triangles) stage.triangles.visible = state.shown !== 'points';
  showLegend(get('legend'), legend, themeColors());
  showTip();
  stage.draw();
}

/** Changes the state and draws what depends on it. */
async function set(changes) {
  Object.assign(state, changes);
  const has = (...names) => names.some((name) => name in changes);
  if (has('field')) state.column = 0;
  if (has('clip', 'clip_at', 'is_flipped')) applyClip();
  if (has('field', 'column')) await showField();
  else if (field() && has('map', 'is_middle', 'lines', 'line_step', 'arrows', 'shown')) {
    if (field().kind === 'label') await showField();
    else if (current) applyColors();
  } else refresh();
  if (has('field', 'map', 'lines', 'clip', 'theme', 'arrows', 'is_lit')) fillPanel();
  if (has('column') && get('column')) {
    get('column').value = state.column + 1;
    get('column').nextSibling.textContent = `${state.column + 1} of ${field().columns.length}`;
  }
}

function fieldSection() {
  const one = field();
  if (!one) return '';
  const parts = [select('field', 'Field', scene.fields.map(({ name }, i) => [i, name || `field ${i + 1}`]), state.field,
                        (value) => set({ field: Number(value) }))];
  if (hasColumns(one))
    parts.push(slider('column', 'Column', { least: 1, most: one.columns.length, step: 1, value: state.column + 1,
                      text: (value) => `${value} of ${one.columns.length}` }, (value) => set({ column: value - 1 })));
  if (one.kind !== 'color' && mapsFor(one).length > 1)
    parts.push(select('map', 'Colours', mapsFor(one).map(({ name }) => [name, name.replaceAll('_', ' ')]), mapOf(one).name,
                      (value) => set({ map: { ...state.map, [state.field]: value } })));
  if (!['color', 'label'].includes(one.kind))
    parts.push(select('range', 'Range', [['all', 'all values'], ['middle', 'middle 98 %']], state.is_middle ? 'middle' : 'all',
                      (value) => set({ is_middle: value === 'middle' })));
  if (one.kind === 'vector') parts.push(check('arrows', 'Arrows', state.arrows, (value) => set({ arrows: value })));
  else if (!['color', 'label'].includes(one.kind)) {
    parts.push(check('lines', one.kind === 'coordinates' ? 'Grid' : 'Isolines', hasLines(one),
                     (value) => set({ lines: { ...state.lines, [state.field]: value } })));
    if (hasLines(one))
      parts.push(slider('line-step', 'Spacing', { least: -3, most: 3, step: 1, value: -state.line_step,
                        text: (value) => ['finest', 'finer', 'fine', 'usual', 'wide', 'wider', 'widest'][value + 3] },
                        (value) => set({ line_step: -value })));
  }
  return element('section', {}, ...parts);
}

function fillPanel() {
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
    fieldSection(),
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

const toggleTheme = () => set({ theme: document.documentElement.dataset.theme === 'dark' ? 'light' : 'dark' });

function reset() {
  const { eye, up } = scene.start;
  const given = (direction) => (direction.some((part) => part !== 0) ? direction : null);
  stage.look(given(eye), given(up));
}

function pick(x, y, reach = 6) {
  const row = state.shown === 'points' ? pickPoint(stage, x, y, reach) : pickTriangle(stage, x, y);
  if (row < 0) return null;
  const position = stage.positions.axes.map((axis) => axis.at(row));
  const value = field() && current ? valueText(field(), current, row) : null;
  return { index: row, position, value, number: current?.at?.(row) ?? null };
}

function showTip() {
  const row = pinned ?? picked;
  const place = row === null ? null : placeOf(stage, row);
  get('tip').hidden = get('ring').hidden = !place;
  if (!place) return;
  const axes = stage.positions.axes;
  const lines = [['point', count(row)],
                 ...['x', 'y', 'z'].map((name, i) => [name, withUnit(stepped(axes[i].at(row), axes[i].step), scene.unit)])];
  if (field() && current) lines.push([field().name, valueText(field(), current, row)]);
  get('tip').replaceChildren(element('dl', {}, ...lines.flatMap(([name, text]) => [element('dt', {}, name), element('dd', {}, text)])));
  Object.assign(get('ring').style, { left: `${place[0]}px`, top: `${place[1]}px` });
  const { clientWidth: width, clientHeight: height } = get('tip');
  const room = get('view');
  const left = place[0] + 16 + width < room.clientWidth ? place[0] + 16 : Math.max(4, place[0] - 16 - width);
  const top = Math.min(Math.max(4, place[1] - height / 2), room.clientHeight - height - 4);
  Object.assign(get('tip').style, { left: `${left}px`, top: `${top}px` });
}

let hover = null;
let last_tap = 0;
const pointer = {
  changed: () => { if (get('ring') && stage) showTip(); },
  hovered: (x, y) => {
    hover ??= requestAnimationFrame(() => {
      hover = null;
      if (pinned !== null) return;
      picked = pick(x, y)?.index ?? null;
      showTip();
    });
  },
  left: () => { picked = null; showTip(); },
  tapped: (x, y, is_touch) => {
    const now = performance.now();
    if (now - last_tap < 350) {
      pinned = null;
      reset();
    } else pinned = pick(x, y, is_touch ? 14 : 6)?.index ?? null;
    last_tap = now;
    showTip();
  },
};

/** A picture of what is seen, with title and legend. */
function save() {
  const source = get('canvas');
  stage.drawNow(); // the browser forgets what was drawn before
  const canvas = element('canvas', { width: source.width, height: source.height });
  const context = canvas.getContext('2d');
  context.drawImage(source, 0, 0);
  const scale = source.width / source.clientWidth;
  if (legend) {
    context.setTransform(scale, 0, 0, scale, 20 * scale, source.height - (18 + legendSize(legend)[1]) * scale);
    drawLegend(context, legend, themeColors());
  }
  canvas.toBlob((blob) => {
    const link = element('a', { href: URL.createObjectURL(blob), download: `${(scene.title || 'view').replace(/[^\p{L}\p{N}._ -]+/gu, '_')}.png` });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  });
}

function key(event) {
  if (event.ctrlKey || event.metaKey || event.altKey || get('help').open) return;
  if (event.target.tagName === 'SELECT' || (event.target.type === 'range' && event.key.startsWith('Arrow'))) return;
  const fields = scene.fields.length;
  const move = (step) => fields > 1 && set({ field: (state.field + step + fields) % fields });
  const turn = (step) => field() && hasColumns(field()) && set({ column: Math.min(Math.max(state.column + step, 0), field().columns.length - 1) });
  const along = (axis) => {
    const eye = [0, 0, 0];
    eye[axis] = event.shiftKey ? -1 : 1;
    stage.look(eye, axis === 2 ? [0, 1, 0] : [0, 0, 1]);
  };
  const actions = {
    f: reset, s: save, t: toggleTheme, h: () => get('help').showModal(), '?': () => get('help').showModal(),
    i: () => field() && set({ lines: { ...state.lines, [state.field]: !hasLines(field()) } }), l: () => set({ is_lit: !state.is_lit }),
    ',': () => turn(-1), '.': () => turn(1), '[': () => move(-1), ']': () => move(1),
    Escape: () => { pinned = picked = null; showTip(); },
  };
  const digit = { Digit1: 0, Digit2: 1, Digit3: 2 }[event.code];
  if (digit !== undefined) along(digit);
  else if (actions[event.key]) actions[event.key]();
  else if (!stage.controls.key(event)) return;
  event.preventDefault();
}

function fillHeading() {
  const { sides, unit } = stage.positions;
  const title = scene.title || 'Points';
  document.title = title;
  const parts = [`${count(scene.count)} points`];
  if (stage.triangles) parts.push(`${count(stage.corners.length / 3)} triangles`);
  parts.push(withUnit(sides.map((side) => number(side * unit, 3)).join(' × '), scene.unit));
  get('heading').append(element('h1', {}, title), element('p', {}, parts.join(' · ')));
}

async function start() {
  if (typeof DecompressionStream === 'undefined')
    throw new Plain('This browser is too old for this page: it cannot unpack the points (DecompressionStream).');
  if (!document.createElement('canvas').getContext('webgl2'))
    throw new Plain('This page needs WebGL 2, which this browser does not have or has switched off.');
  scene = JSON.parse(get('scene').textContent);
  maps = colorMaps(scene);
  Object.assign(state, { field: scene.start.field, column: scene.start.column });
  if (scene.start.map) state.map[state.field] = scene.start.map;
  const places = await positions(scene.positions);
  const directions = scene.normals === undefined ? null : await integers(scene.normals, Uint8Array);
  const triangles = scene.triangles === undefined ? null : await integers(scene.triangles, Uint32Array);
  stage = new Stage(get('canvas'), places, directions, triangles, pointer);
  if (stage.triangles) state.shown = 'triangles';
  fillHelp(get('help'));
  if (matchMedia('(max-width: 760px)').matches) get('panel').classList.add('folded');
  applyTheme();
  fillHeading();
  fillPanel();
  stage.resize();
  reset();
  await showField();
  stage.is_waiting = false;
  stage.drawNow();
  addEventListener('keydown', key);
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => { refresh(); fillPanel(); });
  tell(stage.is_empty ? 'No point of this scene has a finite position.' : '');
  const gl = stage.renderer.getContext();
  gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4)); // waits until it is drawn
  Object.assign(window.tufted, { ready: true, first_picture: performance.now() });
}

window.tufted = {
  ready: false, state, set, pick, get stage() { return stage; }, get legend() { return legend; },
  place: (row) => placeOf(stage, row), get pinned() { return pinned; },
};
start().catch((error) => {
  tell(error instanceof Plain ? error.message : 'This page cannot be shown. The file is damaged, or the browser has too little memory.');
  if (!(error instanceof Plain)) console.error(error);
});
