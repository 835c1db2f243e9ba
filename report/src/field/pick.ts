// Which triangle is at a place of the deformed shape, and values inside it.
import type { Picked } from "../state";

export class Shape {
  private x: Float32Array;
  private y: Float32Array;

  private readonly slack: number; // coordinates are rounded to seven digits

  constructor(private readonly points: Float32Array, private readonly triangles: Uint32Array) {
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

  at(point: number): [number, number] {
    return [this.x[point], this.y[point]];
  }

  /** The triangle drawn last at a place, with the weights of its corners; null outside. A place on an edge counts, up to the rounding of coordinates. */
  pick(px: number, py: number): Picked | null {
    const { x, y, triangles, slack } = this;
    const left = px - slack, right = px + slack, below = py - slack, above = py + slack;
    for (let t = triangles.length - 3; t >= 0; t -= 3) {
      const a = triangles[t], b = triangles[t + 1], c = triangles[t + 2];
      const ax = x[a], bx = x[b], cx = x[c];
      if ((ax < left && bx < left && cx < left) || (ax > right && bx > right && cx > right)) continue;
      const ay = y[a], by = y[b], cy = y[c];
      if ((ay < below && by < below && cy < below) || (ay > above && by > above && cy > above)) continue;
      const area = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay);
      if (area === 0) continue;
      const second = ((px - ax) * (cy - ay) - (cx - ax) * (py - ay)) / area, third = ((bx - ax) * (py - ay) - (px - ax) * (by - ay)) / area;
      const first = 1 - second - third;
      const outside = -Math.min(first, second, third); // by how much of a height, the smallest of which is area over the longest side
      if (outside > 0 && outside * Math.abs(area) > slack * Math.max(Math.hypot(bx - ax, by - ay), Math.hypot(cx - ax, cy - ay), Math.hypot(cx - bx, cy - by))) continue;
      return { triangle: t, weights: [first, second, third] };
    }
    return null;
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
    const still = new Shape(this.points, this.triangles);
    still.move(null, null, 0);
    return still.pick(px, py);
  }

  corner(picked: Picked): number {
    return this.triangles[picked.triangle];
  }
}
