// The things that a picture consists of, as three.js objects: the coloured surface, edges, obstacles, the outline of the contact zone, integration
// points and the line of the section. Each layer knows how to move when the deformation changes; a Shape says where points go.
import {
  BufferAttribute,
  BufferGeometry,
  DataTexture,
  DoubleSide,
  LineBasicMaterial,
  LineSegments,
  LinearFilter,
  Mesh,
  MeshBasicMaterial,
  Points,
  ShaderMaterial,
  Vector2,
  Vector3,
} from "three";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import { no_value, table } from "./colours.js";
import { contact_outline, cross, edges_of, evaluate, evaluate_vector, Locator, unit, vertex_normals } from "./geometry.js";
import { extent } from "./numbers.js";

/** Where the points of a scene are drawn: centred, in units of the scene's size, deformed by `factor`; `level` is the u that is drawn at height 0. */
export class Shape {
  constructor(scene, factor, level) {
    this.scene = scene;
    this.factor = factor;
    this.level = level;
    this.is_height = !scene.vector && scene.dimension === 2;
    this.u = scene.vector ? scene.displacement : (scene.quantity("u")?.values ?? null);
  }

  /** Height at which the value of a scalar is drawn. */
  height(value) {
    return Number.isFinite(value) ? (this.factor * (value - this.level)) / this.scene.size : 0;
  }

  /** Positions of all vertices; a scalar has `values` as height, by default u. */
  positions(values = this.u) {
    const { points, centre, size, n_points } = this.scene;
    const result = new Float32Array(3 * n_points);
    for (let i = 0; i < 3 * n_points; ++i) result[i] = (points[i] - centre[i % 3]) / size;
    if (this.is_height && values) for (let i = 0; i < n_points; ++i) result[3 * i + 2] = this.height(values[i]);
    if (this.scene.vector && this.u)
      for (let i = 0; i < 3 * n_points; ++i) if (Number.isFinite(this.u[i])) result[i] += (this.factor * this.u[i]) / size;
    return result;
  }

  /** The position of a point X of the reference configuration that lies at `place` (null: unknown, it stays where it is). */
  position(X, place) {
    const { centre, size } = this.scene;
    const result = X.map((value, c) => (value - centre[c]) / size);
    if (place === null || !this.u) return result;
    if (this.is_height) result[2] = this.height(evaluate(this.u, place));
    else if (this.scene.vector) {
      const u = evaluate_vector(this.u, place);
      for (let c = 0; c < 3; ++c) if (Number.isFinite(u[c])) result[c] += (this.factor * u[c]) / size;
    }
    return result;
  }
}

const textures = {};

function map_texture(name) {
  if (!textures[name]) {
    textures[name] = new DataTexture(table(name), 256, 1);
    textures[name].minFilter = textures[name].magFilter = LinearFilter;
    textures[name].needsUpdate = true;
  }
  return textures[name];
}

// The value, not the colour, is interpolated over a triangle, and looked up in the map for every pixel. NaN does not survive the way to the
// graphics card on all machines; so its absence goes as a number of its own.
const coloured = `
  uniform sampler2D map; uniform vec2 range; uniform vec3 nothing;
  vec3 colour_of(float value, float valid) {
    if (valid < 0.999) return nothing;
    float place = range.y > range.x ? clamp((value - range.x) / (range.y - range.x), 0., 1.) : 0.5;
    return texture2D(map, vec2((place * 255. + 0.5) / 256., 0.5)).rgb;
  }`;

function coloured_uniforms(name) {
  return { map: { value: map_texture(name) }, range: { value: new Vector2(0, 1) }, nothing: { value: new Vector3(...no_value) } };
}

/** Attributes `value` and `valid` of a list of numbers. */
function set_values(geometry, values) {
  const value = new Float32Array(values.length);
  const valid = new Float32Array(values.length);
  for (let i = 0; i < values.length; ++i)
    if (Number.isFinite(values[i])) {
      value[i] = values[i];
      valid[i] = 1;
    }
  geometry.setAttribute("value", new BufferAttribute(value, 1));
  geometry.setAttribute("valid", new BufferAttribute(valid, 1));
}

