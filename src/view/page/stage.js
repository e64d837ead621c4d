// Draws the points, triangles and arrows.
import {
  BufferAttribute, BufferGeometry, Color, ColorManagement, DepthTexture, DoubleSide, LinearSRGBColorSpace, Mesh,
  NearestFilter, OrthographicCamera, PerspectiveCamera, Points, Scene, ShaderMaterial, UnsignedIntType, Vector2, Vector4,
  WebGLRenderTarget, WebGLRenderer,
} from 'three';
import { makeArrows } from './arrows.js';
import { Controls } from './controls.js';
import { makePath, makeRings } from './path.js';
import { domeFragment, domeVertex, pointFragment, pointVertex, triangleFragment, triangleVertex } from './shaders.js';

ColorManagement.enabled = false; // shows the colours of the maps unchanged

/** The width of a point in radii of its disc: less than the disc's own width, because points face the eye. */
const point_width = 1.3;
/** The vertical angles of view in degrees, usual and for plans. */
const usual_angle = 30, long_lens = 1;
/** The radius of a disc on a square grid, in spacings, see src/view/spacing.cpp. */
const grid_radius = 0.85 * Math.SQRT2;

export class Stage {
  constructor(element, positions, radii, directions, triangles, events) {
    Object.assign(this, { element, positions, radii, has_normals: Boolean(directions), events });
    this.renderer = new WebGLRenderer({ canvas: element, antialias: true, powerPreference: 'high-performance' });
    this.renderer.outputColorSpace = LinearSRGBColorSpace;
    this.camera = new PerspectiveCamera(usual_angle, 1, 0.01, 100);
    this.scene = new Scene();
    this.controls = new Controls(this.camera, element, { ...events, changed: () => { this.draw(); events.changed(); } });
    this.spacing = radii.quartile / grid_radius;
    this.is_lit = true;
    this.is_waiting = true; // until everything that the first picture shows is there
    this.size_factor = 1;
    this.makeUniforms();
    this.makeGeometry(directions, triangles);
    this.makeDome();
    new ResizeObserver(() => this.resize()).observe(element);
    element.addEventListener('webglcontextrestored', () => this.draw());
  }

  makeUniforms() {
    const list = {
      mode: 0, map: null, range: new Vector2(0, 1), plain: new Color(), no_value: new Color(), line_color: new Color(),
      interval: 0, start: 0, grid: 0, thickness: 0.08, is_lit: true, is_flat: false, clip: new Vector4(0, 0, 0, 1), size: 0, least_size: 1.5,
      pixels: 1, arrow_scale: 1, screen: new Vector2(), ratio: 1, path_lift: 0,
    };
    this.uniforms = {};
    for (const [name, value] of Object.entries(list)) this.uniforms[name] = { value };
  }

  set(values) {
    for (const [name, value] of Object.entries(values)) this.uniforms[name].value = value;
  }

  makeGeometry(directions, triangles) {
    const { shown, drawn, count } = this.positions;
    const attributes = { position: new BufferAttribute(shown, 3) };
    attributes.radius = new BufferAttribute(this.radii.each, 1);
    if (directions) attributes.direction = new BufferAttribute(directions, 2);
    attributes.drawn = new BufferAttribute(drawn, 1);
    this.points = new Points(new BufferGeometry(), this.material(pointVertex, pointFragment));
    for (const [name, attribute] of Object.entries(attributes)) this.points.geometry.setAttribute(name, attribute);
    this.corners = new Uint32Array(0);
    this.objects = [this.points];
    if (triangles) {
      this.corners = this.drawnTriangles(triangles, drawn);
      const geometry = new BufferGeometry();
      geometry.setAttribute('position', attributes.position);
      geometry.setIndex(new BufferAttribute(this.corners, 1));
      this.triangles = new Mesh(geometry, this.material(triangleVertex, triangleFragment, DoubleSide));
      this.objects.push(this.triangles);
      this.points.visible = false;
    }
    for (const object of this.objects) {
      object.frustumCulled = false;
      this.scene.add(object);
    }
    this.empty = { value: new Float32Array(count), known: new Uint8Array(count) };
    this.is_empty = !drawn.includes(1);
  }

  drawnTriangles(corners, drawn) {
    const kept = new Uint32Array(corners.length);
    let size = 0;
    for (let t = 0; t < corners.length; t += 3)
      if (drawn[corners[t]] && drawn[corners[t + 1]] && drawn[corners[t + 2]]) {
        kept.set(corners.subarray(t, t + 3), size);
        size += 3;
      }
    return kept.subarray(0, size);
  }

  material(vertexShader, fragmentShader, side = undefined) {
    return new ShaderMaterial({ vertexShader, fragmentShader, uniforms: this.uniforms, ...(side && { side }) });
  }

