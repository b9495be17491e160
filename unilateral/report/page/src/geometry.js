// Geometry of triangle meshes on plain arrays. A *place* is a point of the mesh: { triangle, vertices: [a, b, c], weights: [wa, wb, wc] };
// with it any field can be evaluated there, and the deformed place follows too.

/** The value of a scalar field at a place. Vertices of weight 0 do not count, so that a NaN next door does no harm. */
export function evaluate(values, { vertices, weights }) {
  let sum = 0;
  for (let k = 0; k < 3; ++k) if (weights[k] !== 0) sum += weights[k] * values[vertices[k]];
  return sum;
}

/** The point of a 3-component field (positions, displacements) at a place. */
export function evaluate_vector(values, { vertices, weights }) {
  const result = [0, 0, 0];
  for (let k = 0; k < 3; ++k) if (weights[k] !== 0) for (let c = 0; c < 3; ++c) result[c] += weights[k] * values[3 * vertices[k] + c];
  return result;
}

/** All edges of the triangles, each once: { edges: pairs of vertices, count: the number of triangles at each }. */
export function edges_of(triangles, n_points) {
  const found = new Map();
  for (let t = 0; t < triangles.length; t += 3)
    for (let k = 0; k < 3; ++k) {
      const a = triangles[t + k];
      const b = triangles[t + ((k + 1) % 3)];
      const key = a < b ? a * n_points + b : b * n_points + a;
      found.set(key, (found.get(key) ?? 0) + 1);
    }
  const edges = new Uint32Array(2 * found.size);
  const count = new Uint8Array(found.size);
  let i = 0;
  for (const [key, number] of found) {
    edges[2 * i] = Math.floor(key / n_points);
    edges[2 * i + 1] = key % n_points;
    count[i++] = number;
  }
  return { edges, count };
}

/**
 * The outline of the contact zone as segments; each end lies between two vertices a, b in the middle: 4 vertices per segment (a, b, c, d). The zone
 * reaches half an edge beyond the last vertex in contact. A plane body touches along its boundary: there the zone itself is drawn.
 */
export function contact_outline(scene) {
  const contact = scene.contact;
  const result = [];
  if (contact === null) return result;
  if (scene.dimension === 2 && scene.vector) {
    const { edges, count } = edges_of(scene.triangles, scene.n_points);
    for (let e = 0; e < count.length; ++e) {
      const [a, b] = [edges[2 * e], edges[2 * e + 1]];
      if (count[e] !== 1 || contact[a] + contact[b] === 0) continue;
      if (contact[a] + contact[b] === 2) result.push(a, a, b, b);
      else if (contact[a]) result.push(a, a, a, b);
      else result.push(b, b, a, b);
    }
    return result;
  }
  const { triangles } = scene;
  for (let t = 0; t < triangles.length; t += 3) {
    const sum = contact[triangles[t]] + contact[triangles[t + 1]] + contact[triangles[t + 2]];
    if (sum === 0 || sum === 3) continue;
    const odd = sum === 1 ? 1 : 0; // the one vertex that differs from the other two
    const k = [0, 1, 2].find((i) => contact[triangles[t + i]] === odd);
    const a = triangles[t + k];
    result.push(a, triangles[t + ((k + 1) % 3)], a, triangles[t + ((k + 2) % 3)]);
  }
  return result;
}

/** Unit normals of the vertices, averaged over the triangles with their areas as weights. */
export function vertex_normals(positions, triangles, normals) {
  normals.fill(0);
  for (let t = 0; t < triangles.length; t += 3) {
    const n = triangle_normal(positions, triangles, t);
    for (let k = 0; k < 3; ++k) for (let c = 0; c < 3; ++c) normals[3 * triangles[t + k] + c] += n[c];
  }
  for (let i = 0; i < normals.length; i += 3) {
    const length = Math.hypot(normals[i], normals[i + 1], normals[i + 2]) || 1;
    for (let c = 0; c < 3; ++c) normals[i + c] /= length;
  }
}

/** The normal of the triangle whose vertices start at `t` in `triangles`; its length is twice the area. */
export function triangle_normal(positions, triangles, t) {
  const [a, b, c] = [3 * triangles[t], 3 * triangles[t + 1], 3 * triangles[t + 2]];
  const u = [positions[b] - positions[a], positions[b + 1] - positions[a + 1], positions[b + 2] - positions[a + 2]];
  const v = [positions[c] - positions[a], positions[c + 1] - positions[a + 1], positions[c + 2] - positions[a + 2]];
  return cross(u, v);
}

