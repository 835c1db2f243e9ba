// What is shown, and who wants to know of changes. Parts of the page change it by `set` and never call each other.
import type { Content } from "./content";
import { Units } from "./units";

export interface Picked {
  triangle: number;
  weights: [number, number, number];
}

/** A line along which values are read: places of the undeformed model, relative to its centre. */
export interface Line {
  from: [number, number];
  to: [number, number];
}

export interface Shown {
  increment: number; // from 1; number of the mode in a modal analysis
  quantity: string;
  magnification: number;
  range: "increment" | "all" | "extremes";
  bands: boolean;
  mesh: boolean;
  elements: boolean;
  undeformed: boolean;
  states: boolean;
  contact: number; // whose curves are shown
  pair: number; // lit up, over all contacts; -1: none
  picked: Picked | null;
  hidden: ReadonlySet<number>; // bodies, by their numbers from 1
  order: number[]; // of drawing: the last body is above the others
  extremes: boolean;
  mechanism: boolean;
  line: Line | null;
  units: Units;
  dark: boolean;
}

type Key = keyof Shown;

export class State {
  private readonly listeners: { keys: Key[]; call: () => void }[] = [];

  constructor(readonly content: Content, readonly shown: Shown) {}

  get count(): number {
    return this.content.modal ? this.content.modes.length : this.content.increments.length;
  }

  on(keys: Key[], call: () => void): void {
    this.listeners.push({ keys, call });
  }

  set(changes: Partial<Shown>): void {
    const changed = (Object.keys(changes) as Key[]).filter((key) => this.shown[key] !== changes[key]);
    if (!changed.length) return;
    Object.assign(this.shown, changes);
    for (const listener of this.listeners) if (listener.keys.some((key) => changed.includes(key))) listener.call();
  }

  /** The increment whose fields, or pairs, are shown: the one chosen, or the last one before it that the page has. */
  available(numbers: number[]): number {
    let found = numbers[0];
    for (const known of numbers) if (known <= this.shown.increment) found = known;
    return found;
  }
}
