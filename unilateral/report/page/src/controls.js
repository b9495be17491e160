// What the reader can set for the pictures: one panel for all pictures that are shown, and the settings behind it.
import { button, labelled, make, select, toggle } from "./dom.js";
import { extent, format, parse } from "./numbers.js";
import { has_body_obstacle, has_bounds } from "./viewer.js";

/** A displacement is shown as it is when it is larger than this part of the body, and enlarged to `wanted` otherwise. */
const visible = 0.02;
const wanted = 0.08;

/** More edges than this hide the colours. */
const most_edges = 9000;

/** The nearest number with one of a few leading digits, not above: factors one can talk about. */
function round_number(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  return Number(([10, 8, 6, 5, 4, 3, 2.5, 2, 1.5, 1].find((digit) => digit * power <= value * 1.0001) * power).toPrecision(3));
}

/** The factor with which u is drawn unless the reader says otherwise. */
function default_factor(scenes) {
  const amplitude = Math.max(...scenes.map((scene) => scene.amplitude));
  const size = Math.max(...scenes.map((scene) => scene.size));
  const ratio = amplitude / size;
  if (!(ratio > 0)) return 1;
  if (scenes[0].vector) return ratio > visible ? 1 : round_number(wanted / ratio);
  return ratio > 0.12 && ratio < 0.7 ? 1 : round_number(0.3 / ratio);
}

/** The settings for some scenes that are shown with the same colours: all steps of a sweep, both sides of a comparison. */
export function default_settings(scenes) {
  const [scene] = scenes;
  const heights = scenes.map((each) => (each.vector ? [0, 0] : (each.quantity("u")?.range ?? [0, 0]))).flat();
  const [low, high] = extent(heights);
  const favourite = scene.vector ? ["von_mises", "|u|"] : ["u"];
  return {
    quantity: favourite.find((key) => scene.quantity(key)) ?? scene.quantities[0]?.key,
    range: [0, 1],
    automatic: true,
    factor: scene.dimension === 3 && !scene.vector ? 0 : default_factor(scenes),
    level: (low + high) / 2 || 0,
    amplitude: high - low || 0,
    edges: scene.lines.length / 2 <= most_edges,
    obstacle: true,
    contact: true,
    points: "",
    point_range: [0, 1],
    point_size: 5,
  };
}

/** The range of a quantity in all scenes. */
export function range_of(scenes, key) {
  const [low, high] = extent(scenes.flatMap((scene) => scene.quantity(key)?.range ?? []));
  return Number.isNaN(low) ? [0, 1] : [low, high];
}

function point_range_of(scenes, key) {
  const [low, high] = extent(scenes.flatMap((scene) => (scene.cloud?.[key] ? extent(scene.cloud[key]) : [])));
  return Number.isNaN(low) ? [0, 1] : [low, high];
}