export function cross(u, v) {
  return [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
}

export function dot(u, v) {
  return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

export function unit(u) {
  const length = Math.hypot(...u) || 1;
  return u.map((value) => value / length);
}

/**
 * The place that is nearest to a viewer who looks along `direction` at `target`, or null. Every triangle is tried: 60 000 of them take about two
 * milliseconds, and nothing has to be rebuilt when the mesh deforms.
 */
export function pick(positions, triangles, target, direction) {
  const d = direction;
  let best = null;
  let nearest = Infinity;
  for (let t = 0; t < triangles.length; t += 3) {
    const a = 3 * triangles[t];
    const b = 3 * triangles[t + 1];
    const c = 3 * triangles[t + 2];
    const ux = positions[b] - positions[a];
    const uy = positions[b + 1] - positions[a + 1];
    const uz = positions[b + 2] - positions[a + 2];
    const vx = positions[c] - positions[a];
    const vy = positions[c + 1] - positions[a + 1];
    const vz = positions[c + 2] - positions[a + 2];
    const px = d[1] * vz - d[2] * vy;
    const py = d[2] * vx - d[0] * vz;
    const pz = d[0] * vy - d[1] * vx;
    const determinant = ux * px + uy * py + uz * pz;
    if (Math.abs(determinant) < 1e-18) continue;
    const sx = target[0] - positions[a];
    const sy = target[1] - positions[a + 1];
    const sz = target[2] - positions[a + 2];
    const wb = (sx * px + sy * py + sz * pz) / determinant;
    if (!(wb >= -1e-7 && wb <= 1 + 1e-7)) continue;
    const qx = sy * uz - sz * uy;
    const qy = sz * ux - sx * uz;
    const qz = sx * uy - sy * ux;
    const wc = (d[0] * qx + d[1] * qy + d[2] * qz) / determinant;
    if (!(wc >= -1e-7 && wb + wc <= 1 + 1e-7)) continue;
    const depth = (vx * qx + vy * qy + vz * qz) / determinant;
    if (depth >= nearest) continue;
    nearest = depth;
    best = { triangle: t / 3, vertices: [triangles[t], triangles[t + 1], triangles[t + 2]], weights: [1 - wb - wc, wb, wc] };
  }
  return best;
}

/**
 * Finds the places of points that lie on the mesh, or close to it: integration points. The vertices are sorted into a grid once; a point is then
 * looked for in the triangles around the nearest vertex.
 */
export class Locator {
  constructor(scene) {
    this.scene = scene;
    this.cell = scene.size / Math.min(64, Math.max(4, Math.ceil(Math.sqrt(scene.n_points) / 2)));
    this.shape = [0, 1, 2].map((c) => Math.floor((scene.high[c] - scene.low[c]) / this.cell) + 1);
    const n_cells = this.shape[0] * this.shape[1] * this.shape[2];
    [this.first, this.vertices] = sorted_into(n_cells, scene.n_points, (i) => this.#index(this.#cell_of(scene.points, i)));
    const { triangles } = scene;
    [this.first_triangle, this.corners] = sorted_into(scene.n_points, triangles.length, (i) => triangles[i]);
  }

  #cell_of(points, i) {
    return [0, 1, 2].map((c) => Math.min(this.shape[c] - 1, Math.max(0, Math.floor((points[3 * i + c] - this.scene.low[c]) / this.cell))));
  }

  #index([i, j, k]) {
    return (k * this.shape[1] + j) * this.shape[0] + i;
  }

  #nearest_vertex(points, i) {
    const here = this.#cell_of(points, i);
    let best = -1;
    let smallest = Infinity;
    const last_ring = Math.max(...this.shape);
    for (let ring = 0, after = 0; ring < last_ring && after < 2; ++ring) {
      const from = here.map((c) => Math.max(0, c - ring));
      const to = here.map((c, k) => Math.min(this.shape[k] - 1, c + ring));
      for (let z = from[2]; z <= to[2]; ++z)
        for (let y = from[1]; y <= to[1]; ++y)
          for (let x = from[0]; x <= to[0]; ++x) {
            if (Math.max(Math.abs(x - here[0]), Math.abs(y - here[1]), Math.abs(z - here[2])) !== ring) continue;
            const cell = this.#index([x, y, z]);
            for (let k = this.first[cell]; k < this.first[cell + 1]; ++k) {
              const v = this.vertices[k];
              let distance = 0;
              for (let c = 0; c < 3; ++c) distance += (this.scene.points[3 * v + c] - points[3 * i + c]) ** 2;
              if (distance < smallest) [smallest, best] = [distance, v];
            }
          }
      if (best >= 0) ++after; // a vertex in the next ring can still be nearer than one in the corner of this
    }
    return best;
  }

  /** The place of point i of `points`, or null where the mesh has no triangle near. */
  place(points, i) {
    const v = this.#nearest_vertex(points, i);
    if (v < 0) return null;
    const { points: X, triangles } = this.scene;
    let best = null;
    let smallest = Infinity;
    for (let k = this.first_triangle[v]; k < this.first_triangle[v + 1]; ++k) {
      const t = this.corners[k] - (this.corners[k] % 3);
      const vertices = [triangles[t], triangles[t + 1], triangles[t + 2]];
      const normal = triangle_normal(X, triangles, t);
      const square = dot(normal, normal);
      if (square === 0) continue;
      const weights = [0, 1, 2].map((corner) => {
        const p = [0, 1, 2].map((c) => X[3 * vertices[(corner + 1) % 3] + c]);
        const q = [0, 1, 2].map((c) => X[3 * vertices[(corner + 2) % 3] + c]);
        const x = [0, 1, 2].map((c) => points[3 * i + c]);
        return Math.max(0, dot(normal, cross([q[0] - p[0], q[1] - p[1], q[2] - p[2]], [x[0] - p[0], x[1] - p[1], x[2] - p[2]])) / square);
      });
      const sum = weights[0] + weights[1] + weights[2] || 1;
      const place = { triangle: t / 3, vertices, weights: weights.map((w) => w / sum) };
      const at = evaluate_vector(X, place);
      const distance = (at[0] - points[3 * i]) ** 2 + (at[1] - points[3 * i + 1]) ** 2 + (at[2] - points[3 * i + 2]) ** 2;
      if (distance < smallest) [smallest, best] = [distance, place];
    }
    return best;
  }
}

/** Items 0 … n_items-1 sorted by their bin: [first item of each bin, items]. */
function sorted_into(n_bins, n_items, bin) {
  const first = new Uint32Array(n_bins + 1);
  for (let i = 0; i < n_items; ++i) ++first[bin(i) + 1];
  for (let k = 0; k < n_bins; ++k) first[k + 1] += first[k];
  const next = first.slice();
  const items = new Uint32Array(n_items);
  for (let i = 0; i < n_items; ++i) items[next[bin(i)]++] = i;
  return [first, items];
}
