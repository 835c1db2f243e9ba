// The view of bodies in space: picture, controls, legend, section and the values at the picked point.
import { floats, whole } from "../arrays";
import { button, checkbox, css, element, labelled, section, select, svg } from "../dom";
import { ColourBar } from "../field/bar";
import { levels } from "../field/colours";
import { drawerOn } from "../field/scene";
import { fileName, savePng } from "../files";
import type { Space } from "../content";
import type { State } from "../state";
import { number } from "../units";
import { SpaceCamera, type Vector } from "./camera";
import { cut, type Cut } from "./cut";
import { meanOf, pickAt, type SolidPoint } from "./pick";
import { SpaceScene, type Solids } from "./scene";

const TURN = 6, CLICK = 5; // degrees; pixels
const MOTION = 2400; // of a mechanism, there and back
const AT_REST = 1e-4; // of the largest displacement of a mechanism, as in summary.json
const AXES: Record<string, Vector> = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] };

export class SpacePanel {
  readonly root: HTMLElement;
  readonly camera: SpaceCamera;
  picked: SolidPoint | null = null;
  private readonly space: Space;
  private readonly canvas = element("canvas", {
    id: "space-view", tabindex: 0, role: "application",
    "aria-label": "Bodies in space. Arrow keys turn them, with Shift they move, plus and minus zoom, 0 shows all, Enter reads the values in the middle, "
      + "Escape clears them, Page up and Page down change the increment, Space plays.",
  });
  private readonly stage = element("div", { class: "stage" });
  private readonly overlay = svg("svg", { class: "drawing" });
  private readonly bar = new ColourBar();
  private readonly note = element("p", { class: "note", role: "status" });
  private readonly where = element("p", { class: "where" });
  private readonly values = element("dl", { class: "values", "aria-live": "polite", id: "values" });
  private readonly slider = element("input", { id: "cut-at", type: "range", min: 0, max: 1000, value: 500, "aria-label": "Place of the section" });
  private readonly cutText = element("output", { id: "cut-text", for: "cut-at" });
  private scene!: SpaceScene;
  private solids!: Solids;
  private moved: Float32Array = new Float32Array();
  private value: Float32Array = new Float32Array();
  private cutAxis = "";
  private turned = false; // the other side of the section is seen
  private plane: [number, number, number, number] | null = null;
  private section: Cut | null = null;
  private current = 0;
  private request = 0;
  private mechanismFrame = 0;
  private length = 0; // as which the largest displacement of the mechanism is drawn now
  private waiting = false;

  constructor(private readonly state: State, private readonly actions: { step(by: number): void; play(): void }) {
    this.space = state.content.space!;
    const around = (point: Vector): Vector => point.map((value, k) => value - this.space.centre[k]) as Vector;
    this.camera = new SpaceCamera(around(this.space.low), around(this.space.high));
    this.stage.append(this.canvas, this.overlay);
    this.root = section("field", "Bodies", this.controls(), this.stage, this.bar.root, this.note, this.bodies(), this.where, this.values);
  }

  async start(): Promise<void> {
    const drawer = drawerOn(this.canvas);
    const [points, triangles, body, cells, cellBody, edges] = await Promise.all([floats("space_points"), whole("space_triangles"), whole("space_body"), whole("space_cells"),
      whole("space_cell_body"), whole("space_edges")]);
    this.solids = { points, triangles, body, cells, cellBody, edges };
    this.moved = new Float32Array(points.length);
    this.scene = new SpaceScene(drawer, this.solids);
    this.listen();
    const { state } = this;
    state.on(["increment", "quantity"], () => void this.load());
    state.on(["range", "bands", "units"], () => { this.colour(); this.read(); this.draw(); });
    state.on(["magnification", "pair", "contact"], () => this.draw());
    state.on(["mechanism"], () => void this.load());
    state.on(["hidden"], () => { this.scene.setHidden(state.shown.hidden); this.cutAgain(); this.draw(); });
    state.on(["dark"], () => { this.theme(); this.draw(); });
    new ResizeObserver(() => this.resize()).observe(this.stage);
    this.theme();
    this.resize();
    this.camera.reset();
    await this.load();
  }

