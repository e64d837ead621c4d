// Turning, moving and zooming by mouse, touch and keys. The eye turns freely about the axes of the screen, because
// scans have no certain up direction.
import { Quaternion, Vector3 } from 'three';

const x_axis = new Vector3(1, 0, 0);
const y_axis = new Vector3(0, 1, 0);
const z_axis = new Vector3(0, 0, 1);
const turn = (axis, angle) => new Quaternion().setFromAxisAngle(axis, angle);

export class Controls {
  /** @param camera a perspective camera, which these controls place
   *  @param events `changed()` after each change, `tapped(x, y, is_touch)`, `hovered(x, y)` and `left()` */
  constructor(camera, element, events) {
    Object.assign(this, { camera, element, events, target: new Vector3(), turned: new Quaternion(), distance: 3 });
    this.pointers = new Map();
    element.addEventListener('pointerdown', (event) => this.down(event));
    element.addEventListener('pointermove', (event) => this.move(event));
    for (const name of ['pointerup', 'pointercancel']) element.addEventListener(name, (event) => this.up(event));
    element.addEventListener('pointerleave', () => events.left());
    element.addEventListener('contextmenu', (event) => event.preventDefault());
    element.addEventListener('wheel', (event) => {
      event.preventDefault();
      const lines = event.deltaMode === 1 ? 16 : 1;
      this.zoom(Math.exp(Math.max(-200, Math.min(200, event.deltaY * lines)) * 0.0015), event.offsetX, event.offsetY);
    }, { passive: false });
  }

  /** Looks at the middle from the direction `eye`, from as far as `distanceOf(matrix)` says; its columns are the axes of
   *  the screen. */
  look(eye, up, distanceOf) {
    const back = new Vector3(...eye).normalize();
    let right = new Vector3(...up).cross(back);
    if (right.length() < 1e-6) right = new Vector3().crossVectors(Math.abs(back.y) < 0.9 ? y_axis : z_axis, back);
    right.normalize();
    const matrix = this.camera.matrix.clone().makeBasis(right, new Vector3().crossVectors(back, right), back);
    this.turned.setFromRotationMatrix(matrix);
    this.target.set(0, 0, 0);
    this.distance = distanceOf(matrix);
    this.place();
  }

  place() {
    this.camera.quaternion.copy(this.turned);
    this.camera.position.copy(this.target).addScaledVector(z_axis.clone().applyQuaternion(this.turned), this.distance);
    this.camera.updateMatrixWorld();
    this.events.changed();
  }

  /** The size of a pixel at the target, in the units of space. */
  pixel() {
    return (2 * this.distance * Math.tan((this.camera.fov * Math.PI) / 360)) / this.element.clientHeight;
  }

  rotate(right, down) {
    this.turned.multiply(turn(y_axis, -right)).multiply(turn(x_axis, -down)).normalize();
    this.place();
  }

  pan(right, down) {
    const step = new Vector3(-right, down, 0).multiplyScalar(this.pixel()).applyQuaternion(this.turned);
    this.target.add(step);
    this.place();
  }

  /** Changes the distance, so that what is at a place on the screen stays there. */
  zoom(factor, x = this.element.clientWidth / 2, y = this.element.clientHeight / 2) {
    const distance = Math.min(1e4, Math.max(1e-4, this.distance * factor));
    const right = (x - this.element.clientWidth / 2) * (1 - distance / this.distance);
    const down = (y - this.element.clientHeight / 2) * (1 - distance / this.distance);
    this.pan(-right, -down);
    this.distance = distance;
    this.place();
  }

  down(event) {
    this.element.focus({ preventScroll: true });
    try {
      this.element.setPointerCapture(event.pointerId);
    } catch { /* the finger has left the screen */ }
    this.pointers.set(event.pointerId, { x: event.offsetX, y: event.offsetY });
    if (this.pointers.size === 1) Object.assign(this, { travel: 0, fingers: 1 });
    this.fingers = Math.max(this.fingers, this.pointers.size);
  }

  move(event) {
    const last = this.pointers.get(event.pointerId);
    if (!last) {
      if (event.pointerType === 'mouse') this.events.hovered(event.offsetX, event.offsetY);
      return;
    }
    const before = [...this.pointers.values()].map((pointer) => ({ ...pointer }));
    const step = { x: event.offsetX - last.x, y: event.offsetY - last.y };
    Object.assign(last, { x: event.offsetX, y: event.offsetY });
    this.travel += Math.hypot(step.x, step.y);
    if (this.travel < 4) return; // ignores a shaking hand
    const after = [...this.pointers.values()];
    if (after.length === 1) {
      const turns = Math.PI / Math.max(300, Math.min(this.element.clientWidth, this.element.clientHeight));
      if (event.buttons & 6 || event.shiftKey) this.pan(step.x, step.y);
      else this.rotate(step.x * turns, step.y * turns);
    } else this.pinch(before, after);
  }

  /** Two fingers: their middle moves, their distance zooms, their direction rolls. */
  pinch([a, b], [c, d]) {
    const spread = [Math.hypot(b.x - a.x, b.y - a.y), Math.hypot(d.x - c.x, d.y - c.y)];
    const roll = Math.atan2(d.y - c.y, d.x - c.x) - Math.atan2(b.y - a.y, b.x - a.x);
    this.pan((c.x + d.x - a.x - b.x) / 2, (c.y + d.y - a.y - b.y) / 2);
    this.turned.multiply(turn(z_axis, Math.atan2(Math.sin(roll), Math.cos(roll)))).normalize();
    if (spread[1] > 1) this.zoom(spread[0] / spread[1], (c.x + d.x) / 2, (c.y + d.y) / 2);
  }

  up(event) {
    if (!this.pointers.delete(event.pointerId) || event.type === 'pointercancel') return;
    if (this.pointers.size === 0 && this.fingers === 1 && this.travel < 4)
      this.events.tapped(event.offsetX, event.offsetY, event.pointerType !== 'mouse');
  }

  /** @returns whether the key was one of these controls */
  key(event) {
    const step = 0.08;
    const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    if (arrows[event.key]) {
      const [right, down] = arrows[event.key];
      if (event.shiftKey) this.pan(40 * right, 40 * down);
      else this.rotate(step * right, step * down);
    } else if (event.key === '+' || event.key === '=') this.zoom(1 / 1.15);
    else if (event.key === '-') this.zoom(1.15);
    else return false;
    return true;
  }
}
