// Reads the scene of the page, draws it, and connects the panel, the keys and the pointer with it.
//
// `window.tufted` is for tests and for the console of the browser: `ready` once the first picture is drawn,
// `first_picture` (milliseconds since the navigation), `state`, `stage`, `pick(x, y)` and `place(index)`, with places in
// pixels of the canvas, and `set(changes)`, which changes the state as the panel does.
import { Color, Vector3 } from 'three';
import { canHaveLines, hasLines, intervalOf, mapOf, startState } from './choices.js';
import { colorMaps, mapTexture } from './color.js';
import { doubles, integers, positions, radii } from './data.js';
import { hasColumns, isTinted, legendOf, pairsOf, tintsOf, unpacked, valueText } from './fields.js';
import { count, number, stepped, withUnit } from './format.js';
import { showLegend } from './legend.js';
import * as panel from './panel.js';
import { pickPoint, pickTriangle, placeOf } from './picking.js';
import { savePicture } from './saving.js';
import { Stage } from './stage.js';
import { element, fillHelp } from './ui.js';

const get = (id) => document.getElementById(id);
const state = startState();
let scene, numbers, stage, maps, current, legend, picked = null, pinned = null;

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
/** The number that the maker of the page gives a point: thinned clouds keep those of the whole one. */
const numberOf = (row) => numbers?.[row] ?? row;
const pathColor = () => scene.pathColor.map((channel) => channel / 255);

let wanted = 0;
/** Shows the field and column of the state, unless the state changes while they are decoded. */
async function showField() {
  const turn = ++wanted;
  stage.showRings(field()?.columns[state.column]?.sources ?? [], pathColor());
  if (!field()) {
    stage.show({});
    stage.set({ mode: 0 });
    stage.showArrows(null);
    current = legend = null;
    return refresh();
  }
  const values = await unpacked(scene, state.field, state.column);
  if (turn !== wanted) return;
  current = values;
  const one = field();
  const map = mapOf(one, state, maps);
  if (isTinted(one)) {
    stage.show({ tints: tintsOf(one, values, map, scene.none) });
    stage.set({ mode: 2, is_flat: one.kind === 'label' });
  } else {
    stage.show({ scaled: values.scaled, known: values.known, pairs: one.kind === 'coordinates' ? pairsOf(values) : null });
  }
  applyColors();
}

function applyColors() {
  const one = field();
  const map = mapOf(one, state, maps);
  stage.uniforms.map.value?.dispose();
  stage.set({ map: mapTexture(map), interval: 0, grid: 0 });
  stage.showArrows(null);
  let range = [0, 1];
  let interval = 0;
  if (!isTinted(one)) {
    range = current.ranges[state.range];
    interval = intervalOf(one, state, range, stage.spacing * stage.positions.unit);
    const low = current.toScaled(range[0]);
    const width = current.toScaled(range[1]) - low;
    // All values equal: the middle colour.
    stage.uniforms.range.value.set(width > 0 ? low : low - 0.5, width > 0 ? 1 / width : 1);
    stage.set({ mode: 1 });
    // Lines of distances and coordinates, which have the unit of positions, are as wide as a point.
    const width_of_point = (0.65 * stage.spacing * stage.positions.unit) / interval;
    const is_length = one.kind === 'distance' || one.kind === 'coordinates';
    stage.set({ thickness: is_length ? Math.min(Math.max(width_of_point, 0.03), 0.11) : 0.08 });
    const scaled = interval > 0 ? interval / 2 / current.half_span : 0;
    // Floats cannot count lines from a 0 that is far away, so they are counted from any line.
    const start = current.toScaled(0);
    stage.set({ [one.kind === 'coordinates' ? 'grid' : 'interval']: scaled, start: scaled > 0 ? start % scaled : 0 });
    if (one.kind === 'vector' && state.arrows) {
      const [from, scale] = stage.uniforms.range.value.toArray();
      stage.set({ mode: 0 });
      stage.showArrows(current, (row) => {
        const t = Math.min(Math.max((current.scaled[row] - from) * scale, 0), 1);
        return map.colors[Math.round(t * (map.colors.length - 1))].map((channel) => channel / 255);
      });
    }
  }
  legend = legendOf(one, state.column, current, map, { range, interval, no_value: scene.noValue, none: scene.none });
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

/** Applies the state, except the values of the field. */
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
  else if (field() && has('map', 'range', 'lines', 'line_step', 'arrows', 'shown')) {
    if (field().kind === 'label') await showField();
    else if (current) applyColors();
  } else refresh();
  if (has('field', 'map', 'lines', 'clip', 'theme', 'arrows', 'is_lit')) fillPanel();
  if (has('column') && get('column')) {
    get('column').value = state.column + 1;
    get('column').nextSibling.textContent = `${state.column + 1} of ${field().columns.length}`;
  }
}

const toggleTheme = () => set({ theme: document.documentElement.dataset.theme === 'dark' ? 'light' : 'dark' });

const reset = () => stage.look(scene.start.eye, scene.start.up, scene.start.zoom);

function save() {
  stage.drawNow(); // because the browser does not keep what was drawn
  savePicture(get('canvas'), legend, themeColors(), scene.title);
}

const fillPanel = () => panel.fillPanel({ state, scene, stage, maps, field: field() }, { set, toggleTheme, reset, save });

function pick(x, y, reach = 6) {
  const row = state.shown === 'points' ? pickPoint(stage, x, y, reach) : pickTriangle(stage, x, y);
  if (row < 0) return null;
  const position = stage.positions.axes.map((axis) => axis.at(row));
  const value = field() && current ? valueText(field(), current, row) : null;
  return { index: numberOf(row), row, position, value, number: current?.at?.(row) ?? null };
}

function showTip() {
  const row = pinned ?? picked;
  const place = row === null ? null : placeOf(stage, row);
  get('tip').hidden = get('ring').hidden = !place;
  if (!place) return;
  const axes = stage.positions.axes;
  const lines = [['point', count(numberOf(row))],
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
      picked = pick(x, y)?.row ?? null;
      showTip();
    });
  },
  left: () => { picked = null; showTip(); },
  tapped: (x, y, is_touch) => {
    const now = performance.now();
    if (now - last_tap < 350) {
      pinned = null;
      reset();
    } else pinned = pick(x, y, is_touch ? 14 : 6)?.row ?? null;
    last_tap = now;
    showTip();
  },
};

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
    i: () => field() && canHaveLines(field()) && set({ lines: { ...state.lines, [state.field]: !hasLines(field(), state) } }),
    l: () => set({ is_lit: !state.is_lit }),
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
  const parts = [`${numbers ? `${count(numbers.length)} of ` : ''}${count(scene.finiteCount)} points`];
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
  numbers = scene.numbers === undefined ? null : await integers(scene.numbers, Uint32Array);
  const directions = scene.normals === undefined ? null : await integers(scene.normals, Uint8Array);
  const triangles = scene.triangles === undefined ? null : await integers(scene.triangles, Uint32Array);
  stage = new Stage(get('canvas'), places, await radii(scene, places), directions, triangles, pointer);
  if (scene.path !== undefined)
    stage.showPath(await doubles(scene.path), pathColor());
  if (stage.triangles) state.shown = 'triangles';
  fillHelp(get('help'));
  if (matchMedia('(max-width: 760px)').matches) get('panel').classList.add('folded');
  applyTheme();
  fillHeading();
  fillPanel();
  if (scene.start.parallel) stage.useLongLens();
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