/** The panel with everything that can be set. `changed()` is called after each change; `viewers` are those that the buttons act on. */
export function make_panel(scenes, settings, { changed, viewers, linked }) {
  const [scene] = scenes;
  const panel = make("div", { class: "panel", role: "group", "aria-label": "Settings of the picture" });
  const group = (title, ...children) => panel.append(make("fieldset", {}, make("legend", { textContent: title }), ...children));

  const keys = [];
  for (const each of scenes) for (const { key } of each.quantities) if (!keys.includes(key)) keys.push(key);
  const ends = ["Smallest", "Largest"].map((name, end) => {
    const field = make("input", { type: "text", inputMode: "decimal", size: 8, autocomplete: "off", "aria-label": `${name} value of the colours` });
    field.addEventListener("change", () => {
      const value = parse(field.value);
      const range = settings.range.map((old, k) => (k === end ? value : old));
      const fits = value !== null && range[0] < range[1];
      field.setAttribute("aria-invalid", String(!fits));
      if (!fits) return;
      settings.range = range;
      settings.automatic = false;
      update();
    });
    return field;
  });
  const whole = button("Whole range", () => {
    settings.automatic = true;
    update();
  });
  const update = () => {
    if (settings.automatic) settings.range = range_of(scenes, settings.quantity);
    if (settings.points) settings.point_range = point_range_of(scenes, settings.points);
    ends.forEach((field, end) => {
      field.value = format(settings.range[end]);
      field.setAttribute("aria-invalid", "false");
    });
    whole.disabled = settings.automatic;
    changed();
  };
  const field_select = select(
    keys.map((key) => [key, key]),
    settings.quantity,
    (key) => {
      settings.quantity = key;
      settings.automatic = true;
      update();
    },
  );
  group("Colour", labelled("Field", field_select), make("div", { class: "row" }, ends[0], make("span", { textContent: "to" }), ends[1]), make("div", { class: "row" }, whole));

  if (scene.vector || scene.dimension === 2) add_factor(scene, settings, group, update);

  const names = scene.dimension === 2 && scene.vector ? [] : scene.dimension === 2 ? ["top", "front", "oblique"] : ["top", "front", "side", "oblique", "below"];
  const titles = { top: "Top", front: "Front", side: "Side", oblique: "Oblique", below: "Below" };
  const look = names.map((name) => button(titles[name], () => viewers().forEach((viewer) => viewer.look(name))));
  const steps = [
    ["+", "Zoom in", 1.25],
    ["−", "Zoom out", 0.8],
  ].map(([text, title, factor]) => {
    const element = button(text, () => viewers().forEach((viewer) => viewer.zoom(factor)), title);
    element.setAttribute("aria-label", title);
    return element;
  });
  const reset = button("Reset", () => viewers().forEach((viewer) => viewer.reset()), "The first view again (key 0 on the picture)");
  const link = linked ? toggle("Linked cameras", linked.on, linked.set, "Moving one picture moves all") : null;
  group("View", make("div", { class: "row" }, ...look, ...steps, reset, link));

  const switches = [["edges", "Cells", "The edges of the cells"]];
  if (scenes.some((each) => has_bounds(each) || has_body_obstacle(each))) switches.push(["obstacle", "Obstacle", "The bounds, or the obstacle beside the body"]);
  if (scenes.some((each) => each.contact)) switches.push(["contact", "Contact zone", "Where the contact pressure is positive"]);
  const on_off = switches.map(([key, text, title]) =>
    toggle(text, settings[key], (on) => {
      settings[key] = on;
      update();
    }, title),
  );
  group("Show", make("div", { class: "row" }, ...on_off));

  const values = ["pressure", "gap", "penetration"].filter((key) => scenes.some((each) => each.cloud?.[key]));
  if (values.length > 0) {
    const size = make("input", { type: "range", min: 2, max: 14, step: 1, value: String(settings.point_size) });
    size.addEventListener("input", () => {
      settings.point_size = Number(size.value);
      update();
    });
    const size_control = labelled("Size of the points", size);
    size_control.hidden = !settings.points;
    const points = select([["", "none"], ...values.map((key) => [key, key])], settings.points, (key) => {
      settings.points = key;
      size_control.hidden = !key;
      update();
    });
    group("Integration points", labelled("Coloured by", points), size_control);
  }

  const pictures = button("Save picture", () => viewers().forEach((viewer) => viewer.save()), "A PNG file with title and colour bar");
  panel.append(make("div", { class: "row" }, pictures));
  update();
  return panel;
}

/** Slider and number for the factor of the deformation, or the scale of the height. */
function add_factor(scene, settings, group, update) {
  const first = settings.factor;
  const is_body = scene.vector;
  const slider = make("input", { type: "range", min: 0, max: 300, step: 1 });
  const number = make("input", { type: "text", inputMode: "decimal", size: 7, autocomplete: "off", "aria-label": is_body ? "Factor of the displacement" : "Scale of the height" });
  const show = (also_slider) => {
    number.value = format(settings.factor, 4);
    number.setAttribute("aria-invalid", "false");
    slider.setAttribute("aria-valuetext", `times ${format(settings.factor, 4)}`);
    if (also_slider) slider.value = String(Math.round((100 * settings.factor) / first));
  };
  const set = (factor, also_slider) => {
    settings.factor = factor;
    show(also_slider);
    update();
  };
  slider.addEventListener("input", () => set(Number(((Number(slider.value) / 100) * first).toPrecision(6)), false));
  number.addEventListener("change", () => {
    const value = parse(number.value);
    if (value === null || value < 0) number.setAttribute("aria-invalid", "true");
    else set(value, true);
  });
  show(true);
  const row = [make("span", { textContent: "×" }), number, is_body ? button("None", () => set(0, true)) : button("Flat", () => set(0, true))];
  row.push(button("True", () => set(1, true), is_body ? "The displacement as it is" : "Height in the unit of the plane"));
  if (first !== 1) row.push(button("Default", () => set(first, true)));
  group(is_body ? "Deformation" : "Height", labelled(is_body ? "Displacement times" : "u times", slider), make("div", { class: "row" }, ...row));
}
