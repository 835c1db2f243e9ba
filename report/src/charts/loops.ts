// Two quantities against each other, in the order of the increments: load against displacement, hysteresis.
import { element, labelled, section, select, svg } from "../dom";
import type { Dimension, Series } from "../content";
import type { State } from "../state";
import { number, type Scale } from "../units";

interface Quantity {
  name: string;
  dimension: Dimension;
  values: Series; // one for each increment
}

const WIDTH = 560, HEIGHT = 300, LEFT = 66, RIGHT = 12, TOP = 10, BOTTOM = 44;
const MOST_POINTS = 400; // with a mark of their own

export class LoopPanel {
  readonly root: HTMLElement;
  private readonly picture = svg("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, class: "loop", role: "img" });
  private x: number;
  private y: number;
  private places: ([number, number] | null)[] = [];

  private constructor(private readonly state: State, private readonly quantities: Quantity[]) {
    [this.x, this.y] = firstPair(quantities);
    const options = quantities.map(({ name }, k): [string, string] => [String(k), name]);
    const across = select("loop-x", options, String(this.x), (k) => { this.x = Number(k); this.show(); });
    const up = select("loop-y", options, String(this.y), (k) => { this.y = Number(k); this.show(); });
    this.root = section("loops", "Against each other", element("div", { class: "controls" }, labelled("Up", up), labelled("Across", across)),
      element("div", { class: "chart" }, this.picture), element("p", { class: "note" }, "From increment to increment; the ring is the one that is shown. Click near a point to show its increment."));
    this.picture.addEventListener("click", (event) => this.press(event as MouseEvent));
    state.on(["units", "increment"], () => this.show());
    this.show();
  }

  /** Null where there is nothing to compare. */
  static of(state: State): LoopPanel | null {
    const quantities = quantitiesOf(state);
    return quantities.length > 1 && state.content.increments.length > 2 ? new LoopPanel(state, quantities) : null;
  }

  private show(): void {
    const [across, up] = [this.quantities[this.x], this.quantities[this.y]], { shown } = this.state;
    const [scaleX, scaleY] = [this.scaled(across), this.scaled(up)];
    const xs = across.values.map((value) => (value === null ? null : value * scaleX.factor)), ys = up.values.map((value) => (value === null ? null : value * scaleY.factor));
    const [lowX, highX] = span(xs), [lowY, highY] = span(ys);
    const toX = (value: number) => LEFT + ((value - lowX) / (highX - lowX)) * (WIDTH - LEFT - RIGHT), toY = (value: number) => HEIGHT - BOTTOM - ((value - lowY) / (highY - lowY)) * (HEIGHT - TOP - BOTTOM);
    this.places = xs.map((x, k) => (x === null || ys[k] === null ? null : [toX(x), toY(ys[k])]));
    const parts: SVGElement[] = [];
    for (const value of ticks(lowX, highX)) parts.push(line(toX(value), TOP, toX(value), HEIGHT - BOTTOM), text(toX(value), HEIGHT - BOTTOM + 16, "middle", number(value, 5)));
    for (const value of ticks(lowY, highY)) parts.push(line(LEFT, toY(value), WIDTH - RIGHT, toY(value)), text(LEFT - 6, toY(value) + 4, "end", number(value, 5)));
    parts.push(text((LEFT + WIDTH - RIGHT) / 2, HEIGHT - 8, "middle", named(across, scaleX)));
    const upwards = text(14, (TOP + HEIGHT - BOTTOM) / 2, "middle", named(up, scaleY));
    upwards.setAttribute("transform", `rotate(-90 14 ${(TOP + HEIGHT - BOTTOM) / 2})`);
    parts.push(upwards);
    let pen = "M"; // lifted where a value is missing
    const path = this.places.map((place) => {
      if (!place) pen = "M";
      const part = place ? `${pen}${place[0].toFixed(2)} ${place[1].toFixed(2)}` : "";
      if (place) pen = "L";
      return part;
    }).join("");
    parts.push(svg("path", { d: path, class: "loop-curve" }));
    this.places.forEach((place, k) => {
      if (place && this.places.length <= MOST_POINTS) parts.push(svg("circle", { cx: place[0].toFixed(2), cy: place[1].toFixed(2), r: 2.5, class: "loop-point", "data-x": xs[k], "data-y": ys[k] }));
    });
    const now = this.places[shown.increment - 1];
    if (now) parts.push(svg("circle", { cx: now[0].toFixed(2), cy: now[1].toFixed(2), r: 7, class: "loop-now", "data-x": xs[shown.increment - 1], "data-y": ys[shown.increment - 1] }));
    this.picture.setAttribute("aria-label", `${up.name} against ${across.name}`);
    this.picture.replaceChildren(...parts);
  }

  private scaled(quantity: Quantity): Scale {
    const largest = Math.max(0, ...quantity.values.map((value) => Math.abs(value ?? 0)));
    return quantity.dimension === "number" ? { factor: 1, unit: "" } : this.state.shown.units.scale(quantity.dimension, largest);
  }

  private press(event: MouseEvent): void {
    const box = this.picture.getBoundingClientRect(), size = WIDTH / box.width;
    const at = [(event.clientX - box.left) * size, (event.clientY - box.top) * size];
    let nearest = -1, least = Infinity;
    this.places.forEach((place, k) => {
      const distance = place ? Math.hypot(place[0] - at[0], place[1] - at[1]) : Infinity;
      if (distance < least) [nearest, least] = [k, distance];
    });
    if (nearest >= 0) this.state.set({ increment: nearest + 1 });
  }
}

/** Load factors, total forces of contacts, reactions, and the quantities of `output.history`. */
function quantitiesOf({ content }: State): Quantity[] {
  const rows = content.increments, { totals, reactions, history } = content, quantities: Quantity[] = [];
  for (const column of history?.columns ?? []) {
    const at = new Map(history!.time.map((time, k) => [time, column.values[k]]));
    quantities.push({ name: column.name, dimension: "number", values: rows.map((row) => at.get(row.time) ?? null) });
  }
  for (const name of Object.keys(rows[rows.length - 1]?.factors ?? {})) quantities.push({ name: `factor of ${name}`, dimension: "number", values: rows.map((row) => row.factors[name] ?? null) });
  for (const contact of totals.contacts.filter(({ name }) => totals.curves.includes(name))) {
    quantities.push({ name: `${contact.name}, tangential force`, dimension: "force", values: contact.tangential_force });
    quantities.push({ name: `${contact.name}, normal force`, dimension: "force", values: contact.normal_force });
  }
  for (const support of reactions.supports.filter(({ name }) => reactions.curves.includes(name))) for (const part of ["x", "y", ...(content.space ? ["z"] as const : [])] as const) quantities.push({ name: `${support.name}, reaction ${part}`, dimension: "force", values: support[part]! });
  return quantities.filter(({ values }) => values.some((value) => value !== null));
}

/** The first force over the first other quantity. */
function firstPair(quantities: Quantity[]): [x: number, y: number] {
  const force = quantities.findIndex(({ dimension }) => dimension === "force"), y = force < 0 ? 1 : force;
  return [quantities.findIndex((_, k) => k !== y), y];
}

function named({ name }: Quantity, { unit }: Scale): string {
  return unit ? `${name} (${unit})` : name;
}

function span(values: Series): [number, number] {
  const known = values.filter((value): value is number => value !== null && Number.isFinite(value));
  let [low, high] = [Math.min(0, ...known), Math.max(0, ...known)];
  if (high - low <= 0) [low, high] = [-1, 1];
  const room = 0.06 * (high - low);
  return [low - room, high + room];
}

/** Round values, about five of them. */
function ticks(low: number, high: number): number[] {
  const rough = (high - low) / 5, power = 10 ** Math.floor(Math.log10(rough)), step = power * ([1, 2, 5].find((part) => part * power >= rough) ?? 10);
  const found: number[] = [];
  for (let k = Math.ceil(low / step); k * step <= high; ++k) found.push(k === 0 ? 0 : Number((k * step).toPrecision(12)));
  return found;
}

function line(x1: number, y1: number, x2: number, y2: number): SVGElement {
  return svg("line", { x1, y1, x2, y2, class: "loop-grid" });
}

function text(x: number, y: number, anchor: string, words: string): SVGElement {
  const made = svg("text", { x, y, "text-anchor": anchor, class: "loop-text" });
  made.textContent = words;
  return made;
}
