// A column of a field as shown: data for the graphics card, the legend, and the value of a point.
import { directionColor, labelColor } from './color.js';
import { integers, labels, lengthValues, levelValues } from './data.js';
import { digitsFor, number, withUnit } from './format.js';

const most_kept = 6; // most columns that are kept decoded
const kept = new Map();

async function unpack(field, column) {
  if (field.kind === 'label') return labels(field.columns[column]);
  if (field.kind === 'color') return { colors: await integers(field.columns[0].colors, Uint32Array) };
  if (isWhole(field)) return lengthValues(field);
  return levelValues(field.columns[column]);
}

/** Whether the columns are parts of vectors. */
const isWhole = ({ kind }) => ['vector', 'coordinates', 'direction'].includes(kind);
/** Whether each column is shown by itself. */
export const hasColumns = (field) => !isWhole(field) && field.kind !== 'color' && field.columns.length > 1;
/** Whether points have colours of their own instead of values on a scale. */
export const isTinted = ({ kind }) => ['label', 'color', 'direction'].includes(kind);

export async function unpacked(scene, index, column) {
  const key = `${index} ${column}`;
  const values = kept.get(key) ?? (await unpack(scene.fields[index], column));
  kept.delete(key);
  kept.set(key, values); // moves it to the end: the first one is the oldest
  if (kept.size > most_kept) kept.delete(kept.keys().next().value);
  return values;
}

/** Red, green, blue and 255 of each point, or four zeros. */
export function tintsOf(field, values, map, none) {
  if (field.kind === 'color') return new Uint8Array(values.colors.buffer);
  const of = field.kind === 'direction' ? (i) => directionColor(values.parts.map((part) => part.at(i)))
                                        : (i) => colors[values.indices[i]];
  const colors = Array.from(values.names ?? [], (name) => labelColor(map, name, none));
  const count = (values.indices ?? values.known).length;
  const tints = new Uint8Array(4 * count);
  for (let i = 0; i < count; ++i) {
    const color = of(i);
    if (color) tints.set([...color, 255], 4 * i);
  }
  return tints;
}

/** Coordinates for the graphics card, scaled in the same way as their lengths. */
export function pairsOf(values) {
  const count = values.scaled.length;
  const pairs = new Float32Array(2 * count);
  for (let i = 0; i < count; ++i)
    if (values.known[i]) pairs.set(values.parts.map((part) => values.toScaled(part.at(i))), 2 * i);
  return pairs;
}

const noValue = (field) => (field.kind !== 'label' && field.noValue) || 'no value';
function labelText(field, label) {
  if (label < 0) return field.noValue || 'none';
  return label >= 0 ? field.names[label] ?? number(label, 16) : noValue(field);
}

/** The text that the page shows for the value of a point. */
export function valueText(field, values, row) {
  if (field.kind === 'color') {
    const color = values.colors[row];
    return color === 0 ? 'no value' : [0, 8, 16].map((shift) => (color >> shift) & 255).join(', ');
  }
  if (field.kind === 'label') return labelText(field, values.at(row));
  if (field.kind === 'positive') {
    const value = 10 ** values.at(row);
    return withUnit(number(value, 4), Number.isFinite(value) ? field.unit : '');
  }
  if (values.parts && Number.isFinite(values.at(row)))
    return withUnit(`(${values.parts.map((part) => number(part.at(row))).join(', ')})`, field.unit);
  return withUnit(number(values.at(row), digitsFor(values.at(row), values.step, 5)), Number.isFinite(values.at(row)) ? field.unit : '');
}

export function legendOf(field, column, values, map, { range, interval, no_value, none }) {
  const number_of = hasColumns(field) ? ` ${column + 1} of ${field.columns.length}` : '';
  const name = field.columnNames[column] ?? field.name + number_of;
  const title = withUnit(name, field.unit && `(${field.unit})`);
  const missing_text = noValue(field);
  if (field.kind === 'color') return { title, missing: values.colors.includes(0), missing_text, no_value };
  if (field.kind === 'label') {
    const named = Array.from(values.names).filter((label) => label >= 0);
    return { title, no_value, none: named.length < values.names.length && none, none_text: labelText(field, -1), missing: values.indices.includes(values.names.length), missing_text,
             labels: named.map((label) => ({ text: labelText(field, label), color: labelColor(map, label, none) })) };
  }
  if (field.kind === 'direction') {
    const labels = ['x', 'y', 'z', '-x', '-y', '-z'].map((text, i) => (
      { text, color: directionColor([0, 1, 2].map((axis) => (axis === i % 3 ? (i < 3 ? 1 : -1) : 0))) }));
    return { title, labels, no_value, missing: values.known.includes(0), missing_text };
  }
  const lines = interval > 0
    ? `${field.kind === 'coordinates' ? 'grid' : 'lines'} every ${withUnit(number(interval), field.unit)}` : null;
  return { title, colors: map.colors, range, lines, missing: values.finite < values.scaled.length, missing_text, no_value,
           unit: field.unit, is_logarithmic: field.kind === 'positive' };
}
