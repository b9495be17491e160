// Pictures of reports: node shoot.mjs FOLDER_OF_RESULTS FOLDER_OF_PICTURES [NAME …]
import { execFileSync } from "node:child_process";
import { createRequire } from "node:module";
import { statSync } from "node:fs";
import path from "node:path";
import { pathToFileURL } from "node:url";

const puppeteer = createRequire(new URL("../../../tests/report/page/package.json", import.meta.url))("puppeteer-core");
const [results, pictures, ...wanted] = process.argv.slice(2);
const phone = { width: 390, height: 844, isMobile: true, hasTouch: true };
const desk = { width: 1100, height: 820 };
const max_bytes = 150_000;

// name: folder of results, colours, size of the window, and the part of the page at its top (none: the beginning).
const shots = [
  ["membrane-light", "membrane-over-ball", "light", desk],
  ["membrane-dark", "membrane-over-ball", "dark", desk, "picture"],
  ["membrane-phone", "membrane-over-ball", "light", phone],
  ["convergence", "membrane-over-ball", "light", desk, "convergence"],
  ["adaptive", "membrane-to-a-tolerance", "dark", desk, "adaptive"],
  ["body-3d", "bracket-on-plane", "light", desk, "picture"],
  ["body-3d-phone", "bracket-on-plane", "dark", phone],
  ["axisymmetric", "hertz-sphere", "dark", desk, "picture"],
  ["beam", "beam-on-rigid-ceiling", "light", desk, "picture"],
  ["sweep", "sweep", "light", desk],
  ["study-epsilon", "study", "light", desk],
];

const browser = await puppeteer.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});
for (const [name, folder, scheme, viewport, part] of shots) {
  if (wanted.length > 0 && !wanted.includes(name)) continue;
  const page = await browser.newPage();
  await page.emulateMediaFeatures([{ name: "prefers-color-scheme", value: scheme }]);
  await page.setViewport(viewport);
  await page.goto(pathToFileURL(path.join(results, folder, "report.html")).href);
  await new Promise((resolve) => setTimeout(resolve, 1500));
  if (part) await page.evaluate((id) => document.getElementById(id)?.scrollIntoView(), part);
  await new Promise((resolve) => setTimeout(resolve, 500));
  const file = path.join(pictures, `${name}.png`);
  await page.screenshot({ path: file });
  if (statSync(file).size > max_bytes)
    execFileSync("/usr/bin/python3", ["-c", "import sys; from PIL import Image; Image.open(sys.argv[1]).convert('RGB').quantize(128).save(sys.argv[1], optimize=True)", file]);
  console.log(`${name}.png ${(statSync(file).size / 1000).toFixed(0)} kB`);
  await page.close();
}
await browser.close();
