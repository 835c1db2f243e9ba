// Above the picture: the picked point, the lit-up pair, the length of the scale, and what is under the mouse.
import { element, svg } from "../dom";
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
  private readonly drawing = svg("svg", { class: "drawing" });

  constructor() {
    this.drawing.append(...this.rings, this.cross, this.middle);
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

  /** A round length of about a sixth of the width. */
  showScale(camera: Camera, units: Scale): void {
    const wanted = ((camera.width / 6) * units.factor) / camera.scale, power = 10 ** Math.floor(Math.log10(wanted));
    const length = power * (wanted / power >= 5 ? 5 : wanted / power >= 2 ? 2 : 1);
    this.scaleLine.style.width = `${((length / units.factor) * camera.scale).toFixed(1)}px`;
    this.scaleText.textContent = `${number(length, 3)} ${units.unit}`.trim();
  }
}
