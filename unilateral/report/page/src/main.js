// Turns the static report into an interactive one. Whatever goes wrong here, the static page stays: a figure changes only once its part is ready.
import { default_settings, make_panel } from "./controls.js";
import { read_report } from "./data.js";
import { labelled, make } from "./dom.js";
import { Section } from "./section.js";
import { has_webgl } from "./stage.js";
import { add_theme_button } from "./theme.js";
import { Viewer } from "./viewer.js";

/** A line for the reader at the head of the section with the pictures. */
function tell(text) {
  const section = document.getElementById("picture") ?? document.querySelector("main");
  const heading = section?.querySelector("h2");
  const line = make("p", { class: "message", textContent: text });
  if (heading) heading.after(line);
  else section?.prepend(line);
}

/** The figures of a class by the number of their run. */
function figures_of(name) {
  const result = new Map();
  for (const figure of document.querySelectorAll(`figure.${name}[data-run]`)) result.set(Number(figure.dataset.run), figure);
  return result;
}

function start() {
  add_theme_button();
  mark_sections();
  const element = document.getElementById("data");
  if (!element) return;
  const report = read_report(element.textContent);
  const figures = { viewer: figures_of("viewer"), plot: figures_of("section-plot") };
  const runs = report.runs.filter((run) => run.scene !== null);
  for (const run of report.runs) if (run.problem) tell(`${run.title}: the picture stays as it is, because its data cannot be used: ${run.problem}.`);
  if (runs.length === 0) return;
  if (report.kind === "sweep") show_sweep(report, runs, figures);
  else show_together(runs, figures);
}

/** Makes viewers for runs that are seen at the same time, with one panel for them. Returns null when nothing can be drawn. */
function make_viewers(shown, scenes, figures, on_settings) {
  const drawable = shown.filter((run) => run.scene.is_drawn && figures.has(run.index));
  if (drawable.length === 0) return null;
  if (!has_webgl()) {
    tell("This browser has no WebGL: the pictures stay as they are. The plots along a section work all the same.");
    return null;
  }
  const studio = make("div", { class: `studio${drawable.length > 1 ? " several" : ""}` });
  const stages = make("div", { class: "stages" });
  figures.get(drawable[0].index).before(studio);
  studio.append(stages);

  const settings = default_settings(scenes);
  const linked = { on: true, set: (on) => ((linked.on = on), on && follow(viewers[0])) };
  const follow = (leader) => {
    if (!linked.on) return;
    for (const viewer of viewers)
      if (viewer !== leader) {
        viewer.camera.copy(leader.camera);
        viewer.hide_tooltip();
        viewer.redraw();
      }
  };
  const viewers = drawable.map((run) => {
    const figure = figures.get(run.index);
    stages.append(figure);
    const viewer = new Viewer(figure, { changed: follow });
    viewer.show(run);
    return viewer;
  });
  const panel = make_panel(scenes, settings, {
    viewers: () => viewers,
    changed: () => {
      viewers.forEach((viewer) => viewer.apply(settings));
      on_settings?.();
    },
    linked: viewers.length > 1 ? linked : null,
  });
  studio.append(panel);
  const [{ scene }] = drawable;
  for (const viewer of viewers) {
    viewer.first_view = scene.dimension === 2 && scene.vector ? "top" : "oblique";
    viewer.reset();
  }
  return { viewers, settings, studio };
}

/** The plot of a section for the runs that are shown. */
function make_section(shown, figure, viewers) {
  const section = new Section(figure, {
    draw: viewers
      ? () => {
          viewers[0].figure.scrollIntoView({ block: "nearest" });
          // the line may be drawn on any of the pictures; the first that has one ends it for all
          for (const viewer of viewers)
            viewer.draw_line((from, to, sight) => {
              if (from === null) return;
              for (const other of viewers) if (other !== viewer) other.cancel_line();
              section.set_line({ from, to, sight });
            });
        }
      : null,
    sight: viewers ? () => viewers[0].camera.forward : null,
    changed: (samples) => viewers?.forEach((viewer) => viewer.set_section(samples.get(viewer.run)?.map(({ place }) => place) ?? null)),
  });
  section.show(shown);
  return section;
}

