// Contact faces as maps beside the bodies: a value of the pairs, their states, and the values of the pair under the mouse.
import { bytes, floats, whole } from "../arrays";
import { css, element, labelled, section, select } from "../dom";
import { ColourBar } from "../field/bar";
import { colourMap, ENTRIES, levels } from "../field/colours";
import type { Dimension, Face } from "../content";
import type { State } from "../state";
import { number } from "../units";
import type { Vector } from "./camera";

const VALUES: [key: string, name: string, dimension: Dimension][] = [["pressure", "pressure", "stress"], ["shear", "shear stress", "stress"], ["gap", "gap", "length"], ["slip", "slip", "length"]];
const STATES = ["open", "stick", "slip"];
const EDGE = 30, NEAR = 14, MOST_MARKS = 600;

export class MapPanel {
  readonly root: HTMLElement;
  private readonly faces: Face[];
  private readonly canvas = element("canvas", { id: "face-map", role: "img", tabindex: 0, width: 10, height: 10 });
  private readonly bar = new ColourBar();
  private readonly counts = element("p", { class: "legend" });
  private readonly values = element("dl", { class: "values small", id: "pair-values", "aria-live": "polite" });
  private key = "pressure";
  private data: { places: Float32Array; corners: Uint32Array; points: Float32Array; states: Uint8Array; arrays: Record<string, Float32Array> } | null = null;
  private pixels: [number, number][] = [];
  private request = 0;

