// Totals of contacts, reactions and quantities of `output.history` at the increment that is shown, and all of them as tables.
import { button, element, section, table } from "./dom";
import { fileName, saveCsv } from "./files";
import type { Dimension, Series } from "./content";
import type { State } from "./state";
import { number } from "./units";

const OF_CONTACTS: [key: "normal_force" | "tangential_force" | "max_pressure" | "max_gap", name: string, dimension: Dimension][] = [
  ["normal_force", "normal force", "force"], ["tangential_force", "tangential force", "force"], ["max_pressure", "largest pressure", "stress"], ["max_gap", "largest gap", "length"]];
const COUNTS = ["stick", "slip", "open"] as const;

export class TotalsPanel {
  readonly root: HTMLElement;
  private readonly tables = element("div");

  private constructor(private readonly state: State) {
    const { totals, reactions, history } = state.content;
    this.root = section("totals", "Totals", element("div", { class: "controls" }, element("span", { class: "label" }, "Of all increments:"),
      totals.count > 0 && button("Contacts as CSV", () => this.saveContacts(), { id: "contacts-csv" }),
      reactions.count > 0 && button("Reactions as CSV", () => this.saveReactions(), { id: "reactions-csv" }),
      history && button("History as CSV", () => this.saveHistory(), { id: "history-csv" })), this.tables);
    state.on(["increment", "units"], () => this.show());
    this.show();
  }

  /** Null where a run has none of them. */
  static of(state: State): TotalsPanel | null {
    const { totals, reactions, history } = state.content;
    return state.content.increments.length && (totals.count || reactions.count || history) ? new TotalsPanel(state) : null;
  }

  private get axes(): ("x" | "y" | "z")[] {
    return this.state.content.space ? ["x", "y", "z"] : ["x", "y"];
  }

  private show(): void {
    const { content, shown } = this.state, at = shown.increment - 1, { units } = shown, { totals, reactions, history } = content;
    const parts: (Node | string)[] = [], more = (all: number, listed: number) => (all > listed ? element("p", { class: "note" }, `The ${listed} of ${all} with the largest forces.`) : "");
    if (totals.count) {
      parts.push(element("h3", {}, "Contacts"), table(["contact", ...OF_CONTACTS.map(([, name]) => name), ...COUNTS], totals.contacts.map((contact) => [contact.name,
        ...OF_CONTACTS.map(([key, , dimension]) => units.text(dimension, contact[key][at], 5)), ...COUNTS.map((key) => String(contact[key][at] ?? "–"))]),
        { class: "numbers", "aria-label": "Totals of contacts" }), more(totals.count, totals.contacts.length));
    }
    if (reactions.count) {
      parts.push(element("h3", {}, "Reactions"), table(["support", ...this.axes], reactions.supports.map((support) => [support.name, ...this.axes.map((axis) => units.text("force", support[axis]![at], 5))]),
        { class: "numbers", "aria-label": "Reactions" }), more(reactions.count, reactions.supports.length));
    }
    if (history) {
      const time = content.increments[at].time, row = history.time.reduce((best, other, k) => (Math.abs(other - time) < Math.abs(history.time[best] - time) ? k : best), 0);
      const known = (values: Series) => values.filter((value): value is number => value !== null);
      parts.push(element("h3", {}, "Quantities of output.history"), table(["quantity", "value", "smallest", "largest"], history.columns.map(({ name, values }) => [name, number(values[row], 6),
        ...[Math.min, Math.max].map((most) => number(known(values).length ? known(values).reduce((a, b) => most(a, b)) : null, 6))]), { class: "numbers", "aria-label": "Quantities of output.history" }));
    }
    this.tables.replaceChildren(...parts);
    this.tables.dataset.increment = String(shown.increment);
  }

  private saveContacts(): void {
    const { content } = this.state, keys = [...OF_CONTACTS.map(([key]) => key), ...COUNTS];
    saveCsv(fileName(content.directory, "contacts"), ["step", "increment", "time", "contact", ...keys], content.increments.flatMap((row, k) =>
      content.totals.contacts.map((contact) => [row.step, row.increment, row.time, contact.name, ...keys.map((key) => contact[key][k])])));
  }

  private saveReactions(): void {
    const { content } = this.state;
    saveCsv(fileName(content.directory, "reactions"), ["step", "increment", "time", "support", ...this.axes], content.increments.flatMap((row, k) =>
      content.reactions.supports.map((support) => [row.step, row.increment, row.time, support.name, ...this.axes.map((axis) => support[axis]![k])])));
  }

  private saveHistory(): void {
    const { directory, history } = this.state.content;
    saveCsv(fileName(directory, "history"), ["time", ...history!.columns.map(({ name }) => name)], history!.time.map((time, k) => [time, ...history!.columns.map(({ values }) => values[k])]));
  }
}
