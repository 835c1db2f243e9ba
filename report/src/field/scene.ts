// The picture: triangles in the colours of their values, sides, nodes and states of contact, by three.js.
import {
  BufferAttribute, BufferGeometry, Camera as ThreeCamera, Color, DataTexture, InstancedBufferAttribute, InstancedBufferGeometry, LineSegments,
  Group, Mesh, NearestFilter, Points, Scene, ShaderMaterial, ShapeUtils, Sphere, Vector2, Vector3, WebGLRenderer,
} from "three";
import type { Camera } from "./camera";
import { colourMap, ENTRIES, type Levels } from "./colours";
import { fill, mark, plain, side } from "./shaders";

export interface Geometry {
  points: Float32Array; // x, y of every point, relative to the centre of the model
  triangles: Uint32Array;
  outline: Uint32Array;
  mesh: Uint32Array;
  elements: Uint32Array;
  nodes: Uint32Array;
  body: Uint32Array; // of every point, from 1
  rigid: Uint32Array;
  rigidSizes: Uint32Array;
}

/** How the bodies begin to move, as mechanism.vtu has it. */
export interface Mechanism {
  points: Float32Array;
  triangles: Uint32Array;
  sides: Uint32Array;
  opens: Uint32Array; // pieces of joints
  slips: Uint32Array;
  ux: Float32Array;
  uy: Float32Array;
}

export interface Theme {
  line: string;
  faint: string;
  rigid: string;
  none: string;
  paper: string;
  open: string;
  stick: string;
  slip: string;
}

const NODES_APART = 26; // pixels from node to node, at least, where nodes are marked
const SIDES_APART = 5; // pixels from side to side of cells, at least, where they are drawn: closer ones hide the colours
const MOST_UNMEASURED = 1e5; // corners of triangles

/** Whether a processor without graphics draws: then without smoothing of edges, which costs it most. */
export function drawsSlowly(): boolean {
  const probe = document.createElement("canvas").getContext("webgl2");
  if (!probe) throw new Error("no WebGL 2");
  const names = probe.getExtension("WEBGL_debug_renderer_info");
  const name = String(probe.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : probe.RENDERER));
  probe.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}

/** What draws all meshes of a page. `slow`: on a processor without graphics. */
export interface Drawer {
  renderer: WebGLRenderer;
  slow: boolean;
}

export function drawerOn(canvas: HTMLCanvasElement): Drawer {
  const slow = drawsSlowly();
  const renderer = new WebGLRenderer({ canvas, antialias: !slow, alpha: true, powerPreference: "high-performance", preserveDrawingBuffer: false });
  renderer.setPixelRatio(slow ? 1 : Math.min(window.devicePixelRatio, 2));
  renderer.outputColorSpace = "srgb-linear"; // colours are used as they are given
  renderer.sortObjects = true;
  return { renderer, slow };
}

export class FieldScene {
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly place = { centre: { value: new Vector2() }, zoom: { value: new Vector2() }, magnification: { value: 0 } };
  private readonly pixel = { value: new Vector2() };
  private readonly lift: number;
  private readonly depth: BufferAttribute;
  private readonly ux: BufferAttribute;
  private readonly uy: BufferAttribute;
  private readonly value: BufferAttribute;
  private readonly fillMaterial: ShaderMaterial;
  private readonly colours: Record<string, { value: Color }> = {};
  private readonly maps: Record<"true" | "false", DataTexture>;
  private readonly sides: { ends: Uint32Array; geometry: InstancedBufferGeometry };
  private marks: { geometry: BufferGeometry; points: Points } | null = null;
  private readonly fields = new Group();
  private mechanism: { group: Group; magnification: { value: number } } | null = null;
  private readonly parts: { mesh: LineSegments; elements: LineSegments; nodes: Points; undeformed: LineSegments };
  private readonly still: BufferGeometry; // the same points without displacements
  private readonly ratio: number;
  private readonly measures: boolean;
  private sidesWanted = true;
  cost = 0; // milliseconds of the last drawing, where a processor without graphics draws many triangles; 0 elsewhere

