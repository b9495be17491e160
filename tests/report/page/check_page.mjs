// Opens reports in Chromium and uses them as a reader would: hovers, presses keys and buttons, draws sections, and compares the numbers that are
// shown with the data in the page, which are decoded and interpolated here a second time. Any message of the console is a failure.
//
//     npm ci && node check_page.mjs [report.html …]      (without files: the synthetic ones of unilateral/report/page/sample)
import { execFileSync } from "node:child_process";
import { mkdtempSync, readdirSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { pathToFileURL } from "node:url";
import puppeteer from "puppeteer-core";

const sample = new URL("../../../unilateral/report/page/sample/make_sample.py", import.meta.url).pathname;
const failures = [];
let n_checks = 0;
let file_name = "";

function check(holds, what) {
  ++n_checks;
  if (!holds) failures.push(`${file_name}: ${what}`);
}

function near(a, b, scale, what, digits = 4) {
  check(Math.abs(a - b) <= 10 ** -digits * Math.max(scale, Math.abs(b)), `${what}: shown ${a}, in the data ${b}`);
}

function decode(scene) {
  const array = (text, Type) => {
    const buffer = Buffer.from(text ?? "", "base64");
    return new Type(buffer.buffer.slice(buffer.byteOffset, buffer.byteOffset + buffer.length));
  };
  const fields = new Map();
  for (const field of scene.fields) {
    const values = array(field.values, Float32Array);
    if (field.components === 1) fields.set(field.name, values);
    else {
      const component = (c) => Float32Array.from({ length: values.length / 3 }, (_, i) => values[3 * i + c]);
      ["x", "y", "z"].slice(0, scene.dimension).forEach((axis, c) => fields.set(`${field.name}_${scene.axisymmetric ? "rz"[c] : axis}`, component(c)));
    }
  }
  return { ...scene, points: array(scene.points, Float32Array), triangles: array(scene.triangles, Uint32Array), fields };
}

/** The values of all fields at a point of the mesh, by the triangle that contains it, or is nearest in 3-D; [] when it is not on the mesh. */
function values_at(scene, x) {
  const { points, triangles } = scene;
  const X = (v) => [0, 1, 2].map((c) => points[3 * v + c]);
  const minus = (a, b) => a.map((value, c) => value - b[c]);
  const dot = (a, b) => a.reduce((sum, value, c) => sum + value * b[c], 0);
  let best = null;
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [X(triangles[t]), X(triangles[t + 1]), X(triangles[t + 2])];
    const [u, v, w] = [minus(b, a), minus(c, a), minus(x, a)];
    const [uu, uv, vv, wu, wv] = [dot(u, u), dot(u, v), dot(v, v), dot(w, u), dot(w, v)];
    const determinant = uu * vv - uv * uv;
    if (determinant === 0) continue;
    const [wb, wc] = [(vv * wu - uv * wv) / determinant, (uu * wv - uv * wu) / determinant];
    const outside = Math.max(0, -wb, -wc, wb + wc - 1);
    const off = minus(w, u.map((value, k) => wb * value + wc * v[k]));
    const distance = outside * Math.sqrt(uu + vv) + Math.sqrt(dot(off, off));
    if (!best || distance < best.distance) best = { distance, vertices: [triangles[t], triangles[t + 1], triangles[t + 2]], weights: [1 - wb - wc, wb, wc] };
  }
  const result = new Map();
  for (const [name, values] of scene.fields) result.set(name, best.vertices.reduce((sum, v, k) => sum + (Math.abs(best.weights[k]) < 1e-9 ? 0 : best.weights[k] * values[v]), 0));
  return result;
}

const pause = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds));

async function tooltip(page, k = 0) {
  return page.evaluate((k) => {
    const box = document.querySelectorAll("figure.viewer.live .tooltip")[k];
    return box.hidden ? null : [...box.querySelectorAll("tr")].map((row) => [row.cells[0].textContent, row.cells[1].textContent]);
  }, k);
}

