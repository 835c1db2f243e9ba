// What is read rather than looked at: outcome, warnings, increments, certificate, model.
import type { Content, Model } from "./content";
import { element, section, table } from "./dom";
import type { State } from "./state";
import { counted, number } from "./units";

export function verdict({ content }: State): HTMLElement {
  const { model, increments } = content;
  const worst = Math.max(0, ...increments.map((row) => row.certificate ?? 0)), tiles: [string, string][] = [];
  if (content.modal) {
    tiles.push(["natural modes", String(content.modes.length)], ["lowest frequency", content.modes.length ? number(Math.min(...content.modes.map((mode) => mode.frequency)), 5) : "–"]);
  } else {
    tiles.push([increments.length === 1 ? "increment" : "increments", String(increments.length)], ["worst figure of the certificate", increments.length ? number(worst, 2) : "–"]);
  }
  tiles.push(["degrees of freedom", model.dofs.toLocaleString("en")], elementsOf(model));
  if (model.contact_pairs) tiles.push(["contact pairs", model.contact_pairs.toLocaleString("en")]);
  if (content.timing.total != null) tiles.push(["time", `${number(content.timing.total, 3)} s`]);
  return element("section", { class: `card verdict ${content.verdict.level}`, id: "outcome", "aria-labelledby": "outcome-heading" },
    element("div", {}, element("h2", { id: "outcome-heading" }, content.verdict.heading), element("p", {}, content.verdict.text)),
    element("dl", { class: "tiles" }, ...tiles.map(([name, value]) => element("div", {}, element("dt", {}, name), element("dd", {}, value)))));
}

/** What the bodies are divided into: in space into tetrahedra, or also into hexahedra and wedges. */
function elementsOf(model: Model): [string, string] {
  if (model.finite_elements === undefined) return ["super-elements", (model.super_elements ?? 0).toLocaleString("en")];
  return [model.super_elements ? "cells" : "tetrahedra", (model.finite_elements + (model.super_elements ?? 0)).toLocaleString("en")];
}

export function warnings({ warnings: texts }: Content): HTMLElement | null {
  if (!texts.length) return null;
  return section("warnings", counted(texts.length, "warning"), element("p", { class: "note" }, "The model was solved as written; this may not be what was meant."),
    element("ul", { class: "warnings" }, ...texts.slice(0, 200).map((text) => element("li", {}, text))),
    texts.length > 200 && element("p", { class: "note" }, `${texts.length - 200} more are in summary.json.`));
}

/** The row of the increment that is shown is marked; a press of a number shows another one. */
export function increments(state: State): HTMLElement {
  const { content } = state, contact = content.totals.count > 0, errors = content.increments.some((row) => row.error !== null);
  const names = Object.keys(content.increments[0]?.factors ?? {}).slice(0, 4);
  const head = ["increment", "step", "at", ...names.map((name) => `factor ${name}`), "iterations", "residual", "certificate", ...(contact ? ["stick", "slip", "open"] : []), ...(errors ? ["estimated error"] : [])];
  const rows = content.increments.map((row) => {
    const press = element("button", { type: "button", class: "link", "aria-label": `Show increment ${row.number}` }, String(row.number));
    press.addEventListener("click", () => state.set({ increment: row.number }));
    return [press, row.step_name, number(row.reached, 4), ...names.map((name) => number(row.factors[name], 4)), row.coarse ? `${row.iterations} + ${row.coarse}` : String(row.iterations),
      number(row.residual, 2), number(row.certificate, 2), ...(contact ? [String(row.stick), String(row.slip), String(row.open)] : []), ...(errors ? [number(row.error, 3)] : [])];
  });
  const made = table(head, rows, { class: "numbers", "aria-label": "Increments" }), lines = [...made.querySelectorAll("tbody tr")];
  const markRow = () => lines.forEach((line, k) => (k === state.shown.increment - 1 ? line.setAttribute("aria-current", "true") : line.removeAttribute("aria-current")));
  state.on(["increment"], markRow);
  markRow();
  const failed = content.failed.map((row) => element("p", { class: "failed" }, `Step ${row.step}, increment ${row.increment} did not converge after ${counted(row.newton_iterations, "iteration")}; residual ${number(row.residual, 2)}.`));
  const coarse = content.increments.some((row) => row.coarse) ? "Iterations: those of the whole problem + those on problems with fewer pairs, which give its start. " : "";
  return section("increments", "Increments", made, ...failed, element("p", { class: "note" }, coarse + "Certificate: the worst of its figures, free of units."));
}