  constructor({ renderer, slow }: Drawer, private readonly geometry: Geometry, bodyCount: number) {
    this.measures = slow && geometry.triangles.length > MOST_UNMEASURED;
    this.renderer = renderer;
    this.ratio = renderer.getPixelRatio();
    const count = geometry.points.length / 2;
    const position = new BufferAttribute(geometry.points, 2);
    this.lift = 0.5 * depthStep(bodyCount);
    this.depth = new BufferAttribute(new Float32Array(count), 1);
    this.scene.add(this.fields);
    this.ux = new BufferAttribute(new Float32Array(count), 1);
    this.uy = new BufferAttribute(new Float32Array(count), 1);
    this.value = new BufferAttribute(new Float32Array(count), 1);
    for (const name of ["line", "faint", "rigid", "none", "paper", "open", "stick", "slip"]) this.colours[name] = { value: new Color() };
    this.maps = { true: texture(true), false: texture(false) };

    const shared = (index: Uint32Array | number[]): BufferGeometry => {
      const made = new BufferGeometry();
      made.setAttribute("position", position);
      made.setAttribute("ux", this.ux);
      made.setAttribute("uy", this.uy);
      made.setAttribute("depth", this.depth);
      made.setIndex(new BufferAttribute(index instanceof Uint32Array ? index : new Uint32Array(index), 1));
      return made;
    };
    this.fillMaterial = new ShaderMaterial({
      vertexShader: fill.vertex, fragmentShader: fill.fragment, side: 2,
      uniforms: { ...this.place, lift: { value: 0 }, map: { value: this.maps.false }, range: { value: new Vector2(0, 1) }, bands: { value: 10 }, lines: { value: 1 }, none: this.colours.none },
    });
    const body = shared(geometry.triangles);
    body.setAttribute("value", this.value);
    this.add(new Mesh(body, this.fillMaterial), 1);
    this.add(new Mesh(shared(trianglesOf(geometry.points, geometry.rigid, geometry.rigidSizes)), this.material("rigid", 1, 1, true)), 0);
    this.still = new BufferGeometry();
    this.still.setAttribute("position", position);
    this.still.setIndex(new BufferAttribute(geometry.outline, 1));
    const zero = new BufferAttribute(new Float32Array(count), 1);
    this.still.setAttribute("ux", zero);
    this.still.setAttribute("uy", zero);
    this.still.setAttribute("depth", this.depth);
    const nodes = shared(geometry.nodes);
    this.parts = {
      undeformed: this.add(new LineSegments(this.still, this.material("faint", 0.55)), 0.5),
      mesh: this.add(new LineSegments(shared(geometry.mesh), this.material("line", 0.22)), 2),
      elements: this.add(new LineSegments(shared(geometry.elements), this.material("line", 0.75)), 3),
      nodes: this.add(new Points(nodes, this.material("line", 1, 3.5 * this.ratio)), 4),
    };
    this.sides = this.wideSides(rigidSides(geometry));
  }

  /** The memory of graphics; another mesh is drawn. */
  dispose(): void {
    this.scene.traverse((part) => {
      if (part instanceof Mesh || part instanceof LineSegments || part instanceof Points) {
        part.geometry.dispose();
        (part.material as ShaderMaterial).dispose();
      }
    });
    this.maps.true.dispose();
    this.maps.false.dispose();
  }

  private add<T extends Mesh | LineSegments | Points>(part: T, order: number, to: Group = this.fields): T {
    part.frustumCulled = false;
    part.geometry.boundingSphere = new Sphere(); // for three's sorting; points in the plane have none that it could compute
    part.renderOrder = order;
    to.add(part);
    return part;
  }

  /** Of lines and nodes, or of areas, which hide what is below them. */
  private material(colour: string, opacity: number, size = 1, area = false): ShaderMaterial {
    return new ShaderMaterial({
      vertexShader: plain.vertex, fragmentShader: plain.fragment, depthWrite: area, transparent: !area, side: 2,
      uniforms: { ...this.place, lift: { value: area ? 0 : this.lift }, colour: this.colours[colour], opacity: { value: opacity }, size: { value: size } },
    });
  }