  private controls(): HTMLElement {
    const { shown, content } = this.state, set = this.state.set.bind(this.state), hasFields = this.space.increments.length > 0;
    const scale = element("input", { id: "magnification", type: "range", min: 0, max: 100, step: 0.5, "aria-label": "Magnification of displacements" });
    const exact = element("input", { id: "magnification-number", type: "number", min: 0, step: "any", "aria-label": "Magnification of displacements as a number" });
    const most = 4 * (this.space.magnification || 1);
    const write = () => {
      scale.value = String(100 * Math.sqrt(Math.min(shown.magnification / most, 1)));
      exact.value = String(Number(shown.magnification.toPrecision(3)));
    };
    scale.addEventListener("input", () => set({ magnification: Number((most * (Number(scale.value) / 100) ** 2).toPrecision(3)) }));
    exact.addEventListener("change", () => { const wanted = Number(exact.value); if (Number.isFinite(wanted) && wanted >= 0) set({ magnification: wanted }); else write(); });
    this.state.on(["magnification"], write);
    write();
    const quantities = select("quantity", this.quantities.map(({ key, name }) => [key, name]), shown.quantity, (quantity) => set({ quantity }));
    const ranges = select("range", [["increment", "this increment"], ...(this.space.increments.length > 1 ? [["all", "all increments"] as [string, string]] : []), ["extremes", "extreme values"]],
      shown.range, (range) => set({ range: range as "increment" }));
    const axes = select("cut", [["", "none"], ["x", "across x"], ["y", "across y"], ["z", "across z"]], "", (axis) => { this.cutAxis = axis; this.cutAgain(); this.draw(); });
    this.slider.addEventListener("input", () => { this.cutAgain(); this.draw(); });
    const views = element("div", { class: "buttons", role: "group", "aria-label": "View" },
      ...([["x", 0, 0], ["y", -90, 0], ["z", -90, 90]] as const).map(([axis, azimuth, elevation]) => button(axis, () => { this.camera.look(azimuth, elevation); this.draw(); },
        { id: `view-${axis}`, title: `Look along ${axis}`, "aria-label": `Look along ${axis}` })),
      button("Show all", () => { this.camera.look(-60, 25); this.draw(); }, { id: "show-all", title: "Show all (0)" }),
      button("PNG", () => this.savePicture(), { id: "save-png", title: "The picture as a file" }));
    return element("div", { class: "controls" }, hasFields && labelled("Show", quantities), hasFields && labelled("Colours span", ranges),
      hasFields && element("div", { class: "control" }, element("span", { class: "label" }, "Deformation ×"), element("span", { class: "pair-of" }, scale, exact)),
      labelled("Section", axes), element("div", { class: "control" }, element("span", { class: "label" }, "at"), element("span", { class: "pair-of" }, this.slider, this.cutText)),
      element("div", { class: "checks" }, checkbox("Other side", false, (on) => { this.turned = on; this.cutAgain(); this.draw(); }, "cut-side"),
        hasFields && checkbox("Bands", shown.bands, (bands) => set({ bands }), "show-bands"),
        hasFields && content.mechanism && checkbox("Mechanism", shown.mechanism, (mechanism) => set({ mechanism }), "show-mechanism")), views);
  }

  private bodies(): HTMLElement | null {
    if (this.space.bodies.length < 2) return null;
    const { shown } = this.state;
    return element("details", { class: "bodies" }, element("summary", {}, "Bodies"), element("div", { class: "body-rows" }, ...this.space.bodies.map((name, k) =>
      checkbox(name, true, (on) => {
        const hidden = new Set(shown.hidden);
        if (on) hidden.delete(k + 1); else hidden.add(k + 1);
        this.state.set({ hidden });
      }, `body-${k + 1}`))));
  }

  get quantities(): Space["quantities"] {
    const moves = this.space.quantities.some(({ key }) => key === "ux");
    return moves ? [...this.space.quantities.filter(({ key }) => key !== "displacement"), { key: "displacement", name: "displacement", dimension: "length" }] : this.space.quantities;
  }

  private async array(key: string, increment: number): Promise<Float32Array> {
    if (key !== "displacement") return floats(`${key}_${increment}`);
    const [ux, uy, uz] = await Promise.all(["ux", "uy", "uz"].map((name) => floats(`${name}_${increment}`)));
    return ux.map((value, i) => Math.hypot(value, uy[i], uz[i]));
  }

