// The field view: picture, its controls, the legend and the values at the picked point.
import { bytes, floats, whole } from "../arrays";
import { button, checkbox, css, element, labelled, section, select } from "../dom";
import type { Picked, State } from "../state";
import { number } from "../units";
import { fileName, savePng } from "../files";
import { ColourBar } from "./bar";
import { BodyList, nameOf } from "./bodies";
import { Camera } from "./camera";
import { levels } from "./colours";
import { FieldData } from "./data";
import { interact } from "./interaction";
import { Overlay } from "./overlay";
import { Shape } from "./pick";
import { LinePanel } from "./line";
import { Readout } from "./readout";
import { depthsOf, drawerOn, FieldScene, type Drawer, type Geometry } from "./scene";

const NEAR = 14; // pixels from the mouse to a pair
const SLOW = 25; // milliseconds of a drawing
const MOTION = 2400; // of a mechanism, there and back

interface PairPlaces {
  x: Float32Array;
  y: Float32Array;
  a: Uint32Array;
  b: Uint32Array;
}

export class FieldPanel {
  readonly root: HTMLElement;
  readonly camera: Camera;
  frames = 0; // drawn so far
  private readonly canvas = element("canvas", {
    id: "field-view", tabindex: 0, role: "application",
    "aria-label": "Field. Arrow keys move, plus and minus zoom, 0 shows all, Enter reads the values in the middle, Escape clears them, "
      + "Page up and Page down change the increment, Space plays.",
  });
  private readonly stage = element("div", { class: "stage" });
  private readonly overlay = new Overlay();
  private readonly bar = new ColourBar();
  private readonly note = element("p", { class: "note", role: "status" });
  private readonly data: FieldData;
  private readonly readout: Readout;
  private readonly line: LinePanel;
  private readonly extremes = element("p", { class: "extremes", id: "extremes" });
  private drawer!: Drawer;
  private mesh = -1;
  private scene!: FieldScene;
  private shape!: Shape;
  private geometry!: Geometry;
  private pairs: PairPlaces | null = null;
  private current = 0; // increment whose displacements are in the picture
  private values: Float32Array = new Float32Array();
  private waiting = false;
  private changed = true; // more than the camera, since the picture was drawn
  private drawn = { x: 0, y: 0, scale: 1 }; // the camera then
  private drawnAt = 0;
  private timer = 0;
  private keyboard = false;
  private request = 0;
  private swing = 1; // of a mode that is played

  constructor(private readonly state: State, private readonly actions: { step(by: number): void; play(): void }) {
    const field = state.content.field!;
    this.data = new FieldData(state.content);
    const around = (point: [number, number]): [number, number] => [point[0] - field.centre[0], point[1] - field.centre[1]];
    this.camera = new Camera(around(field.low), around(field.high));
    this.readout = new Readout(state, this.data, (x, y) => this.pickPlace(x, y));
    this.line = new LinePanel(state, this.data);
    this.stage.append(this.canvas, this.overlay.root);
    const bodies = state.shown.order.length > 1 ? new BodyList(state).root : null;
    this.root = section("field", "Field", this.controls(), this.stage, this.bar.root, this.extremes, this.note, bodies, this.readout.root, this.line.root);
  }

  async start(): Promise<void> {
    this.drawer = drawerOn(this.canvas);
    await this.take(this.data.meshOf(this.state.available(this.state.content.field!.increments)));
    interact(this.stage, this.canvas, this.camera, {
      changed: () => this.draw(true), pick: (px, py) => this.pickPixel(px, py), hover: (px, py) => this.hover(px, py), leave: () => this.leave(),
      line: (from, to) => { this.line.arm(false); this.state.set({ line: { from: this.undeformed(...from), to: this.undeformed(...to) } }); }, drawsLine: () => this.line.drawing,
      step: this.actions.step, play: this.actions.play, clear: () => this.state.set({ picked: null, pair: -1 }),
    });
    this.stage.addEventListener("pointerdown", () => this.showKeyboard(false));
    this.canvas.addEventListener("keydown", () => this.showKeyboard(true));
    this.canvas.addEventListener("focus", () => this.showKeyboard(!this.stage.matches(":active")));
    this.canvas.addEventListener("blur", () => this.showKeyboard(false));
    const { state } = this;
    state.on(["increment", "quantity"], () => void this.load());
    state.on(["range", "bands", "units"], () => { this.colour(); this.draw(); this.readout.show(this.shape, this.current); });
    state.on(["magnification"], () => { this.deform(); this.draw(); });
    state.on(["mesh", "elements", "undeformed", "states"], () => { this.scene.show(state.shown); this.draw(); });
    state.on(["picked"], () => { this.readout.show(this.shape, this.current); this.mark(); });
    state.on(["pair"], () => this.mark());
    state.on(["hidden", "order"], () => { this.order(); this.findExtremes(); this.draw(); });
    state.on(["extremes"], () => { this.findExtremes(); this.mark(); });
    state.on(["mechanism"], () => this.playMechanism());
    state.on(["line", "hidden", "order", "units"], () => void this.line.show(this.shape, this.current).then(() => this.mark()));
    state.on(["dark"], () => { this.theme(); this.draw(); });
    new ResizeObserver(() => this.resize()).observe(this.stage);
    this.resize();
    this.camera.reset();
    await this.load();
  }

