// The page: reads what it is filled with and puts its parts together.
import "uplot/dist/uPlot.min.css";
import "./style.css";
import { ContactPanel } from "./charts/contacts";
import { ConvergencePanel } from "./charts/convergence";
import { HistoryPanel } from "./charts/history";
import { LoopPanel } from "./charts/loops";
import { readContent, type Content } from "./content";
import { element } from "./dom";
import { FieldPanel } from "./field/panel";
import { applyTheme, header, navigation } from "./header";
import { IncrementBar } from "./increment_bar";
import { MapPanel } from "./space/maps";
import { SpacePanel } from "./space/panel";
import { State } from "./state";
import { certificate, increments, model, modes, verdict, warnings } from "./tables";
import { TotalsPanel } from "./totals";
import { Units } from "./units";

declare global {
  interface Window {
    scaboReport: { ready: Promise<void>; state: State; field: FieldPanel | null; contacts: ContactPanel | null; space: SpacePanel | null; maps: MapPanel | null };
  }
}

function firstQuantity({ field, modal, space }: Content): string {
  const keys = (field ?? space)?.quantities.map((quantity) => quantity.key) ?? [];
  if (modal && keys.includes("ux")) return "displacement";
  return ["von_mises", "principal_1", "xx"].find((key) => keys.includes(key)) ?? (keys.includes("ux") ? "displacement" : keys[0] ?? "");
}

/** The contact that carries most after the last increment. */
function firstContact({ pairs, space, totals }: Content): number {
  const names = pairs?.names ?? space?.faces.map(({ name }) => name);
  if (!names || !totals.contacts.length) return 0;
  const last = (series: (number | null)[]) => Math.abs(series[series.length - 1] ?? 0);
  const most = totals.contacts.reduce((best, contact) => (last(contact.normal_force) > last(best.normal_force) ? contact : best));
  return Math.max(0, names.indexOf(most.name));
}

let before = ""; // of printing, the choice of colours

/** On paper the colours are light. */
function printing(begins: boolean, state: State, field: FieldPanel | null): void {
  const theme = document.getElementById("theme") as HTMLSelectElement;
  if (begins) before = theme.value;
  applyTheme(state, begins ? "light" : before);
  field?.print(begins);
}

async function start(): Promise<void> {
  const content = readContent(), page = document.getElementById("page")!;
  const count = content.modal ? content.modes.length : content.increments.length;
  const [length, force] = content.units ?? [null, null];
  const state = new State(content, {
    increment: content.modal ? 1 : count, quantity: firstQuantity(content), magnification: (content.field ?? content.space)?.magnification ?? 0, range: "increment", bands: true, mesh: false,
    elements: (content.model.super_elements ?? 0) <= 2000, undeformed: true, states: true, contact: firstContact(content), pair: -1, picked: null,
    hidden: new Set(), order: Array.from({ length: content.field?.bodies ?? 0 }, (_, k) => k + 1), extremes: true, mechanism: false, line: null,
    units: new Units(length, force), dark: false,
  });
  applyTheme(state, "system");
  let field: FieldPanel | null = null;
  const bar = count ? new IncrementBar(state, (part) => field?.setSwing(part)) : null;
  field = content.field ? new FieldPanel(state, { step: (by) => bar!.step(by), play: () => bar!.play() }) : null;
  const contacts = content.pairs ? new ContactPanel(state) : null;
  const space = content.space ? new SpacePanel(state, { step: (by) => bar?.step(by), play: () => bar?.play() }) : null;
  const maps = content.space?.faces.length ? new MapPanel(state) : null;
  if (space && maps) space.placeOfPair = (pair) => maps.placeOf(pair);
  const [picture, beside] = [field?.root ?? space?.root, contacts?.root ?? maps?.root];
  const side: (HTMLElement | null)[] = [content.convergence && count ? new ConvergencePanel(state).root : null, !content.modal && count ? new HistoryPanel(state).root : null];
  const loops = content.modal ? null : LoopPanel.of(state)?.root ?? null;
  const outcome = verdict(state);
  let summary = model(state);
  const alerts = warnings(content);
  const totals = content.modal ? null : TotalsPanel.of(state)?.root ?? null;
  const rest = [totals, content.modal ? modes(state) : count ? increments(state) : null, content.certificate.length ? certificate(content) : null, summary];
  const parts = [alerts, picture, beside, ...side, loops, ...rest].filter((part): part is HTMLElement => !!part);
  page.append(header(state), navigation(parts), element("main", {}, outcome, alerts ?? "", bar?.root ?? "",
    picture || beside ? element("div", { class: picture && beside ? "wide-and-narrow" : "single" }, ...[picture, beside].filter((part): part is HTMLElement => !!part)) : "",
    !picture && count ? element("p", { class: "card note" }, "The run wrote no fields (`output` in the model file), so that there is no picture of them.") : "",
    side.some((part) => part) ? element("div", { class: side.every((part) => part) ? "halves" : "single" }, ...side.filter((part): part is HTMLElement => !!part)) : "", loops ?? "", ...rest.filter((part): part is HTMLElement => !!part)),
    element("footer", {}, `Written by Scabo ${content.version} (scabo report). This file asks no network for anything. Values are those of the results directory, to seven digits; `
      + "between the points of the results the picture interpolates."));
  state.on(["units"], () => {
    const renewed = model(state);
    summary.replaceWith(renewed);
    summary = renewed;
  });
  let made!: () => void;
  window.scaboReport = { ready: new Promise((resolve) => (made = resolve)), state, field, contacts, space, maps };
  try {
    await Promise.all([field?.start(), contacts?.load(), space?.start(), maps?.load()]);
  } catch (error) {
    const webgl = /WebGL/i.test(String(error));
    picture?.querySelectorAll<HTMLElement>(".controls, .bar, .readout").forEach((part) => (part.hidden = true)); // they would change nothing
    picture?.querySelector(".stage")?.replaceWith(element("p", { class: "failed", role: "alert" }, webgl
      ? "This browser has no WebGL 2, which the picture of the field needs. Everything else on this page works without it." : `The picture could not be drawn: ${String(error)}`));
    if (!webgl) throw error;
  }
  addEventListener("beforeprint", () => printing(true, state, field));
  addEventListener("afterprint", () => printing(false, state, field));
  document.documentElement.dataset.ready = "true";
  made();
}

start().catch((error: unknown) => {
  document.getElementById("page")!.append(element("p", { class: "failed", role: "alert" }, `This report could not be shown: ${String(error)}`));
  throw error;
});