  constructor(private readonly state: State) {
    this.faces = state.content.space!.faces;
    const contacts = select("contact", this.faces.map(({ name }, k) => [String(k), name]), String(state.shown.contact), (k) => state.set({ contact: Number(k), pair: -1 }));
    const keys = select("face-value", VALUES.map(([key, name]) => [key, name]), this.key, (key) => { this.key = key; this.draw(); });
    this.root = section("contacts", "Contact faces", element("div", { class: "controls" }, labelled("Contact or tie", contacts), labelled("Show", keys)), this.counts,
      element("div", { class: "face" }, this.canvas), this.bar.root, this.values);
    this.canvas.addEventListener("pointermove", (event) => this.hover(event.offsetX, event.offsetY));
    this.canvas.addEventListener("pointerdown", (event) => this.hover(event.offsetX, event.offsetY));
    this.canvas.addEventListener("keydown", (event) => {
      const by = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key], count = this.pixels.length;
      if (!by || !count) return;
      event.preventDefault();
      state.set({ pair: (state.shown.pair + by + count) % count });
    });
    state.on(["increment", "contact"], () => void this.load());
    state.on(["units", "dark"], () => this.draw());
    state.on(["pair"], () => this.draw());
    new ResizeObserver(() => this.draw()).observe(this.root);
  }

  async load(): Promise<void> {
    const { contact } = this.state.shown, increment = this.state.available(this.state.content.space!.increments), request = ++this.request;
    const name = (what: string) => `face_${contact}_${what}`;
    const [places, corners, points, states, ...arrays] = await Promise.all([floats(name("places")), whole(name("corners")), floats(name("points")), bytes(name(`state_${increment}`)),
      ...VALUES.map(([key]) => floats(name(`${key}_${increment}`)))] as [Promise<Float32Array>, Promise<Uint32Array>, Promise<Float32Array>, Promise<Uint8Array>, ...Promise<Float32Array>[]]);
    if (request !== this.request) return;
    this.data = { places, corners, points, states, arrays: Object.fromEntries(VALUES.map(([key], k) => [key, arrays[k]])) };
    this.draw();
    this.root.dataset.increment = String(increment);
  }

  /** Where a pair of the shown contact is, relative to the centre of the model. */
  placeOf(pair: number): Vector | null {
    return this.data && pair >= 0 && 3 * pair < this.data.points.length ? [...this.data.points.subarray(3 * pair, 3 * pair + 3)] as Vector : null;
  }

  pixelOf(pair: number): [number, number] {
    return this.pixels[pair];
  }

  private hover(px: number, py: number): void {
    let best = NEAR, found = -1;
    this.pixels.forEach(([x, y], k) => {
      const distance = Math.hypot(x - px, y - py);
      if (distance < best) [best, found] = [distance, k];
    });
    this.state.set({ pair: found });
  }

  private draw(): void {
    if (!this.data) return;
    const { places, corners, states, arrays } = this.data, values = arrays[this.key], { units } = this.state.shown, face = this.faces[this.state.shown.contact];
    const [, name, dimension] = VALUES.find(([key]) => key === this.key)!;
    const low = [Infinity, Infinity], high = [-Infinity, -Infinity];
    places.forEach((value, i) => { low[i % 2] = Math.min(low[i % 2], value); high[i % 2] = Math.max(high[i % 2], value); });
    const width = Math.max(200, this.canvas.parentElement!.clientWidth || 400), span = [0, 1].map((k) => Math.max(high[k] - low[k], 1e-300));
    const height = Math.round(Math.min(440, Math.max(150, ((width - 2 * EDGE) * span[1]) / span[0] + 2 * EDGE)));
    const scale = Math.min((width - 2 * EDGE) / span[0], (height - 2 * EDGE) / span[1]);
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(height * ratio);
    this.canvas.style.height = `${height}px`;
    this.pixels = Array.from({ length: places.length / 2 }, (_, i) => [0.5 * width + (places[2 * i] - 0.5 * (low[0] + high[0])) * scale,
      0.5 * height - (places[2 * i + 1] - 0.5 * (low[1] + high[1])) * scale]);
    const shown = levels(values.length ? Math.min(...values) : 0, values.length ? Math.max(...values) : 0), map = colourMap(shown.signed);
    const context = this.canvas.getContext("2d")!, image = context.createImageData(this.canvas.width, this.canvas.height);
    for (let t = 0; t < corners.length; t += 3) this.fill(image, ratio, [corners[t], corners[t + 1], corners[t + 2]], values, (value) => {
      const part = (value - shown.low) / (shown.high - shown.low), at = (Math.floor(Math.min(Math.max(part, 0), 0.99999) * shown.bands) + 0.5) / shown.bands;
      return 4 * Math.round(at * (ENTRIES - 1));
    }, map);
    context.putImageData(image, 0, 0);
    context.scale(ratio, ratio);
    this.marks(context, states);
    this.axes(context, face, height);
    const counts = [0, 0, 0];
    states.forEach((state) => ++counts[state]);
    this.counts.replaceChildren(...[1, 2, 0].map((k) => element("span", { class: `state ${STATES[k]}` }, `${STATES[k]} ${counts[k]}`)));
    this.bar.show(name, units.scale(dimension, Math.max(Math.abs(shown.low), Math.abs(shown.high))), shown, true, false, false);
    this.canvas.setAttribute("aria-label", `Map of the ${name} on ${face.name}`);
    this.show();
  }

  /** A triangle, pixel by pixel. */
  private fill(image: ImageData, ratio: number, nodes: number[], values: Float32Array, entry: (value: number) => number, map: Uint8Array): void {
    const [a, b, c] = nodes.map((node) => this.pixels[node].map((value) => value * ratio)), area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    if (area === 0) return;
    const first = [0, 1].map((k) => Math.max(0, Math.floor(Math.min(a[k], b[k], c[k])))), last = [Math.max(a[0], b[0], c[0]), Math.max(a[1], b[1], c[1])].map(Math.ceil);
    for (let y = first[1]; y <= Math.min(last[1], image.height - 1); ++y)
      for (let x = first[0]; x <= Math.min(last[0], image.width - 1); ++x) {
        const u = ((b[0] - x) * (c[1] - y) - (b[1] - y) * (c[0] - x)) / area, v = ((c[0] - x) * (a[1] - y) - (c[1] - y) * (a[0] - x)) / area;
        if (u < 0 || v < 0 || u + v > 1) continue;
        const from = entry(u * values[nodes[0]] + v * values[nodes[1]] + (1 - u - v) * values[nodes[2]]), to = 4 * (y * image.width + x);
        for (let k = 0; k < 4; ++k) image.data[to + k] = map[from + k];
      }
  }

  private marks(context: CanvasRenderingContext2D, states: Uint8Array): void {
    const size = this.pixels.length > MOST_MARKS ? 1.2 : 3.2;
    context.strokeStyle = css("--card");
    this.pixels.forEach(([x, y], k) => {
      context.fillStyle = css(`--${STATES[states[k]]}`);
      context.beginPath();
      if (states[k] === 1) context.arc(x, y, size, 0, 2 * Math.PI);
      else if (states[k] === 2) { context.moveTo(x, y - 1.3 * size); context.lineTo(x + 1.2 * size, y + size); context.lineTo(x - 1.2 * size, y + size); context.closePath(); }
      else context.rect(x - size, y - size, 2 * size, 2 * size);
      context.fill();
      if (size > 2) context.stroke();
    });
    const lit = this.pixels[this.state.shown.pair];
    if (!lit) return;
    context.strokeStyle = "#ff2fb3";
    context.lineWidth = 3;
    context.beginPath();
    context.arc(lit[0], lit[1], 8, 0, 2 * Math.PI);
    context.stroke();
  }

  private axes(context: CanvasRenderingContext2D, face: Face, height: number): void {
    context.fillStyle = context.strokeStyle = css("--soft");
    context.lineWidth = 1;
    context.font = "12px system-ui, sans-serif";
    context.beginPath();
    context.moveTo(8, height - 36);
    context.lineTo(8, height - 8);
    context.lineTo(36, height - 8);
    context.stroke();
    context.fillText(face.axes[0], 40, height - 4);
    context.fillText(face.axes[1], 4, height - 42);
  }

  /** The values of the pair that is lit up. */
  private show(): void {
    const { pair, units } = this.state.shown, { data } = this;
    this.values.dataset.pair = String(pair);
    if (!data || pair < 0 || pair >= data.states.length) {
      this.values.replaceChildren(element("div", { class: "value wide" }, element("dt", {}, "Point at a pair to read its values.")));
      return;
    }
    this.values.replaceChildren(element("div", { class: "value" }, element("dt", {}, "pair"), element("dd", {}, `${pair + 1}, ${STATES[data.states[pair]]}`)),
      ...VALUES.map(([key, name, dimension]) => element("div", { class: "value", "data-key": key, "data-value": data.arrays[key][pair] }, element("dt", {}, name),
        element("dd", {}, dimension === "number" ? number(data.arrays[key][pair]) : units.text(dimension, data.arrays[key][pair], 5)))));
  }
}