  /** Another mesh, or the first one. Marks of pairs belong to the mesh of the last increment. */
  private async take(mesh: number): Promise<void> {
    const { state } = this, request = this.request, geometry = await this.data.geometry(mesh), { pairs } = state.content;
    const places = pairs && mesh === 0 ? await Promise.all([floats("pair_x"), floats("pair_y"), whole("pair_a"), whole("pair_b")]) : null;
    const mechanism = await this.data.mechanism();
    if (request !== this.request) return;
    const picked = state.shown.picked && this.shape ? this.shape.place(state.shown.picked).undeformed : null;
    this.scene?.dispose();
    this.mesh = mesh;
    this.current = 0;
    this.geometry = geometry;
    this.scene = new FieldScene(this.drawer, geometry, state.shown.order.length);
    this.shape = new Shape(geometry.points, geometry.triangles, geometry.body);
    this.pairs = places && { x: places[0], y: places[1], a: places[2], b: places[3] };
    if (this.pairs) this.scene.setPairs(this.pairs.x, this.pairs.y, pairs!.sizes);
    if (mechanism) this.scene.setMechanism(mechanism);
    this.order();
    this.theme();
    this.scene.show(state.shown);
    this.resize();
    if (picked) state.shown.picked = this.shape.pickUndeformed(...picked); // the same place
  }

  private controls(): HTMLElement {
    const { shown, content } = this.state, set = this.state.set.bind(this.state);
    const scale = element("input", { id: "magnification", type: "range", min: 0, max: 100, step: 0.5, "aria-label": "Magnification of displacements" });
    const exact = element("input", { id: "magnification-number", type: "number", min: 0, step: "any", "aria-label": "Magnification of displacements as a number" });
    const most = 4 * (content.field!.magnification || 1);
    const write = () => {
      scale.value = String(100 * Math.sqrt(Math.min(shown.magnification / most, 1)));
      exact.value = String(Number(shown.magnification.toPrecision(3)));
    };
    scale.addEventListener("input", () => set({ magnification: Number((most * (Number(scale.value) / 100) ** 2).toPrecision(3)) }));
    exact.addEventListener("change", () => { const wanted = Number(exact.value); if (Number.isFinite(wanted) && wanted >= 0) set({ magnification: wanted }); else write(); });
    this.state.on(["magnification"], write);
    write();
    const quantities = select("quantity", this.data.quantities.map(({ key, name }) => [key, name]), shown.quantity, (quantity) => set({ quantity }));
    const ranges = select("range", [["increment", content.modal ? "this mode" : "this increment"], ...(content.field!.increments.length > 1 && !content.modal
      ? [["all", "all increments"] as [string, string]] : []), ["extremes", "extreme values"]], shown.range, (range) => set({ range: range as "increment" }));
    const checks = element("div", { class: "checks" },
      checkbox("Mesh", shown.mesh, (mesh) => set({ mesh }), "show-mesh"),
      checkbox("Super-elements", shown.elements, (elements) => set({ elements }), "show-elements"),
      this.data.moves && checkbox("Undeformed", shown.undeformed, (undeformed) => set({ undeformed }), "show-undeformed"),
      content.pairs && checkbox("Contact states", shown.states, (states) => set({ states }), "show-states"),
      checkbox("Bands", shown.bands, (bands) => set({ bands }), "show-bands"),
      checkbox("Smallest and largest", shown.extremes, (extremes) => set({ extremes }), "show-extremes"),
      content.mechanism && checkbox("Mechanism", shown.mechanism, (mechanism) => set({ mechanism }), "show-mechanism"));
    const zoom = element("div", { class: "buttons", role: "group", "aria-label": "Zoom" },
      button("−", () => { this.camera.zoom(0.7); this.draw(true); }, { "aria-label": "Zoom out", title: "Zoom out (−)" }),
      button("+", () => { this.camera.zoom(1 / 0.7); this.draw(true); }, { "aria-label": "Zoom in", title: "Zoom in (+)" }),
      button("Show all", () => { this.camera.reset(); this.draw(); }, { id: "show-all", title: "Show all (0)" }),
      button("PNG", () => this.savePicture(), { id: "save-png", title: "The picture with its legend as a file" }));
    return element("div", { class: "controls" }, labelled("Show", quantities), labelled("Colours span", ranges),
      this.data.moves && element("div", { class: "control" }, element("span", { class: "label" }, "Deformation ×"), element("span", { class: "pair-of" }, scale, exact)),
      checks, zoom);
  }

