// The legend. It is drawn on a canvas, so that saved pictures have the same one.
import { cssColor } from './color.js';
import { digitsFor, logarithmicTicks, number, ticks, withUnit } from './format.js';

const width = 268;
const most_labels = 8;

function cut(context, text, room) {
  if (context.measureText(text).width <= room) return text;
  let end = text.length;
  while (end > 1 && context.measureText(`${text.slice(0, end)}…`).width > room) --end;
  return `${text.slice(0, end)}…`;
}

/** The content of a legend, in order; `words()` is the same for screen readers. */
export function legendLines(legend) {
  const lines = [{ kind: 'title', text: legend.title }];
  if (legend.colors) lines.push({ kind: 'bar' });
  for (const label of (legend.labels ?? []).slice(0, most_labels))
    lines.push({ kind: 'swatch', color: label.color, text: label.text });
  if (legend.labels?.length > most_labels) lines.push({ kind: 'note', text: `and ${legend.labels.length - most_labels} more` });
  if (legend.lines) lines.push({ kind: 'note', text: legend.lines });
  if (legend.none) lines.push({ kind: 'swatch', color: legend.none, text: legend.none_text });
  if (legend.missing > 0) lines.push({ kind: 'swatch', color: legend.no_value, text: legend.missing_text });
  return lines;
}

const heights = { title: 22, bar: 40, swatch: 20, note: 20 };
export const legendSize = (legend) => [width, legendLines(legend).reduce((sum, line) => sum + heights[line.kind], 6)];

/** A number on the scale, with enough digits to tell the ends apart. */
function rangeText({ range, is_logarithmic }, shown) {
  const valueOf = (place) => (is_logarithmic ? 10 ** place : place);
  return number(valueOf(shown), digitsFor(valueOf(shown), (valueOf(range[1]) - valueOf(range[0])) / 100));
}

function drawBar(context, legend, y, theme) {
  const gradient = context.createLinearGradient(1, 0, width - 1, 0);
  legend.colors.forEach((color, i) => gradient.addColorStop(i / (legend.colors.length - 1), cssColor(color)));
  context.fillStyle = gradient;
  context.beginPath();
  context.roundRect(0, y, width, 12, 3);
  context.fill();
  const [low, high] = legend.range;
  context.fillStyle = theme.soft;
  context.textAlign = 'center';
  const at = (value) => (high > low ? ((value - low) / (high - low)) * width : width / 2);
  let end = -Infinity;
  for (const value of legend.is_logarithmic ? logarithmicTicks(low, high) : ticks(low, high)) {
    const text = rangeText(legend, value);
    const half = context.measureText(text).width / 2;
    const place = Math.min(Math.max(at(value), half), width - half);
    if (place - half < end + 8) continue; // no room
    end = place + half;
    context.fillRect(Math.min(Math.max(at(value), 0.5), width - 1.5), y + 12, 1, 4);
    context.fillText(text, place, y + 28);
  }
  context.textAlign = 'left';
}

/** Draws at (0, 0). @param theme colours: ink, soft, back */
export function drawLegend(context, legend, theme) {
  const family = getComputedStyle(document.body).fontFamily;
  let y = 4;
  context.textBaseline = 'alphabetic';
  for (const line of legendLines(legend)) {
    const is_title = line.kind === 'title';
    context.font = `${is_title ? '600 13px' : '12.5px'} ${family}`;
    context.fillStyle = is_title ? theme.ink : theme.soft;
    if (line.kind === 'bar') drawBar(context, legend, y, theme);
    else if (line.kind === 'swatch') {
      context.fillText(cut(context, line.text, width - 20), 20, y + 12);
      context.fillStyle = cssColor(line.color);
      context.beginPath();
      context.roundRect(0, y + 1, 13, 13, 3);
      context.fill();
    } else context.fillText(cut(context, line.text, width), 0, y + 12);
    y += heights[line.kind];
  }
}

export function words(legend) {
  const parts = legendLines(legend).filter((line) => line.text).map((line) => line.text);
  const end = (i) => rangeText(legend, legend.range[i]);
  if (legend.colors) parts.push(`colours from ${end(0)} to ${withUnit(end(1), legend.unit)}`);
  return parts.join(', ');
}

export function showLegend(canvas, legend, theme) {
  canvas.hidden = !legend;
  if (!legend) return;
  const [w, h] = legendSize(legend);
  const scale = window.devicePixelRatio;
  Object.assign(canvas, { width: Math.ceil(w * scale), height: Math.ceil(h * scale) });
  Object.assign(canvas.style, { width: `${w}px`, height: `${h}px` });
  const context = canvas.getContext('2d');
  context.scale(scale, scale);
  drawLegend(context, legend, theme);
  canvas.setAttribute('aria-label', words(legend));
}