function compare(rows, scene, where) {
  const axes = scene.axisymmetric ? ["r", "z"] : ["x", "y", "z"].slice(0, scene.dimension);
  const shown = new Map(rows);
  const x = [0, 1, 2].map((c) => (c < scene.dimension ? Number(shown.get(axes[c])) : 0));
  for (const [name, value] of values_at(scene, x)) {
    if (Number.isNaN(value)) continue;
    const text = shown.get(name);
    check(text !== undefined, `${where}: no ${name}`);
    // the place is shown with five digits; so a steep field can differ by as much as it changes over the sixth
    const range = scene.fields.get(name).reduce((span, v) => [Math.min(span[0], v || 0), Math.max(span[1], v || 0)], [0, 0]);
    if (text !== undefined && text !== "–") near(Number(text), value, range[1] - range[0], `${where}: ${name} at ${x}`, 3);
  }
}

async function check_tooltips(page, scene, where) {
  const box = await page.$eval("figure.viewer.live canvas", (canvas) => {
    canvas.scrollIntoView({ block: "center", behavior: "instant" });
    const { x, y, width, height } = canvas.getBoundingClientRect();
    return { x, y, width, height };
  });
  let n_shown = 0;
  for (const [a, b] of [[0.5, 0.5], [0.42, 0.58], [0.55, 0.45], [0.35, 0.5], [0.5, 0.62]]) {
    await page.mouse.move(box.x + a * box.width, box.y + b * box.height);
    await pause(80);
    const rows = await tooltip(page);
    if (!rows) continue;
    ++n_shown;
    compare(rows, scene, `${where}, tooltip`);
  }
  check(n_shown > 0, `${where}: no tooltip was shown`);
  return box;
}

async function csv(page, where) {
  await page.evaluate(() => (window.saved = []));
  const found = await page.evaluate(() => {
    const button = [...document.querySelectorAll("button")].find((each) => each.textContent === "Download CSV");
    button?.click();
    return Boolean(button);
  });
  check(found, `${where}: no button for CSV`);
  await pause(50);
  const text = await page.evaluate(async () => (window.saved[0] ? window.saved[0].text() : ""));
  const lines = text.trim().split("\r\n").map((line) => line.split(","));
  return { names: lines[0], rows: lines.slice(1) };
}

async function check_section(page, scene, where) {
  const { names, rows } = await csv(page, where);
  check(rows.length > 3, `${where}: the section has ${rows.length} samples`);
  for (let k = 0; k < rows.length; k += Math.max(1, Math.floor(rows.length / 25))) {
    const row = rows[k].map((text) => (text === "" ? NaN : Number(text)));
    if (scene.dimension === 1) {
      const i = scene.points.findIndex((value, at) => at % 3 === 0 && Math.abs(value - row[1]) < 1e-6 * Math.max(1, Math.abs(value))) / 3;
      for (const [name, values] of scene.fields) near(row[names.indexOf(name)], values[i], 1, `${where}, section: ${name}`, 5);
      continue;
    }
    const x = [0, 1, 2].map((c) => (c < scene.dimension ? row[1 + c] : 0));
    for (const [name, value] of values_at(scene, x)) {
      const at = names.indexOf(name);
      if (at < 0 || Number.isNaN(value) || Number.isNaN(row[at])) continue;
      near(row[at], value, Math.max(...scene.fields.get(name).filter((v) => !Number.isNaN(v)).map(Math.abs)), `${where}, section: ${name} at ${x}`, 4);
    }
  }
}

