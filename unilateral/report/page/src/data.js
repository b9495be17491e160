// What the program wrote into <script type="application/json" id="data">: decoded, checked, with names for everything that can be drawn.
// A part that is damaged is left out with a reason, so that the static page stays what it is.
import { extent } from "./numbers.js";

const format_number = 1;

/** The report of a page: { kind, steps, runs }. Throws an Error with a sentence for the reader when the data cannot be used. */
export function read_report(text) {
  const raw = JSON.parse(text);
  if (raw.format !== format_number) throw new Error(`the data of this page have format ${raw.format}, the page understands ${format_number}`);
  const runs = raw.runs.map((run, k) => new Run(run, k));
  return { kind: raw.kind, steps: Array.isArray(raw.steps) ? raw.steps.map(String) : null, runs };
}

function bytes(text) {
  const binary = atob(text ?? "");
  const result = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) result[i] = binary.charCodeAt(i);
  return result.buffer;
}

function floats(text, count) {
  return checked(new Float32Array(bytes(text)), count);
}

function integers(text, limit) {
  const result = new Uint32Array(bytes(text));
  for (let i = 0; i < result.length; ++i) if (result[i] >= limit) throw new Error(`there is no vertex ${result[i]}`);
  return result;
}

function checked(array, count) {
  if (count !== undefined && array.length !== count) throw new Error(`${array.length} numbers where ${count} were expected`);
  return array;
}

/** One run: its names at once, its scene when it is first asked for; a sweep has many and shows one at a time. */
export class Run {
  #raw;
  #scene;

  constructor(raw, index) {
    this.index = index;
    this.name = String(raw.name ?? `run ${index + 1}`);
    this.title = String(raw.title ?? "") || this.name;
    this.#raw = raw.scene ?? null;
    if (this.#raw === null) this.#scene = null;
  }

  /** The Scene, or null when there is none; `problem` then may say why. */
  get scene() {
    if (this.#scene === undefined) {
      try {
        this.#scene = new Scene(this.#raw);
      } catch (error) {
        this.#scene = null;
        this.problem = error.message;
      }
      this.#raw = null; // the text is no longer needed, and it is larger than the numbers
    }
    return this.#scene;
  }
}

/**
 * One scalar that has a value at every vertex ("points") or in every triangle ("cells"): what can be chosen as colour.
 * `values` and the range are computed when they are first needed.
 */
class Quantity {
  #compute;
  #values;
  #range;

  constructor(key, at, compute, range) {
    this.key = key;
    this.at = at;
    this.#compute = compute;
    this.#range = range;
  }

  get values() {
    this.#values ??= this.#compute();
    return this.#values;
  }

  /** [smallest, largest] finite value. */
  get range() {
    this.#range ??= extent(this.values);
    return this.#range;
  }
}

/** The mesh of a run and everything that is known on it, as typed arrays. */
export class Scene {
  constructor(raw) {
    this.dimension = raw.dimension;
    this.vector = Boolean(raw.vector);
    this.axes = raw.axisymmetric ? ["r", "z", "θ"] : ["x", "y", "z"];
    this.up = ["x", "y"].includes(raw.up) && this.dimension === 3 ? raw.up : "z";
    this.points = floats(raw.points);
    this.n_points = this.points.length / 3;
    if (this.n_points === 0 || !Number.isInteger(this.n_points)) throw new Error("the mesh has no vertices");
    this.triangles = integers(raw.triangles, this.n_points);
    this.n_triangles = Math.floor(this.triangles.length / 3);
    this.lines = integers(raw.lines, this.n_points);
    this.decimated = raw.decimated ?? null;

    this.vectors = new Map(); // vector fields by name, 3 numbers per vertex
    this.quantities = [];
    for (const field of raw.fields ?? []) this.#add_field(field);
    for (const field of raw.cell_fields ?? []) {
      const values = floats(field.values, this.n_triangles);
      this.quantities.push(new Quantity(String(field.name), "cells", () => values));
    }
    this.cloud = raw.cloud ? this.#read_cloud(raw.cloud) : null;
    this.#measure();
  }

