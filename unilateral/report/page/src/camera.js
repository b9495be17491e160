// A parallel projection that mouse, fingers and keys turn, shift and zoom. Everything is drawn in units of the size of the scene around its
// centre; so the same view can be used for scenes of different sizes, side by side.
import { dot } from "./geometry.js";

const degree = Math.PI / 180;

/** Named directions: [azimuth, elevation] in degrees. */
export const views = {
  top: [0, 90],
  front: [0, 0],
  side: [90, 0],
  oblique: [-35, 32],
  below: [-35, -32],
};

/** Of the axis that is up: the directions to the right, away and up of the view from the front. With y up, x is to the right and z towards the viewer. */
// prettier-ignore
const frames = {
  x: [[0, 1, 0], [0, 0, 1], [1, 0, 0]],
  y: [[1, 0, 0], [0, 0, -1], [0, 1, 0]],
  z: [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
};

/** Where the viewer stands: azimuth and elevation, the point in the middle of the picture, and how much is seen of the smaller side. */
export class Camera {
  constructor() {
    this.frame = frames.z;
    this.look(0, 90);
    this.target = [0, 0, 0];
    this.span = 1.2;
  }

  /** Sets the direction, in degrees. */
  look(azimuth, elevation) {
    this.azimuth = azimuth;
    this.elevation = Math.max(-90, Math.min(90, elevation));
    const [ca, sa] = [Math.cos(azimuth * degree), Math.sin(azimuth * degree)];
    const [ce, se] = [Math.cos(this.elevation * degree), Math.sin(this.elevation * degree)];
    const turned = (vector) => [0, 1, 2].map((c) => vector[0] * this.frame[0][c] + vector[1] * this.frame[1][c] + vector[2] * this.frame[2][c]);
    this.right = turned([ca, sa, 0]);
    this.back = turned([sa * ce, -ca * ce, se]); // towards the viewer
    this.up = turned([-sa * se, ca * se, ce]); // back × right
  }

  /** Makes an axis, "x", "y" or "z", the one that is up; azimuth and elevation stay. */
  set_up(axis) {
    this.frame = frames[axis] ?? frames.z;
    this.look(this.azimuth, this.elevation);
  }

  /** The direction of sight. */
  get forward() {
    return this.back.map((value) => -value);
  }

  /** Pixels per unit on a canvas of this size. */
  scale(width, height) {
    return Math.min(width, height) / this.span;
  }

  /** The point, in the plane through the target, under a pixel. */
  at([x, y], width, height) {
    const scale = this.scale(width, height);
    const [a, b] = [(x - width / 2) / scale, (height / 2 - y) / scale];
    return this.target.map((t, c) => t + a * this.right[c] + b * this.up[c]);
  }

  /** The pixel where a point appears. */
  pixel(point, width, height) {
    const scale = this.scale(width, height);
    const offset = point.map((value, c) => value - this.target[c]);
    return [width / 2 + scale * dot(offset, this.right), height / 2 - scale * dot(offset, this.up)];
  }

  /** Shifts the picture by pixels. */
  pan(dx, dy, width, height) {
    const scale = this.scale(width, height);
    this.target = this.target.map((t, c) => t - (dx * this.right[c] - dy * this.up[c]) / scale);
  }

  /** Zooms by a factor, with the point under the pixel staying there. */
  zoom(factor, pixel, width, height) {
    const before = this.at(pixel, width, height);
    this.span = Math.max(1e-4, Math.min(20, this.span / factor));
    const after = this.at(pixel, width, height);
    this.target = this.target.map((t, c) => t + before[c] - after[c]);
  }

  /** Shows a box as a whole, seen from the present direction. */
  fit(low, high, width, height) {
    this.target = low.map((value, c) => (value + high[c]) / 2);
    let [w, h] = [0, 0];
    for (let corner = 0; corner < 8; ++corner) {
      const offset = low.map((value, c) => ((corner >> c) & 1 ? high[c] : value) - this.target[c]);
      w = Math.max(w, Math.abs(dot(offset, this.right)));
      h = Math.max(h, Math.abs(dot(offset, this.up)));
    }
    const smaller = Math.min(width, height);
    this.span = 2.16 * Math.max((w * smaller) / width, (h * smaller) / height) || 1.2;
  }

  /** Takes over the view of another camera. */
  copy(other) {
    this.look(other.azimuth, other.elevation);
    this.target = [...other.target];
    this.span = other.span;
  }
}

/**
 * Lets the reader move a camera on an element. `flat` tells whether there is only one sensible direction: then dragging shifts instead of turning.
 * `moved` is called after every change, `reset` by the key 0. The wheel zooms only once the picture has the focus: before, it scrolls the page.
 */
export function add_gestures(element, camera, { flat, moved, reset, blocked }) {
  const pointers = new Map();
  const size = () => [element.clientWidth, element.clientHeight];
  const place = (event) => {
    const box = element.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };

  element.addEventListener("contextmenu", (event) => event.preventDefault());
  element.addEventListener("pointerdown", (event) => {
    if (blocked()) return;
    element.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, place(event));
  });
  element.addEventListener("pointermove", (event) => {
    const old = pointers.get(event.pointerId);
    if (!old || blocked()) return;
    const now = place(event);
    const [dx, dy] = [now[0] - old[0], now[1] - old[1]];
    if (pointers.size === 1) {
      const turns = (event.buttons & 1) === 1 && !event.ctrlKey && !event.metaKey && event.shiftKey === flat();
      if (turns) camera.look(camera.azimuth - 0.4 * dx, camera.elevation + 0.4 * dy);
      else camera.pan(dx, dy, ...size());
    } else if (pointers.size === 2) {
      const other = [...pointers].find(([id]) => id !== event.pointerId)[1];
      const spread = (a) => Math.hypot(a[0] - other[0], a[1] - other[1]) || 1;
      camera.pan(dx / 2, dy / 2, ...size());
      camera.zoom(spread(now) / spread(old), [(now[0] + other[0]) / 2, (now[1] + other[1]) / 2], ...size());
    }
    pointers.set(event.pointerId, now);
    moved();
  });
  for (const end of ["pointerup", "pointercancel", "lostpointercapture"]) element.addEventListener(end, (event) => pointers.delete(event.pointerId));

  element.addEventListener(
    "wheel",
    (event) => {
      if (document.activeElement !== element && !event.ctrlKey) return;
      event.preventDefault();
      const lines = event.deltaMode === 1 ? 16 : 1;
      camera.zoom(Math.exp(-0.0015 * lines * event.deltaY), place(event), ...size());
      moved();
    },
    { passive: false },
  );

  element.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const middle = size().map((value) => value / 2);
    const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    if (event.key in arrows) {
      const [x, y] = arrows[event.key];
      if (event.shiftKey === flat()) camera.look(camera.azimuth + 6 * x, camera.elevation - 6 * y);
      else camera.pan(-30 * x, -30 * y, ...size());
    } else if (event.key === "+" || event.key === "=") camera.zoom(1.2, middle, ...size());
    else if (event.key === "-" || event.key === "_") camera.zoom(1 / 1.2, middle, ...size());
    else if (event.key === "0") reset();
    else return;
    event.preventDefault();
    moved();
  });
}