  /** The frame and the middle of the picture, for those who read values with the Enter key. */
  private showKeyboard(on: boolean): void {
    if (on === this.keyboard) return;
    this.keyboard = on;
    this.stage.classList.toggle("keyboard", on);
    this.mark();
  }

  private theme(): void {
    this.scene.setTheme({
      line: css("--line"), faint: css("--faint"), rigid: css("--rigid"), none: css("--rigid"), paper: css("--card"), open: css("--open"),
      stick: css("--stick"), slip: css("--slip"),
    });
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.stage;
    if (!clientWidth || !clientHeight) return;
    const grown = clientWidth / this.camera.width;
    this.camera.width = clientWidth;
    this.camera.height = clientHeight;
    if (Number.isFinite(grown)) this.camera.scale *= grown;
    this.scene.resize(clientWidth, clientHeight);
    this.draw();
  }

  /** Values of the increment that is chosen; the last request counts, whichever array is unpacked first. */
  private async load(): Promise<void> {
    const { content, shown } = this.state, request = ++this.request;
    const increment = this.state.available(content.field!.increments), mesh = this.data.meshOf(increment);
    if (mesh !== this.mesh) await this.take(mesh);
    const [[ux, uy], values, states] = await Promise.all([
      this.data.displacement(increment), this.data.values(shown.quantity, increment),
      content.pairs && bytes(`state_${this.state.available(content.pairs.increments)}`),
    ]);
    if (request !== this.request) return;
    if (increment !== this.current) this.scene.setDisplacement(ux, uy);
    if (states && this.pairs) this.scene.setStates(states, this.pairs.a);
    this.current = increment;
    this.displacements = [ux, uy];
    this.values = values;
    this.scene.setValues(values);
    const differs = increment !== shown.increment ? `The fields of ${content.modal ? "mode" : "increment"} ${shown.increment} are not in this page: those of ${increment} are shown. ` : "";
    this.note.textContent = differs + content.field!.note;
    this.colour();
    this.deform();
    this.findExtremes();
    this.draw();
    await Promise.all([this.readout.show(this.shape, increment), this.line.show(this.shape, increment)]);
    if (shown.line) this.draw(true); // its places have moved
    this.root.dataset.increment = String(increment);
    this.root.dataset.quantity = shown.quantity;
  }

  private displacements: [Float32Array | null, Float32Array | null] = [null, null];

  /** Bodies that are hidden, and which is above which. */
  private order(): void {
    const { order, hidden } = this.state.shown, depths = depthsOf(this.geometry.body, order, hidden);
    this.scene.setDepths(depths, this.pairs && [this.pairs.a, this.pairs.b]);
    this.shape.order(depths);
  }

  private ofExtremes: Picked[] = [];

  /** Of all points that are seen: marks in the picture, and a sentence. */
  private findExtremes(): void {
    const { shown, content } = this.state, quantity = this.data.quantity(shown.quantity), found = shown.extremes ? this.shape.extremes(this.values) : null;
    this.ofExtremes = [];
    this.extremes.replaceChildren();
    if (!found) return;
    const [cx, cy] = content.field!.centre;
    for (const [name, point] of [["Smallest", found.least], ["Largest", found.greatest]] as const) {
      const picked = this.shape.pickPoint(point)!, { undeformed: [x, y] } = this.shape.place(picked);
      this.ofExtremes.push(picked);
      const { low, high } = content.field!, length = shown.units.scale("length", Math.max(...[...low, ...high].map(Math.abs)));
      const place = [x + cx, y + cy].map((value) => number(value * length.factor, 5)).join(", ");
      this.extremes.append(element("span", { "data-key": name.toLowerCase(), "data-value": this.values[point], "data-x": x + cx, "data-y": y + cy }, `${name}: `,
        button(shown.units.text(quantity.dimension, this.values[point]), () => this.state.set({ picked }), { class: "link", title: "Read all values there" }),
        ` in ${nameOf(this.state, this.geometry.body[point])} at (${place})${length.unit ? ` ${length.unit}` : ""} `));
    }
  }