async function check_controls(page, where) {
  await page.evaluate(() => {
    for (const each of document.querySelectorAll(".panel button.toggle")) {
      each.click();
      each.click();
    }
    for (const each of document.querySelectorAll(".panel select, .toolbar select"))
      for (const value of [...each.options].map((option) => option.value).reverse()) {
        each.value = value;
        each.dispatchEvent(new Event("change"));
      }
    for (const each of document.querySelectorAll(".panel input[type=range]"))
      for (const value of ["0", "200", "100"]) {
        each.value = value;
        each.dispatchEvent(new Event("input"));
      }
    for (const each of document.querySelectorAll(".panel button:not(.toggle)")) if (!each.disabled && each.textContent !== "Save picture") each.click();
  });
  await pause(300);
  const canvas = await page.$("figure.viewer.live canvas");
  if (canvas) {
    const picture = () => page.$eval("figure.viewer.live canvas", (each) => each.toDataURL().length + each.toDataURL().slice(2000, 6000));
    await canvas.focus();
    const before = await picture();
    await page.keyboard.press("ArrowLeft");
    await page.keyboard.press("+");
    await pause(150);
    check((await picture()) !== before, `${where}: keys do not move the picture`);
    await page.keyboard.press("0");
    await pause(150);
    await page.evaluate(() => {
      window.saved = [];
      [...document.querySelectorAll("button")].find((each) => each.textContent === "Save picture").click();
    });
    await page.waitForFunction(() => window.saved.length > 0, { timeout: 10_000 }).catch(() => {});
    const size = await page.evaluate(() => window.saved[0]?.size ?? 0);
    check(size > 5000, `${where}: the saved picture has ${size} bytes`);
    await page.keyboard.press("Enter");
    await page.keyboard.press("Escape");
  }
  const theme = async () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  const first = await theme();
  await page.click("button.theme");
  check((await theme()) !== first, `${where}: the button does not change the theme`);
  await page.click("button.theme");
  const plots = await page.$(".plots");
  if (plots) {
    await plots.focus();
    await page.keyboard.press("ArrowRight");
    const told = await page.$eval(".section-plot .unseen", (each) => each.textContent);
    check(told.length > 0, `${where}: arrow keys do not move the cursor of the plot`);
  }
}

async function check_drawing(page, where) {
  await page.evaluate(() => [...document.querySelectorAll("button")].find((each) => each.textContent === "Draw a section").click());
  const box = await page.$eval("figure.viewer.live canvas", (canvas) => {
    canvas.scrollIntoView({ block: "center", behavior: "instant" });
    const { x, y, width, height } = canvas.getBoundingClientRect();
    return { x, y, width, height };
  });
  const fields = () => page.$$eval(".toolbar input", (all) => all.map((each) => each.value).join(" "));
  const before = await fields();
  await page.mouse.click(box.x + 0.4 * box.width, box.y + 0.52 * box.height);
  await page.mouse.click(box.x + 0.6 * box.width, box.y + 0.48 * box.height);
  await pause(150);
  check((await fields()) !== before, `${where}: two clicks do not make a section`);
  const second = await fields();
  await page.evaluate(() => [...document.querySelectorAll("button")].find((each) => each.textContent === "Draw a section").click());
  await page.mouse.move(box.x + 0.45 * box.width, box.y + 0.45 * box.height);
  await page.mouse.down();
  await page.mouse.move(box.x + 0.55 * box.width, box.y + 0.55 * box.height, { steps: 4 });
  await page.mouse.up();
  await pause(150);
  check((await fields()) !== second, `${where}: a drag does not make a section`);
}

