// The programs of the graphics card. A surface that faces the eye has exactly the colour of its value.

const shared = `
  uniform int mode;        // 0: one colour, 1: by the map, 2: a colour of each point
  uniform sampler2D map;
  uniform vec2 range;      // the scaled value of the first colour, and one over that of the range
  uniform vec3 plain, no_value, line_color;
  uniform float interval;  // between isolines, scaled; 0: none
  uniform float start;     // the scaled value of 0, where an isoline runs
  uniform float grid;      // between grid lines of coordinates; 0: none
  uniform float thickness; // half of that of a line through points, in intervals
  uniform bool is_lit;
`;

const vertexShared = `
  attribute float value, known;
  attribute vec4 tint;
  attribute vec2 pair;
  uniform vec4 clip;       // drawn where clip.xyz * position <= clip.w
  varying float v_value, v_known, v_side;
  varying vec3 v_eye;
  varying vec2 v_pair;
`;

const fragmentShared = `
  varying float v_value, v_known, v_side;
  varying vec3 v_eye;
  varying vec2 v_pair;
  vec3 colorOfValue(vec4 tint) {
    if (mode == 0) return plain;
    if (mode == 2) return tint.a > 0.5 ? tint.rgb : no_value;
    if (v_known < 0.999) return no_value;
    float t = clamp((v_value - range.x) * range.y, 0.0, 1.0);
    return texture2D(map, vec2((t * 255.0 + 0.5) / 256.0, 0.5)).rgb;
  }
  float toWhole(float x) { return abs(fract(x + 0.5) - 0.5); }
`;

export const pointVertex = `
  ${vertexShared}
  attribute vec2 direction;
  attribute float drawn, radius;
  const float bulge = 0.05;
  uniform float size, least_size, pixels;  // of discs in their radii; least_size in pixels; pixels of a unit at distance 1
  varying vec4 v_tint;
  varying float v_light, v_size;
  flat varying vec4 v_depth;  // of the middle and its rim, and how depths become those of the screen
  vec3 unfolded(vec2 bytes) {
    vec2 p = (bytes - 128.0) / 127.0;
    vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    if (n.z < 0.0) n.xy = (1.0 - abs(n.yx)) * vec2(n.x < 0.0 ? -1.0 : 1.0, n.y < 0.0 ? -1.0 : 1.0);
    return normalize(n);
  }
  void main() {
    vec4 eye = modelViewMatrix * vec4(position, 1.0);
    v_value = value; v_known = known; v_tint = tint; v_eye = eye.xyz; v_pair = pair;
    v_side = dot(clip.xyz, position) - clip.w;
    v_light = 1.0;
    if (direction.x > 0.5) v_light = abs(dot(normalize(normalMatrix * unfolded(direction)), normalize(eye.xyz)));
    gl_Position = projectionMatrix * eye;
    gl_PointSize = v_size = clamp(size * radius * pixels / max(-eye.z, 1e-6), least_size, 64.0);
    v_depth = vec4(eye.z, bulge * size * radius, projectionMatrix[2][2], projectionMatrix[3][2]);
    if (drawn < 0.5 || v_side > 0.0) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  }`;

export const pointFragment = `
  ${shared}
  ${fragmentShared}
  varying vec4 v_tint;
  varying float v_light, v_size;
  flat varying vec4 v_depth;
  void main() {
    vec2 q = 2.0 * gl_PointCoord - 1.0;
    if (v_size > 2.5 && dot(q, q) > 1.0) discard;
    // Discs stand forward in their middle: of overlapping ones the nearest point is seen.
    float z = v_depth.x - v_depth.y * min(dot(q, q), 1.0);
    gl_FragDepth = 0.5 - 0.5 * (v_depth.z * z + v_depth.w) / z;
    vec3 color = colorOfValue(v_tint);
    // A point has one value: those near a line are dark.
    float part = 0.0;
    if (interval > 0.0 && v_known > 0.5) part = 1.0 - smoothstep(0.7 * thickness, 1.3 * thickness, toWhole((v_value - start) / interval));
    if (grid > 0.0 && v_known > 0.5)
      part = 1.0 - smoothstep(0.7 * thickness, 1.3 * thickness, min(toWhole(v_pair.x / grid), toWhole(v_pair.y / grid)));
    color = mix(color, line_color, 0.75 * part);
    gl_FragColor = vec4(is_lit ? color * (0.35 + 0.65 * v_light) : color, 1.0);
  }`;

export const triangleVertex = `
  ${vertexShared}
  flat varying vec4 v_tint;
  varying vec4 v_blend;
  void main() {
    vec4 eye = modelViewMatrix * vec4(position, 1.0);
    v_value = value; v_known = known; v_tint = tint; v_blend = tint; v_eye = eye.xyz; v_pair = pair;
    v_side = dot(clip.xyz, position) - clip.w;
    gl_Position = projectionMatrix * eye;
  }`;

export const triangleFragment = `
  ${shared}
  ${fragmentShared}
  uniform bool is_flat;  // a triangle has the colour of one corner
  flat varying vec4 v_tint;
  varying vec4 v_blend;
  void main() {
    if (v_side > 0.0) discard;
    vec3 color = colorOfValue(is_flat ? v_tint : v_blend);
    float part = 0.0;
    float x = (v_value - start) / max(interval, 1e-30);
    float width = fwidth(x);
    vec2 uv = v_pair / max(grid, 1e-30);
    vec2 widths = fwidth(uv);
    if (v_known > 0.999) {
      if (interval > 0.0 && width > 0.0) part = 1.0 - smoothstep(0.6, 1.4, toWhole(x) / width);
      if (grid > 0.0)
        part = 1.0 - smoothstep(0.6, 1.4, min(toWhole(uv.x) / max(widths.x, 1e-9), toWhole(uv.y) / max(widths.y, 1e-9)));
    }
    color = mix(color, line_color, 0.75 * part);
    vec3 normal = normalize(cross(dFdx(v_eye), dFdy(v_eye)));
    if (is_lit) color *= 0.35 + 0.65 * abs(dot(normal, normalize(v_eye)));
    gl_FragColor = vec4(color, 1.0);
  }`;