  private mechanismFrame = 0;

  /** From where the bodies are to the motion and back, again and again; at rest for those who want no motion. */
  private playMechanism(): void {
    cancelAnimationFrame(this.mechanismFrame);
    const { mechanism } = this.state.content, shows = this.state.shown.mechanism;
    this.root.classList.toggle("of-mechanism", shows);
    if (!shows || !mechanism) {
      this.scene.showMechanism(null);
      this.load();
      return;
    }
    this.note.textContent = `${mechanism.text} Colours: displacements, of which only the direction and the ratios mean something.`;
    const still = matchMedia("(prefers-reduced-motion: reduce)").matches, start = performance.now();
    const frame = (now: number) => {
      this.scene.showMechanism(mechanism.length * (still ? 1 : 0.5 - 0.5 * Math.cos((2 * Math.PI * (now - start)) / MOTION)));
      this.drawNow();
      if (!still) this.mechanismFrame = requestAnimationFrame(frame);
    };
    frame(start);
  }

  /** The picture, its marks and its legend. */
  private picture(): HTMLCanvasElement {
    const { width, height } = this.camera, title = this.state.content.title, top = title ? 26 : 0;
    this.drawNow();
    const made = document.createElement("canvas"), ratio = this.canvas.width / width;
    made.width = this.canvas.width;
    made.height = Math.round((top + height + 62) * ratio);
    const context = made.getContext("2d")!;
    context.scale(ratio, ratio);
    context.fillStyle = css("--card");
    context.fillRect(0, 0, width, top + height + 62);
    context.font = "bold 15px system-ui, sans-serif";
    context.fillStyle = css("--ink");
    context.fillText(title, 12, 19);
    context.drawImage(this.canvas, 0, top, width, height);
    this.overlay.draw(context, top, height);
    if (!this.state.shown.mechanism) this.bar.draw(context, 20, top + height + 8, width - 40);
    return made;
  }

  private savePicture(): void {
    const { content, shown } = this.state;
    savePng(fileName(content.directory, shown.mechanism ? "mechanism" : shown.quantity, this.current), this.picture());
  }

  /** On paper an image stands for the canvas, which a printer cannot ask to draw. */
  print(begins: boolean): void {
    if (!this.scene) return;
    this.printed?.remove();
    this.printed = begins ? element("img", { class: "printed", src: this.picture().toDataURL("image/png"), alt: "Field" }) : null;
    if (this.printed) this.stage.before(this.printed);
  }

  private printed: HTMLImageElement | null = null;

  /** Where a pixel is in the undeformed model; outside all bodies as if nothing had moved. */
  private undeformed(px: number, py: number): [number, number] {
    const at = this.camera.toPlane(px, py), picked = this.shape.pick(...at);
    return picked ? this.shape.place(picked).undeformed : at;
  }

  private colour(): void {
    const { shown } = this.state, quantity = this.data.quantity(shown.quantity);
    const [low, high] = this.data.range(this.state, this.current), [, , least, greatest] = this.data.extremes(shown.quantity, this.current);
    const scale = shown.units.scale(quantity.dimension, Math.max(Math.abs(low), Math.abs(high)));
    const chosen = levels(low * scale.factor, high * scale.factor);
    const inModel = { ...chosen, low: chosen.low / scale.factor, high: chosen.high / scale.factor, step: chosen.step / scale.factor };
    this.scene.setLevels(inModel, shown.bands);
    this.bar.show(quantity.name, scale, inModel, shown.bands, least < inModel.low - 1e-9 * inModel.step, greatest > inModel.high + 1e-9 * inModel.step);
  }

  private deform(): void {
    const magnification = this.state.shown.magnification * this.swing;
    this.scene.setMagnification(magnification);
    this.shape.move(...this.displacements, magnification);
  }

  /** A mode that is played: from 1 to -1 and back. */
  setSwing(part: number): void {
    this.swing = part;
    this.deform();
    this.draw();
  }

  private pickPixel(px: number, py: number): void {
    this.state.set({ picked: this.shape.pick(...this.camera.toPlane(px, py)) });
  }

  /** A place of the undeformed model, in its units. */
  private pickPlace(x: number, y: number): boolean {
    const [cx, cy] = this.state.content.field!.centre;
    const picked = this.shape.pickUndeformed(x - cx, y - cy);
    if (picked) this.state.set({ picked });
    return picked !== null;
  }

