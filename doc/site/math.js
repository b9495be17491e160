// Draws the formulas of a page with KaTeX, which lies beside it: \( \) within lines, \[ \] between them.
document.addEventListener("DOMContentLoaded", function () {
  document.querySelectorAll(".math").forEach(function (element) {
    if (element.dataset.drawn) return;
    element.dataset.drawn = "yes";
    var text = element.textContent.trim();
    var number = element.querySelector(".eqno");
    if (number) text = text.replace(number.textContent, "").trim();
    var display = text.startsWith("\\[");
    katex.render(text.replace(/^\\[\[(]|\\[\])]$/g, ""), element, { displayMode: display, throwOnError: false });
  });
});
