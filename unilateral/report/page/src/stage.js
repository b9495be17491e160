// One WebGL context draws for all viewers of the page, one after the other, and the result is copied to their canvases: browsers allow few
// contexts, a comparison has many pictures, and a copied picture can be saved at any time.
import { WebGLRenderer } from "three";

let renderer; // undefined: not yet tried; null: there is no WebGL
const lost_listeners = [];

/** Whether pictures can be drawn. */
export function has_webgl() {
  if (renderer === undefined) {
    try {
      const canvas = document.createElement("canvas");
      // asked for here, so that a missing WebGL is an answer and no message in the console
      const context = canvas.getContext("webgl2", { antialias: true, alpha: true });
      renderer = context ? new WebGLRenderer({ canvas, context, antialias: true, alpha: true }) : null;
      canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
      canvas.addEventListener("webglcontextrestored", () => lost_listeners.forEach((listener) => listener()));
    } catch {
      renderer = null;
    }
  }
  return renderer !== null;
}

/** Calls `listener` when everything has to be drawn again, because the graphics card was taken away and given back. */
export function on_restored(listener) {
  lost_listeners.push(listener);
}

/** Draws a scene into a 2-D canvas of `width` × `height` CSS pixels. */
export function draw(scene, camera, canvas, width, height, ratio) {
  const [w, h] = [Math.floor(width * ratio), Math.floor(height * ratio)];
  if (renderer.domElement.width !== w || renderer.domElement.height !== h) {
    // a new size throws the buffers away; so only where it is needed
    renderer.setPixelRatio(ratio);
    renderer.setSize(width, height, false);
  }
  renderer.setClearColor(0x000000, 0);
  renderer.render(scene, camera);
  const source = renderer.domElement;
  if (canvas.width !== w || canvas.height !== h) {
    canvas.width = w;
    canvas.height = h;
  }
  const context = canvas.getContext("2d");
  context.clearRect(0, 0, canvas.width, canvas.height);
  context.drawImage(source, 0, 0);
}
