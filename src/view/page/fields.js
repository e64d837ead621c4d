// A column of a field as shown: data for the graphics card, the legend, and the value of a point.
import { labelColor } from './color.js';
import { integers, labels, lengthValues, levelValues } from './data.js';
import { digitsFor, number, withUnit } from './format.js';

const most_kept = 6; // most columns that are kept decoded
const kept = new Map();

async function unpack(field, column) {
  if (field.kind === 'label') return labels(field.columns[column]);
  if (field.kind === 'color') return { colors: await integers(field.columns[0].colors, Uint32Array) };
  if (field.kind === 'vector' || field.kind === 'coordinates') return lengthValues(field);
  return levelValues(field.columns[column]);
}

/** Whether each column is shown by itself. */
export const hasColumns = (field) =>
  !['vector', 'coordinates', 'color'].includes(field.kind) && field.columns.length > 1;

export async function unpacked(scene, index, column) {
  const key = `${index} ${column}`;
  const values = kept.get(key) ?? (await unpack(scene.fields[index], column));
  kept.delete(key);
  kept.set(key, values); // moves it to the end: the first one is the oldest
  if (kept.size > most_kept) kept.delete(kept.keys().next().value);
  return values;
}

/** Red, green, blue and 255 of each point, or four zeros. */
export function tintsOf(field, values, map) {
  if (field.kind === 'color') return new Uint8Array(values.colors.buffer);
  const colors = Array.from(values.names, (name) => labelColor(map, name));
  const tints = new Uint8Array(4 * values.indices.length);
  values.indices.forEach((name, i) => {
    const color = colors[name];
    if (color) tints.set([...color, 255], 4 * i);
  });
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

const noValue = (field) => field.noValue || 'no value';
const labelText = (field, label) => (label >= 0 ? field.names[label] ?? number(label, 16) : noValue(field));

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

export function legendOf(field, column, values, map, { range, interval, no_value }) {
  const name = hasColumns(field) ? `${field.name} ${column + 1} of ${field.columns.length}` : field.name;
  const title = withUnit(name, field.unit && `(${field.unit})`);
  const missing_text = noValue(field);
  if (field.kind === 'color') return { title, missing: values.colors.includes(0), missing_text, no_value };
  if (field.kind === 'label') {
    const named = Array.from(values.names).filter((label) => label >= 0);
    const is_missing = named.length < values.names.length || values.indices.includes(values.names.length);
    return { title, no_value, missing: is_missing, missing_text,
             labels: named.map((label) => ({ text: labelText(field, label), color: labelColor(map, label) })) };
  }
  const lines = interval > 0
    ? `${field.kind === 'coordinates' ? 'grid' : 'lines'} every ${withUnit(number(interval), field.unit)}` : null;
  return { title, colors: map.colors, range, lines, missing: values.finite < values.scaled.length, missing_text, no_value,
           unit: field.unit, is_logarithmic: field.kind === 'positive' };
}
