// Values along a line of the undeformed model.
import { Chart } from "../charts/chart";
import { button, element } from "../dom";
import { fileName, saveCsv } from "../files";
import type { State } from "../state";
import { nameOf } from "./bodies";
import type { FieldData } from "./data";
import type { Shape } from "./pick";

const PARTS = 240;

export class LinePanel {
  readonly root = element("div", { class: "line", id: "line" });
  private readonly ends = ["x1", "y1", "x2", "y2"].map((name) => element("input", { type: "number", step: "any", id: `line-${name}`, "aria-label": `${name} of the line` }));
  private readonly note = element("p", { class: "where" });
  private readonly chart: Chart;
  private readonly below: HTMLElement;
  private readonly pencil: HTMLButtonElement;
  private request = 0;
  private table: [head: string[], rows: (string | number | null)[][]] = [[], []];
  /** Of the deformed shape, for the picture. */
  places: [number, number][] = [];

  constructor(private readonly state: State, private readonly data: FieldData) {
    const { content } = state, [cx, cy] = content.field!.centre;
    this.chart = new Chart({ height: 170, x: "", y: "", above: true, label: "Values along the line", hover: (index) => this.point(index) });
    this.pencil = button("Draw a line", () => this.arm(this.pencil.getAttribute("aria-pressed") !== "true"), { id: "line-draw", "aria-pressed": "false",
      title: "Then drag in the picture; dragging with the Shift key does the same" });
    const form = element("form", { class: "pick-form" }, element("span", { class: "label" }, "Values along a line"), this.pencil, ...this.ends.map((end, k) =>
      element("label", {}, ["from x ", "y ", "to x ", "y "][k], end)), element("button", { type: "submit" }, "Read"), button("Clear", () => state.set({ line: null }), { id: "line-clear" }));
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      const [x1, y1, x2, y2] = this.ends.map((end) => (end.value === "" ? NaN : Number(end.value)));
      if (![x1, y1, x2, y2].every(Number.isFinite)) this.note.textContent = "Give both ends in the units of the model.";
      else state.set({ line: { from: [x1 - cx, y1 - cy], to: [x2 - cx, y2 - cy] } });
    });
    this.below = element("div", { hidden: true }, this.chart.root, element("div", { class: "buttons" }, button("CSV", () => this.save(), { id: "line-csv", title: "The values along the line as a table" })));
    this.root.append(form, this.note, this.below);
    state.on(["dark"], () => this.chart.build());
  }

  get drawing(): boolean {
    return this.pencil.getAttribute("aria-pressed") === "true";
  }

  arm(on: boolean): void {
    this.pencil.setAttribute("aria-pressed", String(on));
  }

  private point: (index: number | null) => void = () => {};

  async show(shape: Shape, increment: number): Promise<void> {
    const { line, units, quantity: key } = this.state.shown, request = ++this.request;
    this.below.hidden = !line;
    if (!line) {
      this.places = [];
      this.note.textContent = "";
      return;
    }
    const values = await this.data.values(key, increment);
    if (request !== this.request) return;
    const picked = shape.along(line, PARTS), quantity = this.data.quantity(key), [cx, cy] = this.state.content.field!.centre;
    const length = Math.hypot(line.to[0] - line.from[0], line.to[1] - line.from[1]);
    const at = picked.map((_, i) => [0, 1].map((k) => line.from[k] + ((line.to[k] - line.from[k]) * i) / PARTS) as [number, number]);
    const distances = at.map((_, i) => (length * i) / PARTS), read = picked.map((place) => (place ? shape.value(place, values) : null));
    const known = read.map((value) => (value !== null && Number.isFinite(value) ? value : null));
    this.places = picked.map((place, i) => (place ? shape.place(place).deformed : at[i]));
    this.point = (index) => this.state.set({ picked: index === null ? null : picked[index] });
    [line.from[0] + cx, line.from[1] + cy, line.to[0] + cx, line.to[1] + cy].forEach((value, k) => (this.ends[k].value = String(Number(value.toPrecision(7)))));
    const along = units.scale("length", length), scale = units.scale(quantity.dimension, known.reduce<number>((most, value) => Math.max(most, Math.abs(value ?? 0)), 0));
    this.chart.show(distances.map((x) => x * along.factor), [{ name: quantity.name, colour: "--c1", values: known.map((y) => (y === null ? null : y * scale.factor)), points: false }],
      { x: `distance along the line${along.unit ? ` (${along.unit})` : ""}`, y: scale.unit ? `${quantity.name} (${scale.unit})` : quantity.name });
    this.note.textContent = known.some((value) => value !== null) ? "" : "The line meets no elastic body that is shown.";
    this.table = [["distance", "x", "y", "body", key], picked.map((place, i) => [distances[i], at[i][0] + cx, at[i][1] + cy, place ? nameOf(this.state, shape.body(place)) : "", known[i]])];
  }

  private save(): void {
    const { content, shown } = this.state;
    saveCsv(fileName(content.directory, "line", shown.quantity, shown.increment), ...this.table);
  }
}
