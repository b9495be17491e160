// Colour maps whose lightness grows evenly, so that they are right for every kind of colour vision and in grey. Values in between the knots
// are interpolated.

const knots = {
  viridis: ["440154", "482878", "3e4989", "31688e", "26828e", "1f9e89", "35b779", "6ece58", "b5de2b", "fde725"],
  plasma: ["0d0887", "46039f", "7201a8", "9c179e", "bd3786", "d8576b", "ed7953", "fb9f3a", "fdca26", "f0f921"],
};

/** The colour of the places that have no value. */
export const no_value = [0.62, 0.62, 0.64];

const size = 256;

/** 256 RGBA colours of the map called `name`, as bytes. */
export function table(name) {
  const colours = knots[name].map((hex) => [0, 2, 4].map((at) => parseInt(hex.slice(at, at + 2), 16)));
  const result = new Uint8Array(4 * size);
  for (let i = 0; i < size; ++i) {
    const place = (i / (size - 1)) * (colours.length - 1);
    const k = Math.min(Math.floor(place), colours.length - 2);
    for (let c = 0; c < 3; ++c) result[4 * i + c] = Math.round(colours[k][c] + (place - k) * (colours[k + 1][c] - colours[k][c]));
    result[4 * i + 3] = 255;
  }
  return result;
}

/** The map as a CSS gradient from left to right. */
export function gradient(name) {
  return `linear-gradient(to right, ${knots[name].map((hex) => `#${hex}`).join(", ")})`;
}

/** The map painted into a rectangle of a 2-D canvas, for the saved picture. */
export function paint(context, name, x, y, width, height) {
  const fill = context.createLinearGradient(x, 0, x + width, 0);
  knots[name].forEach((hex, k, all) => fill.addColorStop(k / (all.length - 1), `#${hex}`));
  context.fillStyle = fill;
  context.fillRect(x, y, width, height);
}
