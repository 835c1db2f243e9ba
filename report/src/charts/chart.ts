// A curve chart of uPlot in the colours of the page.
import uPlot from "uplot";
import { css, element } from "../dom";
import { number } from "../units";

export interface Curve {
  name: string;
  colour: string; // name of a CSS variable
  dash?: number[];
  values: (number | null)[] | Float32Array;
  points?: boolean;
}

export interface ChartOptions {
  height: number;
  x: string;
  y: string;
  above?: boolean; // the name of y stands above the curves, where it has room
  part?: [number, number] | null; // of x that is shown at first
  logarithmic?: boolean;
  zero?: boolean; // zero is in the range of y
  whole?: boolean; // x has whole numbers only
  legend?: boolean;
  sync?: string;
  label: string; // for those who cannot see it
  hover?(index: number | null): void;
  press?(index: number): void;
  draw?(chart: uPlot): void; // above the curves
}

export class Chart {
  readonly root = element("div", { class: "chart", role: "img" });
  private readonly name = element("div", { class: "chart-name" });
  private plot: uPlot | null = null;
  private data: uPlot.AlignedData = [[]];
  private width = 0;
  private quiet = false;

  constructor(private options: ChartOptions) {
    this.root.setAttribute("aria-label", options.label);
    if (options.above) this.root.append(this.name);
    new ResizeObserver(() => {
      const width = Math.floor(this.root.clientWidth);
      if (!width || width === this.width) return;
      this.width = width;
      if (this.plot) this.plot.setSize({ width, height: this.options.height });
      else this.build();
    }).observe(this.root);
  }

  private curves: Curve[] = [];

  show(x: number[] | Float32Array, curves: Curve[], changes: Partial<ChartOptions> = {}): void {
    this.name.textContent = changes.y ?? this.options.y;
    const same = this.plot && curves.length === this.curves.length && Object.keys(changes).length === 0
      && curves.every((curve, k) => curve.name === this.curves[k].name && curve.colour === this.curves[k].colour);
    this.options = { ...this.options, ...changes };
    this.curves = curves;
    this.data = [Array.from(x), ...curves.map((curve) => Array.from(curve.values as ArrayLike<number | null>))] as uPlot.AlignedData;
    if (same) this.plot!.setData(this.data);
    else this.build();
  }

  /** Lines and texts again, after a change of colours. */
  build(): void {
    if (!this.width) return;
    const { options } = this;
    this.plot?.destroy();
    const axis = (name: string, side: number, size: number): uPlot.Axis => ({
      label: name || undefined, side, size, labelSize: 20, gap: 4, font: "12px system-ui, sans-serif", labelFont: "12px system-ui, sans-serif", stroke: () => css("--soft"),
      grid: { stroke: () => css("--grid"), width: 1 }, ticks: { stroke: () => css("--grid"), width: 1, size: 5 },
      values: (_, splits) => splits.map((value) => (value === null ? "" : side === 3 && options.logarithmic ? power(value) : number(value, 5))),
    });
    const x: uPlot.Axis = { ...axis(options.x, 2, 34), space: 50, ...(options.whole ? { incrs: [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000, 1e5] } : {}) };
    const single = this.data[0].length === 1;
    this.plot = new uPlot({
      width: this.width, height: options.height, legend: { show: options.legend ?? false }, padding: [10, 12, 0, 0],
      scales: {
        x: { time: false, range: (_, low, high) => this.spanned(low, high) },
        y: options.logarithmic ? { distr: 3, range: (_, low, high) => [10 ** Math.floor(Math.log10(low || 1e-17) - 0.2), 10 ** Math.ceil(Math.log10(high || 1) + 0.2)] }
          : { range: (_, low, high) => around(low, high, options.zero ?? false) },
      },
      axes: [x, { ...axis(options.above ? "" : options.y, 3, 58), ...(options.logarithmic ? { splits: decades, filter: (_: uPlot, splits: number[]) => splits } : { space: 28 }) }],
      series: [{ label: options.x, value: (_, value) => number(value, 5) }, ...this.curves.map((curve): uPlot.Series => ({
        label: curve.name, stroke: () => css(curve.colour), width: 1.6, dash: curve.dash, spanGaps: false,
        points: { show: curve.points ?? (single || this.data[0].length <= 40), size: 5, fill: () => css(curve.colour) },
        value: (_, value) => number(value, 5),
      }))],
      cursor: {
        drag: { x: true, y: false, setScale: true }, y: false, points: { size: 9 }, focus: { prox: 30 },
        ...(options.sync ? { sync: { key: options.sync, setSeries: false } } : {}),
        ...(options.press ? { bind: { click: (plot: uPlot) => () => { if (plot.cursor.idx != null) options.press!(plot.cursor.idx); return null; } } } : {}),
      },
      hooks: {
        setCursor: [(plot) => {
          if (this.quiet || !options.hover) return;
          options.hover(plot.cursor.left! < 0 || plot.cursor.idx == null ? null : plot.cursor.idx);
        }],
        draw: [(plot) => options.draw?.(plot)],
      },
    }, this.data, this.root);
  }

