// Names and powers of ten, as python/scabo/plot/units.py: a model has no units of its own.
import type { Dimension } from "./content";

const METRES: Record<string, number> = { m: 1, cm: 1e-2, mm: 1e-3, um: 1e-6, km: 1e3 };
const NEWTONS: Record<string, number> = { N: 1, kN: 1e3, MN: 1e6, mN: 1e-3 };
const PREFIXES: [string, number][] = [["n", 1e-9], ["µ", 1e-6], ["m", 1e-3], ["", 1], ["k", 1e3], ["M", 1e6], ["G", 1e9]];
const SI: Partial<Record<Dimension, [string, string]>> = { length: ["m", "nµm"], force: ["N", "mkMG"], stress: ["Pa", "mkMG"], energy: ["J", "µmkMG"] };
const PLAIN: Record<Dimension, string> = { length: "length", force: "force", stress: "force / length²", energy: "force × length", number: "" };

export interface Scale {
  factor: number;
  unit: string;
}

export class Units {
  constructor(readonly length: string | null, readonly force: string | null) {}

  /** For values of up to `largest` in size. */
  scale(dimension: Dimension, largest: number): Scale {
    largest = Number.isFinite(largest) ? Math.abs(largest) : 0;
    const length = METRES[this.length ?? ""], force = NEWTONS[this.force ?? ""], si = SI[dimension];
    if (si && length && force) {
      const base = { length, force, stress: force / length ** 2, energy: force * length, number: 1 }[dimension];
      const allowed = PREFIXES.filter(([prefix]) => prefix === "" || si[1].includes(prefix));
      const fitting = allowed.filter(([, size]) => largest * base >= (size <= 1 ? 0.0999 : 0.999) * size);
      const [prefix, size] = largest > 0 ? (fitting.length ? fitting[fitting.length - 1] : allowed[0]) : ["", 1];
      return { factor: base / size, unit: prefix + si[0] };
    }
    const named: Partial<Record<Dimension, string | null>> = { length: this.length, force: this.force };
    if (this.length && this.force) {
      named.stress = `${this.force}/${this.length}²`;
      named.energy = `${this.force}·${this.length}`;
    }
    const unit = named[dimension] || PLAIN[dimension];
    if (largest === 0 || (largest >= 1e-2 && largest < 1e4)) return { factor: 1, unit };
    const power = 3 * Math.floor(Math.log10(largest) / 3 + 1e-9);
    return { factor: 10 ** -power, unit: `10${superscript(power)} ${unit}`.trim() };
  }

  /** `1.25 MPa`: one value with its own prefix. */
  text(dimension: Dimension, value: number | null | undefined, digits = 4): string {
    if (value === null || value === undefined || !Number.isFinite(value)) return "–";
    const scale = this.scale(dimension, value);
    return `${number(value * scale.factor, digits)} ${scale.unit}`.trim();
  }
}

function superscript(power: number): string {
  return String(power).replace(/[-0-9]/g, (digit) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(digit)]);
}

/** With so many significant digits; a true minus. */
export function number(value: number | null | undefined, digits = 4): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  const text = size < 1e-3 || size >= 1e6 ? tidy(value.toExponential(digits - 1)) : String(Number(value.toPrecision(digits)));
  return text.replace(/^-/, "−");
}

function tidy(text: string): string {
  const [mantissa, power] = text.split("e");
  return `${String(Number(mantissa))}·10${superscript(Number(power))}`;
}

export function counted(count: number, noun: string): string {
  return `${count.toLocaleString("en")} ${noun}${count === 1 ? "" : "s"}`;
}
