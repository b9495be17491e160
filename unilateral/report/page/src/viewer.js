// A picture of one scene that the reader can turn: the canvas with its tooltip and colour bars in place of the static picture of a <figure>.
import { Matrix4, OrthographicCamera, Scene as Graph } from "three";
import { add_gestures, Camera, views } from "./camera.js";
import { gradient, paint } from "./colours.js";
import { file_name, make, save } from "./dom.js";
import { evaluate, evaluate_vector, pick } from "./geometry.js";
import { BodyObstacle, Bounds, Cloud, ContactOutline, SectionLine, Shape, Surface } from "./layers.js";
import { format, ticks } from "./numbers.js";
import { draw, on_restored } from "./stage.js";
import { colour } from "./theme.js";

/** A section that is being drawn, or a tap, must not be taken for a drag when the hand shakes. */
const steady = 6;

const depth = 50;

/** What colour bars show: the same on the page and in a saved picture. */
class ColourBar {
  constructor(map) {
    this.map = map;
    this.name = make("span", { class: "bar-name" });
    this.strip = make("div", { class: "bar-strip" });
    this.strip.style.background = gradient(map);
    this.ticks = make("div", { class: "bar-ticks" });
    this.element = make("div", { class: "bar", hidden: true }, this.name, make("div", { class: "bar-scale" }, this.strip, this.ticks));
  }

  set(name, range) {
    this.range = range;
    this.label = name;
    this.name.textContent = name;
    this.element.hidden = false;
    this.ticks.replaceChildren(
      ...this.marks().map(([at, text]) => {
        const tick = make("span", { textContent: text });
        tick.style.left = `${100 * at}%`;
        return tick;
      }),
    );
  }

  /** [place from 0 to 1, text] of every tick. */
  marks() {
    const [low, high] = this.range;
    if (!(high > low)) return [[0.5, format(low)]];
    return ticks(low, high, 4).map((value) => [(value - low) / (high - low), format(value)]);
  }
}

/** See above. `changed(viewer)` is called when the reader moved the camera. */
export class Viewer {
  constructor(figure, { changed }) {
    this.figure = figure;
    this.camera = new Camera();
    this.changed = changed;
    this.graph = new Graph();
    this.lens = new OrthographicCamera(-1, 1, 1, -1, 0, 2 * depth);
    this.lens.matrixAutoUpdate = false;
    this.layers = {};
    this.#make_elements();
    on_restored(() => this.redraw());
    new ResizeObserver(() => this.redraw()).observe(this.stage);
  }

  #make_elements() {
    this.canvas = make("canvas", { class: "picture", tabIndex: 0, role: "img" });
    this.tooltip = make("div", { class: "tooltip", hidden: true });
    this.spot = make("div", { class: "spot", hidden: true });
    this.rubber = make("div", { class: "rubber", hidden: true });
    this.said = make("div", { class: "unseen", "aria-live": "polite" });
    this.hint = make("p", { class: "stage-hint", hidden: true });
    this.stage = make("div", { class: "stage" }, this.canvas, this.rubber, this.spot, this.tooltip, this.hint, this.said);
    this.bar = new ColourBar("viridis");
    this.point_bar = new ColourBar("plasma");
    this.caption = this.figure.querySelector("figcaption") ?? this.figure.appendChild(make("figcaption"));
    this.note = make("p", { class: "viewer-note", hidden: true });
    this.caption.before(this.stage, make("div", { class: "bars" }, this.bar.element, this.point_bar.element), this.note);
    this.figure.classList.add("live");

