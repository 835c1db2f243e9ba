// What the page is filled with: the values of python/scabo/report/content.py, fields.py and pairs.py.

export type Range = [low: number, high: number, least: number, greatest: number];
export type Dimension = "length" | "force" | "stress" | "energy" | "number";
export type Series = (number | null)[];

export interface Row {
  number: number;
  step: number;
  increment: number;
  reached: number;
  step_name: string;
  time: number;
  factors: Record<string, number | null>;
  iterations: number;
  coarse: number;
  residual: number | null;
  certificate: number | null;
  open: number;
  stick: number;
  slip: number;
  energy: { external: number | null; elastic: number | null; friction: number | null } | null;
  error: number | null;
}

export interface Listed<T> {
  count: number;
  listed: T[];
}

export interface Model {
  nodes: number;
  dofs: number;
  super_elements?: number;
  finite_elements?: number; // of models in space, which have super-elements only where there are hexahedra or wedges
  contact_pairs: number;
  plane?: string;
  thickness?: number;
  steps?: string[];
  materials: Listed<{ name: string; law: string; young: number | null; poisson: number | null; density: number | null }>;
  bodies: Listed<{
    name: string; rigid: boolean; unbounded: boolean; materials: string[]; nodes: number; super_elements?: number; finite_elements: number;
  }>;
  contacts: Listed<{ name: string; between: [string, string]; law: string }>;
}

export interface Fields {
  centre: [number, number];
  points: number;
  triangles: number;
  bodies: number;
  increments: number[];
  mesh_of: Record<string, number>; // of every increment; 0 is the mesh of the last one
  ranges: Record<string, Record<string, Range>>;
  magnification: number;
  low: [number, number];
  high: [number, number];
  note: string;
  quantities: { key: string; name: string; dimension: Dimension }[];
}

export interface Pairs {
  names: string[];
  sizes: number[];
  increments: number[];
  note: string;
}

/** A contact face of a model in space. */
export interface Face {
  name: string;
  axes: [string, string]; // names of its two coordinates
  pairs: number;
}

/** Bodies in space: the values of python/scabo/report/space.py. */
export interface Space {
  centre: [number, number, number];
  low: [number, number, number];
  high: [number, number, number];
  bodies: string[];
  increments: number[]; // none where the page has a mechanism alone
  ranges: Record<string, Record<string, Range>>;
  magnification: number;
  quantities: { key: string; name: string; dimension: Dimension }[];
  note: string;
  faces: Face[];
}

/** Of one contact over the increments. */
export interface Totals {
  name: string;
  normal_force: Series;
  tangential_force: Series;
  max_pressure: Series;
  max_gap: Series;
  stick: Series;
  slip: Series;
  open: Series;
}

export interface Mode {
  mode: number;
  frequency: number;
  body: string;
  rigid: boolean;
  modal_mass: number;
  effective_mass: [number, number];
  residual: number;
}

export interface Content {
  version: string;
  title: string;
  status: string;
  directory: string;
  verdict: { level: "good" | "bad" | "warning"; heading: string; text: string };
  warnings: string[];
  model: Model;
  modal: boolean;
  passes: { dofs: number; error: number | null; raised: number; divided: number }[];
  timing: Record<string, number | null>;
  memory: number | null;
  modes: Mode[];
  total_mass: number | null;
  certificate: { key: string; question: string; meaning: string; measure: string; worst: number; increment: number }[];
  increments: Row[];
  failed: { step: number; increment: number; newton_iterations: number; residual: number | null }[];
  cracks: ({ name: string; kind: string } & Record<string, number | string>)[];
  quantities: { of: string; value: number | null; bar: number | null; relative: number | null; wanted: number | null; reached: boolean | null }[];
  totals: { count: number; curves: string[]; contacts: Totals[] };
  reactions: { count: number; curves: string[]; supports: { name: string; x: Series; y: Series; z?: Series }[] }; // z: of models in space
  time_axis: string;
  in_time: boolean;
  history: { time: number[]; columns: { name: string; values: Series }[]; note: string } | null;
  convergence: {
    step: number[]; increment: number[]; attempt: number[]; iteration: number[]; residual: Series; stage: number[]; stages: string[]; note: string;
  } | null;
  units: [string, string] | null;
  field: Fields | null;
  pairs: Pairs | null;
  space?: Space | null; // of a model in space, which has neither `field` nor `pairs`
  mechanism: { text: string; length: number } | null; // `length`: as which its largest displacement is drawn
}

export function readContent(): Content {
  return JSON.parse(document.getElementById("content")!.textContent!) as Content;
}
