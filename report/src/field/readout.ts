// Values at the picked point, and the way to pick one by its coordinates.
import { button, element } from "../dom";
import type { State } from "../state";
import { number } from "../units";
import { hide, nameOf } from "./bodies";
import type { FieldData } from "./data";
import type { Shape } from "./pick";

export class Readout {
  readonly root = element("div", { class: "readout" });
  private readonly values = element("dl", { class: "values", "aria-live": "polite", id: "values" });
  private readonly where = element("p", { class: "where" });
  private readonly x = element("input", { type: "number", step: "any", id: "pick-x", "aria-label": "x of the point" });
  private readonly y = element("input", { type: "number", step: "any", id: "pick-y", "aria-label": "y of the point" });
  private request = 0;

  constructor(private readonly state: State, private readonly data: FieldData, pick: (x: number, y: number) => boolean) {
    const form = element("form", { class: "pick-form" }, element("span", { class: "label" }, "Read the values at"), element("label", {}, "x ", this.x),
      element("label", {}, "y ", this.y), element("button", { type: "submit" }, "Read"), button("Clear", () => state.set({ picked: null })));
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      const x = Number(this.x.value), y = Number(this.y.value);
      if (this.x.value === "" || this.y.value === "" || !pick(x, y)) {
        state.set({ picked: null });
        this.where.textContent = this.x.value === "" || this.y.value === "" ? "Give x and y in the units of the model."
          : `There is no elastic body at (${number(x, 6)}, ${number(y, 6)}).`;
      }
    });
    this.root.append(form, this.where, this.values);
  }

  async show(shape: Shape, increment: number): Promise<void> {
    const { picked, units } = this.state.shown, request = ++this.request;
    if (!picked) {
      this.values.replaceChildren();
      this.where.textContent = "Click on a body, or press Enter in the picture, to read the values there.";
      return;
    }
    const { quantities } = this.data;
    const arrays = await Promise.all(quantities.map(({ key }) => this.data.values(key, increment)));
    if (request !== this.request) return;
    const [cx, cy] = this.state.content.field!.centre, [x, y] = shape.place(picked).undeformed;
    const { low, high } = this.state.content.field!;
    const size = Math.hypot(high[0] - low[0], high[1] - low[1]), decimals = Math.max(0, Math.min(100, 6 - Math.floor(Math.log10(size))));
    this.x.value = String(Number((x + cx).toFixed(decimals))); // to 1e-6 of the model's size or so, however far from the origin it is
    this.y.value = String(Number((y + cy).toFixed(decimals)));
    const farthest = Math.max(...[...low, ...high].map(Math.abs)), length = units.scale("length", farthest);
    const digits = Math.min(15, 5 + Math.max(0, Math.floor(Math.log10(farthest / size))));
    const place = [x + cx, y + cy].map((value) => number(Math.abs(value) < 1e-7 * Math.abs(high[0] - low[0]) ? 0 : value * length.factor, digits)).join(", ");
    const body = shape.body(picked);
    this.where.textContent = `${nameOf(this.state, body)}, at (${place})${length.unit ? ` ${length.unit}` : ""} `
      + "of the undeformed shape. Values are interpolated linearly between the three nearest points of the results. ";
    if (this.state.shown.order.length > 1) this.where.append(button("Hide this body", () => hide(this.state, body, true), { class: "link", id: "hide-picked" }));
    this.values.replaceChildren(...quantities.map(({ key, name, dimension }, k) => {
      const value = shape.value(picked, arrays[k]);
      return element("div", { class: key === this.state.shown.quantity ? "value chosen" : "value", "data-key": key, "data-value": value },
        element("dt", {}, name), element("dd", {}, dimension === "number" ? number(value, 5) : units.text(dimension, value, 5)));
    }));
  }
}