function set_positions(geometry, positions) {
  geometry.setAttribute("position", new BufferAttribute(positions, 3));
  geometry.boundingSphere = null;
}

/** The surface, coloured by a quantity, and the edges of the cells on it. */
export class Surface {
  constructor(scene) {
    this.scene = scene;
    this.material = new ShaderMaterial({
      side: DoubleSide,
      polygonOffset: true, // edges lie in front of the faces they belong to
      polygonOffsetFactor: 1,
      polygonOffsetUnits: 1,
      uniforms: { ...coloured_uniforms("viridis"), lit: { value: 1 }, smooth_normals: { value: 0 } },
      vertexShader: `
        attribute float value; attribute float valid;
        varying float v_value; varying float v_valid; varying vec3 v_normal; varying vec3 v_position;
        void main() {
          v_value = value; v_valid = valid; v_normal = normalMatrix * normal;
          vec4 view = modelViewMatrix * vec4(position, 1.);
          v_position = view.xyz;
          gl_Position = projectionMatrix * view;
        }`,
      fragmentShader: `
        ${coloured}
        uniform float lit; uniform float smooth_normals;
        varying float v_value; varying float v_valid; varying vec3 v_normal; varying vec3 v_position;
        void main() {
          vec3 n = smooth_normals > 0.5 ? normalize(v_normal) : normalize(cross(dFdx(v_position), dFdy(v_position)));
          float light = mix(1., 0.62 + 0.38 * abs(dot(n, normalize(vec3(0.35, 0.55, 1.)))), lit);
          gl_FragColor = vec4(colour_of(v_value, v_valid) * light, 1.);
        }`,
    });
    this.mesh = new Mesh(new BufferGeometry(), this.material);
    const lines = scene.lines.length > 0 ? scene.lines : edges_of(scene.triangles, scene.n_points).edges;
    this.edges = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ color: 0x000000, transparent: true, opacity: 0.28, depthWrite: false }));
    this.edges.geometry.setIndex(new BufferAttribute(lines, 1));
    this.edges.renderOrder = 2;
    this.objects = [this.mesh, this.edges];
    for (const object of this.objects) object.frustumCulled = false;
    this.at = null;
  }

  /** Colours by a Quantity. A value per triangle needs vertices that belong to one triangle only. */
  colour(quantity, range) {
    const { scene } = this;
    if (this.at !== quantity.at) {
      this.at = quantity.at;
      this.mesh.geometry.dispose();
      this.mesh.geometry = new BufferGeometry();
      if (this.at === "points") this.mesh.geometry.setIndex(new BufferAttribute(scene.triangles, 1));
      if (this.positions) this.#place();
    }
    if (this.quantity !== quantity)
      set_values(
        this.mesh.geometry,
        this.at === "points" ? quantity.values : Float32Array.from(scene.triangles, (_, i) => quantity.values[Math.floor(i / 3)]),
      );
    this.quantity = quantity;
    this.material.uniforms.range.value.set(...range);
  }

  /** Moves the vertices. */
  deform(shape) {
    this.positions = shape.positions();
    this.material.uniforms.smooth_normals.value = shape.is_height ? 1 : 0;
    // what is flat and seen from above keeps exactly the colours of the colour bar
    this.material.uniforms.lit.value = this.scene.dimension === 3 || (shape.is_height && shape.factor !== 0) ? 1 : 0;
    this.normals = null;
    if (shape.is_height) {
      this.normals = new Float32Array(this.positions.length);
      vertex_normals(this.positions, this.scene.triangles, this.normals);
    }
    set_positions(this.edges.geometry, this.positions);
    this.#place();
  }

  #place() {
    const { geometry } = this.mesh;
    const expanded = (values) => {
      if (this.at === "points") return values;
      const result = new Float32Array(3 * this.scene.triangles.length);
      this.scene.triangles.forEach((v, i) => result.set(values.subarray(3 * v, 3 * v + 3), 3 * i));
      return result;
    };
    set_positions(geometry, expanded(this.positions));
    if (this.normals) geometry.setAttribute("normal", new BufferAttribute(expanded(this.normals), 3));
  }
}