  /** Outlines of all bodies. */
  private wideSides(ends: Uint32Array): { ends: Uint32Array; geometry: InstancedBufferGeometry } {
    const made = new InstancedBufferGeometry();
    made.setAttribute("position", new BufferAttribute(new Float32Array([0, -0.5, 0, 1, -0.5, 0, 1, 0.5, 0, 0, 0.5, 0]), 3));
    made.setIndex([0, 1, 2, 0, 2, 3]);
    const count = ends.length / 2;
    for (const name of ["from", "to", "from_moved", "to_moved"]) made.setAttribute(name, new InstancedBufferAttribute(new Float32Array(2 * count), 2));
    made.setAttribute("depth", new InstancedBufferAttribute(new Float32Array(count), 1));
    made.instanceCount = count;
    const from = made.getAttribute("from"), to = made.getAttribute("to"), { points } = this.geometry;
    for (let i = 0; i < count; ++i) {
      from.setXY(i, points[2 * ends[2 * i]], points[2 * ends[2 * i] + 1]);
      to.setXY(i, points[2 * ends[2 * i + 1]], points[2 * ends[2 * i + 1] + 1]);
    }
    const material = new ShaderMaterial({
      vertexShader: side.vertex, fragmentShader: side.fragment, depthWrite: false, transparent: true, side: 2,
      uniforms: { ...this.place, lift: { value: this.lift }, pixel: this.pixel, width: { value: 1.4 * this.ratio }, colour: this.colours.line, opacity: { value: 1 } },
    });
    this.add(new Mesh(made, material), 5);
    return { ends, geometry: made };
  }

  /** Marks of contact pairs, at points of the fields (plus 1) or, where a side is rigid, at their own place. `sizes`: pairs of each
   * contact, whose neighbours give the direction of the joint and the room for a mark. */
  setPairs(x: Float32Array, y: Float32Array, sizes: number[]): void {
    const made = new BufferGeometry(), at = new Float32Array(3 * x.length);
    for (let i = 0; i < x.length; ++i) at.set([x[i], y[i], 0], 3 * i);
    made.setAttribute("position", new BufferAttribute(at, 3));
    for (const name of ["ux", "uy", "state", "depth"]) made.setAttribute(name, new BufferAttribute(new Float32Array(x.length), 1));
    const { beside, room } = besideJoints(x, y, sizes);
    made.setAttribute("beside", new BufferAttribute(beside, 2));
    made.setAttribute("room", new BufferAttribute(room, 1));
    const { open, stick, slip, paper } = this.colours;
    const points = new Points(made, new ShaderMaterial({
      vertexShader: mark.vertex, fragmentShader: mark.fragment, depthTest: false, depthWrite: false, transparent: true,
      uniforms: { ...this.place, lift: { value: 0 }, pixel: this.pixel, sizes: { value: new Vector2(3 * this.ratio, 10 * this.ratio) }, open, stick, slip, paper },
    }));
    this.marks = { geometry: made, points: this.add(points, 6) };
  }

  setStates(states: Uint8Array, at: Uint32Array): void {
    if (!this.marks) return;
    const { geometry } = this.marks;
    const ux = geometry.getAttribute("ux"), uy = geometry.getAttribute("uy"), state = geometry.getAttribute("state");
    for (let i = 0; i < states.length; ++i) {
      ux.setX(i, at[i] ? this.ux.array[at[i] - 1] : 0);
      uy.setX(i, at[i] ? this.uy.array[at[i] - 1] : 0);
      state.setX(i, states[i]);
    }
    for (const attribute of [ux, uy, state]) attribute.needsUpdate = true;
  }

  setDisplacement(ux: Float32Array | null, uy: Float32Array | null): void {
    if (!ux || !uy) return;
    this.ux.array.set(ux);
    this.uy.array.set(uy);
    this.ux.needsUpdate = this.uy.needsUpdate = true;
    const from = this.sides.geometry.getAttribute("from_moved"), to = this.sides.geometry.getAttribute("to_moved"), { ends } = this.sides;
    for (let i = 0; i < ends.length / 2; ++i) {
      from.setXY(i, ux[ends[2 * i]], uy[ends[2 * i]]);
      to.setXY(i, ux[ends[2 * i + 1]], uy[ends[2 * i + 1]]);
    }
    from.needsUpdate = to.needsUpdate = true;
  }