async function check_report(browser, file) {
  file_name = path.basename(file);
  const page = await browser.newPage();
  page.on("console", (message) => check(!["error", "warn", "warning"].includes(message.type()) || /GPU stall|GL Driver Message/.test(message.text()), `console: ${message.text()}`));
  page.on("pageerror", (error) => check(false, `exception: ${error.message}`));
  page.on("dialog", (dialog) => (check(false, "a dialog was opened"), dialog.dismiss()));
  page.on("request", (request) => check(/^(file|data|blob):/.test(request.url()), `network: ${request.url()}`));
  await page.evaluateOnNewDocument(() => {
    // what would be downloaded is kept for the test
    window.saved = [];
    const create = URL.createObjectURL;
    URL.createObjectURL = (blob) => (window.saved.push(blob), create.call(URL, blob));
  });
  await page.setViewport({ width: 1200, height: 900 });
  await page.goto(pathToFileURL(file).href);
  await pause(500);

  const data = JSON.parse(await page.$eval("#data", (element) => element.textContent));
  const is_hostile = /onerror/.test(JSON.stringify(data).slice(0, 2e6)) && file_name.startsWith("hostile");
  check((await page.evaluate(() => window.broken)) === undefined, "a string of the data was run");
  check((await page.evaluate(() => document.querySelectorAll("img, iframe, object, embed").length)) === 0, "a string of the data became an element");
  if (!is_hostile) check((await page.evaluate(() => document.querySelectorAll(".message:not([hidden])").length)) === 0, "there is a message");

  const runs = data.runs.filter((run) => run.scene);
  const is_sweep = data.kind === "sweep";
  // a sweep begins with the step that has figures in the page, the last one
  const scene = runs.length > 0 ? decode(runs.at(is_sweep ? -1 : 0).scene) : null;
  const has_plot = await page.$(".section-plot.live");
  const has_viewer = await page.$("figure.viewer.live");
  if (scene) {
    check(has_viewer || scene.dimension === 1, "there is no viewer");
    check(has_plot || scene.vector || scene.dimension === 3, "there is no plot of a section");
    if (has_plot) await check_section(page, scene, "as opened");
    if (has_viewer) await check_tooltips(page, scene, "as opened");
    if (is_sweep) {
      await page.$eval(".sweep input", (slider) => {
        slider.value = slider.min;
        slider.dispatchEvent(new Event("input"));
      });
      await pause(200);
      const other = decode(runs[0].scene);
      if (has_viewer) await check_tooltips(page, other, "first step");
      if (has_plot) await check_section(page, other, "first step");
      const shown = await page.evaluate(() => [...document.querySelectorAll("figure.viewer, figure.section-plot")].filter((each) => each.offsetHeight > 0).length);
      check(shown > 0, "no picture is seen");
      if (data.steps && scene.dimension === 1)
        check((await page.$eval(".section-plot figcaption", (caption) => caption.textContent)) === data.steps[0], "the caption names another step");
    }
    if (has_viewer && has_plot) await check_drawing(page, "page");
  }
  await check_controls(page, "page");

  for (const width of [360, 768]) {
    await page.setViewport({ width, height: 740 });
    let found = Infinity;
    for (let tries = 0; found > width && tries < 15; ++tries) {
      await pause(200); // plots follow the width when the browser has time for it
      found = await page.evaluate(() => document.documentElement.scrollWidth);
    }
    check(found <= width, `the page is ${found} wide on a screen of ${width}`);
  }
  await page.close();

  const still = await browser.newPage();
  await still.setJavaScriptEnabled(false);
  await still.goto(pathToFileURL(file).href);
  const text = await still.title();
  check(text.length > 0, "no title without JavaScript");
  await still.close();
}

const folder = process.argv.length > 2 ? null : mkdtempSync(path.join(tmpdir(), "unilateral-report-"));
const files = process.argv.slice(2);
if (folder) {
  execFileSync("python3", [sample, folder]);
  files.push(...readdirSync(folder).map((name) => path.join(folder, name)));
}
const browser = await puppeteer.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  headless: true,
  args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});
try {
  for (const file of files) await check_report(browser, path.resolve(file));
} finally {
  await browser.close();
  if (folder) rmSync(folder, { recursive: true });
}
for (const failure of failures.slice(0, 40)) console.log(`failed: ${failure}`);
console.log(`${n_checks} checks of ${files.length} pages, ${failures.length} failed`);
process.exitCode = failures.length > 0 ? 1 : 0;