  private async load(): Promise<void> {
    cancelAnimationFrame(this.mechanismFrame);
    this.root.classList.toggle("of-mechanism", this.showsMechanism);
    if (this.showsMechanism) return this.playMechanism();
    const { shown } = this.state, request = ++this.request, increment = this.state.available(this.space.increments);
    const moves = this.space.quantities.some(({ key }) => key === "ux");
    const [value, parts] = await Promise.all([this.array(shown.quantity, increment), moves ? Promise.all(["ux", "uy", "uz"].map((name) => floats(`${name}_${increment}`))) : null]);
    if (request !== this.request) return;
    this.value = value;
    this.moved = new Float32Array(this.solids.points.length);
    parts?.forEach((part, k) => part.forEach((u, i) => (this.moved[3 * i + k] = u)));
    this.current = increment;
    this.scene.setMoved(this.moved);
    this.scene.setValues(value);
    this.note.textContent = (increment !== shown.increment ? `The fields of increment ${shown.increment} are not in this page: those of ${increment} are shown. ` : "") + this.space.note;
    this.colour();
    this.cutAgain();
    this.read();
    this.draw();
    this.root.dataset.increment = String(increment);
    this.root.dataset.quantity = shown.quantity;
  }

  /** Also where no increment was finished, so that the page has nothing else to draw. */
  get showsMechanism(): boolean {
    return this.state.shown.mechanism || !this.space.increments.length;
  }

  /** From where the bodies are to the motion and back, again and again; at rest for those who want no motion. */
  private async playMechanism(): Promise<void> {
    const { mechanism } = this.state.content, request = ++this.request;
    const parts = await Promise.all(["ux", "uy", "uz"].map((name) => floats(`mechanism_${name}`)));
    if (request !== this.request || !mechanism) return;
    parts.forEach((part, k) => part.forEach((u, i) => (this.moved[3 * i + k] = u)));
    this.value = this.withoutBodiesAtRest(parts[0].map((u, i) => Math.hypot(u, parts[1][i], parts[2][i])));
    this.picked = null;
    this.scene.setMoved(this.moved);
    this.scene.setValues(this.value);
    this.note.textContent = `${mechanism.text} Colours: displacements, of which only the direction and the ratios mean something.`;
    this.colour();
    this.cutAgain();
    this.read();
    const still = matchMedia("(prefers-reduced-motion: reduce)").matches, start = performance.now();
    const frame = (now: number) => {
      this.length = mechanism.length * (still ? 1 : 0.5 - 0.5 * Math.cos((2 * Math.PI * (now - start)) / MOTION));
      this.drawNow();
      if (!still) this.mechanismFrame = requestAnimationFrame(frame);
    };
    frame(start);
    this.root.dataset.quantity = "mechanism";
  }

  /** Those have no colour. */
  private withoutBodiesAtRest(sizes: Float32Array): Float32Array {
    const { body } = this.solids, most = new Map<number, number>();
    sizes.forEach((size, i) => most.set(body[i], Math.max(most.get(body[i]) ?? 0, size)));
    return sizes.map((size, i) => (most.get(body[i])! > AT_REST ? size : NaN));
  }

  /** By which displacements are multiplied. */
  private get magnification(): number {
    return this.showsMechanism ? this.length : this.state.shown.magnification;
  }

  private colour(): void {
    if (this.showsMechanism) return this.scene.setLevels(levels(0, 1), false);
    const { shown } = this.state, { ranges } = this.space, quantity = this.quantities.find(({ key }) => key === shown.quantity)!;
    const numbers = shown.range === "all" ? this.space.increments : [this.current], first = shown.range === "extremes" ? 2 : 0;
    const of = (n: number) => ranges[String(n)][shown.quantity] ?? [0, 0, 0, 0];
    const low = Math.min(...numbers.map((n) => of(n)[first])), high = Math.max(...numbers.map((n) => of(n)[first + 1]));
    const shownLevels = levels(low, high), [, , least, greatest] = of(this.current);
    this.scene.setLevels(shownLevels, shown.bands);
    this.bar.show(quantity.name, shown.units.scale(quantity.dimension, Math.max(Math.abs(low), Math.abs(high))), shownLevels, shown.bands,
      least < shownLevels.low, greatest > shownLevels.high);
  }

