// The state of the page at first, and how a field is shown by default and by the state.
import { roundUp } from './format.js';

export const startState = () => ({
  field: 0, column: 0, map: {}, range: 'usual', lines: {}, line_step: 0, arrows: true, shown: 'points', size: 0,
  is_lit: true, clip: 'off', clip_at: 0.5, is_flipped: false, theme: null,
});

/** The colour maps that suit a field. */
export function mapsFor({ kind }, maps) {
  if (kind === 'label') return maps.filter((map) => map.use === 'categorical');
  return maps.filter((map) => map.use !== 'categorical');
}

export function mapOf(field, state, maps) {
  const name = state.map[state.field] ?? field.map;
  return maps.find((map) => map.name === name) ?? maps[0];
}

/** Whether a field can have isolines or a grid; not on a logarithmic scale, where intervals differ. */
export const canHaveLines = ({ kind }) => ['scalar', 'diverging', 'distance', 'coordinates'].includes(kind);
export const hasLines = (field, state) =>
  canHaveLines(field) && (state.lines[state.field] ?? ['distance', 'coordinates'].includes(field.kind));

/** The interval of isolines: a round number, finer or coarser by the slider.
 *  @param spacing spacing of the points, in their unit */
export function intervalOf(field, state, [low, high], spacing) {
  if (!hasLines(field, state) || !(high > low)) return 0;
  // Lines through points are as wide as points, so intervals of lengths are at least a few spacings.
  const is_length = ['distance', 'coordinates'].includes(field.kind);
  const least = state.shown === 'points' && is_length ? 4.5 * spacing : 0;
  const wanted = (high - low) / (field.kind === 'coordinates' ? 8 : 16);
  return roundUp(Math.max(wanted, Math.min(least, (high - low) / 3)) * 2 ** -state.line_step);
}