const obstacle_colour = 0xd07a2d;

/** The bounds of a scalar as translucent surfaces. */
export class Bounds {
  constructor(scene, amplitude) {
    this.parts = [...scene.family("lower"), ...scene.family("upper")].map((quantity) => {
      const is_lower = quantity.key.startsWith("lower");
      const mesh = new Mesh(
        new BufferGeometry(),
        new MeshBasicMaterial({
          color: obstacle_colour,
          transparent: true,
          opacity: 0.42,
          side: DoubleSide,
          depthWrite: false,
          polygonOffset: true, // where u touches the bound, u is what is seen
          polygonOffsetFactor: is_lower ? 2 : 3,
          polygonOffsetUnits: 6,
        }),
      );
      mesh.renderOrder = 4;
      mesh.frustumCulled = false;
      return { quantity, mesh };
    });
    this.scene = scene;
    this.amplitude = amplitude;
    this.objects = this.parts.map((part) => part.mesh);
  }

  /** Only what is not much farther away than u itself is drawn: a bound of -1000 means "none". */
  deform(shape) {
    const { triangles } = this.scene;
    const limit = 1.5 * this.amplitude || Infinity;
    this.heights = [];
    for (const { quantity, mesh } of this.parts) {
      const { values } = quantity;
      const near = (v) => Math.abs(values[v] - shape.level) <= limit;
      set_positions(mesh.geometry, shape.positions(values));
      const kept = [];
      for (let t = 0; t < triangles.length; t += 3)
        if (near(triangles[t]) && near(triangles[t + 1]) && near(triangles[t + 2])) kept.push(triangles[t], triangles[t + 1], triangles[t + 2]);
      mesh.geometry.setIndex(new BufferAttribute(Uint32Array.from(kept), 1));
      this.heights.push(...extent(kept.map((v) => shape.height(values[v]))).filter(Number.isFinite));
    }
  }
}

/** The obstacles of a body, at the points where the gap is measured: a short piece of the obstacle's tangent, hatched on the far side. */
export class BodyObstacle {
  constructor(scene) {
    this.scene = scene;
    this.lines = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ color: obstacle_colour }));
    this.dots = new Points(new BufferGeometry(), dot_material(null));
    this.dots.material.uniforms.plain.value.set(0xd0 / 255, 0x7a / 255, 0x2d / 255);
    this.dots.material.uniforms.size.value = scene.dimension === 3 ? 2.5 : 3;
    this.objects = [this.lines, this.dots];
    for (const object of this.objects) {
      object.frustumCulled = false;
      object.renderOrder = 3;
    }
    const { n } = scene.cloud;
    this.step = Math.ceil(n / 8000); // more would be a solid patch, slowly
  }

  deform(shape) {
    const { cloud, centre, size, dimension } = this.scene;
    const [dots, lines] = [[], []];
    for (let i = 0; i < cloud.n; i += this.step) {
      const distance = shape.factor * (cloud.gap[i] + cloud.u_along[i]);
      // farther than half the body's size is another part of the world
      if (!(Math.abs(shape.factor * cloud.gap[i]) <= size / 2) || !Number.isFinite(distance)) continue;
      const d = unit([cloud.direction[3 * i], cloud.direction[3 * i + 1], cloud.direction[3 * i + 2]]);
      const p = d.map((component, c) => (cloud.points[3 * i + c] - centre[c] + distance * component) / size);
      dots.push(...p);
      const piece = (tangent, length) => {
        for (const sign of [-1, 1]) lines.push(...p.map((value, c) => value + sign * length * tangent[c]));
      };
      if (dimension === 2) {
        const tangent = [-d[1], d[0], 0];
        piece(tangent, 0.008);
        lines.push(...p, ...p.map((value, c) => value + 0.014 * (d[c] - tangent[c])));
      } else {
        const first = unit(cross(d, Math.abs(d[0]) < 0.8 ? [1, 0, 0] : [0, 1, 0]));
        piece(first, 0.006);
        piece(cross(d, first), 0.006);
      }
    }
    set_positions(this.lines.geometry, Float32Array.from(lines));
    set_positions(this.dots.geometry, Float32Array.from(dots));
  }
}

