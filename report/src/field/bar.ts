// The legend of colours below the picture.
import { element } from "../dom";
import { number, type Scale } from "../units";
import { gradient, type Levels } from "./colours";

export class ColourBar {
  readonly root = element("div", { class: "bar", role: "img" });

  show(name: string, scale: Scale, levels: Levels, bands: boolean, below: boolean, above: boolean): void {
    const count = Math.round((levels.high - levels.low) / levels.step), every = Math.max(1, Math.ceil(count / 6));
    const ticks: HTMLElement[] = [];
    const zero = Math.round(-levels.low / levels.step);
    for (let k = 0; k <= count; ++k) {
      if ((k - (levels.signed ? zero : 0)) % every !== 0) continue;
      const value = levels.low + k * levels.step;
      const shown = Math.abs(value) < 1e-9 * levels.step ? 0 : value * scale.factor;
      ticks.push(element("span", { class: "tick", style: `left:${(100 * k) / count}%` }, number(shown, 3)));
    }
    const strip = element("div", { class: "strip" },
      element("span", { class: below ? "end more" : "end", title: below ? "there are smaller values" : "" }, below ? "◀" : ""),
      element("div", { class: "colours", style: `background:${gradient(levels.signed, bands ? levels.bands : 0, "to right")}` }),
      element("span", { class: above ? "end more" : "end", title: above ? "there are larger values" : "" }, above ? "▶" : ""));
    this.root.replaceChildren(element("div", { class: "bar-name" }, scale.unit ? `${name} (${scale.unit})` : name), strip, element("div", { class: "ticks" }, ...ticks));
    this.root.setAttribute("aria-label", `Colours of ${name} from ${number(levels.low * scale.factor, 3)} to ${number(levels.high * scale.factor, 3)} ${scale.unit}`);
  }
}
