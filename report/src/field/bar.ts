// The legend of colours below the picture.
import { css, element } from "../dom";
import { number, type Scale } from "../units";
import { colourMap, ENTRIES, gradient, type Levels } from "./colours";

export class ColourBar {
  readonly root = element("div", { class: "bar", role: "img" });
  private drawn: { name: string; ticks: [part: number, text: string][]; signed: boolean; bands: number } | null = null;

  show(name: string, scale: Scale, levels: Levels, bands: boolean, below: boolean, above: boolean): void {
    const count = Math.round((levels.high - levels.low) / levels.step), every = Math.max(1, Math.ceil(count / 6));
    const ticks: HTMLElement[] = [], texts: [number, string][] = [];
    const zero = Math.round(-levels.low / levels.step);
    for (let k = 0; k <= count; ++k) {
      if ((k - (levels.signed ? zero : 0)) % every !== 0) continue;
      const value = levels.low + k * levels.step;
      const shown = Math.abs(value) < 1e-9 * levels.step ? 0 : value * scale.factor;
      ticks.push(element("span", { class: "tick", style: `left:${(100 * k) / count}%` }, number(shown, 3)));
      texts.push([k / count, number(shown, 3)]);
    }
    const strip = element("div", { class: "strip" },
      element("span", { class: below ? "end more" : "end", title: below ? "there are smaller values" : "" }, below ? "◀" : ""),
      element("div", { class: "colours", style: `background:${gradient(levels.signed, bands ? levels.bands : 0, "to right")}` }),
      element("span", { class: above ? "end more" : "end", title: above ? "there are larger values" : "" }, above ? "▶" : ""));
    this.root.replaceChildren(element("div", { class: "bar-name" }, scale.unit ? `${name} (${scale.unit})` : name), strip, element("div", { class: "ticks" }, ...ticks));
    this.drawn = { name: scale.unit ? `${name} (${scale.unit})` : name, ticks: texts, signed: levels.signed, bands: bands ? levels.bands : 0 };
    this.root.setAttribute("aria-label", `Colours of ${name} from ${number(levels.low * scale.factor, 3)} to ${number(levels.high * scale.factor, 3)} ${scale.unit}`);
  }
  /** The same on a picture: `width` wide, 48 pixels high, from (`left`, `top`) on. */
  draw(context: CanvasRenderingContext2D, left: number, top: number, width: number): void {
    if (!this.drawn) return;
    const { name, ticks, signed, bands } = this.drawn, count = bands || 256;
    context.font = "13px system-ui, sans-serif";
    context.fillStyle = css("--ink");
    context.textAlign = "left";
    context.fillText(name, left, top + 12);
    const map = colourMap(signed);
    for (let k = 0; k < count; ++k) {
      const at = 4 * Math.round(((k + 0.5) / count) * (ENTRIES - 1));
      context.fillStyle = `rgb(${map[at]},${map[at + 1]},${map[at + 2]})`;
      context.fillRect(left + (width * k) / count, top + 18, width / count + 0.5, 12);
    }
    context.fillStyle = css("--ink");
    context.textAlign = "center";
    for (const [part, text] of ticks) context.fillText(text, left + part * width, top + 44);
  }
}
