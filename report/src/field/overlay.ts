// Above the picture: the picked point, the lit-up pair, the length of the scale, and what is under the mouse.
import { css, element, svg } from "../dom";
import { number, type Scale } from "../units";
import type { Camera } from "./camera";

export class Overlay {
  readonly root = element("div", { class: "overlay", "aria-hidden": "true" });
  readonly hint = element("div", { class: "hint" });
  private readonly cross = svg("path", { d: "M-9 0H-3M3 0H9M0 -9V-3M0 3V9", class: "cross" });
  private readonly rings = [svg("circle", { r: 8, class: "ring" }), svg("circle", { r: 8, class: "ring" })];
  private readonly middle = svg("path", { d: "M-7 0H7M0 -7V7", class: "middle" });
  private readonly scaleLine = element("div", { class: "scale-line" });
  private readonly scaleText = element("div", { class: "scale-text" });
  private readonly line = svg("polyline", { class: "probe" });
  private readonly extremes = [svg("path", { d: "M-6 -5H6L0 5Z", class: "extreme" }), svg("path", { d: "M-6 5H6L0 -5Z", class: "extreme" })];
  private readonly drawing = svg("svg", { class: "drawing" });

  constructor() {
    this.drawing.append(this.line, ...this.extremes, ...this.rings, this.cross, this.middle);
    this.root.append(this.drawing, element("div", { class: "scale" }, this.scaleText, this.scaleLine), this.hint);
  }

  private place(shape: SVGElement, at: [number, number] | null): void {
    shape.style.display = at ? "" : "none";
    if (at) shape.setAttribute("transform", `translate(${at[0].toFixed(1)} ${at[1].toFixed(1)})`);
  }

  show(camera: Camera, picked: [number, number] | null, pair: [number, number][], keyboard: boolean): void {
    const pixel = (point: [number, number] | null | undefined) => (point ? camera.toPixel(...point) : null);
    this.place(this.cross, pixel(picked));
    this.rings.forEach((ring, k) => this.place(ring, pixel(pair[k])));
    this.place(this.middle, keyboard ? [0.5 * camera.width, 0.5 * camera.height] : null);
  }

  /** Where the smallest and the largest value are, and the line along which values are read. */
  showPlaces(camera: Camera, extremes: [number, number][], line: [number, number][]): void {
    this.extremes.forEach((mark, k) => this.place(mark, extremes[k] ? camera.toPixel(...extremes[k]) : null));
    this.line.setAttribute("points", line.map((at) => camera.toPixel(...at).map((pixel) => pixel.toFixed(1)).join(",")).join(" "));
  }

  /** A round length of about a sixth of the width. */
  showScale(camera: Camera, units: Scale): void {
    const wanted = ((camera.width / 6) * units.factor) / camera.scale, power = 10 ** Math.floor(Math.log10(wanted));
    const length = power * (wanted / power >= 5 ? 5 : wanted / power >= 2 ? 2 : 1);
    this.scaleLine.style.width = `${((length / units.factor) * camera.scale).toFixed(1)}px`;
    this.scaleText.textContent = `${number(length, 3)} ${units.unit}`.trim();
  }

  /** The same on a picture of this height, `top` pixels lower. */
  draw(context: CanvasRenderingContext2D, top: number, height: number): void {
    const [line, ...marks] = [this.line, ...this.extremes, this.cross];
    const points = (line.getAttribute("points") ?? "").split(" ").filter(Boolean).map((point) => point.split(",").map(Number));
    context.lineWidth = 2;
    context.strokeStyle = css("--probe");
    context.beginPath();
    points.forEach(([x, y], k) => (k ? context.lineTo(x, y + top) : context.moveTo(x, y + top)));
    context.stroke();
    for (const mark of marks) {
      const at = /translate\((\S+) (\S+)\)/.exec(mark.style.display === "none" ? "" : mark.getAttribute("transform") ?? "");
      if (!at) continue;
      context.save();
      context.translate(Number(at[1]), Number(at[2]) + top);
      const path = new Path2D(mark.getAttribute("d")!);
      context.strokeStyle = "#000";
      context.fillStyle = "#fff";
      context.lineWidth = 1.2;
      if (mark !== this.cross) context.fill(path);
      context.stroke(path);
      context.restore();
    }
    const width = parseFloat(this.scaleLine.style.width);
    context.strokeStyle = context.fillStyle = css("--ink");
    context.lineWidth = 1.5;
    context.font = "13px system-ui, sans-serif";
    context.textAlign = "center";
    context.beginPath();
    context.moveTo(12, top + height - 16);
    context.lineTo(12, top + height - 10);
    context.lineTo(12 + width, top + height - 10);
    context.lineTo(12 + width, top + height - 16);
    context.stroke();
    context.fillText(this.scaleText.textContent ?? "", 12 + 0.5 * width, top + height - 18);
    context.textAlign = "left";
  }
}