  private cutAgain(): void {
    if (!this.solids) return;
    const axis = AXES[this.cutAxis], k = "xyz".indexOf(this.cutAxis), { low, high, centre } = this.space;
    this.slider.disabled = !axis;
    this.cutText.textContent = "";
    if (!axis) {
      this.plane = this.section = null;
      return this.scene.setCut(null, null, null, null);
    }
    const part = 0.001 + 0.998 * (Number(this.slider.value) / 1000), at = low[k] + part * (high[k] - low[k]), sign = this.turned ? -1 : 1;
    this.plane = [...(axis.map((value) => sign * value) as Vector), sign * (at - centre[k])];
    this.section = cut(this.solids.points, this.solids.cells, this.solids.cellBody, this.state.shown.hidden, axis, at - centre[k]);
    this.scene.setCut(this.section, this.plane, this.moved, this.value);
    const length = this.state.shown.units.scale("length", Math.max(...[...low, ...high].map(Math.abs)));
    this.cutText.textContent = `${this.cutAxis} = ${number(at * length.factor, 4)}${length.unit ? ` ${length.unit}` : ""}`;
  }

  private listen(): void {
    const { stage, canvas, camera } = this;
    let before: [number, number] | null = null, way = 0, moves = false;
    const at = (event: MouseEvent): [number, number] => {
      const box = stage.getBoundingClientRect();
      return [event.clientX - box.left - stage.clientLeft, event.clientY - box.top - stage.clientTop];
    };
    stage.addEventListener("contextmenu", (event) => event.preventDefault());
    stage.addEventListener("pointerdown", (event) => {
      stage.setPointerCapture(event.pointerId);
      canvas.focus({ preventScroll: true });
      event.preventDefault();
      [before, way, moves] = [at(event), 0, event.button !== 0 || event.shiftKey];
    });
    stage.addEventListener("pointermove", (event) => {
      if (!before) return;
      const now = at(event), by: [number, number] = [now[0] - before[0], now[1] - before[1]];
      way += Math.hypot(...by);
      if (moves) camera.pan(...by); else camera.rotate(...by);
      before = now;
      this.draw();
    });
    const end = (event: PointerEvent) => {
      if (before && event.type === "pointerup" && way < CLICK && !moves) this.pick(...at(event));
      before = null;
    };
    stage.addEventListener("pointerup", end);
    stage.addEventListener("pointercancel", end);
    stage.addEventListener("dblclick", () => { camera.reset(); this.draw(); });
    stage.addEventListener("wheel", (event) => {
      event.preventDefault();
      const pixels = event.deltaMode === 1 ? 16 * event.deltaY : event.deltaY;
      camera.zoom(Math.exp(-0.0016 * Math.max(-300, Math.min(300, pixels))), ...at(event));
      this.draw();
    }, { passive: false });
    const arrow = (px: number, py: number, shift: boolean) => (shift ? camera.pan(10 * px, 10 * py) : camera.rotate(px / 0.4, py / 0.4));
    const keys: Record<string, (shift: boolean) => void> = {
      ArrowLeft: (shift) => arrow(-TURN, 0, shift), ArrowRight: (shift) => arrow(TURN, 0, shift), ArrowUp: (shift) => arrow(0, -TURN, shift), ArrowDown: (shift) => arrow(0, TURN, shift),
      "+": () => camera.zoom(1.25), "=": () => camera.zoom(1.25), "-": () => camera.zoom(0.8), "0": () => camera.reset(), Enter: () => this.pick(0.5 * camera.width, 0.5 * camera.height),
      PageUp: () => this.actions.step(-1), PageDown: () => this.actions.step(1), " ": () => this.actions.play(), Escape: () => this.clear(),
    };
    canvas.addEventListener("keydown", (event) => {
      const act = keys[event.key];
      if (!act || event.ctrlKey || event.altKey || event.metaKey) return;
      event.preventDefault();
      act(event.shiftKey);
      this.draw();
    });
  }

  private get magnified(): Float32Array {
    const { magnification } = this;
    return this.moved.map((u) => magnification * u);
  }

  pick(px: number, py: number): void {
    if (this.showsMechanism) return; // it has no values
    this.picked = pickAt(px, py, this.camera, { solids: this.solids, moved: this.magnified, hidden: this.state.shown.hidden, plane: this.plane, cut: this.section });
    this.read();
    this.draw();
  }

  private clear(): void {
    this.picked = null;
    this.state.set({ pair: -1 });
    this.read();
  }

  private reading = 0;

