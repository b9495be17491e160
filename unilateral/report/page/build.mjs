// Bundles src/ into dist/report.js and dist/report.css, the two files that the C++ part puts into every report.html.
import { build } from "esbuild";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";

const here = new URL("./", import.meta.url);
const read = (path) => readFileSync(new URL(path, here), "utf8");
const largest_script = 800_000;

/** The licences of what is bundled, as a comment: both ask that the notice goes along with every copy. */
function licences() {
  const notice = (name) => {
    const version = JSON.parse(read(`node_modules/${name}/package.json`)).version;
    return `${name} ${version}\n\n${read(`node_modules/${name}/LICENSE`).trim()}`;
  };
  return `/*!\nThis file contains:\n\n${notice("three")}\n\n\n${notice("uplot")}\n*/\n`.replaceAll("\r", "").replaceAll("©", "(c)");
}

const script = await build({
  absWorkingDir: new URL(".", here).pathname,
  entryPoints: ["src/main.js"],
  bundle: true,
  minify: true,
  format: "iife",
  target: "es2020",
  treeShaking: true,
  charset: "ascii", // the file is read correctly whatever encoding somebody saves the page in
  legalComments: "none",
  write: false,
});
const style = await build({
  absWorkingDir: new URL(".", here).pathname,
  entryPoints: ["src/style.css"],
  bundle: true,
  minify: true,
  legalComments: "none",
  write: false,
});

const js = licences() + script.outputFiles[0].text;
const css = style.outputFiles[0].text;

// Inside an inline <script> or <style> these would end the element, or change how the parser reads what follows.
for (const [name, text, forbidden] of [["report.js", js, /<\/script|<script|<!--/i], ["report.css", css, /<\/style|@import|url\(/i]]) {
  const found = forbidden.exec(text);
  if (found) throw new Error(`${name} contains '${found[0]}' and cannot be put into a page`);
}
if (js.length > largest_script) throw new Error(`report.js has ${js.length} bytes, more than ${largest_script}`);

mkdirSync(new URL("dist", here), { recursive: true });
writeFileSync(new URL("dist/report.js", here), js);
writeFileSync(new URL("dist/report.css", here), css);
console.log(`dist/report.js ${js.length} bytes, dist/report.css ${css.length} bytes`);
