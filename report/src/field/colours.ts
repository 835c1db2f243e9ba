// Colours of values. Magnitudes: viridis (M. Niccoli, S. van der Walt; CC0); signed values: from blue through white to red,
// after ColorBrewer's RdBu (Apache-2.0). Both can be told apart with any colour vision.

const MAGNITUDE = ["#440154", "#482878", "#3e4a89", "#31688e", "#26828e", "#1f9e89", "#35b779", "#6dcd59", "#b4de2c", "#fde725"];
const SIGNED = ["#053061", "#2166ac", "#4393c3", "#92c5de", "#d1e5f0", "#f7f7f7", "#fddbc7", "#f4a582", "#d6604d", "#b2182b", "#67001f"];
export const ENTRIES = 256;

function rgb(text: string): [number, number, number] {
  return [1, 3, 5].map((at) => parseInt(text.slice(at, at + 2), 16)) as [number, number, number];
}

/** RGBA bytes of a map from the least to the greatest value. */
export function colourMap(signed: boolean): Uint8Array {
  const stops = (signed ? SIGNED : MAGNITUDE).map(rgb);
  const bytes = new Uint8Array(4 * ENTRIES);
  for (let i = 0; i < ENTRIES; ++i) {
    const at = (i / (ENTRIES - 1)) * (stops.length - 1), low = Math.min(Math.floor(at), stops.length - 2), part = at - low;
    for (let k = 0; k < 3; ++k) bytes[4 * i + k] = Math.round(stops[low][k] * (1 - part) + stops[low + 1][k] * part);
    bytes[4 * i + 3] = 255;
  }
  return bytes;
}

/** The same for the style of an element, from bottom or left, in bands or continuous. */
export function gradient(signed: boolean, bands: number, direction: string): string {
  const bytes = colourMap(signed);
  const colour = (part: number) => {
    const i = Math.round(Math.min(Math.max(part, 0), 1) * (ENTRIES - 1));
    return `rgb(${bytes[4 * i]},${bytes[4 * i + 1]},${bytes[4 * i + 2]})`;
  };
  const stops: string[] = [];
  if (bands > 0) for (let b = 0; b < bands; ++b) stops.push(`${colour((b + 0.5) / bands)} ${(100 * b) / bands}% ${(100 * (b + 1)) / bands}%`);
  else for (let i = 0; i <= 32; ++i) stops.push(`${colour(i / 32)} ${(100 * i) / 32}%`);
  return `linear-gradient(${direction}, ${stops.join(", ")})`;
}

export interface Levels {
  low: number;
  high: number;
  step: number;
  bands: number;
  signed: boolean;
}

/** Round levels of about ten bands; symmetric about zero where values lie on both sides of it. */
export function levels(low: number, high: number): Levels {
  const largest = Math.max(Math.abs(low), Math.abs(high));
  if (!(largest > 0)) return { low: 0, high: 1, step: 0.1, bands: 10, signed: false };
  const signed = low < -0.05 * high && high > 0.05 * -low;
  if (signed) {
    const step = roundStep((2 * largest) / 10);
    const count = Math.max(1, Math.ceil(largest / step - 1e-9));
    return { low: -count * step, high: count * step, step, bands: 2 * count, signed };
  }
  if (high - low <= 1e-6 * largest) {
    const middle = 0.5 * (low + high);
    return { low: middle - 0.05 * largest, high: middle + 0.05 * largest, step: 0.1 * largest, bands: 1, signed: false };
  }
  if (low >= 0 ? low < 0.6 * high : high > 0.05 * -low) low = Math.min(low, 0);
  if (high <= 0 && high > 0.6 * low) high = 0;
  const step = roundStep((high - low) / 10);
  const first = Math.floor(low / step + 1e-9), last = Math.ceil(high / step - 1e-9);
  return { low: first * step, high: last * step, step, bands: last - first, signed: false };
}

function roundStep(wanted: number): number {
  const power = 10 ** Math.floor(Math.log10(wanted));
  return power * (wanted / power < 1.5 ? 1 : wanted / power < 2.2 ? 2 : wanted / power < 3.5 ? 2.5 : wanted / power < 7.5 ? 5 : 10);
}
