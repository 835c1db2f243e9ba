// Pressure, shear, gap and slip along a contact, with the state of every pair. A pair lights up here and in the field together.
import type uPlot from "uplot";
import { bytes, floats, whole } from "../arrays";
import { button, checkbox, css, element, labelled, section } from "../dom";
import { fileName, saveCsv } from "../files";
import type { Dimension } from "../content";
import type { State } from "../state";
import { counted } from "../units";
import { Chart } from "./chart";

const CURVES: { key: string; name: string; dimension: Dimension }[] = [
  { key: "pressure", name: "pressure", dimension: "stress" }, { key: "shear", name: "shear", dimension: "stress" },
  { key: "gap", name: "gap", dimension: "length" }, { key: "slip", name: "slip", dimension: "length" },
];
const STATES = ["open", "stick", "slip"];
const MOST_MARKS = 70;
const SMALL = 0.1; // part of a contact that touches, below which it is shown alone at first

export class ContactPanel {
  readonly root: HTMLElement;
  private readonly charts: Chart[];
  private readonly starts: number[] = [];
  private readonly pairSlider = element("input", { type: "range", id: "pair", min: 0, step: 1, value: 0, "aria-label": "Pair, from the start of the contact; 0: none" });
  private readonly values = element("dl", { class: "values small", "aria-live": "polite", id: "pair-values" });
  private readonly legend = element("p", { class: "legend" });
  private readonly note = element("p", { class: "note" });
  private readonly chooser = element("select", { id: "contact" });
  private readonly onlyPart = checkbox("Only the part in contact", true, () => void this.load(), "only-part");
  private states: Uint8Array = new Uint8Array();
  private numbers: Uint32Array = new Uint32Array();
  private arrays: Record<string, Float32Array> = {};
  private along: Float32Array = new Float32Array();
  private shownIncrement = 0;
  private request = 0;

  constructor(private readonly state: State) {
    const pairs = state.content.pairs!;
    let at = 0;
    for (const size of pairs.sizes) {
      this.starts.push(at);
      at += size;
    }
    this.charts = CURVES.map((curve) => new Chart({
      height: 128, x: "", y: curve.name, above: true, zero: true, sync: "pairs", label: `${curve.name} along the contact`,
      hover: (index) => state.set({ pair: index === null ? -1 : this.start + index }), draw: (plot) => this.mark(plot),
    }));
    pairs.names.forEach((name, k) => this.chooser.append(element("option", { value: k, selected: k === state.shown.contact }, name)));
    this.chooser.addEventListener("change", () => state.set({ contact: Number(this.chooser.value), pair: -1 }));
    this.pairSlider.addEventListener("input", () => state.set({ pair: Number(this.pairSlider.value) === 0 ? -1 : this.start + Number(this.pairSlider.value) - 1 }));
    this.root = section("contacts", "Contact", element("div", { class: "controls" }, pairs.names.length > 1 && labelled("Contact", this.chooser), labelled("Pair", this.pairSlider, "control grow"), this.onlyPart,
      button("CSV", () => this.save(), { id: "pairs-csv", title: "The pairs of this contact at this increment as a table" })),
      this.legend, element("div", { class: "stack" }, ...this.charts.map((chart) => chart.root)), this.values, this.note);
    state.on(["increment", "contact", "units"], () => void this.load());
    state.on(["pair"], () => this.light());
    state.on(["dark"], () => this.charts.forEach((chart) => chart.build()));
  }

  private get start(): number {
    return this.starts[this.state.shown.contact];
  }

  private get size(): number {
    return this.state.content.pairs!.sizes[this.state.shown.contact];
  }

  async load(): Promise<void> {
    const { content, shown } = this.state, request = ++this.request, increment = this.state.available(content.pairs!.increments);
    const [distance, numbers, states, ...values] = await Promise.all([
      floats("pair_distance"), whole("pair_number"), bytes(`state_${increment}`),
      ...[...CURVES.map((curve) => curve.key), "normal_force", "tangential_force"].map((key) => floats(`${key}_of_pairs_${increment}`)),
    ]);
    if (request !== this.request) return;
    const cut = <T extends Float32Array | Uint8Array | Uint32Array>(array: T) => array.subarray(this.start, this.start + this.size) as T;
    this.states = cut(states);
    this.along = cut(distance);
    this.shownIncrement = increment;
    this.numbers = cut(numbers);
    [...CURVES.map((curve) => curve.key), "normal_force", "tangential_force"].forEach((key, k) => (this.arrays[key] = cut(values[k])));
    const along = cut(distance), length = shown.units.scale("length", along[along.length - 1] ?? 0);
    this.chooser.value = String(shown.contact);
    this.pairSlider.max = String(this.size);
    const touching = [...this.states.keys()].filter((i) => this.states[i] !== 0), part = this.partOf(along, touching, length.factor);
    CURVES.forEach((curve, k) => {
      const array = this.arrays[curve.key], scale = shown.units.scale(curve.dimension, array.reduce((most, value) => Math.max(most, Math.abs(value)), 0));
      const last = k === CURVES.length - 1;
      this.charts[k].show(along.map((x) => x * length.factor), [{ name: curve.name, colour: "--curve", values: array.map((y) => y * scale.factor), points: false }],
        { part, x: last ? `distance along the contact${length.unit ? ` (${length.unit})` : ""}` : "", y: scale.unit ? `${curve.name} (${scale.unit})` : curve.name, height: last ? 150 : 128 });
    });
    const counts = STATES.map((_, kind) => this.states.filter((state) => state === kind).length);
    this.legend.replaceChildren(...[1, 2, 0].filter((kind) => counts[kind]).map((kind) => element("span", { class: `state ${STATES[kind]}` }, `${STATES[kind]} (${counted(counts[kind], "pair")})`)),
      element("span", { class: "soft" }, "forces on the second side; shear and slip positive along t"));
    const differs = increment !== shown.increment ? `The pairs of increment ${shown.increment} are not in this page: those of ${increment} are shown. ` : "";
    this.note.textContent = differs + content.pairs!.note;
    this.root.dataset.increment = String(increment);
    this.light();
  }

