// Bodies in space by three.js: their surface, sharp edges and, where they are cut, the section, in the colours of their values.
import {
  BufferAttribute, BufferGeometry, Camera as ThreeCamera, Color, type DataTexture, LineSegments, Matrix3, Mesh, Scene, ShaderMaterial, Sphere, Vector2, Vector3, Vector4,
} from "three";
import type { Levels } from "../field/colours";
import { texture, type Drawer } from "../field/scene";
import type { Cut } from "./cut";
import type { SpaceCamera } from "./camera";

export interface Solids {
  points: Float32Array; // x, y, z of every point, relative to the centre of the model
  triangles: Uint32Array;
  edges: Uint32Array;
  body: Uint32Array; // of every point, from 1
  cells: Uint32Array; // corners of tetrahedra
  cellBody: Uint32Array;
}

const PLACE = `
uniform mat3 axes; uniform vec3 middle; uniform vec2 zoom; uniform float deep; uniform float magnification; uniform float lift; uniform vec4 plane;
attribute vec3 moved; attribute float there;
varying vec3 seen; varying float gone;
void place() {
  seen = axes * (position + magnification * moved - middle);
  gone = there < 0.5 ? 1.0 : dot(plane.xyz, position) - plane.w;
  gl_Position = vec4(seen.xy * zoom, -seen.z * deep - lift, 1.0);
}
`;
const FILL = {
  vertex: `${PLACE} attribute float value; varying float shown; void main() { shown = value; place(); }`,
  fragment: `
uniform sampler2D map; uniform vec2 range; uniform float bands; uniform vec3 none; varying float shown; varying vec3 seen; varying float gone;
void main() {
  if (gone > 0.0) discard;
  vec3 n = normalize(cross(dFdx(seen), dFdy(seen)));
  float light = 0.7 + 0.3 * abs(n.z);
  float part = (shown - range.x) / (range.y - range.x);
  float at = bands > 0.0 ? (floor(clamp(part, 0.0, 0.99999) * bands) + 0.5) / bands : clamp(part, 0.0, 1.0);
  vec3 colour = abs(shown) < 3e38 ? texture2D(map, vec2(at, 0.5)).rgb : none;
  gl_FragColor = vec4(colour * light, 1.0);
}`,
};
const LINE = {
  vertex: `${PLACE} void main() { place(); }`,
  fragment: `uniform vec3 colour; varying float gone; void main() { if (gone > 0.0) discard; gl_FragColor = vec4(colour, 1.0); }`,
};
const NO_CAMERA = new ThreeCamera(); // shaders place points themselves

export class SpaceScene {
  private readonly scene = new Scene();
  private readonly place = {
    axes: { value: new Matrix3() }, middle: { value: new Vector3() }, zoom: { value: new Vector2() }, deep: { value: 1 }, magnification: { value: 0 },
  };
  private readonly plane = { value: new Vector4(0, 0, 0, 1) };
  private readonly colours = { range: { value: new Vector2(0, 1) }, bands: { value: 10 }, map: { value: null as DataTexture | null }, none: { value: new Color() } };
  private readonly line = { value: new Color() };
  private readonly maps = { true: texture(true), false: texture(false) };
  private readonly moved: BufferAttribute;
  private readonly there: BufferAttribute;
  private readonly value: BufferAttribute;
  private readonly section = new BufferGeometry();

  constructor(private readonly drawer: Drawer, private readonly solids: Solids) {
    const count = solids.points.length / 3;
    this.moved = new BufferAttribute(new Float32Array(3 * count), 3);
    this.there = new BufferAttribute(new Float32Array(count).fill(1), 1);
    this.value = new BufferAttribute(new Float32Array(count), 1);
    const shared = (index: Uint32Array): BufferGeometry => {
      const made = new BufferGeometry();
      made.setAttribute("position", new BufferAttribute(solids.points, 3));
      for (const [name, attribute] of Object.entries({ moved: this.moved, there: this.there, value: this.value })) made.setAttribute(name, attribute);
      made.setIndex(new BufferAttribute(index, 1));
      return made;
    };
    const whole = { value: new Vector4(0, 0, 0, 1) };
    this.add(new Mesh(shared(solids.triangles), this.fill(this.plane)));
    this.add(new Mesh(this.section, this.fill(whole)));
    this.add(new LineSegments(shared(solids.edges), new ShaderMaterial({ vertexShader: LINE.vertex, fragmentShader: LINE.fragment,
      uniforms: { ...this.place, plane: this.plane, lift: { value: 1e-3 }, colour: this.line } })));
    this.setCut(null, null, null, null);
  }

