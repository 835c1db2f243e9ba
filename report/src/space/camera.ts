// From where bodies in space are seen, without perspective: two angles, the point in the middle of the picture, relative to the
// centre of the model, and pixels per length.

export type Vector = [number, number, number];

export class SpaceCamera {
  azimuth = -60; // degrees: from which side the eye looks, about z from x
  elevation = 25; // how high it is
  middle: Vector = [0, 0, 0];
  scale = 1;
  width = 1;
  height = 1;

  constructor(private readonly low: Vector, private readonly high: Vector) {}

  get size(): number {
    return Math.hypot(...this.low.map((value, k) => this.high[k] - value)) || 1;
  }

  /** Rows: to the right, upwards, and towards the eye. */
  axes(): [Vector, Vector, Vector] {
    const a = (this.azimuth * Math.PI) / 180, e = (this.elevation * Math.PI) / 180;
    return [[-Math.sin(a), Math.cos(a), 0], [-Math.sin(e) * Math.cos(a), -Math.sin(e) * Math.sin(a), Math.cos(e)],
      [Math.cos(e) * Math.cos(a), Math.cos(e) * Math.sin(a), Math.sin(e)]];
  }

  /** Pixels, and how near the eye. */
  toPixel(x: number, y: number, z: number, axes = this.axes()): Vector {
    const of = [x - this.middle[0], y - this.middle[1], z - this.middle[2]];
    const [right, up, near] = axes.map((axis) => axis[0] * of[0] + axis[1] * of[1] + axis[2] * of[2]);
    return [0.5 * this.width + right * this.scale, 0.5 * this.height - up * this.scale, near];
  }

  /** All of the model. */
  reset(edge = 28): void {
    this.middle = this.low.map((value, k) => 0.5 * (value + this.high[k])) as Vector;
    const half = this.high.map((value, k) => 0.5 * (value - this.low[k]));
    const [right, up] = this.axes().map((axis) => axis.reduce((sum, part, k) => sum + Math.abs(part) * half[k], 0));
    this.scale = Math.min((0.5 * this.width - edge) / Math.max(right, 1e-300), (0.5 * this.height - edge) / Math.max(up, 1e-300));
    if (!(this.scale > 0) || !Number.isFinite(this.scale)) this.scale = 1;
  }

  look(azimuth: number, elevation: number): void {
    this.azimuth = azimuth;
    this.elevation = elevation;
    this.reset();
  }

  rotate(px: number, py: number): void {
    this.azimuth -= 0.4 * px;
    this.elevation = Math.min(Math.max(this.elevation + 0.4 * py, -90), 90);
  }

  pan(px: number, py: number): void {
    const [right, up] = this.axes();
    for (let k = 0; k < 3; ++k) this.middle[k] += (-px * right[k] + py * up[k]) / this.scale;
  }

  /** The point under the pixel stays where it is. */
  zoom(factor: number, px = 0.5 * this.width, py = 0.5 * this.height): void {
    const least = (0.2 * Math.min(this.width, this.height)) / this.size, scale = Math.min(Math.max(this.scale * factor, least), 1e5 * least);
    const [right, up] = this.axes(), change = 1 / this.scale - 1 / scale;
    for (let k = 0; k < 3; ++k) this.middle[k] += ((px - 0.5 * this.width) * right[k] - (py - 0.5 * this.height) * up[k]) * change;
    this.scale = scale;
  }
}
