// Light, dark or as the system says: the button of the theme. Debian's furo ships its script as a module, which browsers do not load from a disk.
(function () {
  document.documentElement.classList.remove("no-js");
  var dark = window.matchMedia("(prefers-color-scheme: dark)");
  function show(theme) {
    document.body.dataset.theme = theme;
    try { localStorage.setItem("theme", theme); } catch (error) { /* no storage: the choice holds for this page */ }
  }
  function next() {
    var order = dark.matches ? ["auto", "light", "dark"] : ["auto", "dark", "light"];
    show(order[(order.indexOf(document.body.dataset.theme || "auto") + 1) % 3]);
  }
  Array.prototype.forEach.call(document.getElementsByClassName("theme-toggle"), function (button) { button.addEventListener("click", next); });
})();
