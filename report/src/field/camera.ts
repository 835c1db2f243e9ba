// Which part of the plane is seen: its middle, relative to the centre of the model, and pixels per length.

export class Camera {
  x = 0;
  y = 0;
  scale = 1; // CSS pixels per length
  width = 1;
  height = 1;

  constructor(private readonly low: [number, number], private readonly high: [number, number]) {}

  /** All of the model, with `edge` pixels around it. */
  reset(edge = 28): void {
    const across = Math.max(this.high[0] - this.low[0], 1e-300), up = Math.max(this.high[1] - this.low[1], 1e-300);
    this.x = 0.5 * (this.low[0] + this.high[0]);
    this.y = 0.5 * (this.low[1] + this.high[1]);
    this.scale = Math.min((this.width - 2 * edge) / across, (this.height - 2 * edge) / up);
    if (!(this.scale > 0) || !Number.isFinite(this.scale)) this.scale = 1;
  }

  get size(): number {
    return Math.hypot(this.high[0] - this.low[0], this.high[1] - this.low[1]) || 1;
  }

  toPixel(x: number, y: number): [number, number] {
    return [0.5 * this.width + (x - this.x) * this.scale, 0.5 * this.height - (y - this.y) * this.scale];
  }

  toPlane(px: number, py: number): [number, number] {
    return [this.x + (px - 0.5 * this.width) / this.scale, this.y - (py - 0.5 * this.height) / this.scale];
  }

  pan(px: number, py: number): void {
    this.x -= px / this.scale;
    this.y += py / this.scale;
    this.hold();
  }

  /** The point under the pixel stays where it is. */
  zoom(factor: number, px = 0.5 * this.width, py = 0.5 * this.height): void {
    const [x, y] = this.toPlane(px, py);
    const least = (0.2 * Math.min(this.width, this.height)) / this.size;
    this.scale = Math.min(Math.max(this.scale * factor, least), 1e6 * least);
    const [nx, ny] = this.toPlane(px, py);
    this.x += x - nx;
    this.y += y - ny;
    this.hold();
  }

  /** The model does not get lost. */
  private hold(): void {
    const beyond = [0.5 * (this.high[0] - this.low[0]), 0.5 * (this.high[1] - this.low[1])];
    this.x = Math.min(Math.max(this.x, this.low[0] - beyond[0]), this.high[0] + beyond[0]);
    this.y = Math.min(Math.max(this.y, this.low[1] - beyond[1]), this.high[1] + beyond[1]);
  }
}
