// Light and dark: the system's choice until the reader presses the button, then the reader's, as long as the page is open.
import { make } from "./dom.js";

const listeners = [];

/** Calls `listener` whenever the colours of the page change. Canvases do not follow CSS by themselves. */
export function on_theme_change(listener) {
  listeners.push(listener);
}

/** The value of a CSS variable, as "--ink". */
export function colour(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

function is_dark() {
  const chosen = document.documentElement.dataset.theme;
  return chosen ? chosen === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
}

/** Puts the button into the page's header. */
export function add_theme_button() {
  const header = document.querySelector("header") ?? document.body;
  const element = make("button", { type: "button", class: "theme" });
  const name = () => {
    element.textContent = is_dark() ? "☀ Light" : "☾ Dark";
    element.setAttribute("aria-label", is_dark() ? "Use light colours" : "Use dark colours");
  };
  const changed = () => {
    name();
    for (const listener of listeners) listener();
  };
  element.addEventListener("click", () => {
    document.documentElement.dataset.theme = is_dark() ? "light" : "dark";
    changed();
  });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", changed);
  name();
  header.append(element);
}
