// The increment that everything shows: a slider, steps to both sides, and play.
import { button, element } from "./dom";
import type { State } from "./state";
import { number } from "./units";

const PAUSE = 500; // milliseconds of each increment while playing
const LENGTH = 15000; // of a motion in time, whose increments are played faster where they are many
const LEAST = 40; // a display shows no more than 25 pictures of this size in a second
const SWING = 1600; // of one swing of a mode

export class IncrementBar {
  readonly root: HTMLElement;
  private readonly slider = element("input", { type: "range", id: "increment", min: 1, step: 1, "aria-label": "Increment" });
  private readonly name = element("output", { class: "increment-name", id: "increment-name", for: "increment" });
  private readonly playButton: HTMLButtonElement;
  private timer = 0;
  private frame = 0;

  constructor(private readonly state: State, private readonly swing: (part: number) => void) {
    const { content } = state;
    this.slider.max = String(state.count);
    if (content.modal) this.slider.setAttribute("aria-label", "Mode");
    this.playButton = button("▶ Play", () => this.play(), { id: "play", "aria-pressed": "false" });
    const many = state.count > 1;
    this.root = element("div", { class: "increment-bar", role: "group", "aria-label": content.modal ? "Mode" : "Increment" },
      (many || content.modal) && this.playButton, many && button("◀", () => this.step(-1), { "aria-label": "Previous", id: "previous" }), many && this.slider,
      many && button("▶", () => this.step(1), { "aria-label": "Next", id: "next" }), this.name);
    this.slider.addEventListener("input", () => state.set({ increment: Number(this.slider.value) }));
    state.on(["increment"], () => this.show());
    this.show();
  }

  private show(): void {
    const { content, shown } = this.state;
    this.slider.value = String(shown.increment);
    const row = content.increments[shown.increment - 1], mode = content.modes[shown.increment - 1];
    const text = content.modal ? `mode ${shown.increment} of ${this.state.count}: ${mode.body}, frequency ${number(mode.frequency, 6)}`
      : content.in_time
        ? `time ${number(row.time, 4)}: increment ${shown.increment} of ${this.state.count}, step ${row.step_name}`
        : `increment ${shown.increment} of ${this.state.count}: step ${row.step_name}, increment ${row.increment}, at ${number(row.reached, 4)}`;
    this.name.textContent = text;
    this.slider.setAttribute("aria-valuetext", text);
  }

  step(by: number): void {
    this.state.set({ increment: Math.min(Math.max(this.state.shown.increment + by, 1), this.state.count) });
  }

  play(): void {
    const playing = this.playButton.getAttribute("aria-pressed") === "true";
    this.playButton.setAttribute("aria-pressed", String(!playing));
    this.playButton.textContent = playing ? "▶ Play" : "❚❚ Pause";
    window.clearInterval(this.timer);
    cancelAnimationFrame(this.frame);
    if (playing) return this.swing(1);
    if (this.state.content.modal) {
      const start = performance.now();
      const frame = (now: number) => {
        this.swing(Math.cos((2 * Math.PI * (now - start)) / SWING));
        this.frame = requestAnimationFrame(frame);
      };
      this.frame = requestAnimationFrame(frame);
      return;
    }
    const next = () => this.state.set({ increment: (this.state.shown.increment % this.state.count) + 1 });
    next();
    this.timer = window.setInterval(next, this.state.content.in_time ? Math.min(PAUSE, Math.max(LEAST, LENGTH / this.state.count)) : PAUSE);
  }
}
