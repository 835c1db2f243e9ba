// Title, units and the choice between light and dark.
import { element, labelled, select } from "./dom";
import type { State } from "./state";
import { Units } from "./units";

const UNITS: [string, string][] = [["m", "N"], ["m", "kN"], ["m", "MN"], ["mm", "N"], ["mm", "kN"], ["cm", "N"], ["cm", "kN"], ["um", "mN"], ["km", "MN"]];

export function header(state: State): HTMLElement {
  const { content } = state, given = content.units;
  const options: [string, string][] = [["", "no names"], ...UNITS.map((pair): [string, string] => [pair.join(","), pair.join(", ")])];
  if (given && !options.some(([value]) => value === given.join(","))) options.push([given.join(","), given.join(", ")]);
  const units = select("units", options, given ? given.join(",") : "", (value) => {
    const [length, force] = value ? value.split(",") : [null, null];
    state.set({ units: new Units(length, force) });
  });
  units.title = "Units of the model file: a model has none of its own, as long as they are consistent";
  const theme = select("theme", [["system", "as the system"], ["light", "light"], ["dark", "dark"]], "system", (value) => applyTheme(state, value));
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => applyTheme(state, theme.value));
  return element("header", {},
    element("div", { class: "titles" }, element("p", { class: "kind" }, `Scabo ${content.version} · results in ${content.directory}`), element("h1", {}, content.title || content.directory)),
    element("div", { class: "controls" }, labelled("Units of the model", units), labelled("Colours", theme)));
}

export function applyTheme(state: State, chosen: string): void {
  const dark = chosen === "dark" || (chosen === "system" && matchMedia("(prefers-color-scheme: dark)").matches);
  document.documentElement.dataset.theme = dark ? "dark" : "light";
  state.set({ dark });
}

/** Links to the parts of the page. */
export function navigation(sections: HTMLElement[]): HTMLElement {
  return element("nav", { "aria-label": "Parts of this page" }, ...sections.map((part) => element("a", { href: `#${part.id}` }, part.querySelector("h2")!.textContent!)));
}