  makeDome() {
    this.target = new WebGLRenderTarget(1, 1, { minFilter: NearestFilter, magFilter: NearestFilter });
    this.target.depthTexture = new DepthTexture(1, 1, UnsignedIntType);
    this.dome_uniforms = {
      colors: { value: this.target.texture }, depths: { value: this.target.depthTexture }, pixel: { value: new Vector2() },
      near_far: { value: new Vector2() }, strength: { value: 0 },
    };
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(new Float32Array([-1, -1, 0, 3, -1, 0, -1, 3, 0]), 3));
    const material = new ShaderMaterial({
      vertexShader: domeVertex, fragmentShader: domeFragment, uniforms: this.dome_uniforms, depthTest: false,
      depthWrite: false,
    });
    this.dome = new Scene();
    const mesh = new Mesh(geometry, material);
    mesh.frustumCulled = false;
    this.dome.add(mesh);
    this.dome_camera = new OrthographicCamera();
  }

  /** Sets the values of the points: `scaled` and `known` of Values, `tints` (4 bytes each), `pairs` (2 floats each). */
  show({ scaled = this.empty.value, known = this.empty.known, tints = null, pairs = null }) {
    const attributes = {
      value: new BufferAttribute(scaled, 1), known: new BufferAttribute(known, 1, true),
      tint: tints && new BufferAttribute(tints, 4, true), pair: pairs && new BufferAttribute(pairs, 2),
    };
    for (const object of this.objects)
      for (const [name, attribute] of Object.entries(attributes))
        if (attribute) object.geometry.setAttribute(name, attribute);
        else object.geometry.deleteAttribute(name);
  }

  showArrows(values, colorAt) {
    if (this.arrows) {
      this.scene.remove(this.arrows);
      this.arrows.geometry.dispose();
      this.arrows = null;
    }
    if (!values) return;
    this.arrows = makeArrows(this.positions, values, this.spacing, this.uniforms, colorAt);
    this.scene.add(this.arrows);
  }

  /** Shows a line through corners (x, y, z of each), in a colour of numbers from 0 to 1. */
  showPath(corners, color) {
    for (const part of makePath(corners, this.positions, this.uniforms, color)) this.scene.add(part);
  }

  /** Marks points by rings, in a colour of numbers from 0 to 1. */
  showRings(rows, color) {
    for (const part of this.rings ?? []) {
      this.scene.remove(part);
      part.geometry.dispose();
    }
    this.rings = rows.length > 0 ? makeRings(rows, this.positions, this.uniforms, color) : [];
    for (const part of this.rings) this.scene.add(part);
  }

  /** Sees from afar, so that vertical walls of a plan are lines. */
  useLongLens() {
    this.camera.fov = long_lens;
  }

  /** Looks at the middle from a direction, at a distance from which all is seen, divided by `zoom`. */
  look(eye, up, zoom = 1) {
    this.controls.look(eye, up, (toEye) => this.distanceToSee(toEye) / zoom);
  }

  /** The distance of the eye from the middle of the box at which all points are seen, by the rows of `toEye`. */
  distanceToSee(toEye) {
    const { shown, drawn, count } = this.positions;
    const m = toEye.elements;
    const height = Math.tan((this.camera.fov * Math.PI) / 360);
    const width = height * this.camera.aspect;
    let distance = 0;
    for (let i = 0; i < count; ++i) {
      const [x, y, z] = [shown[3 * i], shown[3 * i + 1], shown[3 * i + 2]];
      if (!drawn[i] || Math.max(Math.abs(x), Math.abs(y), Math.abs(z)) > 0.501) continue;
      const right = Math.abs(m[0] * x + m[1] * y + m[2] * z) / width;
      const up = Math.abs(m[4] * x + m[5] * y + m[6] * z) / height;
      distance = Math.max(distance, Math.max(right, up) + m[8] * x + m[9] * y + m[10] * z);
    }
    return Math.max(1.28 * distance, 6 * this.spacing, 1e-3);
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.element;
    if (width === 0 || height === 0) return;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    const size = this.renderer.getDrawingBufferSize(new Vector2());
    this.target.setSize(size.x, size.y);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.drawNow();
    this.events.changed();
  }

  draw() {
    if (this.is_waiting) return;
    this.waiting ??= requestAnimationFrame(() => this.drawNow());
  }

  drawNow() {
    if (this.is_waiting) return;
    cancelAnimationFrame(this.waiting);
    this.waiting = null;
    const size = this.renderer.getDrawingBufferSize(new Vector2());
    const away = this.camera.position.length();
    this.camera.near = Math.max(this.controls.distance * 0.01, away - 2);
    this.camera.far = away + Math.max(4, this.controls.distance);
    this.camera.updateProjectionMatrix();
    this.set({
      is_lit: this.is_lit, size: point_width * this.size_factor,
      least_size: 1.5 * Math.min(2, this.size_factor) * this.renderer.getPixelRatio(),
      screen: size, ratio: this.renderer.getPixelRatio(),
      // Points face the eye, so on a slope the next one is nearer to it by up to the width of its disc.
      path_lift: this.radii.quartile * (this.points.visible ? point_width * this.size_factor : 0.5),
      pixels: size.y / (2 * Math.tan((this.camera.fov * Math.PI) / 360)),
    });
    const is_domed = this.points.visible;
    this.renderer.setRenderTarget(is_domed ? this.target : null);
    this.renderer.render(this.scene, this.camera);
    if (is_domed) {
      this.renderer.setRenderTarget(null);
      this.dome_uniforms.pixel.value.set(1 / size.x, 1 / size.y).multiplyScalar(this.renderer.getPixelRatio());
      this.dome_uniforms.near_far.value.set(this.camera.near, this.camera.far);
      // Large points form steps, at which full shading would outline each of them.
      const splat = (this.uniforms.size.value * this.radii.quartile * this.uniforms.pixels.value) / this.controls.distance;
      const softness = Math.min(1, Math.max(0.2, 4 / splat));
      this.dome_uniforms.strength.value = this.is_lit ? (this.has_normals ? 60 : 160) * softness * (usual_angle / this.camera.fov) : 0;
      this.renderer.render(this.dome, this.dome_camera);
    }
    this.drawn_pictures = (this.drawn_pictures ?? 0) + 1;
  }

  /** Whether a point is cut away. */
  clipTest() {
    const { x, y, z, w } = this.uniforms.clip.value;
    const { shown } = this.positions;
    return (row) => x * shown[3 * row] + y * shown[3 * row + 1] + z * shown[3 * row + 2] > w;
  }
}