    add_gestures(this.canvas, this.camera, {
      flat: () => this.is_flat,
      moved: () => this.#moved(),
      reset: () => this.reset(),
      blocked: () => Boolean(this.line_done),
    });
    this.canvas.addEventListener("pointermove", (event) => this.#hover(event));
    this.canvas.addEventListener("pointerleave", () => this.hide_tooltip());
    this.canvas.addEventListener("pointerdown", (event) => this.#press(event));
    this.canvas.addEventListener("pointerup", (event) => this.#release(event));
    this.canvas.addEventListener("keydown", (event) => this.#key(event));
    this.canvas.addEventListener("blur", () => this.hide_tooltip());
  }

  /** Shows the scene of a Run, with the same settings and camera as before. */
  show(run) {
    const { scene, title } = run;
    for (const layer of Object.values(this.layers)) this.#remove(layer);
    this.layers = {};
    this.scene = scene;
    this.title = title;
    this.run = run;
    this.section_places = null; // they are places on the mesh of the run before
    this.is_flat = scene.dimension === 2 && scene.vector;
    this.camera.set_up(scene.up);
    const what = scene.vector ? "deformed body" : scene.dimension === 2 ? "surface of height u" : "body";
    this.canvas.setAttribute(
      "aria-label",
      `${title}: ${what}, interactive. Arrow keys ${this.is_flat ? "shift" : "turn"}, with Shift they ${this.is_flat ? "turn" : "shift"}; ` +
        "plus and minus zoom, 0 resets, Enter tells the values in the middle.",
    );
    const { decimated } = scene;
    this.note.hidden = !decimated;
    if (decimated) this.note.textContent = `Drawn with ${decimated.to} of ${decimated.from} triangles.`;
    this.hide_tooltip();
  }

  #remove(layer) {
    for (const object of layer.objects) {
      this.graph.remove(object);
      object.geometry.dispose();
      object.material.dispose();
    }
  }

  /** The layer called `name`, made when it is first needed. */
  #layer(name, make_layer) {
    if (!this.layers[name]) {
      this.layers[name] = make_layer();
      this.graph.add(...this.layers[name].objects);
      this.layers[name].stale = true;
    }
    return this.layers[name];
  }

  /**
   * Draws according to the settings: { quantity: key, range, factor, level, amplitude, edges, obstacle, contact, points: "" or key, point_range,
   * point_size }.
   */
  apply(settings) {
    const { scene } = this;
    if (!scene) return;
    const shape = new Shape(scene, settings.factor, settings.level);
    const reshaped = !this.shape || this.shape.scene !== scene || this.shape.factor !== shape.factor || this.shape.level !== shape.level;
    if (reshaped) {
      this.shape = shape;
      for (const layer of Object.values(this.layers)) layer.stale = true;
    }
    const surface = this.#layer("surface", () => new Surface(scene));
    const quantity = scene.quantity(settings.quantity) ?? scene.quantities[0];
    surface.colour(quantity, settings.range);
    surface.edges.visible = settings.edges;
    this.bar.set(quantity.key, settings.range);

    const optional = (name, wanted, make_layer) => {
      if (wanted) this.#layer(name, make_layer);
      if (this.layers[name]) for (const object of this.layers[name].objects) object.visible = Boolean(wanted);
    };
    if (has_bounds(scene)) optional("bounds", settings.obstacle, () => new Bounds(scene, settings.amplitude));
    if (has_body_obstacle(scene)) optional("obstacle", settings.obstacle, () => new BodyObstacle(scene));
    if (scene.contact) optional("contact", settings.contact, () => new ContactOutline(scene));
    const values = settings.points && scene.cloud ? scene.cloud[settings.points] : null;
    optional("cloud", values, () => new Cloud(scene));
    if (values) {
      this.layers.cloud.colour(values, settings.point_range, settings.point_size);
      this.point_bar.set(`points: ${settings.points}`, settings.point_range);
    } else this.point_bar.element.hidden = true;
    optional("section", this.section_places, () => new SectionLine(scene));
    if (this.section_places && this.layers.section.places !== this.section_places) {
      this.layers.section.places = this.section_places;
      this.layers.section.stale = true;
    }
    this.settings = settings;
    this.#deform();
    this.redraw();
  }

  #deform() {
    const { surface } = this.layers;
    for (const layer of [surface, ...Object.values(this.layers)]) {
      if (!layer.stale || !layer.objects.some((object) => object.visible)) continue;
      layer.deform(this.shape, surface.positions);
      layer.stale = false;
    }
    for (const layer of Object.values(this.layers))
      for (const object of layer.objects) if (object.has_segments === false) object.visible = false;
  }

  /** Shows the line of the section: places, null where it is interrupted; null removes it. */
  set_section(places) {
    this.section_places = places;
    if (this.settings) this.apply(this.settings);
  }

  /** Looks from one of the named directions and shows everything. */
  look(view) {
    this.camera.look(...views[view]);
    this.view = view;
    this.fit();
    this.#moved();
  }

  /** Zooms around the middle. */
  zoom(factor) {
    this.camera.zoom(
      factor,
      this.size.map((value) => value / 2),
      ...this.size,
    );
    this.#moved();
  }

  /** Back to the first view. */
  reset() {
    this.look(this.first_view);
  }

  /** Shows everything from the present direction. */
  fit() {
    const [low, high] = [
      [Infinity, Infinity, Infinity],
      [-Infinity, -Infinity, -Infinity],
    ];
    const include = (coordinate, c) => {
      low[c] = Math.min(low[c], coordinate);
      high[c] = Math.max(high[c], coordinate);
    };
    this.layers.surface.positions.forEach((coordinate, i) => include(coordinate, i % 3));
    if (this.shape.is_height) {
      // room for u of all steps, so that none of them leaves the picture, and for the bounds
      const { level, amplitude } = this.settings;
      for (const sign of [-0.5, 0.5]) include(this.shape.height(level + sign * amplitude), 2);
      if (this.layers.bounds && this.settings.obstacle) for (const height of this.layers.bounds.heights) include(height, 2);
    }
    this.camera.fit(low, high, ...this.size);
  }

