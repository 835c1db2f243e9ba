// Curves over the increments: forces, states, factors, energies, reactions and the quantities of `output.history`.
import { element, labelled, section, select } from "../dom";
import type { Dimension, Series } from "../content";
import type { State } from "../state";
import { Chart, markIncrement, type Curve } from "./chart";

const COLOURS = ["--c1", "--c2", "--c3", "--c4", "--c5", "--c6", "--c7", "--c8"];
const DASHES = [undefined, [7, 4], [2, 3], [9, 3, 2, 3]];
const MOST = 8;

interface Group {
  name: string;
  y: string;
  dimension: Dimension;
  time?: number[];
  curves: { name: string; values: Series; colour?: string }[];
  note?: string;
}

export class HistoryPanel {
  readonly root: HTMLElement;
  private readonly groups: Group[];
  private group: Group;
  private readonly chart: Chart;
  private readonly note = element("p", { class: "note" });

  constructor(private readonly state: State) {
    this.groups = groupsOf(state);
    this.group = this.groups[0];
    const times = state.content.increments.map((row) => row.time);
    const nearest = (x: number) => times.reduce((best, time, i) => (Math.abs(time - x) < Math.abs(times[best] - x) ? i : best), 0);
    this.chart = new Chart({
      height: 300, x: state.content.time_axis, y: "", zero: true, legend: true, label: "Values over the increments",
      press: (index) => state.set({ increment: nearest((this.group.time ?? times)[index]) + 1 }), draw: (plot) => markIncrement(plot, times[state.shown.increment - 1]),
    });
    const chooser = select("history-group", this.groups.map((group, k) => [String(k), group.name]), "0", (k) => { this.group = this.groups[Number(k)]; this.show(); });
    this.root = section("history", "History", element("div", { class: "controls" }, labelled("Over the increments", chooser)), this.chart.root, this.note);
    state.on(["units"], () => this.show());
    state.on(["dark"], () => this.chart.build());
    state.on(["increment"], () => this.chart.redraw());
    this.show();
  }

  private show(): void {
    const { group } = this, { content, shown } = this.state;
    const largest = Math.max(0, ...group.curves.flatMap((curve) => curve.values.map((value) => Math.abs(value ?? 0))));
    const scale = group.dimension === "number" ? { factor: 1, unit: "" } : shown.units.scale(group.dimension, largest);
    const curves: Curve[] = group.curves.slice(0, MOST).map((curve, k) => ({
      name: curve.name, colour: curve.colour ?? COLOURS[k % COLOURS.length], dash: DASHES[Math.floor(k / 2) % DASHES.length],
      values: curve.values.map((value) => (value === null ? null : value * scale.factor)),
    }));
    this.chart.show(group.time ?? content.increments.map((row) => row.time), curves, { y: scale.unit ? `${group.y} (${scale.unit})` : group.y });
    const one = content.increments.length === 1 ? "There is one increment only: its values are marked. " : "Click on an increment to show it. ";
    this.note.textContent = one + (group.note ?? "");
  }
}

function groupsOf({ content }: State): Group[] {
  const axes: ("x" | "y" | "z")[] = content.space ? ["x", "y", "z"] : ["x", "y"], rows = content.increments, groups: Group[] = [], { totals, reactions, history } = content;
  if (totals.count) {
    const many = totals.count > totals.curves.length ? `Of ${totals.count} contacts those ${totals.curves.length} with the largest forces are in this page.` : "";
    const names = (text: string, name: string) => (totals.count > 1 ? `${name}, ${text}` : text);
    const loaded = totals.contacts.filter(({ name }) => totals.curves.includes(name)), first = loaded.slice(0, MOST / 2);
    groups.push({ name: "forces of contacts", y: "force", dimension: "force", note: many, curves: first.flatMap((contact) => [
      { name: names("normal", contact.name), values: contact.normal_force }, { name: names("tangential", contact.name), values: contact.tangential_force }]) });
    groups.push({ name: "largest pressure", y: "pressure", dimension: "stress", note: many, curves: loaded.map((contact) => ({ name: contact.name, values: contact.max_pressure })) });
    groups.push({ name: "pairs in each state", y: "pairs", dimension: "number", curves: (["stick", "slip", "open"] as const).map((state) => (
      { name: state, colour: `--${state}`, values: rows.map((row) => row[state]) })) });
  }
  const factors = Object.keys(rows[rows.length - 1]?.factors ?? {});
  if (factors.length) groups.push({ name: "load factors", y: "factor", dimension: "number", note: factors.length > MOST ? `The first ${MOST} of ${factors.length} are shown.` : "",
    curves: factors.map((name) => ({ name, values: rows.map((row) => row.factors[name] ?? null) })) });
  if (rows.some((row) => row.energy)) groups.push({ name: "energies", y: "energy", dimension: "energy", curves: (["external", "elastic", "friction"] as const).map((kind) => (
    { name: { external: "work of the loads", elastic: "elastic energy", friction: "dissipated by friction" }[kind], values: rows.map((row) => row.energy?.[kind] ?? null) })) });
  if (reactions.count) groups.push({ name: "reactions", y: "force", dimension: "force", note: reactions.count > MOST / 2 ? `Of ${reactions.count} supports those with the largest reactions are shown.` : "",
    curves: reactions.supports.filter(({ name }) => reactions.curves.includes(name)).slice(0, MOST / 2).flatMap((support) => axes.map((axis) => ({ name: `${support.name}, ${axis}`, values: support[axis]! }))) });
  for (const column of history?.columns ?? []) groups.push({ name: `history: ${column.name}`, y: column.name, dimension: "number", time: history!.time, note: history!.note,
    curves: [{ name: column.name, values: column.values }] });
  return groups;
}
