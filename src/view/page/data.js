// Decodes the numbers of the page, elements of deflated base64: see src/view/page_parts.cpp.

const top_level = 65534;
const no_level = 65535;
const middle_step = 128;

export function bytesOf(base64) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(base64);
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

async function inflated(block) {
  const bytes = bytesOf(document.getElementById(`block-${block}`).textContent);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// Undoes bytePlanes() of page_parts.cpp: puts the bytes of each number side by side.
function joined(planes, width) {
  const count = planes.length / width;
  const bytes = new Uint8Array(planes.length);
  for (let byte = 0; byte < width; ++byte)
    for (let i = 0, from = byte * count; i < count; ++i) bytes[i * width + byte] = planes[from + i];
  return bytes.buffer;
}

/** Integers that were stored as differences: `Type` is Uint8Array, Uint16Array or Uint32Array. */
export async function integers(block, Type) {
  const values = new Type(joined(await inflated(block), Type.BYTES_PER_ELEMENT));
  for (let i = 1; i < values.length; ++i) values[i] += values[i - 1]; // modulo the size of the type
  return values;
}

export async function doubles(block) {
  return new Float64Array(joined(await inflated(block), 8));
}

/**
 * Values at the points, for the graphics card and for people. `scaled` is (value - least) / span as floats; `known` is
 * 255 where there is a value, otherwise 0.
 */
export class Values {
  constructor(count) {
    this.scaled = new Float32Array(count);
    this.known = new Uint8Array(count);
    Object.assign(this, { least: 0, half_span: 0.5, finite: 0, ranges: null });
  }

  toScaled(value) {
    return (value / 2 - this.least / 2) / this.half_span; // halves, because a difference may overflow
  }
}

/** The values of a column of levels; `at(row)` returns one as a double. */
export async function levelValues(column) {
  const levels = await integers(column.levels, Uint16Array);
  const values = new Values(levels.length);
  Object.assign(values, column);
  values.half_span = (column.step / 2) * top_level || column.maximum / 2 - column.minimum / 2 || 0.5;
  for (let i = 0; i < levels.length; ++i) {
    if (levels[i] === no_level) continue;
    values.known[i] = 255;
    values.scaled[i] = column.step > 0 ? levels[i] / top_level : 0;
  }
  const far = new Map();
  if (column.far) {
    const rows = await integers(column.far.rows, Uint32Array);
    const kept = await doubles(column.far.values);
    rows.forEach((row, i) => {
      far.set(row, kept[i]);
      values.scaled[row] = values.toScaled(kept[i]);
    });
  }
  values.at = (row) =>
    levels[row] === no_level ? NaN : (far.get(row) ?? column.least + column.step * levels[row]);
  return values;
}

/** The lengths of vectors whose coordinates are the columns of levels `parts`. */
export async function lengthValues({ columns, ranges }) {
  const parts = [];
  for (const column of columns) parts.push(await levelValues(column));
  const count = parts[0].scaled.length;
  const values = new Values(count);
  const lengths = new Float64Array(count);
  for (let i = 0; i < count; ++i) {
    lengths[i] = Math.hypot(...parts.map((part) => part.at(i)));
    if (Number.isFinite(lengths[i])) ++values.finite;
  }
  Object.assign(values, { ranges, half_span: ranges.all[1] / 2 || 0.5 });
  for (let i = 0; i < count; ++i) {
    if (!Number.isFinite(lengths[i])) continue;
    values.known[i] = 255;
    values.scaled[i] = values.toScaled(lengths[i]);
  }
  values.at = (row) => lengths[row];
  values.parts = parts;
  return values;
}

/** A column of labels: `at(row)` is the integer, or NaN. */
export async function labels(column) {
  const names = await doubles(column.names);
  const indices = await integers(column.indices, Uint32Array);
  return { names, indices, at: (row) => names[indices[row]] ?? NaN };
}

/** The radius of the disc of each point, and their lower quartile, in the unit of `positions()`. */
export async function radii(scene, { unit, count }) {
  if (!scene.radii) return { each: new Float32Array(count), quartile: 0.02 };
  const quartile = scene.radii.quartile / unit;
  const steps = await integers(scene.radii.block, Uint8Array);
  return { each: Float32Array.from(steps, (step) => quartile * 2 ** ((step - middle_step) * scene.radii.step)), quartile };
}

/** Positions of the points: `shown` for the graphics card, around 0 with the longest side of the box 1. */
export async function positions(columns) {
  const axes = [];
  for (const column of columns) axes.push(await levelValues(column));
  const count = axes[0].scaled.length;
  const largest = Math.max(...columns.map((column) => column.step)) || 1;
  const shown = new Float32Array(3 * count);
  const drawn = new Uint8Array(count);
  const farthest = 1e6; // in sides of the box; points beyond it are out of view
  const sides = columns.map((column) => column.step / largest);
  for (let i = 0; i < count; ++i) {
    drawn[i] = axes[0].known[i] & axes[1].known[i] & axes[2].known[i] & 1;
    for (let axis = 0; axis < 3; ++axis) {
      const { scaled } = axes[axis];
      const place = columns[axis].step > 0 ? (scaled[i] - 0.5) * sides[axis] : scaled[i];
      shown[3 * i + axis] = drawn[i] ? Math.min(Math.max(place, -farthest), farthest) : 0;
    }
  }
  return { axes, shown, drawn, count, sides, unit: largest * top_level, step: largest };
}
