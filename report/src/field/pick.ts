// Which triangle is at a place of the deformed shape, and values inside it.
import type { Line, Picked } from "../state";
import { HIDDEN } from "./scene";

export class Shape {
  private x: Float32Array;
  private y: Float32Array;
  private depths: Float32Array | null = null; // of all points: the body with the smallest one is above the others

  private readonly slack: number; // coordinates are rounded to seven digits

  constructor(private readonly points: Float32Array, private readonly triangles: Uint32Array, private readonly bodies: Uint32Array) {
    this.slack = 4e-7 * points.reduce((largest, value) => Math.max(largest, Math.abs(value)), 0);
    this.x = new Float32Array(points.length / 2);
    this.y = new Float32Array(points.length / 2);
  }

  move(ux: Float32Array | null, uy: Float32Array | null, magnification: number): void {
    const { x, y, points } = this;
    for (let i = 0; i < x.length; ++i) {
      x[i] = points[2 * i] + (ux ? magnification * ux[i] : 0);
      y[i] = points[2 * i + 1] + (uy ? magnification * uy[i] : 0);
    }
  }

  /** Which bodies are hidden, and which are above which. */
  order(depths: Float32Array): void {
    this.depths = depths;
  }

  at(point: number): [number, number] {
    return [this.x[point], this.y[point]];
  }

  /** The triangle that is seen at a place, with the weights of its corners; null outside. A place on an edge counts, up to the rounding of coordinates. */
  pick(px: number, py: number): Picked | null {
    const { x, y, triangles, slack } = this;
    const left = px - slack, right = px + slack, below = py - slack, above = py + slack;
    let found: Picked | null = null, least = HIDDEN;
    for (let t = triangles.length - 3; t >= 0; t -= 3) {
      const a = triangles[t], b = triangles[t + 1], c = triangles[t + 2];
      const ax = x[a], bx = x[b], cx = x[c];
      if ((ax < left && bx < left && cx < left) || (ax > right && bx > right && cx > right)) continue;
      const ay = y[a], by = y[b], cy = y[c];
      if ((ay < below && by < below && cy < below) || (ay > above && by > above && cy > above)) continue;
      const depth = this.depths ? this.depths[a] : 0;
      if (depth >= least) continue;
      const weights = this.weightsAt(t, px, py);
      if (weights) [found, least] = [{ triangle: t, weights }, depth];
    }
    return found;
  }

  /** Weights of the corners of the triangle that begins at `t`; null where the place lies outside it. */
  private weightsAt(t: number, px: number, py: number): [number, number, number] | null {
    const { x, y, triangles, slack } = this, a = triangles[t], b = triangles[t + 1], c = triangles[t + 2];
    const ax = x[a], bx = x[b], cx = x[c], ay = y[a], by = y[b], cy = y[c];
    const area = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay);
    if (area === 0) return null;
    const second = ((px - ax) * (cy - ay) - (cx - ax) * (py - ay)) / area, third = ((bx - ax) * (py - ay) - (px - ax) * (by - ay)) / area;
    const first = 1 - second - third;
    const outside = -Math.min(first, second, third); // by how much of a height, the smallest of which is area over the longest side
    if (outside > 0 && outside * Math.abs(area) > slack * Math.max(Math.hypot(bx - ax, by - ay), Math.hypot(cx - ax, cy - ay), Math.hypot(cx - bx, cy - by))) return null;
    return [first, second, third];
  }

  /** What is seen at `count` + 1 places at equal distances of a line of the undeformed shape; null outside all bodies. */
  along({ from, to }: Line, count: number): (Picked | null)[] {
    const found: (Picked | null)[] = new Array(count + 1).fill(null), least = new Float32Array(count + 1).fill(HIDDEN);
    const still = this.still(), { x, y } = still, { triangles, slack } = this;
    const across = to[0] - from[0], up = to[1] - from[1], length = Math.hypot(across, up);
    if (!(length > 0)) return found;
    for (let t = 0; t < triangles.length; t += 3) {
      let low = Infinity, high = -Infinity, left = Infinity, right = -Infinity; // of the corners, along the line and across it
      for (let k = 0; k < 3; ++k) {
        const dx = x[triangles[t + k]] - from[0], dy = y[triangles[t + k]] - from[1];
        const part = (dx * across + dy * up) / length, side = (dx * up - dy * across) / length;
        [low, high, left, right] = [Math.min(low, part), Math.max(high, part), Math.min(left, side), Math.max(right, side)];
      }
      if (left > slack || right < -slack || high < -slack || low > length + slack) continue;
      const depth = this.depths ? this.depths[triangles[t]] : 0;
      const last = Math.min(count, Math.floor(((high + slack) / length) * count));
      for (let i = Math.max(0, Math.ceil(((low - slack) / length) * count)); i <= last; ++i) {
        if (depth >= least[i]) continue;
        const weights = still.weightsAt(t, from[0] + (across * i) / count, from[1] + (up * i) / count);
        if (weights) [found[i], least[i]] = [{ triangle: t, weights }, depth];
      }
    }
    return found;
  }

  /** The points with the smallest and the largest of the values that are seen; null where there are none. */
  extremes(values: Float32Array): { least: number; greatest: number } | null {
    let least = -1, greatest = -1;
    for (const point of this.triangles) {
      const value = values[point];
      if (!Number.isFinite(value) || (this.depths && this.depths[point] === HIDDEN)) continue;
      if (least < 0 || value < values[least]) least = point;
      if (greatest < 0 || value > values[greatest]) greatest = point;
    }
    return least < 0 ? null : { least, greatest };
  }

  /** A point as a place in one of its triangles. */
  pickPoint(point: number): Picked | null {
    const at = this.triangles.indexOf(point);
    if (at < 0) return null;
    const weights: [number, number, number] = [0, 0, 0];
    weights[at % 3] = 1;
    return { triangle: at - (at % 3), weights };
  }

  /** Interpolated linearly between the corners. */
  value(picked: Picked, values: Float32Array): number {
    const { triangles } = this, t = picked.triangle;
    return picked.weights.reduce((sum, weight, k) => (weight === 0 ? sum : sum + weight * values[triangles[t + k]]), 0);
  }

  /** Where the point lies: in the deformed shape, and in the undeformed one. */
  place(picked: Picked): { deformed: [number, number]; undeformed: [number, number] } {
    const sum = (get: (point: number) => number) =>
      picked.weights.reduce((total, weight, k) => total + weight * get(this.triangles[picked.triangle + k]), 0);
    return {
      deformed: [sum((p) => this.x[p]), sum((p) => this.y[p])],
      undeformed: [sum((p) => this.points[2 * p]), sum((p) => this.points[2 * p + 1])],
    };
  }

  /** The triangle at a place of the undeformed shape. */
  pickUndeformed(px: number, py: number): Picked | null {
    return this.still().pick(px, py);
  }

  private still(): Shape {
    const still = new Shape(this.points, this.triangles, this.bodies);
    still.move(null, null, 0);
    still.depths = this.depths;
    return still;
  }

  /** Number of the body, from 1. */
  body(picked: Picked): number {
    return this.bodies[this.triangles[picked.triangle]];
  }
}
