// A path on the surface: a line with a rim, of a width in pixels, dashed where it is hidden, with circles at its ends.
import {
  GreaterDepth, InstancedBufferAttribute, InstancedBufferGeometry, BufferAttribute, LessEqualDepth, Mesh, ShaderMaterial,
} from 'three';
import { pathFragment, pathVertex } from './shaders.js';

const widths = { rim: 6, line: 3, hidden: 2, end_rim: 13, end: 10, hole: 5 }; // pixels
const white = [1, 1, 1];

/** The corners in the coordinates of shown points, without those that are not finite. */
function shownCorners(corners, { axes, sides }) {
  const places = [];
  for (let i = 0; i + 2 < corners.length; i += 3) {
    const place = axes.map((axis, k) => (axis.step > 0 ? (axis.toScaled(corners[i + k]) - 0.5) * sides[k] : 0));
    if (place.every(Number.isFinite)) places.push(place);
  }
  return places;
}

/** @param strokes lists of from, to, width and colour; later ones are drawn above earlier ones */
function strokesMesh(strokes, uniforms, options) {
  const geometry = new InstancedBufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array([-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0]), 3));
  geometry.setIndex([0, 1, 2, 0, 2, 3]);
  const attribute = (name, size, of) =>
    geometry.setAttribute(name, new InstancedBufferAttribute(Float32Array.from(strokes.flatMap(of)), size));
  attribute('begin', 3, ([begin]) => begin);
  attribute('end', 3, ([, end]) => end);
  attribute('width', 1, ([, , width]) => [width]);
  attribute('shade', 3, ([, , , shade]) => shade);
  geometry.instanceCount = strokes.length;
  const material = new ShaderMaterial({
    vertexShader: pathVertex, fragmentShader: pathFragment, uniforms, depthWrite: false, ...options,
  });
  const mesh = new Mesh(geometry, material);
  mesh.frustumCulled = false;
  mesh.renderOrder = 1; // after the points, whose depths may hide it
  return mesh;
}

/** @param hidden strokes that are drawn where something is in front of them; `seen` elsewhere */
const meshesOf = (hidden, seen, uniforms) => [
  strokesMesh(hidden, uniforms, { depthFunc: GreaterDepth, defines: { STIPPLED: 1 } }),
  strokesMesh(seen, uniforms, { depthFunc: LessEqualDepth })];

const dots = (places, width, shade) => places.map((place) => [place, place, width, shade]);
const rings = (places, color) => [
  ...dots(places, widths.end_rim, white), ...dots(places, widths.end, color), ...dots(places, widths.hole, white)];

/** Rings around points. @param color numbers from 0 to 1 */
export function makeRings(rows, { shown }, uniforms, color) {
  const places = rows.map((row) => [...shown.subarray(3 * row, 3 * row + 3)]);
  return meshesOf(dots(places, widths.end, color), rings(places, color), uniforms);
}

/** @param color numbers from 0 to 1 */
export function makePath(corners, positions, uniforms, color) {
  const places = shownCorners(corners, positions);
  if (places.length === 0) return [];
  const along = (width, shade) => places.slice(1).map((place, i) => [places[i], place, width, shade]);
  const [first, last] = [places[0], places[places.length - 1]];
  const seen = [
    ...along(widths.rim, white), ...along(widths.line, color), ...dots([last], widths.end_rim, white),
    ...dots([last], widths.end, color), ...rings([first], color),
  ];
  return meshesOf([...along(widths.hidden, color), ...dots([first, last], widths.end, color)], seen, uniforms);
}