export const arrowVertex = `
  attribute vec3 foot, arrow;
  attribute vec3 shade;
  uniform float arrow_scale;
  uniform vec4 clip;
  varying vec3 v_color, v_eye;
  void main() {
    float size = length(arrow) * arrow_scale;
    vec3 along = normalize(arrow);
    vec3 side = normalize(cross(along, abs(along.z) < 0.9 ? vec3(0, 0, 1) : vec3(1, 0, 0)));
    vec3 place = foot + size * (along * position.z + 0.9 * (side * position.x + cross(along, side) * position.y));
    vec4 eye = modelViewMatrix * vec4(place, 1.0);
    v_color = shade; v_eye = eye.xyz;
    gl_Position = projectionMatrix * eye;
    gl_Position.z -= 0.002 * gl_Position.w;  // not hidden by the surface that it lies in
    if (dot(clip.xyz, foot) > clip.w) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  }`;

export const arrowFragment = `
  uniform bool is_lit;
  varying vec3 v_color, v_eye;
  void main() {
    vec3 normal = normalize(cross(dFdx(v_eye), dFdy(v_eye)));
    float light = is_lit ? 0.55 + 0.45 * abs(dot(normal, normalize(v_eye))) : 1.0;
    gl_FragColor = vec4(v_color * light, 1.0);
  }`;

// Strokes have the same width on the screen at any distance, and round ends.
export const pathVertex = `
  attribute vec3 begin, end;
  attribute vec3 shade;
  attribute float width;
  uniform vec2 screen;     // pixels
  uniform float ratio;     // pixels of the screen in one of the page
  uniform float path_lift; // towards the eye, so that the surface that it lies on does not hide it
  uniform vec4 clip;
  varying vec3 v_color;
  varying vec2 v_place;    // along and across the stroke, in pixels
  varying float v_length, v_half;
  vec4 lifted(vec3 place) {
    vec3 eye = (modelViewMatrix * vec4(place, 1.0)).xyz;
    return projectionMatrix * vec4(eye * (1.0 - min(path_lift / length(eye), 0.5)), 1.0);
  }
  void main() {
    const float nearest = 1e-4;
    vec4 a = lifted(begin), b = lifted(end);
    v_color = shade;
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    if (max(a.w, b.w) < nearest || dot(clip.xyz, begin) > clip.w) return;
    if (a.w < nearest) a = mix(b, a, (b.w - nearest) / (b.w - a.w));
    if (b.w < nearest) b = mix(a, b, (a.w - nearest) / (a.w - b.w));
    vec2 from = 0.5 * screen * a.xy / a.w, to = 0.5 * screen * b.xy / b.w;
    v_length = distance(from, to);
    v_half = 0.5 * width * ratio;
    vec2 along = v_length > 0.0 ? (to - from) / v_length : vec2(1.0, 0.0);
    vec2 place = (position.x < 0.0 ? from : to) + v_half * (position.x * along + position.y * vec2(-along.y, along.x));
    v_place = vec2(dot(place - from, along), position.y * v_half);
    // Divided here, so that places on the screen are between those of the corners.
    gl_Position = vec4(2.0 * place / screen, position.x < 0.0 ? a.z / a.w : b.z / b.w, 1.0);
  }`;

export const pathFragment = `
  varying vec3 v_color;
  varying vec2 v_place;
  varying float v_length, v_half;
  void main() {
    if (distance(v_place, vec2(clamp(v_place.x, 0.0, v_length), 0.0)) > v_half) discard;
    #ifdef STIPPLED
      if (mod(floor(gl_FragCoord.x / 3.0) + floor(gl_FragCoord.y / 3.0), 2.0) > 0.5) discard;
    #endif
    gl_FragColor = vec4(v_color, 1.0);
  }`;

// Eye-dome lighting (Boucheny 2009): a pixel is darker the farther it lies behind its neighbours.
export const domeVertex = `
  varying vec2 v_uv;
  void main() { v_uv = position.xy * 0.5 + 0.5; gl_Position = vec4(position.xy, 0.0, 1.0); }`;

export const domeFragment = `
  uniform sampler2D colors, depths;
  uniform vec2 pixel;
  uniform vec2 near_far;
  uniform float strength;
  varying vec2 v_uv;
  float logDepth(vec2 uv) {
    float d = texture2D(depths, uv).r;
    return log2(near_far.x * near_far.y / (near_far.y - d * (near_far.y - near_far.x)));
  }
  void main() {
    vec4 color = texture2D(colors, v_uv);
    float shade = 1.0;
    if (strength > 0.0 && texture2D(depths, v_uv).r < 1.0) {
      float own = logDepth(v_uv), sum = 0.0;
      for (int k = 0; k < 8; ++k) {
        float angle = 0.785398 * float(k);
        sum += max(0.0, own - logDepth(v_uv + 1.5 * pixel * vec2(cos(angle), sin(angle))));
      }
      shade = max(0.25, exp(-strength * sum / 8.0));
    }
    gl_FragColor = vec4(color.rgb * shade, 1.0);
  }`;