/** A run, or several side by side. */
function show_together(runs, figures) {
  const made = make_viewers(runs, drawn(runs), figures.viewer);
  const first = runs.find((run) => figures.plot.has(run.index));
  if (!first) return;
  // only runs of the same kind go into one plot
  const alike = runs.filter((run) => run.scene.dimension === first.scene.dimension && run.scene.vector === first.scene.vector);
  for (const run of runs) if (run !== first) figures.plot.get(run.index)?.classList.add("spare");
  make_section(alike, figures.plot.get(first.index), made?.viewers ?? null);
}

/** The steps of a sweep in one picture, with a slider. It begins with a step that has figures in the page: of many steps only one has. */
function show_sweep(report, runs, figures) {
  const first = runs.find((run) => figures.viewer.has(run.index) || figures.plot.has(run.index)) ?? runs[0];
  const keep = (map) => {
    const figure = map.get(first.index) ?? null;
    for (const [index, other] of map) if (index !== first.index) other.classList.add("spare");
    return figure;
  };
  const figure = keep(figures.viewer);
  const plot = keep(figures.plot);
  const label_of = (run) => report.steps?.[run.index] ?? run.title;
  const captions = new Map(runs.map((run) => [run.index, figures.viewer.get(run.index)?.querySelector("figcaption")?.textContent ?? label_of(run)]));
  const made = make_viewers([first], drawn(runs), figures.viewer);
  const section = plot ? make_section([first], plot, made?.viewers ?? null) : null;
  // in 1-D the plot is the picture, and its caption names the step
  const plot_caption = first.scene.dimension === 1 ? (plot?.querySelector("figcaption") ?? null) : null;

  const slider = make("input", { type: "range", min: 0, max: runs.length - 1, step: 1, value: String(runs.indexOf(first)) });
  const output = make("output", { class: "step" });
  const show = () => {
    const run = runs[Number(slider.value)];
    output.textContent = `${label_of(run)} (${Number(slider.value) + 1} of ${runs.length})`;
    slider.setAttribute("aria-valuetext", label_of(run));
    if (made) {
      const [viewer] = made.viewers;
      viewer.show(run);
      viewer.apply(made.settings);
      viewer.caption.textContent = captions.get(run.index);
    } else if (figures.viewer.has(run.index)) {
      // no WebGL: the static picture of the step; where it has none, the one that is shown stays, and its caption says of which step it is
      for (const [index, other] of figures.viewer) other.classList.toggle("spare", index !== run.index);
    }
    section?.show([run]);
    if (plot_caption) plot_caption.textContent = label_of(run);
  };
  slider.addEventListener("input", show);
  const bar = make("div", { class: "sweep" }, labelled("Step", slider, output));
  (made?.studio ?? figure ?? plot)?.before(bar);
  show();
}

function drawn(runs) {
  return runs.map((run) => run.scene).filter((scene) => scene.is_drawn);
}

/** Marks the link of the section that is being read. */
function mark_sections() {
  const links = new Map([...document.querySelectorAll("nav a[href^='#']")].map((link) => [link.getAttribute("href").slice(1), link]));
  const seen = new Set();
  const observer = new IntersectionObserver(
    (entries) => {
      for (const { target, isIntersecting } of entries) isIntersecting ? seen.add(target.id) : seen.delete(target.id);
      const current = [...links.keys()].find((id) => seen.has(id));
      for (const [id, link] of links) id === current ? link.setAttribute("aria-current", "true") : link.removeAttribute("aria-current");
    },
    { rootMargin: "-20% 0px -60% 0px" },
  );
  for (const id of links.keys()) {
    const target = document.getElementById(id);
    if (target) observer.observe(target);
  }
}

try {
  start();
} catch (error) {
  tell(`The interactive part of this page does not work here: ${error.message}.`);
  console.error(error);
}