  private hover(px: number, py: number): void {
    const pair = this.nearestPair(px, py);
    if (pair >= 0 || this.hovered) this.state.set({ pair });
    this.hovered = pair >= 0;
    const picked = this.shape.pick(...this.camera.toPlane(px, py));
    const quantity = this.data.quantity(this.state.shown.quantity);
    this.overlay.hint.textContent = picked ? `${quantity.name} ${this.state.shown.units.text(quantity.dimension, this.shape.value(picked, this.values))}` : "";
    this.stage.classList.toggle("over", picked !== null);
  }

  private hovered = false;

  private leave(): void {
    if (this.hovered) this.state.set({ pair: -1 });
    this.hovered = false;
    this.overlay.hint.textContent = "";
  }

  private placesOf(pair: number): [number, number][] {
    const { x, y, a, b } = this.pairs!, places: [number, number][] = [];
    for (const point of [a[pair], b[pair]]) if (point) places.push(this.shape.at(point - 1));
    return places.length ? places : [[x[pair], y[pair]]];
  }

  private nearestPair(px: number, py: number): number {
    if (!this.pairs) return -1;
    let best = -1, least = NEAR / this.camera.scale;
    const [cx, cy] = this.camera.toPlane(px, py);
    for (let i = 0; i < this.pairs.x.length; ++i) {
      if (Math.abs(this.pairs.x[i] - cx) > 0.25 * this.camera.size + least) continue;
      const [x, y] = this.placesOf(i)[0], distance = Math.hypot(x - cx, y - cy);
      if (distance < least) [best, least] = [i, distance];
    }
    return best;
  }

  /** Draws once before the next frame, however often it is called. `moved`: only the camera has changed. */
  draw(moved = false): void {
    if (!this.scene || !this.current) return; // nothing is read yet
    this.changed ||= !moved;
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      if (this.changed || !this.mayWait()) this.drawNow();
      else this.moveDrawn();
    });
  }

  /** Only what stands above the picture has changed. Drawing the picture again takes seconds where it has 1e5 cells. */
  private mark(): void {
    if (this.scene && this.current && !this.waiting) this.showOverlay(); // a picture that is to be drawn shows it too
  }

  /** Whether drawing takes so long that a moved picture is better than a late one. */
  private mayWait(): boolean {
    return this.scene.cost > SLOW && performance.now() - this.drawnAt < 6 * this.scene.cost;
  }

  /** Moves the picture as it is, and draws it anew when the camera rests. */
  private moveDrawn(): void {
    const { camera, drawn } = this, scale = camera.scale / drawn.scale;
    const [left, top] = camera.toPixel(drawn.x - (0.5 * camera.width) / drawn.scale, drawn.y + (0.5 * camera.height) / drawn.scale);
    this.canvas.style.transform = `translate(${left}px, ${top}px) scale(${scale})`;
    this.showOverlay();
    window.clearTimeout(this.timer);
    this.timer = window.setTimeout(() => this.draw(), 120);
    ++this.frames;
  }

  drawNow(): void {
    window.clearTimeout(this.timer);
    this.changed = false;
    this.canvas.style.transform = "";
    this.scene.draw(this.camera);
    this.drawn = { x: this.camera.x, y: this.camera.y, scale: this.camera.scale };
    this.drawnAt = performance.now();
    this.showOverlay();
    ++this.frames;
  }

  private showOverlay(): void {
    const { shown } = this.state;
    const picked = shown.picked ? this.shape.place(shown.picked).deformed : null;
    this.overlay.show(this.camera, picked, shown.pair >= 0 && this.pairs ? this.placesOf(shown.pair) : [], this.keyboard);
    const fields = !shown.mechanism;
    this.overlay.showPlaces(this.camera, fields ? this.ofExtremes.map((at) => this.shape.place(at).deformed) : [], fields ? this.line.places : []);
    this.overlay.showScale(this.camera, shown.units.scale("length", this.camera.width / this.camera.scale));
  }

  /** For tests: the pixel of a place of the undeformed model. */
  pixelOf(x: number, y: number): [number, number] {
    const [cx, cy] = this.state.content.field!.centre;
    const picked = this.shape.pickUndeformed(x - cx, y - cy);
    return this.camera.toPixel(...(picked ? this.shape.place(picked).deformed : [x - cx, y - cy] as [number, number]));
  }

  pixelOfPair(pair: number): [number, number] {
    return this.camera.toPixel(...this.placesOf(pair)[0]);
  }
}

