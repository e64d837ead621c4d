// Finds the point under the pointer.
import { Matrix4, Vector3 } from 'three';

/** Maps points in space to the screen: [x, y, depth], x and y in pixels of the page; null behind the eye. */
export function projector(camera, element) {
  const m = new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse).elements;
  const width = element.clientWidth / 2;
  const height = element.clientHeight / 2;
  return (x, y, z, out) => {
    const w = m[3] * x + m[7] * y + m[11] * z + m[15];
    if (w <= 0) return false;
    out[0] = width * (1 + (m[0] * x + m[4] * y + m[8] * z + m[12]) / w);
    out[1] = height * (1 - (m[1] * x + m[5] * y + m[9] * z + m[13]) / w);
    out[2] = w;
    return true;
  };
}

/** The front one of the points within `reach` pixels, or -1. */
export function pickPoint(stage, x, y, reach) {
  const { shown, drawn, count } = stage.positions;
  const project = projector(stage.camera, stage.element);
  const is_clipped = stage.clipTest();
  const at = [0, 0, 0];
  let best = -1;
  let best_score = Infinity;
  for (let i = 0; i < count; ++i) {
    if (!drawn[i] || !project(shown[3 * i], shown[3 * i + 1], shown[3 * i + 2], at)) continue;
    const away = Math.max(Math.abs(at[0] - x), Math.abs(at[1] - y));
    if (away > reach || is_clipped(i)) continue;
    // Prefers the front surface, and on it the nearest point: a pixel aside counts as two pixels of depth.
    const score = at[2] + Math.hypot(at[0] - x, at[1] - y) * stage.controls.pixel() * 2;
    if (score < best_score) [best, best_score] = [i, score];
  }
  return best;
}

/** The corner nearest to where the line of sight meets the first triangle, or -1. */
export function pickTriangle(stage, x, y) {
  const { shown } = stage.positions;
  const { corners } = stage;
  const project = projector(stage.camera, stage.element);
  const is_clipped = stage.clipTest();
  const places = new Float32Array(shown.length);
  const at = [0, 0, 0];
  for (let i = 0; i < shown.length; i += 3) {
    if (!project(shown[i], shown[i + 1], shown[i + 2], at)) at[2] = -1;
    places.set(at, i);
  }
  let best = -1;
  let best_depth = Infinity;
  for (let t = 0; t < corners.length; t += 3) {
    const [a, b, c] = [3 * corners[t], 3 * corners[t + 1], 3 * corners[t + 2]];
    if (places[a + 2] <= 0 || places[b + 2] <= 0 || places[c + 2] <= 0) continue;
    const side = (p, q) =>
      (places[q] - places[p]) * (y - places[p + 1]) - (places[q + 1] - places[p + 1]) * (x - places[p]);
    const [u, v, w] = [side(b, c), side(c, a), side(a, b)];
    const sum = u + v + w;
    if (sum === 0 || u * sum < 0 || v * sum < 0 || w * sum < 0) continue;
    const depth = sum / (u / places[a + 2] + v / places[b + 2] + w / places[c + 2]);
    if (depth >= best_depth) continue;
    const nearest = u * sum >= v * sum && u * sum >= w * sum ? a : v * sum >= w * sum ? b : c;
    if (is_clipped(nearest / 3)) continue;
    [best, best_depth] = [nearest / 3, depth];
  }
  return best;
}

export const placeOf = (stage, row) => {
  const at = [0, 0, 0];
  const { shown } = stage.positions;
  return projector(stage.camera, stage.element)(...shown.subarray(3 * row, 3 * row + 3), at) ? at : null;
};
export const vectorOf = (shown, row) => new Vector3(shown[3 * row], shown[3 * row + 1], shown[3 * row + 2]);
