// Numbers for people: short, without noise, with the typographic minus left out so that they can be copied into a program.

/** A number with some significant digits, without trailing zeros. */
export function format(value, digits = 5) {
  if (value === null || value === undefined || Number.isNaN(value)) return "–";
  if (!Number.isFinite(value)) return value > 0 ? "∞" : "-∞";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e5 || size < 1e-3) {
    const [mantissa, exponent] = value.toExponential(digits - 1).split("e");
    return `${trimmed(mantissa)}e${Number(exponent)}`;
  }
  return trimmed(value.toPrecision(digits));
}

function trimmed(text) {
  return text.includes(".") ? text.replace(/\.?0+$/, "") : text;
}

/** What somebody typed, or null when it is no number. A decimal comma is understood. */
export function parse(text) {
  const plain = text.trim().replace(",", ".").replace("−", "-");
  if (plain === "") return null;
  const value = Number(plain);
  return Number.isFinite(value) ? value : null;
}

/** Round numbers that divide [from, to] into about `wanted` parts. */
export function ticks(from, to, wanted = 5) {
  const span = to - from;
  if (!(span > 0) || !Number.isFinite(span)) return [from];
  const raw = span / wanted;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 2.5, 5, 10].map((factor) => factor * power).find((value) => value >= raw * 0.999);
  const result = [];
  for (let k = Math.ceil(from / step - 1e-6); k * step <= to + 1e-6 * step; ++k) result.push(k * step);
  // k * step has rounding in its last digits, which toPrecision removes
  return result.map((value) => Number(value.toPrecision(10)));
}

/** The smallest and largest finite value, [NaN, NaN] when there is none. */
export function extent(values) {
  let low = Infinity;
  let high = -Infinity;
  for (let i = 0; i < values.length; ++i) {
    const value = values[i];
    if (value < low && value > -Infinity) low = value;
    if (value > high && value < Infinity) high = value;
  }
  return low <= high ? [low, high] : [NaN, NaN];
}
