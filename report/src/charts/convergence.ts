// How the contact solver converged: residuals of the increment that is shown, and the iterations of all.
import { element, section } from "../dom";
import type { State } from "../state";
import { counted } from "../units";
import { Chart, markIncrement } from "./chart";

const COLOURS = ["--c1", "--c2", "--c3", "--c4", "--c5", "--c6"];
const LEAST = 1e-17; // drawn for a residual of zero

export class ConvergencePanel {
  readonly root: HTMLElement;
  private readonly residuals = new Chart({ height: 250, x: "iteration", y: "residual / largest force", logarithmic: true, whole: true, legend: true, label: "Residual over the iterations" });
  private readonly iterations: Chart | null;
  private readonly text = element("p", { class: "note" });

  constructor(private readonly state: State) {
    const { increments, convergence } = state.content;
    this.iterations = increments.length < 2 ? null : new Chart({
      height: 180, x: "increment", y: "iterations", zero: true, whole: true, label: "Iterations of every increment", press: (index) => state.set({ increment: index + 1 }),
      draw: (plot) => markIncrement(plot, state.shown.increment),
    });
    this.root = section("convergence", "Convergence", this.residuals.root, this.text, this.iterations?.root, convergence?.note ? element("p", { class: "note" }, convergence.note) : null);
    this.iterations?.show(increments.map((row) => row.number), [{ name: "iterations", colour: "--c1", values: increments.map((row) => row.iterations) }]);
    state.on(["increment"], () => { this.show(); this.iterations?.redraw(); });
    state.on(["dark"], () => { this.residuals.build(); this.iterations?.build(); });
    this.show();
  }

  private show(): void {
    const table = this.state.content.convergence!, row = this.state.content.increments[this.state.shown.increment - 1];
    const attempts = new Map<number, Map<number, number>>();
    const coarse = new Set<string>();
    table.step.forEach((step, k) => {
      if (!row || step !== row.step || table.increment[k] !== row.increment) return;
      const attempt = attempts.get(table.attempt[k]) ?? new Map<number, number>();
      attempt.set(table.iteration[k], Math.max(table.residual[k] ?? NaN, LEAST));
      attempts.set(table.attempt[k], attempt);
      coarse.add(table.stages[table.stage[k]]);
    });
    const last = Math.max(1, ...[...attempts.values()].flatMap((attempt) => [...attempt.keys()]));
    const x = Array.from({ length: last + 1 }, (_, k) => k);
    this.residuals.show(x, [...attempts].map(([number, attempt], k) => ({
      name: attempts.size > 1 ? `attempt ${number}` : "residual", colour: COLOURS[k % COLOURS.length], values: x.map((n) => attempt.get(n) ?? null), points: true,
    })));
    this.text.textContent = !row || !attempts.size ? "This page has no iterations of this increment."
      : `Step ${row.step_name}, increment ${row.increment}: ${counted(row.iterations, "iteration")}${row.coarse ? ` and ${row.coarse} on problems with fewer pairs` : ""}`
        + `${attempts.size > 1 ? `, ${attempts.size} attempts` : ""}. Stages: ${[...coarse].join("; ")}.`;
  }
}
