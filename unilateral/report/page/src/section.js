// The plot along a section: u with its bounds above, the contact pressure below, the same axis for both.
import uPlot from "uplot";
import { cut, default_line } from "./cut.js";
import { button, file_name, labelled, make, new_id, save, select } from "./dom.js";
import { cross, dot, evaluate, evaluate_vector, triangle_normal, unit } from "./geometry.js";
import { extent, format, parse } from "./numbers.js";
import { colour, on_theme_change } from "./theme.js";

const axis_width = 66;

/** The interactive plot in a <figure class="section-plot">. */
export class Section {
  /** `draw` starts the drawing of a line on the picture and is null when there is no picture; `changed(Map from run to samples)` follows every change. */
  constructor(figure, { draw, sight, changed }) {
    this.figure = figure;
    this.changed = changed;
    this.sight = sight;
    this.runs = [];
    this.upper = make("div", { class: "plot-upper" });
    this.lower = make("div", { class: "plot-lower" });
    this.plots_box = make(
      "div",
      { class: "plots", tabIndex: 0, role: "group", "aria-label": "Plot along the section. Left and right arrow keys move the cursor." },
      this.upper,
      this.lower,
    );
    this.said = make("div", { class: "unseen", "aria-live": "polite" });
    this.toolbar = make("div", { class: "toolbar" });
    this.message = make("p", { class: "message", role: "status", hidden: true });
    this.draw_button = draw ? button("Draw a section", draw, "Two clicks on the picture, or a drag") : null;
    const caption = figure.querySelector("figcaption");
    const parts = [this.toolbar, this.message, this.plots_box, this.said];
    if (caption) caption.before(...parts);
    else figure.append(...parts);
    figure.classList.add("live");
    this.plots_box.addEventListener("keydown", (event) => this.#key(event));
    new ResizeObserver(() => this.#resize()).observe(this.plots_box);
    on_theme_change(() => this.#plot());
  }

  /** Shows these Runs along the same line; the line stays when it is there already. */
  show(runs) {
    this.runs = runs;
    const first = runs[0].scene;
    if (first.dimension > 1) this.line ??= default_line(first);
    this.options = options_of(runs.map((run) => run.scene));
    if (!this.options.some(([key]) => key === this.shown)) this.shown = this.options[0][0];
    if (!this.toolbar.firstChild) this.#make_toolbar(first);
    this.#cut();
  }

  /** Takes a new line. */
  set_line(line) {
    this.line = line;
    this.#cut();
  }

  #make_toolbar(scene) {
    this.fields = [];
    if (this.draw_button) this.toolbar.append(this.draw_button);
    if (scene.dimension > 1) {
      for (const [end, text] of [
        ["from", "From"],
        ["to", "To"],
      ]) {
        const group = make("fieldset", { class: "point" }, make("legend", { textContent: text }));
        for (let c = 0; c < scene.dimension; ++c) {
          const field = make("input", { type: "text", inputMode: "decimal", size: 7, autocomplete: "off", "aria-label": `${text} ${scene.axes[c]}` });
          field.addEventListener("change", () => this.#typed(field, end, c));
          this.fields.push([field, end, c]);
          group.append(make("span", { class: "axis-name", textContent: scene.axes[c], "aria-hidden": "true" }), field);
        }
        this.toolbar.append(group);
      }
      this.toolbar.append(
        button("Default line", () => this.set_line(default_line(this.runs[0].scene)), "Through the largest contact pressure, along the longest side"),
      );
      if (scene.dimension === 3 && this.sight)
        this.toolbar.append(
          button("As seen now", () => this.set_line({ ...this.line, sight: this.sight() }), "Take the surface that is nearest in the present view"),
        );
    }
    if (this.options.length > 1) this.toolbar.append(labelled("Above", select(this.options, this.shown, (key) => this.#choose(key))));
    this.toolbar.append(button("Download CSV", () => this.download(), "All fields along the section"));
  }

  #choose(key) {
    this.shown = key;
    this.#plot();
  }

  #typed(field, end, c) {
    const value = parse(field.value);
    field.setAttribute("aria-invalid", String(value === null));
    if (value === null) return;
    const line = { ...this.line, from: [...this.line.from], to: [...this.line.to] };
    line[end][c] = value;
    this.set_line(line);
  }

  #cut() {
    for (const [field, end, c] of this.fields) {
      field.value = format(this.line[end][c], 6);
      field.setAttribute("aria-invalid", "false");
    }
    this.samples = this.runs.map(({ scene }) => cut(scene, this.line ?? {}));
    this.#plot();
    this.changed(new Map(this.runs.map((run, k) => [run, this.samples[k]])));
  }

  /** Series of the plot above or below: { label, values per sample of its run, colour, kind }. */
  #series(where) {
    const several = this.runs.length > 1;
    return this.runs.flatMap(({ scene, title }, k) => {
      const samples = this.samples[k];
      const wanted = where === "below" ? scene.family("contact_pressure").map(as_series("pressure")) : chosen(scene, this.shown, samples, this.line);
      return wanted.map((series, i) => ({
        ...series,
        run: k,
        label: several ? `${series.label}, ${title}` : series.label,
        // several runs: the colour says which run, dashes that it is a bound
        colour: colour(`--series-${several ? k % 6 : series.kind === "bound" ? 5 : series.kind === "pressure" ? 1 : i % 5}`),
        y: samples.map(({ place }) => (place === null ? null : number_or_null(series.at(place)))),
      }));
    });
  }

  #plot() {
    for (const plot of this.plots ?? []) plot.destroy();
    this.plots = [];
    if (!this.samples) return;
    const found = this.samples.some((samples) => samples.some(({ place }) => place !== null));
    this.message.hidden = found;
    this.message.textContent = "The line does not meet the body.";
    this.plots_box.hidden = !found;
    if (!found) return;
    const s = union(this.samples);
    const parts = [
      [this.upper, this.#series("above"), 250, false],
      [this.lower, this.#series("below"), 170, true],
    ].filter(([, series]) => series.length > 0);
    this.sync = new_id("sync");
    parts.forEach(([box, series, height], k) => {
      const data = [s, ...series.map(({ run, y }) => onto(s, this.samples[run], y))];
      this.plots.push(new uPlot(this.#plot_options(series, data, height, k === parts.length - 1), data, box));
    });
    this.lower.hidden = parts.length < 2;
  }

  #plot_options(series, data, height, is_last) {
    const { scene } = this.runs[0];
    const [ink, grid] = [colour("--muted"), colour("--line")];
    const font = "12px system-ui, sans-serif";
    const axis = { stroke: ink, font, labelFont: font, grid: { stroke: grid, width: 1 }, ticks: { stroke: grid, width: 1, size: 5 } };
    const x_name = scene.dimension === 1 ? scene.axes[0] : "distance along the section";
    const range = y_range(series, data);
    return {
      width: this.plots_box.clientWidth || 600,
      height,
      padding: [10, 12, 0, 0],
      cursor: { sync: { key: this.sync }, focus: { prox: 24 }, drag: { x: true, y: false } },
      focus: { alpha: 0.55 },
      scales: { x: { time: false, range: (_, low, high) => [low, high] }, y: { range: () => range } },
      axes: [
        { ...axis, space: 72, size: is_last ? 40 : 8, label: is_last ? x_name : undefined, labelSize: 18, values: is_last ? (_, all) => all.map((v) => format(v)) : () => [] },
        { ...axis, size: axis_width, values: (_, all) => all.map((v) => format(v, 4)) },
      ],
      series: [
        { label: scene.dimension === 1 ? scene.axes[0] : "distance", value: (_, v) => format(v) },
        ...series.map(({ label, colour: stroke, kind }) => ({
          label,
          stroke,
          width: kind === "bound" ? 1.5 : 2,
          dash: kind === "bound" ? [6, 4] : undefined,
          fill: kind === "pressure" && series.length === 1 ? `${stroke}2e` : undefined,
          fillTo: 0,
          points: { show: false },
          value: (_, v) => format(v),
        })),
      ],
    };
  }

  #resize() {
    const width = this.plots_box.clientWidth;
    for (const plot of this.plots ?? []) if (width > 0 && plot.width !== width) plot.setSize({ width, height: plot.height });
  }

  #key(event) {
    const step = { ArrowLeft: -1, ArrowRight: 1, PageDown: -20, PageUp: 20 }[event.key];
    if (!step || this.plots.length === 0) return;
    event.preventDefault();
    const [plot] = this.plots;
    const s = plot.data[0];
    const i = Math.max(0, Math.min(s.length - 1, (plot.cursor.idx ?? -step) + step));
    for (const each of this.plots) each.setCursor({ left: each.valToPos(s[i], "x"), top: 10 });
    this.said.textContent = this.plots.flatMap((each) => each.series.map((series, k) => `${series.label} ${format(each.data[k][i])}`)).join("; ");
  }

  /** The section as comma-separated values, with all fields of the run. */
  csv() {
    const quoted = (text) => (/[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
    return this.runs.map(({ scene, title }, k) => {
      const fields = scene.quantities.filter((quantity) => quantity.at === "points");
      const axes = scene.axes.slice(0, scene.dimension);
      const lines = [["s", ...axes, ...fields.map((field) => field.key)].map(quoted).join(",")];
      for (const { s, place } of this.samples[k]) {
        if (place === null) continue;
        const X = evaluate_vector(scene.points, place).slice(0, scene.dimension);
        lines.push([s, ...X, ...fields.map((field) => evaluate(field.values, place))].map((v) => (Number.isFinite(v) ? String(Number(v.toPrecision(8))) : "")).join(","));
      }
      return { name: file_name(`section-${title}`, ".csv"), text: `${lines.join("\r\n")}\r\n` };
    });
  }

  download() {
    for (const { name, text } of this.csv()) save(new Blob([text], { type: "text/csv" }), name);
  }
}

const number_or_null = (value) => (Number.isFinite(value) ? value : null);

const as_series = (kind) => (quantity) => ({ label: quantity.key, kind, at: (place) => evaluate(quantity.values, place) });

/** What can be plotted above: [key, label]. */
function options_of(scenes) {
  const [scene] = scenes;
  const result = scene.vector ? [["components", `${component_keys(scene).join(", ")}`]] : [["u", scene.dimension === 3 ? "u" : "u and its bounds"]];
  if (scene.vector && scene.displacement)
    result.push(["normal", scene.dimension === 2 ? "u, normal to the line" : "u, normal to the surface"]);
  const skip = /^(u|lower(_\d+)?|upper(_\d+)?|contact_pressure(_\d+)?)$/;
  for (const { key, at } of scene.quantities) if (at === "points" && !skip.test(key)) result.push([key, key]);
  return result;
}

function component_keys(scene) {
  return scene.axes.slice(0, scene.dimension).map((axis) => `u_${axis}`).filter((key) => scene.quantity(key));
}

/** The series for one of the options. */
function chosen(scene, key, samples, line) {
  const curve = as_series("curve");
  if (key === "u") return [...scene.family("u").map(curve), ...[...scene.family("lower"), ...scene.family("upper")].map(as_series("bound"))];
  if (key === "components") return component_keys(scene).map((name) => curve(scene.quantity(name)));
  if (key === "normal" && scene.displacement) {
    const along = scene.dimension === 2 ? unit([line.to[0] - line.from[0], line.to[1] - line.from[1], 0]) : null;
    const normal = (place) => {
      if (along) return cross([0, 0, 1], along);
      const n = unit(triangle_normal(scene.points, scene.triangles, 3 * place.triangle));
      return dot(n, line.sight) > 0 ? n.map((value) => -value) : n; // outwards is towards the viewer
    };
    return [{ label: "u normal", kind: "curve", at: (place) => dot(normal(place), evaluate_vector(scene.displacement, place)) }];
  }
  const quantity = scene.quantity(key);
  return quantity ? [curve(quantity)] : [];
}

/** All distances of several sections, sorted. */
function union(sections) {
  if (sections.length === 1) return sections[0].map(({ s }) => s);
  const all = Float64Array.from(sections.flatMap((samples) => samples.map(({ s }) => s))).sort();
  return Array.from(all).filter((s, i) => i === 0 || s > all[i - 1]);
}

/** The values of one section at the distances of all. */
function onto(s, samples, y) {
  if (s.length === samples.length) return y;
  let k = 0;
  return s.map((x) => {
    while (k < samples.length - 2 && samples[k + 1].s < x) ++k;
    const [a, b] = [samples[k], samples[k + 1]];
    if (!b || x < a.s || x > b.s) return null;
    if (x === a.s) return y[k];
    if (x === b.s) return y[k + 1];
    return y[k] === null || y[k + 1] === null ? null : y[k] + ((x - a.s) / (b.s - a.s)) * (y[k + 1] - y[k]);
  });
}

/** All of the curves, and of the bounds what is not far away from them: a bound of -1000 must not make u a straight line. */
function y_range(series, data) {
  const values = (wanted) => series.flatMap(({ kind }, k) => (wanted(kind) ? data[k + 1].filter((v) => v !== null) : []));
  let [low, high] = extent(values((kind) => kind !== "bound"));
  if (Number.isNaN(low)) [low, high] = [0, 1];
  const reach = high - low || Math.abs(high) || 1;
  const bounds = extent(values((kind) => kind === "bound").filter((v) => v >= low - reach && v <= high + reach));
  if (!Number.isNaN(bounds[0])) [low, high] = [Math.min(low, bounds[0]), Math.max(high, bounds[1])];
  if (series.some(({ kind }) => kind === "pressure")) low = Math.min(low, 0);
  const margin = 0.06 * (high - low) || Math.abs(high) || 1;
  const sits_on_zero = low === 0 && series.some(({ kind }) => kind === "pressure");
  return [sits_on_zero ? 0 : low - margin, high + margin];
}