function dot_material(map) {
  return new ShaderMaterial({
    uniforms: { ...coloured_uniforms(map ?? "plasma"), size: { value: 5 }, ratio: { value: 1 }, plain: { value: new Vector3() } },
    vertexShader: `
      attribute float value; attribute float valid; uniform float size; uniform float ratio; varying float v_value; varying float v_valid;
      void main() {
        v_value = value; v_valid = valid;
        gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.);
        gl_Position.z -= 2e-4; // in front of the surface it lies on
        gl_PointSize = size * ratio;
      }`,
    fragmentShader: `
      ${coloured}
      uniform vec3 plain; varying float v_value; varying float v_valid;
      void main() {
        if (length(gl_PointCoord - 0.5) > 0.5) discard;
        gl_FragColor = vec4(${map ? "colour_of(v_value, v_valid)" : "plain"}, 1.);
      }`,
  });
}

/** Integration points as dots, coloured by one of their values. They move with the body. */
export class Cloud {
  constructor(scene) {
    this.scene = scene;
    this.dots = new Points(new BufferGeometry(), dot_material("plasma"));
    this.dots.frustumCulled = false;
    this.dots.renderOrder = 5;
    this.objects = [this.dots];
  }

  colour(values, range, size) {
    if (this.values !== values) set_values(this.dots.geometry, values);
    this.values = values;
    this.dots.material.uniforms.range.value.set(...range);
    this.dots.material.uniforms.size.value = size;
  }

  deform(shape) {
    const { points, n } = this.scene.cloud;
    if (!this.places) {
      const locator = new Locator(this.scene);
      this.places = Array.from({ length: n }, (_, i) => locator.place(points, i));
    }
    const positions = new Float32Array(3 * n);
    for (let i = 0; i < n; ++i) positions.set(shape.position([points[3 * i], points[3 * i + 1], points[3 * i + 2]], this.places[i]), 3 * i);
    set_positions(this.dots.geometry, positions);
  }
}

/** Lines of some pixels' width with a rim of the opposite lightness: they are seen on every colour. */
class BoldLines {
  constructor(core, rim, width) {
    this.objects = [
      [rim, width + 2.5, 6],
      [core, width, 7],
    ].map(([color, linewidth, order]) => {
      // no depth is written: else the rim of one segment would cover the core of the next
      const material = new LineMaterial({ color, linewidth, depthWrite: false, polygonOffset: true, polygonOffsetFactor: -2, polygonOffsetUnits: -40 });
      const object = new LineSegments2(new LineSegmentsGeometry(), material);
      object.renderOrder = order;
      object.frustumCulled = false;
      return object;
    });
  }

  /** Draws segments: 6 numbers each. */
  set(segments) {
    for (const object of this.objects) {
      object.geometry.dispose();
      object.geometry = new LineSegmentsGeometry();
      if (segments.length > 0) object.geometry.setPositions(segments);
      object.has_segments = segments.length > 0;
    }
  }
}

/** The outline of the contact zone. */
export class ContactOutline extends BoldLines {
  constructor(scene) {
    super(0xffffff, 0x111111, 2);
    this.ends = contact_outline(scene);
  }

  deform(_, positions) {
    const segments = new Float32Array((this.ends.length / 2) * 3);
    for (let i = 0; i < this.ends.length; i += 2)
      for (let c = 0; c < 3; ++c) segments[(i / 2) * 3 + c] = (positions[3 * this.ends[i] + c] + positions[3 * this.ends[i + 1] + c]) / 2;
    this.set(segments);
  }
}

/** The line of the section, on the surface. */
export class SectionLine extends BoldLines {
  constructor(scene) {
    super(0xff4f3f, 0xffffff, 2.5);
    this.scene = scene;
    this.places = [];
  }

  deform(shape) {
    const segments = [];
    let last = null;
    for (const place of this.places) {
      const here = place === null ? null : shape.position(evaluate_vector(this.scene.points, place), place);
      if (last !== null && here !== null) segments.push(...last, ...here);
      last = here;
    }
    this.set(Float32Array.from(segments));
  }
}
