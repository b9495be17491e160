// Sections: where a line runs through the mesh, exactly, triangle by triangle. Fields are linear in a triangle; so samples where the line enters
// and leaves each of them are all there is to know. A sample is { s, place }: the distance along the line and the place (see geometry.js), or null
// for the place where the section is interrupted.
import { cross, dot, triangle_normal, unit } from "./geometry.js";

const tiny = 1e-9;

/** The section of a 1-D scene: the whole mesh from left to right; s is the coordinate. */
export function cut_interval(scene) {
  const samples = [];
  const order = [];
  for (let e = 0; e < scene.lines.length; e += 2) {
    const [a, b] = [scene.lines[e], scene.lines[e + 1]];
    order.push(scene.points[3 * a] <= scene.points[3 * b] ? [a, b] : [b, a]);
  }
  order.sort((p, q) => scene.points[3 * p[0]] - scene.points[3 * q[0]]);
  const add = (v) => {
    const s = scene.points[3 * v];
    if (samples.length === 0 || samples.at(-1).s < s) samples.push({ s, place: { triangle: -1, vertices: [v, v, v], weights: [1, 0, 0] } });
  };
  for (const [a, b] of order) {
    add(a);
    add(b);
  }
  return samples;
}

/** The section of a plane scene along the line from A to B. */
export function cut_plane(scene, A, B) {
  const { points, triangles } = scene;
  const length = Math.hypot(B[0] - A[0], B[1] - A[1]);
  const pieces = [];
  if (length === 0) return [];
  const [dx, dy] = [B[0] - A[0], B[1] - A[1]];
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [3 * triangles[t], 3 * triangles[t + 1], 3 * triangles[t + 2]];
    const area = (points[b] - points[a]) * (points[c + 1] - points[a + 1]) - (points[c] - points[a]) * (points[b + 1] - points[a + 1]);
    if (area === 0) continue;
    // weights of the three vertices at A and how they change towards B
    const start = [];
    const slope = [];
    let [from, to] = [0, 1];
    for (let k = 0; k < 3 && from <= to; ++k) {
      const p = [b, c, a][k];
      const q = [c, a, b][k];
      const [ex, ey] = [points[q] - points[p], points[q + 1] - points[p + 1]];
      start[k] = (ex * (A[1] - points[p + 1]) - ey * (A[0] - points[p])) / area;
      slope[k] = (ex * dy - ey * dx) / area;
      const root = (-tiny - start[k]) / slope[k];
      if (Math.abs(slope[k]) < tiny) {
        if (start[k] < -tiny) to = -1; // parallel to this side, and outside
      } else if (slope[k] > 0) from = Math.max(from, root);
      else to = Math.min(to, root);
    }
    if (to - from < 1e-7) continue;
    const place = (x) => ({ triangle: t / 3, vertices: [triangles[t], triangles[t + 1], triangles[t + 2]], weights: start.map((w, k) => w + x * slope[k]) });
    pieces.push({ from, to, at: place });
  }
  pieces.sort((p, q) => p.from - q.from || p.to - q.to);
  const samples = [];
  let last = -Infinity;
  for (const { from, to, at } of pieces) {
    if (to <= last + 1e-7) continue; // the other triangle at an edge that the line runs along
    if (samples.length > 0 && from > last + 1e-6) samples.push({ s: (length * (last + from)) / 2, place: null });
    if (samples.length === 0 || from > last + 1e-6) samples.push({ s: length * from, place: at(from) });
    samples.push({ s: length * to, place: at(to) });
    last = to;
  }
  return samples;
}

/**
 * The section of the surface of a body along the line from A to B as it appears to somebody who looks along d: where the plane through A and B
 * that contains d cuts the surface, only what is nearest.
 */
