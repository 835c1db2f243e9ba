// Elements of the page. Texts become text nodes, never markup: titles and names come from the user.

type Child = Node | string | null | undefined | false;
type Attributes = Record<string, string | number | boolean | null | undefined>;

export function element<K extends keyof HTMLElementTagNameMap>(tag: K, attributes: Attributes = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  const made = document.createElement(tag);
  assign(made, attributes);
  made.append(...children.filter((child): child is Node | string => child !== null && child !== undefined && child !== false));
  return made;
}

export function svg(tag: string, attributes: Attributes = {}): SVGElement {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
  assign(made, attributes);
  return made;
}

function assign(made: Element, attributes: Attributes): void {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === true) made.setAttribute(name, "");
    else if (value !== false && value !== null && value !== undefined) made.setAttribute(name, String(value));
  }
}

/** A control below or beside its label. */
export function labelled(text: string, control: HTMLElement, kind = "control"): HTMLLabelElement {
  return element("label", { class: kind }, element("span", { class: "label" }, text), control);
}

export function checkbox(text: string, checked: boolean, change: (on: boolean) => void, id: string): HTMLLabelElement {
  const box = element("input", { type: "checkbox", id, checked });
  box.addEventListener("change", () => change(box.checked));
  return element("label", { class: "check" }, box, element("span", {}, text));
}

export function select(id: string, options: [value: string, text: string][], chosen: string, change: (value: string) => void): HTMLSelectElement {
  const control = element("select", { id });
  for (const [value, text] of options) control.append(element("option", { value, selected: value === chosen }, text));
  control.addEventListener("change", () => change(control.value));
  return control;
}

export function button(text: string, press: () => void, attributes: Attributes = {}): HTMLButtonElement {
  const made = element("button", { type: "button", ...attributes }, text);
  made.addEventListener("click", press);
  return made;
}

export function section(id: string, heading: string, ...children: Child[]): HTMLElement {
  return element("section", { id, class: "card", "aria-labelledby": `${id}-heading` }, element("h2", { id: `${id}-heading` }, heading), ...children);
}

export function table(head: string[], rows: (string | Node)[][], attributes: Attributes = {}): HTMLDivElement {
  const body = element("tbody", {}, ...rows.map((row) => element("tr", {}, ...row.map((cell) => element("td", {}, cell)))));
  return element("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": String(attributes["aria-label"] ?? "table") },
    element("table", attributes, element("thead", {}, element("tr", {}, ...head.map((text) => element("th", { scope: "col" }, text)))), body));
}

export function css(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}