export function modes({ content }: State): HTMLElement {
  const mass = content.total_mass ?? 0, part = (value: number) => (mass > 0 ? `${number(value < 1e-12 * mass ? 0 : (100 * value) / mass, 3)} %` : "–");
  return section("modes", "Natural modes", table(["mode", "frequency (1 / time)", "body", "effective mass x", "effective mass y", "residual"],
    content.modes.map((mode) => [String(mode.mode), mode.rigid ? "0 (rigid)" : number(mode.frequency, 6), mode.body, part(mode.effective_mass[0]), part(mode.effective_mass[1]), number(mode.residual, 2)]),
    { class: "numbers", "aria-label": "Natural modes" }));
}

export function certificate(content: Content): HTMLElement {
  const one = content.increments.length === 1;
  return section("certificate", "Certificate",
    element("p", {}, "After every increment the solution is checked against the equations themselves, by other sums than those of the solver. Each figure is free of units: "
      + "it is divided by the largest force, or by the largest motion that this force causes. An increment in which a figure exceeds the tolerance of the model (1e-10 unless it sets another) "
      + "does not count as solved."),
    table(["check", "what the figure is", one ? "figure" : "worst figure", ...(one ? [] : ["in increment"])],
      content.certificate.map((row) => [element("strong", {}, row.question), `${row.meaning} In parts of the ${row.measure}.`, row.worst === 0 ? "0, exactly" : number(row.worst, 2), ...(one ? [] : [String(row.increment)])]),
      { class: "prose", "aria-label": "Certificate" }));
}

export function model(state: State): HTMLElement {
  const { content } = state, { model: m } = content, { units } = state.shown;
  const facts: [string, string][] = [];
  if (m.plane) facts.push(["plane", m.plane], ["thickness", units.text("length", m.thickness ?? null)]);
  facts.push(["nodes", m.nodes.toLocaleString("en")], ["degrees of freedom", m.dofs.toLocaleString("en")], elementsOf(m));
  if (m.contact_pairs) facts.push(["contact pairs", m.contact_pairs.toLocaleString("en")]);
  if (m.steps?.length && !content.modal) facts.push(["steps", m.steps.slice(0, 20).join(", ") + (m.steps.length > 20 ? " ..." : "")]);
  facts.push(["units", units.length && units.force ? `${units.length}, ${units.force}` : "those of the model file"]);
  if (content.memory) facts.push(["peak of memory", `${number(content.memory / 1e6, 3)} MB`]);
  const parts: (HTMLElement | null)[] = [element("dl", { class: "facts" }, ...facts.map(([name, value]) => element("div", {}, element("dt", {}, name), element("dd", {}, value))))];
  const list = (heading: string, all: number, head: string[], rows: string[][]) => {
    if (!rows.length) return;
    parts.push(element("h3", {}, heading), table(head, rows, { class: "numbers", "aria-label": heading }));
    if (all > rows.length) parts.push(element("p", { class: "note" }, `The first ${rows.length} of ${all}.`));
  };
  list("Bodies", m.bodies.count, ["body", "material", ...(content.space ? [m.bodies.listed.some((body) => body.super_elements) ? "cells" : "tetrahedra"] : ["super-elements", "finite elements"]), "nodes"], m.bodies.listed.map((body) => [body.name + (body.unbounded ? " (unbounded)" : ""),
    body.rigid ? "rigid" : body.materials.join(", "), ...(content.space ? [String(body.finite_elements + (body.super_elements ?? 0))] : [String(body.super_elements), String(body.finite_elements)]), body.nodes.toLocaleString("en")]));
  list("Materials", m.materials.count, ["material", "law", "Young's modulus", "Poisson's ratio", "density"], m.materials.listed.map((material) => [material.name, material.law,
    units.text("stress", material.young), number(material.poisson), number(material.density)]));
  list("Contacts", m.contacts.count, ["contact", "first side", "second side", "law"], m.contacts.listed.map((contact) => [contact.name, ...contact.between, contact.law]));
  list("Cracks and corners after the last increment", content.cracks.length, ["name", "kind", "factors"], content.cracks.map(({ name, kind, ...factors }) => [name, String(kind).replace("_", " "),
    Object.entries(factors).map(([key, value]) => `${key} = ${number(Number(value), 5)}`).join(", ")]));
  list("Numbers with error bars after the last increment", content.quantities.length, ["number", "value", "error bar", "wanted"], content.quantities.map((entry) => [entry.of, number(entry.value, 7),
    `± ${number(entry.bar, 3)}`, entry.wanted === null ? "–" : `${number(entry.wanted)}, ${entry.reached ? "reached" : "not reached"}`]));
  list("Meshes of the refinement", content.passes.length, ["pass", "degrees of freedom", "estimated error"], content.passes.map((pass, k) => [String(k + 1), pass.dofs.toLocaleString("en"), number(pass.error, 3)]));
  const timing = Object.entries(content.timing).filter(([, seconds]) => seconds !== null);
  list("Time", timing.length, ["stage", "seconds"], timing.map(([stage, seconds]) => [stage.replace("_", "-"), number(seconds, 3)]));
  return section("model", "Model", ...parts);
}
