// The arrays of the fields: what is shown of one increment, and the values at a point of it.
import { floats, whole } from "../arrays";
import type { Content, Dimension, Range } from "../content";
import type { State } from "../state";
import { trianglesOf, type Geometry, type Mechanism } from "./scene";

export interface Quantity {
  key: string;
  name: string;
  dimension: Dimension;
}

export class FieldData {
  readonly quantities: Quantity[];

  constructor(readonly content: Content) {
    this.quantities = content.field!.quantities.slice();
    if (this.moves) this.quantities.splice(2, 0, { key: "displacement", name: "displacement", dimension: "length" });
    if (content.modal) this.quantities = this.quantities.map((entry) => ({ ...entry, name: `${entry.name} of the mode`, dimension: "number" }));
  }

  get moves(): boolean {
    return this.content.field!.quantities.some((quantity) => quantity.key === "ux");
  }

  async geometry(mesh: number): Promise<Geometry> {
    const name = (what: string) => `${what}_of_mesh_${mesh}`;
    const [points, triangles, outline, sides, elements, nodes, body, rigid, rigidSizes] = await Promise.all([
      floats(name("points")), whole(name("triangles")), whole(name("outline")), whole(name("mesh")), whole(name("elements")), whole(name("nodes")),
      whole(name("body")), whole(name("rigid")), whole(name("rigid_sizes")),
    ]);
    return { points, triangles, outline, mesh: sides, elements, nodes, body, rigid, rigidSizes };
  }

  meshOf(increment: number): number {
    return this.content.field!.mesh_of[String(increment)];
  }

  /** Null where the run has no mechanism. */
  async mechanism(): Promise<Mechanism | null> {
    if (!this.content.mechanism) return null;
    const [points, rings, sizes, sides, opens, slips, ux, uy] = await Promise.all([floats("mechanism_points"), whole("mechanism_rings"), whole("mechanism_sizes"),
      whole("mechanism_sides"), whole("mechanism_opens"), whole("mechanism_slips"), floats("mechanism_ux"), floats("mechanism_uy")]);
    return { points, triangles: new Uint32Array(trianglesOf(points, rings, sizes)), sides, opens, slips, ux, uy };
  }

  displacement(increment: number): Promise<[Float32Array | null, Float32Array | null]> {
    if (!this.moves) return Promise.resolve([null, null]);
    return Promise.all([floats(`ux_${increment}`), floats(`uy_${increment}`)]);
  }

  async values(key: string, increment: number): Promise<Float32Array> {
    if (key !== "displacement") return floats(`${key}_${increment}`);
    const [ux, uy] = await this.displacement(increment);
    const size = new Float32Array(ux!.length);
    for (let i = 0; i < size.length; ++i) size[i] = Math.hypot(ux![i], uy![i]);
    return size;
  }

  quantity(key: string): Quantity {
    return this.quantities.find((quantity) => quantity.key === key)!;
  }

  /** What colours span. */
  range(state: State, increment: number): [number, number] {
    const { ranges } = this.content.field!, { quantity, range } = state.shown;
    const of = (number: number): Range => ranges[String(number)][quantity] ?? [0, 0, 0, 0];
    if (range === "increment") return [of(increment)[0], of(increment)[1]];
    const first = range === "all" ? 0 : 2;
    const numbers = range === "all" ? this.content.field!.increments : [increment];
    return [Math.min(...numbers.map((n) => of(n)[first])), Math.max(...numbers.map((n) => of(n)[first + 1]))];
  }

  extremes(key: string, increment: number): Range {
    return this.content.field!.ranges[String(increment)][key] ?? [0, 0, 0, 0];
  }
}