  /** Which body is above which, and which are hidden: `depths` of all points. `sides`: points of the fields, plus 1, at both sides of all pairs. */
  setDepths(depths: Float32Array, sides: [Uint32Array, Uint32Array] | null): void {
    (this.depth.array as Float32Array).set(depths);
    this.depth.needsUpdate = true;
    const ofSides = this.sides.geometry.getAttribute("depth"), { ends } = this.sides;
    for (let i = 0; i < ends.length / 2; ++i) ofSides.setX(i, depths[ends[2 * i]]);
    ofSides.needsUpdate = true;
    if (!this.marks || !sides) return;
    const ofMarks = this.marks.geometry.getAttribute("depth"), hidden = (point: number) => point > 0 && depths[point - 1] === HIDDEN;
    for (let i = 0; i < ofMarks.count; ++i) ofMarks.setX(i, hidden(sides[0][i]) || hidden(sides[1][i]) ? HIDDEN : 0);
    ofMarks.needsUpdate = true;
  }

  /** The motion of a mechanism in place of the fields. */
  setMechanism(motion: Mechanism): void {
    const count = motion.points.length / 2, group = new Group(), magnification = { value: 0 };
    const size = new Float32Array(count);
    for (let i = 0; i < count; ++i) size[i] = Math.hypot(motion.ux[i], motion.uy[i]);
    const attributes = { position: new BufferAttribute(motion.points, 2), ux: new BufferAttribute(motion.ux, 1), uy: new BufferAttribute(motion.uy, 1),
      value: new BufferAttribute(size, 1), depth: new BufferAttribute(new Float32Array(count), 1) };
    const shaped = (index: Uint32Array): BufferGeometry => {
      const made = new BufferGeometry();
      for (const [name, attribute] of Object.entries(attributes)) made.setAttribute(name, attribute);
      made.setIndex(new BufferAttribute(index, 1));
      return made;
    };
    const drawn = (material: ShaderMaterial): ShaderMaterial => {
      material.uniforms.magnification = magnification;
      material.depthTest = false;
      return material;
    };
    const colours = this.fillMaterial.clone();
    Object.assign(colours.uniforms, { ...this.place, map: { value: this.maps.false }, range: { value: new Vector2(0, 1) }, bands: { value: 10 }, lines: { value: 0 }, none: this.colours.none });
    this.add(new Mesh(shaped(motion.triangles), drawn(colours)), 1, group);
    this.add(new LineSegments(shaped(motion.sides), drawn(this.material("line", 1))), 2, group);
    this.add(new LineSegments(shaped(motion.opens), drawn(this.material("open", 1))), 3, group);
    this.add(new LineSegments(shaped(motion.slips), drawn(this.material("slip", 1))), 4, group);
    group.visible = false;
    this.scene.add(group);
    this.mechanism = { group, magnification };
  }

  /** `length`: of the largest displacement of the mechanism; null shows the fields. */
  showMechanism(length: number | null): void {
    if (!this.mechanism) return;
    this.mechanism.group.visible = length !== null;
    this.fields.visible = length === null;
    this.mechanism.magnification.value = length ?? 0;
  }

  setValues(values: Float32Array): void {
    this.value.array.set(values);
    this.value.needsUpdate = true;
  }

  setLevels(levels: Levels, bands: boolean): void {
    const { uniforms } = this.fillMaterial;
    uniforms.map.value = levels.signed ? this.maps.true : this.maps.false;
    (uniforms.range.value as Vector2).set(levels.low, levels.high);
    uniforms.bands.value = bands ? levels.bands : 0;
  }

  setMagnification(value: number): void {
    this.place.magnification.value = value;
  }

  show(what: { mesh: boolean; elements: boolean; undeformed: boolean; states: boolean }): void {
    this.parts.mesh.visible = what.mesh;
    this.sidesWanted = what.elements;
    this.parts.undeformed.visible = what.undeformed;
    if (this.marks) this.marks.points.visible = what.states;
  }