  get size() {
    return [this.stage.clientWidth || 300, this.stage.clientHeight || 300];
  }

  #moved() {
    this.hide_tooltip();
    this.redraw();
    this.changed(this);
  }

  /** Draws at the next opportunity, once. */
  redraw() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.draw_now();
    });
  }

  draw_now(canvas = this.canvas, ratio = Math.min(2, devicePixelRatio || 1)) {
    if (!this.layers.surface?.positions || this.stage.clientWidth === 0) return;
    const [width, height] = this.size;
    const { camera, lens } = this;
    const scale = camera.scale(width, height);
    Object.assign(lens, { left: -width / 2 / scale, right: width / 2 / scale, top: height / 2 / scale, bottom: -height / 2 / scale });
    lens.updateProjectionMatrix();
    const [r, u, b, t] = [camera.right, camera.up, camera.back, camera.target];
    // prettier-ignore
    lens.matrix.copy(new Matrix4(
      r[0], u[0], b[0], t[0] + depth * b[0],
      r[1], u[1], b[1], t[1] + depth * b[1],
      r[2], u[2], b[2], t[2] + depth * b[2],
      0, 0, 0, 1));
    lens.updateMatrixWorld(true);
    for (const name of ["cloud", "obstacle"]) if (this.layers[name]?.dots) this.layers[name].dots.material.uniforms.ratio.value = ratio;
    draw(this.graph, lens, canvas, width, height, ratio);
  }

  /** The place of the mesh under a pixel, or null. */
  place_at(pixel) {
    const { positions } = this.layers.surface;
    return pick(positions, this.scene.triangles, this.camera.at(pixel, ...this.size).map((value, c) => value + depth * this.camera.back[c]), this.camera.forward);
  }

  /** The point of the reference configuration under a pixel, beside the mesh too. */
  point_at(pixel) {
    const place = this.place_at(pixel);
    const { scene, camera } = this;
    if (place) return evaluate_vector(scene.points, place);
    let point = camera.at(pixel, ...this.size);
    if (scene.dimension === 2 && Math.abs(camera.back[2]) > 0.05) {
      const along = point[2] / camera.back[2]; // down to the plane of the mesh
      point = point.map((value, c) => value - along * camera.back[c]);
    }
    return point.map((value, c) => value * scene.size + scene.centre[c]).map((value, c) => (scene.dimension === 2 && c === 2 ? 0 : value));
  }

  #pixel(event) {
    const box = this.canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  #hover(event) {
    const pixel = this.#pixel(event);
    if (this.line_done) {
      if (this.line_from) this.#stretch(this.line_from.pixel, pixel);
      return;
    }
    if (event.buttons !== 0 || event.pointerType === "touch") return;
    this.hovered = pixel;
    if (this.hover_waiting) return;
    this.hover_waiting = true;
    requestAnimationFrame(() => {
      this.hover_waiting = false;
      if (this.hovered) this.show_tooltip(this.hovered);
    });
  }

  #press(event) {
    this.canvas.focus({ preventScroll: true });
    const pixel = this.#pixel(event);
    this.pressed = pixel;
    if (this.line_done && !this.line_from) {
      event.preventDefault();
      this.canvas.setPointerCapture(event.pointerId);
      this.line_from = { pixel, point: this.point_at(pixel) };
    }
  }

  #release(event) {
    const pixel = this.#pixel(event);
    const moved = this.pressed ? Math.hypot(pixel[0] - this.pressed[0], pixel[1] - this.pressed[1]) : 0;
    if (this.line_done) {
      const length = this.line_from ? Math.hypot(pixel[0] - this.line_from.pixel[0], pixel[1] - this.line_from.pixel[1]) : 0;
      if (length > steady) this.#end_line(pixel);
      return;
    }
    if (event.pointerType === "touch" && moved < steady) this.show_tooltip(pixel);
  }

  #key(event) {
    if (event.key === "Escape") {
      this.hide_tooltip();
      this.cancel_line();
    } else if (event.key === "Enter" || event.key === " ") {
      event.preventDefault();
      this.show_tooltip(this.size.map((value) => value / 2));
      this.said.textContent = this.tooltip.hidden ? "Nothing here." : this.rows.map(([name, value]) => `${name} ${value}`).join("; ");
    }
  }

  /** Lets the reader draw a line by two clicks or a drag; calls done(from, to, direction of sight), or done(null) when it is given up. */
  draw_line(done) {
    this.cancel_line();
    this.hide_tooltip();
    this.line_done = done;
    this.hint.textContent = "Section: click both ends, or drag. Escape cancels.";
    this.hint.hidden = false;
    this.stage.classList.add("drawing");
  }

  cancel_line() {
    const done = this.line_done;
    this.#line_over();
    done?.(null);
  }

  #line_over() {
    this.line_done = this.line_from = null;
    this.hint.hidden = this.rubber.hidden = true;
    this.stage.classList.remove("drawing");
  }

  #end_line(pixel) {
    const [done, from] = [this.line_done, this.line_from.point];
    const to = this.point_at(pixel);
    this.#line_over();
    done(from, to, this.camera.forward);
  }

  #stretch(from, to) {
    const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
    this.rubber.hidden = false;
    Object.assign(this.rubber.style, {
      left: `${from[0]}px`,
      top: `${from[1]}px`,
      width: `${Math.hypot(dx, dy)}px`,
      transform: `rotate(${Math.atan2(dy, dx)}rad)`,
    });
  }

  /** [name, value] of everything that is known at a place. */
  values_at(place) {
    const { scene } = this;
    const X = evaluate_vector(scene.points, place);
    const rows = scene.axes.slice(0, scene.dimension).map((axis, c) => [axis, format(X[c])]);
    for (const quantity of scene.quantities)
      rows.push([quantity.key, format(quantity.at === "cells" ? quantity.values[place.triangle] : evaluate(quantity.values, place))]);
    return rows;
  }

  show_tooltip(pixel) {
    const place = this.place_at(pixel);
    if (place === null) return this.hide_tooltip();
    this.rows = this.values_at(place);
    const [shown] = [this.bar.label];
    const body = make("tbody");
    for (const [name, value] of this.rows)
      body.append(make("tr", { class: name === shown ? "shown" : null }, make("th", { scope: "row", textContent: name }), make("td", { textContent: value })));
    this.tooltip.replaceChildren(make("table", {}, body));
    this.tooltip.hidden = this.spot.hidden = false;
    const [width, height] = this.size;
    // beside the spot, on the side where there is room, and within the picture
    const [w, h] = [this.tooltip.offsetWidth, this.tooltip.offsetHeight];
    const left = pixel[0] + 16 + w <= width ? pixel[0] + 16 : Math.max(0, pixel[0] - 16 - w);
    const top = Math.max(0, Math.min(height - h, pixel[1] - h / 2));
    Object.assign(this.tooltip.style, { left: `${left}px`, top: `${top}px` });
    Object.assign(this.spot.style, { left: `${pixel[0]}px`, top: `${pixel[1]}px` });
  }

  hide_tooltip() {
    this.hovered = null;
    this.tooltip.hidden = this.spot.hidden = true;
  }

  /** Saves what is seen as PNG, in twice the resolution, with the title above and the colour bars below. */
  save() {
    const ratio = 2;
    const picture = document.createElement("canvas");
    this.draw_now(picture, ratio);
    const [width, height] = this.size;
    const bars = [this.bar, this.point_bar].filter((bar) => !bar.element.hidden);
    const [head, row] = [34, 46];
    const sheet = make("canvas", { width: width * ratio, height: (height + head + row * bars.length + 8) * ratio });
    const context = sheet.getContext("2d");
    context.scale(ratio, ratio);
    context.fillStyle = colour("--paper");
    context.fillRect(0, 0, sheet.width, sheet.height);
    context.drawImage(picture, 0, head, width, height);
    context.fillStyle = colour("--ink");
    context.textBaseline = "middle";
    const font = "system-ui, sans-serif";
    context.font = `600 15px ${font}`;
    context.fillText(this.title, 12, head / 2, width - 24);
    context.font = `13px ${font}`;
    bars.forEach((bar, k) => {
      const y = head + height + k * row + 8;
      const [x, length] = [Math.min(150, width / 3), Math.min(360, width - Math.min(150, width / 3) - 30)];
      context.textAlign = "left";
      context.fillText(bar.label, 12, y + 7, x - 20);
      paint(context, bar.map, x, y, length, 14);
      context.fillStyle = colour("--ink");
      context.textAlign = "center";
      for (const [at, text] of bar.marks()) context.fillText(text, x + at * length, y + 25);
    });
    sheet.toBlob((blob) => save(blob, file_name(this.title, ".png")), "image/png");
  }
}

/** Whether a scene has bounds that can be drawn as surfaces. */
export function has_bounds(scene) {
  return !scene.vector && scene.dimension === 2 && scene.family("lower").length + scene.family("upper").length > 0;
}

/** Whether a scene has obstacles that can be drawn beside the body. */
export function has_body_obstacle(scene) {
  return scene.vector && Boolean(scene.cloud?.direction && scene.cloud.u_along && scene.cloud.gap);
}
