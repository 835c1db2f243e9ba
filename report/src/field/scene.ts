// The picture: triangles in the colours of their values, sides, nodes and states of contact, by three.js.
import {
  BufferAttribute, BufferGeometry, Camera as ThreeCamera, Color, DataTexture, InstancedBufferAttribute, InstancedBufferGeometry, LineSegments,
  Mesh, NearestFilter, Points, Scene, ShaderMaterial, ShapeUtils, Sphere, Vector2, Vector3, WebGLRenderer,
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
  rigid: Uint32Array;
  rigidSizes: Uint32Array;
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

export class FieldScene {
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly place = { centre: { value: new Vector2() }, zoom: { value: new Vector2() }, magnification: { value: 0 } };
  private readonly pixel = { value: new Vector2() };
  private readonly ux: BufferAttribute;
  private readonly uy: BufferAttribute;
  private readonly value: BufferAttribute;
  private readonly fillMaterial: ShaderMaterial;
  private readonly colours: Record<string, { value: Color }> = {};
  private readonly maps: Record<"true" | "false", DataTexture>;
  private readonly sides: { ends: Uint32Array; geometry: InstancedBufferGeometry };
  private marks: { geometry: BufferGeometry; points: Points } | null = null;
  private readonly parts: { mesh: LineSegments; elements: LineSegments; nodes: Points; undeformed: LineSegments };
  private readonly still: BufferGeometry; // the same points without displacements
  private readonly ratio: number;
  private readonly measures: boolean;
  private nodesWanted = true;
  cost = 0; // milliseconds of the last drawing, where a processor without graphics draws many triangles; 0 elsewhere

  constructor(canvas: HTMLCanvasElement, private readonly geometry: Geometry) {
    const slow = drawsSlowly();
    this.measures = slow && geometry.triangles.length > MOST_UNMEASURED;
    this.renderer = new WebGLRenderer({ canvas, antialias: !slow, alpha: true, powerPreference: "high-performance", preserveDrawingBuffer: false });
    this.ratio = slow ? 1 : Math.min(window.devicePixelRatio, 2);
    this.renderer.setPixelRatio(this.ratio);
    this.renderer.outputColorSpace = "srgb-linear"; // colours are used as they are given
    this.renderer.sortObjects = true;
    const count = geometry.points.length / 2;
    const position = new BufferAttribute(geometry.points, 2);
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
      made.setIndex(new BufferAttribute(index instanceof Uint32Array ? index : new Uint32Array(index), 1));
      return made;
    };
    this.fillMaterial = new ShaderMaterial({
      vertexShader: fill.vertex, fragmentShader: fill.fragment, depthTest: false, depthWrite: false, side: 2,
      uniforms: { ...this.place, map: { value: this.maps.false }, range: { value: new Vector2(0, 1) }, bands: { value: 10 }, lines: { value: 1 }, none: this.colours.none },
    });
    const body = shared(geometry.triangles);
    body.setAttribute("value", this.value);
    this.add(new Mesh(body, this.fillMaterial), 1);
    this.add(new Mesh(shared(rigidTriangles(geometry)), this.material("rigid", 1)), 0);
    this.still = new BufferGeometry();
    this.still.setAttribute("position", position);
    this.still.setIndex(new BufferAttribute(geometry.outline, 1));
    const zero = new BufferAttribute(new Float32Array(count), 1);
    this.still.setAttribute("ux", zero);
    this.still.setAttribute("uy", zero);
    const nodes = shared(geometry.nodes);
    this.parts = {
      undeformed: this.add(new LineSegments(this.still, this.material("faint", 0.55)), 0.5),
      mesh: this.add(new LineSegments(shared(geometry.mesh), this.material("line", 0.22)), 2),
      elements: this.add(new LineSegments(shared(geometry.elements), this.material("line", 0.75)), 3),
      nodes: this.add(new Points(nodes, this.material("line", 1, 3.5 * this.ratio)), 4),
    };
    this.sides = this.wideSides(rigidSides(geometry));
  }

  private add<T extends Mesh | LineSegments | Points>(part: T, order: number): T {
    part.frustumCulled = false;
    part.geometry.boundingSphere = new Sphere(); // for three's sorting; points in the plane have none that it could compute
    part.renderOrder = order;
    this.scene.add(part);
    return part;
  }

  private material(colour: string, opacity: number, size = 1): ShaderMaterial {
    return new ShaderMaterial({
      vertexShader: plain.vertex, fragmentShader: plain.fragment, depthTest: false, depthWrite: false, transparent: true, side: 2,
      uniforms: { ...this.place, colour: this.colours[colour], opacity: { value: opacity }, size: { value: size } },
    });
  }

  /** Outlines of all bodies. */
  private wideSides(ends: Uint32Array): { ends: Uint32Array; geometry: InstancedBufferGeometry } {
    const made = new InstancedBufferGeometry();
    made.setAttribute("position", new BufferAttribute(new Float32Array([0, -0.5, 0, 1, -0.5, 0, 1, 0.5, 0, 0, 0.5, 0]), 3));
    made.setIndex([0, 1, 2, 0, 2, 3]);
    const count = ends.length / 2;
    for (const name of ["from", "to", "from_moved", "to_moved"]) made.setAttribute(name, new InstancedBufferAttribute(new Float32Array(2 * count), 2));
    made.instanceCount = count;
    const from = made.getAttribute("from"), to = made.getAttribute("to"), { points } = this.geometry;
    for (let i = 0; i < count; ++i) {
      from.setXY(i, points[2 * ends[2 * i]], points[2 * ends[2 * i] + 1]);
      to.setXY(i, points[2 * ends[2 * i + 1]], points[2 * ends[2 * i + 1] + 1]);
    }
    const material = new ShaderMaterial({
      vertexShader: side.vertex, fragmentShader: side.fragment, depthTest: false, depthWrite: false, transparent: true, side: 2,
      uniforms: { ...this.place, pixel: this.pixel, width: { value: 1.4 * this.ratio }, colour: this.colours.line, opacity: { value: 1 } },
    });
    this.add(new Mesh(made, material), 5);
    return { ends, geometry: made };
  }

  /** Marks of contact pairs, at points of the fields (plus 1) or, where a side is rigid, at their own place. */
  setPairs(x: Float32Array, y: Float32Array): void {
    const made = new BufferGeometry(), at = new Float32Array(3 * x.length);
    for (let i = 0; i < x.length; ++i) at.set([x[i], y[i], 0], 3 * i);
    made.setAttribute("position", new BufferAttribute(at, 3));
    for (const name of ["ux", "uy", "state"]) made.setAttribute(name, new BufferAttribute(new Float32Array(x.length), 1));
    const { open, stick, slip, paper } = this.colours;
    const points = new Points(made, new ShaderMaterial({
      vertexShader: mark.vertex, fragmentShader: mark.fragment, depthTest: false, depthWrite: false, transparent: true,
      uniforms: { ...this.place, size: { value: (x.length > 400 ? 8 : 11) * this.ratio }, open, stick, slip, paper },
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
    this.parts.elements.visible = what.elements;
    this.nodesWanted = what.elements;
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
    this.parts.nodes.visible = this.nodesWanted && camera.size * camera.scale > NODES_APART * Math.sqrt(this.geometry.nodes.length);
    const start = performance.now();
    this.renderer.render(this.scene, NO_CAMERA);
    if (!this.measures) return;
    const gl = this.renderer.getContext();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4)); // waits until all is drawn
    this.cost = performance.now() - start;
  }
}

const NO_CAMERA = new ThreeCamera(); // shaders place points themselves

function texture(signed: boolean): DataTexture {
  const made = new DataTexture(colourMap(signed), ENTRIES, 1);
  made.magFilter = made.minFilter = NearestFilter;
  made.needsUpdate = true;
  return made;
}

function rigidTriangles({ points, rigid, rigidSizes }: Geometry): number[] {
  const corners: number[] = [];
  let at = 0;
  for (const size of rigidSizes) {
    const ring = rigid.subarray(at, at + size);
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