  setTheme(theme: Theme): void {
    for (const [name, colour] of Object.entries(theme)) {
      const value = new Vector3(...[1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16) / 255));
      this.colours[name].value.setRGB(value.x, value.y, value.z, "srgb-linear");
    }
  }

  resize(width: number, height: number): void {
    this.renderer.setSize(width, height, false);
    this.pixel.value.set(2 / (width * this.ratio), 2 / (height * this.ratio));
  }

  draw(camera: Camera): void {
    this.place.centre.value.set(camera.x, camera.y);
    this.place.zoom.value.set((2 * camera.scale) / camera.width, (2 * camera.scale) / camera.height);
    this.parts.elements.visible = this.sidesWanted && camera.size * camera.scale > SIDES_APART * Math.sqrt(0.25 * this.geometry.elements.length);
    this.parts.nodes.visible = this.sidesWanted && camera.size * camera.scale > NODES_APART * Math.sqrt(this.geometry.nodes.length);
    const start = performance.now();
    this.renderer.render(this.scene, NO_CAMERA);
    if (!this.measures) return;
    const gl = this.renderer.getContext();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4)); // waits until all is drawn
    this.cost = performance.now() - start;
  }
}

/** Depths for a list of bodies, the last of which is above all others; `hidden` ones lie behind everything. */
export function depthsOf(body: Uint32Array, order: number[], hidden: ReadonlySet<number>): Float32Array {
  const ofBody = new Float32Array(order.length + 1).fill(HIDDEN), step = depthStep(order.length);
  order.forEach((number, rank) => { if (!hidden.has(number)) ofBody[number] = 1 - step * (rank + 1); });
  return Float32Array.from(body, (number) => ofBody[number]);
}

export const HIDDEN = 3; // beyond what is drawn, which lies between -1 and 1

function depthStep(bodies: number): number {
  return 2 / (bodies + 2);
}

/** For every pair a direction across the joint, and the distance to its nearest neighbour. */
function besideJoints(x: Float32Array, y: Float32Array, sizes: number[]): { beside: Float32Array; room: Float32Array } {
  const beside = new Float32Array(2 * x.length), room = new Float32Array(x.length);
  let first = 0;
  for (const size of sizes) {
    const end = first + size;
    for (let i = first; i < end; ++i) {
      const before = Math.max(i - 1, first), after = Math.min(i + 1, end - 1);
      const along = [x[after] - x[before], y[after] - y[before]], length = Math.hypot(along[0], along[1]);
      beside.set(length > 0 ? [-along[1] / length, along[0] / length] : [0, 1], 2 * i);
      const distances = [before, after].filter((k) => k !== i).map((k) => Math.hypot(x[k] - x[i], y[k] - y[i]));
      room[i] = distances.length ? Math.min(...distances) : 1e30;
    }
    first = end;
  }
  return { beside, room };
}

const NO_CAMERA = new ThreeCamera(); // shaders place points themselves

export function texture(signed: boolean): DataTexture {
  const made = new DataTexture(colourMap(signed), ENTRIES, 1);
  made.magFilter = made.minFilter = NearestFilter;
  made.needsUpdate = true;
  return made;
}

/** Triangles of polygons, whose points stand in `rings` one polygon after the other. */
export function trianglesOf(points: Float32Array, rings: Uint32Array, sizes: Uint32Array): number[] {
  const corners: number[] = [];
  let at = 0;
  for (const size of sizes) {
    const ring = rings.subarray(at, at + size);
    const contour = Array.from(ring, (point) => new Vector2(points[2 * point], points[2 * point + 1]));
    for (const triangle of ShapeUtils.triangulateShape(contour, [])) corners.push(...triangle.map((k) => ring[k]));
    at += size;
  }
  return corners;
}

function rigidSides({ outline, rigid, rigidSizes }: Geometry): Uint32Array {
  const ends = Array.from(rigidSizes).reduce((sum, size) => sum + 2 * size, 0);
  const sides = new Uint32Array(outline.length + ends);
  sides.set(outline);
  let to = outline.length, at = 0;
  for (const size of rigidSizes) {
    for (let k = 0; k < size; ++k) {
      sides[to++] = rigid[at + k];
      sides[to++] = rigid[at + ((k + 1) % size)];
    }
    at += size;
  }
  return sides;
}
