// What is seen at a pixel: the foremost triangle of the surface or of the section.
import type { SpaceCamera } from "./camera";
import type { Cut } from "./cut";
import type { Solids } from "./scene";

/** A point of a body as a mean over nodes. */
export interface SolidPoint {
  nodes: number[];
  weights: number[];
}

export interface Seen {
  solids: Solids;
  moved: Float32Array; // magnified displacements
  hidden: ReadonlySet<number>;
  plane: [number, number, number, number] | null;
  cut: Cut | null;
}

export function pickAt(px: number, py: number, camera: SpaceCamera, { solids, moved, hidden, plane, cut }: Seen): SolidPoint | null {
  const { points, triangles, body } = solids, axes = camera.axes(), count = points.length / 3, places = new Float64Array(3 * count);
  for (let i = 0; i < count; ++i)
    places.set(camera.toPixel(points[3 * i] + moved[3 * i], points[3 * i + 1] + moved[3 * i + 1], points[3 * i + 2] + moved[3 * i + 2], axes), 3 * i);
  let best = -Infinity, found: SolidPoint | null = null;
  const test = (corners: [number, number, number][]): { near: number; weights: number[] } | null => {
    const [[ax, ay, az], [bx, by, bz], [cx, cy, cz]] = corners, area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
    if (area === 0) return null;
    const u = ((bx - px) * (cy - py) - (by - py) * (cx - px)) / area, v = ((cx - px) * (ay - py) - (cy - py) * (ax - px)) / area, w = 1 - u - v;
    return u < 0 || v < 0 || w < 0 ? null : { near: u * az + v * bz + w * cz, weights: [u, v, w] };
  };
  const at = (node: number): [number, number, number] => [places[3 * node], places[3 * node + 1], places[3 * node + 2]];
  for (let t = 0; t < triangles.length; t += 3) {
    const nodes = [triangles[t], triangles[t + 1], triangles[t + 2]];
    if (hidden.has(body[nodes[0]])) continue;
    const hit = test([at(nodes[0]), at(nodes[1]), at(nodes[2])]);
    if (!hit || hit.near <= best) continue;
    if (plane && nodes.reduce((sum, node, k) => sum + hit.weights[k] * (plane[0] * points[3 * node] + plane[1] * points[3 * node + 1] + plane[2] * points[3 * node + 2]), 0) > plane[3]) continue;
    best = hit.near;
    found = { nodes, weights: hit.weights };
  }
  for (let t = 0; cut && t < cut.part.length; t += 3) {
    const corner = (i: number): [number, number, number] => {
      const a = at(cut.a[i]), b = at(cut.b[i]), part = cut.part[i];
      return [0, 1, 2].map((k) => (1 - part) * a[k] + part * b[k]) as [number, number, number];
    };
    const hit = test([corner(t), corner(t + 1), corner(t + 2)]);
    if (!hit || hit.near <= best) continue;
    best = hit.near;
    found = { nodes: [0, 1, 2].flatMap((k) => [cut.a[t + k], cut.b[t + k]]),
      weights: [0, 1, 2].flatMap((k) => [hit.weights[k] * (1 - cut.part[t + k]), hit.weights[k] * cut.part[t + k]]) };
  }
  return found;
}

export function meanOf(point: SolidPoint, values: Float32Array, width = 1, component = 0): number {
  return point.nodes.reduce((sum, node, k) => sum + point.weights[k] * values[width * node + component], 0);
}