  private fill(plane: { value: Vector4 }): ShaderMaterial {
    return new ShaderMaterial({ vertexShader: FILL.vertex, fragmentShader: FILL.fragment, side: 2,
      uniforms: { ...this.place, ...this.colours, plane, lift: { value: 0 } } });
  }

  private add(part: Mesh | LineSegments): void {
    part.frustumCulled = false;
    part.geometry.boundingSphere = new Sphere();
    this.scene.add(part);
  }

  setHidden(hidden: ReadonlySet<number>): void {
    const { body } = this.solids;
    for (let i = 0; i < body.length; ++i) this.there.setX(i, hidden.has(body[i]) ? 0 : 1);
    this.there.needsUpdate = true;
  }

  setMoved(moved: Float32Array): void {
    (this.moved.array as Float32Array).set(moved);
    this.moved.needsUpdate = true;
  }

  setValues(values: Float32Array): void {
    (this.value.array as Float32Array).set(values);
    this.value.needsUpdate = true;
  }

  setLevels(levels: Levels, bands: boolean): void {
    this.colours.map.value = levels.signed ? this.maps.true : this.maps.false;
    this.colours.range.value.set(levels.low, levels.high);
    this.colours.bands.value = bands ? levels.bands : 0;
  }

  /** What lies above the plane is taken away; null: nothing. */
  setCut(cut: Cut | null, plane: [number, number, number, number] | null, moved: Float32Array | null, values: Float32Array | null): void {
    this.plane.value.set(...(plane ?? [0, 0, 0, 1]));
    const count = cut?.part.length ?? 0, { points } = this.solids;
    const at = new Float32Array(3 * count), by = new Float32Array(3 * count), value = new Float32Array(count);
    for (let i = 0; i < count; ++i) {
      const a = cut!.a[i], b = cut!.b[i], t = cut!.part[i];
      for (let k = 0; k < 3; ++k) {
        at[3 * i + k] = (1 - t) * points[3 * a + k] + t * points[3 * b + k];
        by[3 * i + k] = moved ? (1 - t) * moved[3 * a + k] + t * moved[3 * b + k] : 0;
      }
      value[i] = values ? (1 - t) * values[a] + t * values[b] : 0;
    }
    this.section.setAttribute("position", new BufferAttribute(at, 3));
    this.section.setAttribute("moved", new BufferAttribute(by, 3));
    this.section.setAttribute("value", new BufferAttribute(value, 1));
    this.section.setAttribute("there", new BufferAttribute(new Float32Array(count).fill(1), 1));
    this.section.setDrawRange(0, count);
    this.section.boundingSphere = new Sphere();
  }

  setMagnification(value: number): void {
    this.place.magnification.value = value;
  }

  setTheme(line: string, none: string): void {
    const read = (colour: string) => [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16) / 255) as [number, number, number];
    this.line.value.setRGB(...read(line), "srgb-linear");
    this.colours.none.value.setRGB(...read(none), "srgb-linear");
  }

  resize(width: number, height: number): void {
    this.drawer.renderer.setSize(width, height, false);
  }

  draw(camera: SpaceCamera, reach: number): void {
    const [right, up, near] = camera.axes();
    this.place.axes.value.set(...right, ...up, ...near);
    this.place.middle.value.set(...camera.middle);
    this.place.zoom.value.set((2 * camera.scale) / camera.width, (2 * camera.scale) / camera.height);
    this.place.deep.value = 0.9 / (reach + Math.hypot(...camera.middle));
    this.drawer.renderer.render(this.scene, NO_CAMERA);
  }
}