export function cut_surface(scene, A, B, d) {
  const { points, triangles } = scene;
  const line = B.map((value, c) => value - A[c]);
  const length = Math.hypot(...line);
  const sight = unit(d);
  const across = line.map((value, c) => value - dot(line, sight) * sight[c]); // what is seen of the line
  const square = dot(across, across);
  if (!(square > 1e-12 * length * length)) return [];
  const normal = unit(cross(across, sight));
  const pieces = [];
  const X = (v) => [points[3 * v] - A[0], points[3 * v + 1] - A[1], points[3 * v + 2] - A[2]];
  for (let t = 0; t < triangles.length; t += 3) {
    const vertices = [triangles[t], triangles[t + 1], triangles[t + 2]];
    const corners = vertices.map(X);
    const side = corners.map((x) => dot(x, normal));
    const ends = [];
    for (let k = 0; k < 3; ++k) {
      const l = (k + 1) % 3;
      if (side[k] >= 0 === side[l] >= 0) continue;
      const share = side[k] / (side[k] - side[l]);
      const weights = [0, 0, 0];
      weights[k] = 1 - share;
      weights[l] = share;
      const x = [0, 1, 2].map((c) => (1 - share) * corners[k][c] + share * corners[l][c]);
      ends.push({ t: dot(x, across) / square, depth: dot(x, sight), weights });
    }
    if (ends.length !== 2) continue;
    ends.sort((p, q) => p.t - q.t);
    const [p, q] = ends;
    if (q.t < 0 || p.t > 1 || q.t - p.t < 1e-9) continue;
    const between = (a, b, x) => a + ((x - p.t) / (q.t - p.t)) * (b - a);
    pieces.push({
      from: Math.max(0, p.t),
      to: Math.min(1, q.t),
      depth: (x) => between(p.depth, q.depth, x),
      at: (x) => ({ triangle: t / 3, vertices, weights: p.weights.map((w, k) => between(w, q.weights[k], x)) }),
    });
  }
  // Places to look at: just inside both ends of every piece, and some more where the pieces are long and may hide each other.
  const where = new Set();
  for (const { from, to } of pieces) {
    const inset = Math.min(1e-6, 0.01 * (to - from));
    where.add(from + inset).add(to - inset);
  }
  for (let k = 0; k <= 400; ++k) where.add(k / 400);
  const places = Float64Array.from(where).sort();
  const nearest = new Array(places.length).fill(null);
  for (const piece of pieces)
    for (let i = first_at_least(places, piece.from); i < places.length && places[i] <= piece.to; ++i) {
      const depth = piece.depth(places[i]);
      if (nearest[i] === null || depth < nearest[i].depth) nearest[i] = { depth, piece };
    }
  return Array.from(places, (x, i) => ({ s: x * length, place: nearest[i] === null ? null : nearest[i].piece.at(x) }));
}

function first_at_least(sorted, value) {
  let [low, high] = [0, sorted.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (sorted[middle] < value) low = middle + 1;
    else high = middle;
  }
  return low;
}

/** The section of any scene. */
export function cut(scene, { from, to, sight }) {
  if (scene.dimension === 1) return cut_interval(scene);
  return scene.dimension === 2 ? cut_plane(scene, from, to) : cut_surface(scene, from, to, sight);
}

/**
 * A line that shows something at once: { from, to, sight } through the place of the largest contact pressure (else the middle), along the longest
 * side of the bounding box that lies in the surface there; a body is seen from outside at that place.
 */
export function default_line(scene) {
  const { low, high, centre, n_points } = scene;
  const pressure = new Float64Array(n_points);
  for (const { values } of scene.family("contact_pressure")) for (let i = 0; i < n_points; ++i) if (values[i] > pressure[i]) pressure[i] = values[i];
  const strongest = pressure.reduce((a, b) => Math.max(a, b), 0);
  const point = (i) => [0, 1, 2].map((c) => scene.points[3 * i + c]);
  const sides = [0, 1, 2].slice(0, scene.dimension).sort((a, b) => high[b] - low[b] - (high[a] - low[a]));
  let through = [...centre];
  let side = sides[0];
  let sight = [0, 0, -1];
  if (strongest > 0) {
    const vertex = pressure.indexOf(strongest);
    if (scene.dimension === 3) {
      sight = outwards(scene, vertex).map((value) => -value);
      side = sides.find((c) => Math.abs(sight[c]) < 0.7) ?? side;
    }
    through = point(vertex);
    // The pressure is often nearly as large along a whole ring; then the line through the middle of the contact says most.
    const sum = [0, 0, 0];
    const total = pressure.reduce((a, b) => a + b, 0);
    for (let i = 0; i < n_points; ++i) if (pressure[i] > 0) point(i).forEach((x, c) => (sum[c] += (pressure[i] / total) * x));
    const beside = (x) => Math.hypot(...x.map((value, c) => (c === side ? 0 : value - sum[c])));
    for (let i = 0; i < n_points; ++i) if (pressure[i] > 0.9 * strongest && beside(point(i)) < beside(through)) through = point(i);
  }
  const [from, to] = [[...through], [...through]];
  from[side] = low[side];
  to[side] = high[side];
  return { from, to, sight };
}

/** The direction out of a body at a vertex. Triangles need not be oriented; outside is where the middle of the body is not. */
function outwards(scene, vertex) {
  const { triangles, points, centre } = scene;
  const from_middle = [0, 1, 2].map((c) => points[3 * vertex + c] - centre[c]);
  const sum = [0, 0, 0];
  for (let t = 0; t < triangles.length; t += 3) {
    if (triangles[t] !== vertex && triangles[t + 1] !== vertex && triangles[t + 2] !== vertex) continue;
    const normal = triangle_normal(points, triangles, t);
    const sign = dot(normal, from_middle) < 0 ? -1 : 1;
    for (let c = 0; c < 3; ++c) sum[c] += sign * normal[c];
  }
  return Math.hypot(...sum) > 0 ? unit(sum) : [0, 0, 1];
}
