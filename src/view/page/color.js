// Colour maps, which come with the data.
import { ClampToEdgeWrapping, DataTexture, LinearFilter } from 'three';
import { bytesOf } from './data.js';

/** The colour of a direction, see directionColor() of src/view/color_maps.h; null for 0 and NaN. */
export function directionColor(direction) {
  const length = Math.hypot(...direction);
  return length > 0 ? direction.map((part) => Math.round(127.5 * (1 + part / length))) : null;
}

export const cssColor = (rgb) => `rgb(${rgb.join(' ')})`;

/** The maps of the page: name, use, and colours as a list of [red, green, blue]. */
export function colorMaps(scene) {
  return scene.maps.map((map) => {
    const bytes = bytesOf(map.colors);
    const colors = [];
    for (let i = 0; i < bytes.length; i += 3) colors.push([...bytes.subarray(i, i + 3)]);
    return { name: map.name, use: map.use, colors };
  });
}

export function mapTexture(map) {
  const bytes = new Uint8Array(4 * map.colors.length);
  map.colors.forEach((color, i) => bytes.set([...color, 255], 4 * i));
  const texture = new DataTexture(bytes, map.colors.length, 1);
  texture.minFilter = texture.magFilter = LinearFilter;
  texture.wrapS = texture.wrapT = ClampToEdgeWrapping;
  texture.needsUpdate = true;
  return texture;
}

/** The colour of a label, in a map whose colours repeat; `none` for negative labels, null for NaN. */
export function labelColor(map, label, none) {
  if (label < 0) return none;
  if (!Number.isFinite(label)) return null;
  return map.colors[Math.round(label) % map.colors.length];
}