  /** Values at the picked point. */
  private async read(): Promise<void> {
    const { picked, space, quantities } = this, { units } = this.state.shown, request = ++this.reading;
    if (this.showsMechanism) {
      this.values.replaceChildren();
      this.where.textContent = "Drag to turn, with Shift or the right button to move.";
      return;
    }
    if (!picked) {
      this.values.replaceChildren();
      this.where.textContent = "Drag to turn, with Shift or the right button to move. Click on a body, or press Enter in the picture, to read the values there.";
      return;
    }
    const arrays = await Promise.all(quantities.map(({ key }) => this.array(key, this.current)));
    if (request !== this.reading) return;
    const at = space.centre.map((centre, k) => centre + meanOf(picked, this.solids.points, 3, k));
    const size = this.camera.size, length = units.scale("length", Math.max(...[...space.low, ...space.high].map(Math.abs)));
    const place = at.map((value) => number(Math.abs(value) < 1e-6 * size ? 0 : value * length.factor, 5)).join(", ");
    this.where.textContent = `${space.bodies[this.solids.body[picked.nodes[0]] - 1]}, at (${place})${length.unit ? ` ${length.unit}` : ""} of the undeformed shape. Values are interpolated linearly.`;
    this.values.dataset.at = at.join(" ");
    this.values.replaceChildren(...quantities.map(({ key, name, dimension }, k) => {
      const value = meanOf(picked, arrays[k]);
      return element("div", { class: key === this.state.shown.quantity ? "value chosen" : "value", "data-key": key, "data-value": value },
        element("dt", {}, name), element("dd", {}, units.text(dimension, Number.isNaN(value) ? null : value, 5)));
    }));
  }

  private theme(): void {
    this.scene.setTheme(css("--line"), css("--rigid"));
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.stage;
    if (!clientWidth || !clientHeight) return;
    const grown = clientWidth / this.camera.width;
    this.camera.width = clientWidth;
    this.camera.height = clientHeight;
    this.camera.scale *= grown;
    this.overlay.setAttribute("viewBox", `0 0 ${clientWidth} ${clientHeight}`);
    this.scene.resize(clientWidth, clientHeight);
    this.drawNow();
  }

  private draw(): void {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => this.drawNow());
  }

  /** Reads places of pairs, which are lit up in the picture. */
  placeOfPair: (pair: number) => Vector | null = () => null;

  private drawNow(): void {
    this.waiting = false;
    const { shown } = this.state;
    this.scene.setMagnification(this.magnification);
    this.scene.draw(this.camera, 0.75 * this.camera.size + this.reachOfMotion());
    const marks: SVGElement[] = [], ring = (at: Vector, kind: string) => {
      const [px, py] = this.camera.toPixel(...at);
      marks.push(svg("circle", { cx: px, cy: py, r: 7, class: kind }));
    };
    if (this.picked) {
      const { magnification } = this, picked = this.picked;
      ring([0, 1, 2].map((k) => meanOf(picked, this.solids.points, 3, k) + magnification * meanOf(picked, this.moved, 3, k)) as Vector, "probe picked");
    }
    const pair = this.placeOfPair(shown.pair);
    if (pair) ring(pair, "ring");
    this.overlay.replaceChildren(...marks, ...this.triad());
  }

  private reachOfMotion(): number {
    let most = 0;
    for (const u of this.moved) most = Math.max(most, Math.abs(u));
    return 2 * (this.showsMechanism ? this.state.content.mechanism?.length ?? 0 : this.magnification) * most;
  }

  /** The axes, in the corner. */
  private triad(): SVGElement[] {
    const axes = this.camera.axes(), origin = [46, this.camera.height - 46];
    return [..."xyz"].flatMap((name, k) => {
      const x = origin[0] + 30 * axes[0][k], y = origin[1] - 30 * axes[1][k];
      const label = svg("text", { x: origin[0] + 40 * axes[0][k] - 4, y: origin[1] - 40 * axes[1][k] + 4, class: "axis-name" });
      label.textContent = name;
      return [svg("line", { x1: origin[0], y1: origin[1], x2: x, y2: y, class: "axis" }), label];
    });
  }

  private savePicture(): void {
    this.drawNow();
    const { width, height } = this.canvas, picture = element("canvas", { width, height: height + 60 }), context = picture.getContext("2d")!;
    context.fillStyle = css("--card");
    context.fillRect(0, 0, width, height + 60);
    context.drawImage(this.canvas, 0, 0);
    if (!this.showsMechanism) this.bar.draw(context, 20, height + 6, width - 40);
    savePng(fileName(this.state.content.directory, this.showsMechanism ? "mechanism" : this.state.shown.quantity, this.current), picture);
  }
}