  /** The part of the contact that touches, with its surroundings; null where the whole is shown. */
  private partOf(along: Float32Array, touching: number[], factor: number): [number, number] | null {
    const whole = along[along.length - 1] ?? 0;
    if (!touching.length || !(whole > 0)) return null;
    const low = along[Math.max(touching[0] - 1, 0)], high = along[Math.min(touching[touching.length - 1] + 1, along.length - 1)];
    const few = high - low < SMALL * whole;
    this.onlyPart.hidden = !few;
    if (!few || !this.onlyPart.querySelector("input")!.checked) return null;
    const room = 0.35 * (high - low);
    return [Math.max(0, low - room) * factor, Math.min(whole, high + room) * factor];
  }

  /** Marks of the states along the curve; of many pairs some, the ends of each run of equal states among them. */
  private mark(plot: uPlot): void {
    const [xs, ys] = plot.data as [number[], number[]], { ctx } = plot, { min, max } = plot.scales.x;
    const seen = xs.flatMap((x, i) => (x >= min! && x <= max! ? [i] : []));
    const every = Math.ceil(seen.length / MOST_MARKS), changes = this.states.reduce((count, state, i) => count + Number(i > 0 && state !== this.states[i - 1]), 0);
    ctx.save();
    ctx.beginPath();
    ctx.rect(plot.bbox.left - 6, plot.bbox.top - 6, plot.bbox.width + 12, plot.bbox.height + 12);
    ctx.clip();
    for (const i of seen) {
      const state = this.states[i], border = changes <= MOST_MARKS && (state !== this.states[i - 1] || state !== this.states[i + 1]);
      if (i % every !== 0 && !border) continue;
      shape(ctx, state, plot.valToPos(xs[i], "x", true), plot.valToPos(ys[i], "y", true), 3.6 * devicePixelRatio);
    }
    ctx.restore();
  }

  private light(): void {
    const { shown, content } = this.state, { pair } = shown;
    if (pair >= 0 && (pair < this.start || pair >= this.start + this.size)) {
      let contact = this.starts.length - 1;
      while (this.starts[contact] > pair) --contact;
      this.state.set({ contact }); // its curves are loaded, and then the pair lights up
      return;
    }
    const index = pair < 0 ? null : pair - this.start;
    for (const chart of this.charts) chart.point(index);
    this.pairSlider.value = String(index === null ? 0 : index + 1);
    this.pairSlider.setAttribute("aria-valuetext", index === null ? "none" : `pair ${this.numbers[index] ?? index + 1}`);
    this.values.dataset.pair = String(pair);
    if (index === null || index >= this.states.length) {
      this.values.replaceChildren(element("div", { class: "value wide" }, element("dt", {}, "Point at a pair, in these curves or in the field"), element("dd", {}, "")));
      return;
    }
    const row = (name: string, text: string, key: string, value?: number) => element("div", { class: "value", "data-key": key, "data-value": value }, element("dt", {}, name), element("dd", {}, text));
    const force = (key: string) => shown.units.text("force", this.arrays[key][index], 5);
    this.values.replaceChildren(row(content.pairs!.names[shown.contact], `pair ${this.numbers[index]}`, "pair", this.numbers[index]), row("state", STATES[this.states[index]], "state"),
      ...CURVES.map((curve) => row(curve.name, shown.units.text(curve.dimension, this.arrays[curve.key][index], 5), curve.key, this.arrays[curve.key][index])),
      row("normal force", force("normal_force"), "normal_force", this.arrays.normal_force[index]), row("tangential force", force("tangential_force"), "tangential_force", this.arrays.tangential_force[index]));
  }

  private save(): void {
    const { content, shown } = this.state, keys = Object.keys(this.arrays);
    saveCsv(fileName(content.directory, content.pairs!.names[shown.contact], this.shownIncrement), ["pair", "distance", ...keys, "state"],
      [...this.along].map((distance, k) => [this.numbers[k], distance, ...keys.map((key) => this.arrays[key][k]), STATES[this.states[k]]]));
  }

  /** For tests. */
  get chart(): Chart {
    return this.charts[0];
  }
}

function shape(ctx: CanvasRenderingContext2D, state: number, x: number, y: number, r: number): void {
  const colour = css(`--${STATES[state]}`);
  ctx.beginPath();
  if (state === 0) ctx.rect(x - 0.85 * r, y - 0.85 * r, 1.7 * r, 1.7 * r);
  else if (state === 1) ctx.arc(x, y, r, 0, 2 * Math.PI);
  else {
    ctx.moveTo(x, y - 1.15 * r);
    ctx.lineTo(x + 1.1 * r, y + 0.85 * r);
    ctx.lineTo(x - 1.1 * r, y + 0.85 * r);
    ctx.closePath();
  }
  ctx.fillStyle = state === 0 ? css("--card") : colour;
  ctx.fill();
  ctx.strokeStyle = colour;
  ctx.lineWidth = 1.3 * devicePixelRatio;
  ctx.stroke();
}