  #add_field(field) {
    const name = String(field.name);
    const components = field.components ?? 1;
    const values = floats(field.values, this.n_points * components);
    if (components === 1) {
      const given = Number.isFinite(field.min) && Number.isFinite(field.max) ? [field.min, field.max] : undefined;
      this.quantities.push(new Quantity(name, "points", () => values, given));
      return;
    }
    this.vectors.set(name, values);
    const n = this.n_points;
    this.quantities.push(
      new Quantity(`|${name}|`, "points", () =>
        Float32Array.from({ length: n }, (_, i) => Math.hypot(values[components * i], values[components * i + 1], values[components * i + 2])),
      ),
    );
    const shown = Math.min(components, this.dimension);
    for (let c = 0; c < shown; ++c)
      this.quantities.push(
        new Quantity(`${name}_${this.axes[c]}`, "points", () => Float32Array.from({ length: n }, (_, i) => values[components * i + c])),
      );
  }

  #read_cloud(raw) {
    const points = floats(raw.points);
    const n = points.length / 3;
    if (n === 0) return null;
    const cloud = { n, points, direction: raw.direction ? floats(raw.direction, 3 * n) : null, u_along: raw.u_along ? floats(raw.u_along, n) : null };
    for (const key of ["pressure", "gap", "penetration"]) cloud[key] = raw[key] ? floats(raw[key], n) : null;
    cloud.active = raw.active ? checked(new Uint8Array(bytes(raw.active)), n) : null;
    return cloud;
  }

  #measure() {
    this.low = [Infinity, Infinity, Infinity];
    this.high = [-Infinity, -Infinity, -Infinity];
    for (let i = 0; i < this.points.length; ++i) {
      const c = i % 3;
      if (this.points[i] < this.low[c]) this.low[c] = this.points[i];
      if (this.points[i] > this.high[c]) this.high[c] = this.points[i];
    }
    this.centre = this.low.map((low, c) => (low + this.high[c]) / 2);
    /** The longest side of the bounding box: the unit in which everything is drawn. */
    this.size = Math.max(...this.high.map((high, c) => high - this.low[c])) || 1;
  }

  /** The quantity called `key`, or undefined. */
  quantity(key) {
    return this.quantities.find((quantity) => quantity.key === key);
  }

  /** The quantities called `stem` or `stem`_0, `stem`_1, …: there is one for each constraint. */
  family(stem) {
    const pattern = new RegExp(`^${stem}(_\\d+)?$`);
    return this.quantities.filter((quantity) => quantity.at === "points" && pattern.test(quantity.key));
  }

  /** The displacement, 3 numbers per vertex, or null for a scalar problem. */
  get displacement() {
    return this.vector ? (this.vectors.get("u") ?? null) : null;
  }

  /** Whether there is something that a viewer shows better than the plot of a section. */
  get is_drawn() {
    return this.dimension > 1 && this.n_triangles > 0;
  }

  /** The largest length of the displacement or, for a scalar, the range of u. */
  get amplitude() {
    if (this.vector) return this.quantity("|u|")?.range[1] || 0;
    const range = this.quantity("u")?.range ?? [0, 0];
    return range[1] - range[0] || 0;
  }

  /** 1 at the vertices that are in contact with any of the obstacles, else 0; null when no pressure is known. */
  get contact() {
    if (this.contact_values === undefined) {
      const pressures = this.family("contact_pressure");
      this.contact_values = pressures.length === 0 ? null : new Uint8Array(this.n_points);
      for (const { values } of pressures) for (let i = 0; i < this.n_points; ++i) if (values[i] > 0) this.contact_values[i] = 1;
    }
    return this.contact_values;
  }
}
