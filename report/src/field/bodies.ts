// The bodies: which are hidden, and which is above the others where they overlap.
import { button, checkbox, element } from "../dom";
import type { State } from "../state";

const MOST = 300; // rows at a time

export class BodyList {
  readonly root: HTMLElement;
  private readonly rows = element("div", { class: "body-rows" });
  private readonly summary = element("summary");
  private readonly filter = element("input", { type: "search", id: "body-filter", placeholder: "part of a name", "aria-label": "Bodies whose names contain" });

  constructor(private readonly state: State) {
    const all = (hide: boolean) => state.set({ hidden: new Set([...state.shown.hidden].filter((number) => !this.fits(number)).concat(hide ? this.fitting() : [])) });
    this.filter.addEventListener("input", () => this.show());
    this.root = element("details", { class: "bodies", id: "bodies" }, this.summary, element("div", { class: "body-tools" }, this.filter,
      button("Show", () => all(false), { id: "bodies-show", title: "Show the bodies of the list" }), button("Hide", () => all(true), { id: "bodies-hide", title: "Hide the bodies of the list" })), this.rows);
    this.root.addEventListener("toggle", () => this.show());
    state.on(["hidden", "order"], () => this.show());
    this.show();
  }

  private fits(number: number): boolean {
    return nameOf(this.state, number).toLowerCase().includes(this.filter.value.trim().toLowerCase());
  }

  private fitting(): number[] {
    return this.state.shown.order.filter((number) => this.fits(number));
  }

  private show(): void {
    const { hidden, order } = this.state.shown;
    this.summary.textContent = hidden.size ? `Bodies (${hidden.size} of ${order.length} hidden)` : `Bodies (${order.length})`;
    if (!(this.root as HTMLDetailsElement).open) return;
    const fitting = this.fitting().reverse();
    this.rows.replaceChildren(...fitting.slice(0, MOST).map((number) => element("div", { class: "body-row" },
      checkbox(nameOf(this.state, number), !hidden.has(number), (on) => hide(this.state, number, !on), `body-${number}`),
      order[order.length - 1] !== number && button("to the front", () => toFront(this.state, number), { class: "link", "aria-label": `Draw ${nameOf(this.state, number)} above all others` }))),
      fitting.length > MOST ? element("p", { class: "note" }, `${fitting.length - MOST} more: give a part of a name.`) : "");
  }
}

export function nameOf({ content }: State, number: number): string {
  return content.model.bodies.listed[number - 1]?.name ?? `body ${number}`;
}

export function hide(state: State, number: number, away: boolean): void {
  const hidden = new Set(state.shown.hidden);
  if (away) hidden.add(number);
  else hidden.delete(number);
  state.set({ hidden });
}

export function toFront(state: State, number: number): void {
  state.set({ order: [...state.shown.order.filter((other) => other !== number), number] });
}
