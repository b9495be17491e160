// Small helpers that make elements. Strings only ever become text or attribute values, never markup: names and titles in a report are
// whatever somebody wrote into a case file.

let last_id = 0;

/** A new id that is unique in the page, for labels. */
export function new_id(stem = "part") {
  return `${stem}-${++last_id}`;
}

/** An element with properties and children. Keys that start with "on" are listeners, "class" and keys with a dash are attributes. */
export function make(tag, properties = {}, ...children) {
  const element = document.createElement(tag);
  for (const [key, value] of Object.entries(properties)) {
    if (value === undefined || value === null) continue;
    if (key.startsWith("on")) element.addEventListener(key.slice(2), value);
    else if (key === "class" || key.includes("-") || key === "role" || key === "for") element.setAttribute(key, value);
    else element[key] = value;
  }
  element.append(...children.filter((child) => child !== null && child !== undefined));
  return element;
}

/** A button that does something at once. */
export function button(text, action, title) {
  return make("button", { type: "button", textContent: text, title, onclick: action });
}

/** A button that is on or off; `change` gets the new state. Returns the element, with a method set(on) that does not call `change`. */
export function toggle(text, on, change, title) {
  const element = make("button", { type: "button", class: "toggle", textContent: text, title });
  element.set = (state) => element.setAttribute("aria-pressed", String(state));
  element.set(on);
  element.addEventListener("click", () => {
    const state = element.getAttribute("aria-pressed") !== "true";
    element.set(state);
    change(state);
  });
  return element;
}

/** A select of [value, label] pairs. */
export function select(options, value, change) {
  const element = make("select");
  for (const [key, label] of options) element.append(make("option", { value: key, textContent: label, selected: key === value }));
  element.addEventListener("change", () => change(element.value));
  return element;
}

/** A control under its label. */
export function labelled(text, control, ...others) {
  control.id ||= new_id();
  return make("div", { class: "control" }, make("label", { for: control.id, textContent: text }), control, ...others);
}

/** Offers a blob as a download. */
export function save(blob, name) {
  const address = URL.createObjectURL(blob);
  const link = make("a", { href: address, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}

/** A file name made of a title: letters, digits, dots and dashes only. */
export function file_name(title, ending) {
  const stem = title.replace(/\.out\/?$/, "").replace(/[^\p{L}\p{N}._-]+/gu, "-").replace(/^[-.]+|[-.]+$/g, "").slice(0, 60);
  return (stem || "picture") + ending;
}
