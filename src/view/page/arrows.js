// Arrows of a vector field, at an evenly spread part of the points.
import {
  ConeGeometry, CylinderGeometry, DoubleSide, InstancedBufferAttribute, InstancedBufferGeometry, Mesh, ShaderMaterial,
} from 'three';
import { arrowFragment, arrowVertex } from './shaders.js';

const most_arrows = 1500;

/** At most `most_arrows` rows: the middle one in each cell of a lattice. */
function spreadRows(positions, values) {
  const { shown, drawn, count } = positions;
  for (let cells = 64; ; cells /= 1.25) {
    const taken = new Map();
    for (let i = 0; i < count && taken.size <= most_arrows; ++i) {
      if (!drawn[i] || !values.known[i]) continue;
      let cell = 0;
      let away = 0;
      for (let axis = 0; axis < 3; ++axis) {
        const place = (shown[3 * i + axis] + 0.5) * cells;
        cell = cell * 4096 + Math.floor(place);
        away += (place - Math.floor(place) - 0.5) ** 2;
      }
      if (!(taken.get(cell)?.away <= away)) taken.set(cell, { row: i, away });
    }
    if (taken.size <= most_arrows) return { rows: Array.from(taken.values(), ({ row }) => row), cell: 1 / cells };
  }
}

function shape() {
  const shaft = new CylinderGeometry(0.05, 0.05, 0.7, 8).translate(0, 0.35, 0);
  const head = new ConeGeometry(0.15, 0.34, 10).translate(0, 0.83, 0);
  const geometry = new InstancedBufferGeometry();
  const places = [];
  for (const part of [shaft, head]) {
    const loose = part.rotateX(Math.PI / 2).toNonIndexed().getAttribute('position').array;
    places.push(...loose);
  }
  return [geometry, new Float32Array(places)];
}

/** @param colorAt returns the colour of a row as numbers from 0 to 1 */
export function makeArrows(positions, values, spacing, uniforms, colorAt) {
  const { rows, cell } = spreadRows(positions, values);
  const [geometry, places] = shape();
  geometry.setAttribute('position', new InstancedBufferAttribute(places, 3));
  geometry.getAttribute('position').isInstancedBufferAttribute = false;
  const foot = new Float32Array(3 * rows.length);
  const arrow = new Float32Array(3 * rows.length);
  const shade = new Float32Array(3 * rows.length);
  // Lengths relative to the end of the colour map, at most 2.
  const whole = values.ranges.usual[1] || 1;
  rows.forEach((row, i) => {
    const shortened = Math.min(1, 2 / (values.at(row) / whole));
    foot.set(positions.shown.subarray(3 * row, 3 * row + 3), 3 * i);
    shade.set(colorAt(row), 3 * i);
    for (let axis = 0; axis < 3; ++axis) arrow[3 * i + axis] = (values.parts[axis].at(row) / whole) * shortened;
  });
  geometry.setAttribute('foot', new InstancedBufferAttribute(foot, 3));
  geometry.setAttribute('arrow', new InstancedBufferAttribute(arrow, 3));
  geometry.setAttribute('shade', new InstancedBufferAttribute(shade, 3));
  geometry.instanceCount = rows.length;
  uniforms.arrow_scale.value = Math.max(1.5 * cell, 2 * spacing);
  const material = new ShaderMaterial({ vertexShader: arrowVertex, fragmentShader: arrowFragment, uniforms, side: DoubleSide });
  const mesh = new Mesh(geometry, material);
  mesh.frustumCulled = false;
  return mesh;
}