  /** The whole of x, the part that is shown at first in its place, or what was chosen with the mouse. */
  private spanned(low: number, high: number): [number, number] {
    const xs = this.data[0], { part } = this.options;
    if (low === high) return [low - 0.5, high + 0.5];
    return part && low === xs[0] && high === xs[xs.length - 1] ? part : [low, high];
  }

  redraw(): void {
    this.plot?.redraw(false, false);
  }

  /** Puts the cursor on a value, or takes it away, without telling anybody. */
  point(index: number | null): void {
    if (!this.plot) return;
    this.quiet = true;
    const left = index === null ? -10 : this.plot.valToPos(this.data[0][index], "x");
    this.plot.setCursor({ left, top: index === null ? -10 : 0.5 * this.plot.over.clientHeight }, false);
    this.quiet = false;
  }

  get over(): HTMLElement | null {
    return this.plot?.over ?? null;
  }

  positionOf(index: number): number | null {
    return this.plot ? this.plot.valToPos(this.data[0][index], "x") : null;
  }
}

/** Powers of ten, at most about eight of them. */
function decades(plot: uPlot): number[] {
  const first = Math.ceil(Math.log10(plot.scales.y.min!) - 1e-9), last = Math.floor(Math.log10(plot.scales.y.max!) + 1e-9), every = Math.max(1, Math.ceil((last - first) / 8));
  const powers: number[] = [];
  for (let k = Math.ceil(first / every) * every; k <= last; k += every) powers.push(10 ** k);
  return powers;
}

function power(value: number): string {
  const exponent = Math.log10(value);
  return Math.abs(exponent - Math.round(exponent)) < 1e-6 ? `10${String(Math.round(exponent)).replace(/[-0-9]/g, (d) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(d)])}` : "";
}

function around(low: number | null, high: number | null, zero: boolean): [number, number] {
  if (low === null || high === null || !Number.isFinite(low) || !Number.isFinite(high)) return [0, 1];
  if (zero) [low, high] = [Math.min(low, 0), Math.max(high, 0)];
  if (high - low <= 1e-9 * Math.max(Math.abs(low), Math.abs(high))) {
    const half = Math.max(Math.abs(high), Math.abs(low)) || 1;
    return zero || low === 0 ? [Math.min(low, -0.1 * half), Math.max(high, 0.1 * half) * 1.1] : [low - 0.1 * half, high + 0.1 * half];
  }
  const room = 0.08 * (high - low);
  return [low - room, high + room];
}

/** A vertical line at the increment that is shown. */
export function markIncrement(plot: uPlot, x: number): void {
  const at = plot.valToPos(x, "x", true), { ctx, bbox } = plot;
  if (!(at >= bbox.left && at <= bbox.left + bbox.width)) return;
  ctx.save();
  ctx.strokeStyle = css("--accent");
  ctx.lineWidth = devicePixelRatio;
  ctx.setLineDash([4 * devicePixelRatio, 3 * devicePixelRatio]);
  ctx.beginPath();
  ctx.moveTo(at, bbox.top);
  ctx.lineTo(at, bbox.top + bbox.height);
  ctx.stroke();
  ctx.restore();
}
