// The arrays of the fields: what is shown of one increment, and the values at a point of it.
import { floats, has, whole } from "../arrays";
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
    if (has(`${key}_${increment}`)) return floats(`${key}_${increment}`);
    if (key !== "displacement") return this.derived(key, increment);
    const [ux, uy] = await this.displacement(increment);
    const size = new Float32Array(ux!.length);
    for (let i = 0; i < size.length; ++i) size[i] = Math.hypot(ux![i], uy![i]);
    return size;
  }

  /** Principal stresses, descending, and von Mises stress, from the stresses; those of one increment are kept. */
  private async derived(key: string, increment: number): Promise<Float32Array> {
    if (this.kept.increment !== increment) {
      const [xx, yy, xy, zz] = await Promise.all(["xx", "yy", "xy", "zz"].map((name) => floats(`${name}_${increment}`)));
      const [first, second, third, mises] = [0, 1, 2, 3].map(() => new Float32Array(xx.length));
      for (let i = 0; i < xx.length; ++i) {
        const middle = 0.5 * (xx[i] + yy[i]), radius = Math.hypot(0.5 * (xx[i] - yy[i]), xy[i]);
        const high = middle + radius, low = middle - radius, out = zz[i];
        first[i] = Math.max(high, out);
        third[i] = Math.min(low, out);
        second[i] = Math.max(low, Math.min(high, out));
        mises[i] = Math.sqrt(0.5 * ((high - low) ** 2 + (low - out) ** 2 + (out - high) ** 2));
      }
      this.kept = { increment, arrays: { principal_1: first, principal_2: second, principal_3: third, von_mises: mises } };
    }
    return this.kept.arrays[key];
  }

  private kept: { increment: number; arrays: Record<string, Float32Array> } = { increment: 0, arrays: {} };

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
