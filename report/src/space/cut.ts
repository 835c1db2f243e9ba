// Where a plane cuts tetrahedra: triangles, each of whose corners lies between two nodes.

export interface Cut {
  a: Uint32Array; // nodes of every corner, and how far it lies from a to b
  b: Uint32Array;
  part: Float32Array;
}

/** `normal . x = at`, of the undeformed shape. A node in the plane counts as above; cells of `hidden` bodies are left out. */
export function cut(points: Float32Array, cells: Uint32Array, bodies: Uint32Array, hidden: ReadonlySet<number>, normal: [number, number, number], at: number): Cut {
  const height = new Float32Array(points.length / 3);
  for (let i = 0; i < height.length; ++i) height[i] = normal[0] * points[3 * i] + normal[1] * points[3 * i + 1] + normal[2] * points[3 * i + 2] - at;
  const a: number[] = [], b: number[] = [], part: number[] = [], ring: [number, number][] = [], above: number[] = [], below: number[] = [];
  for (let c = 0; c < bodies.length; ++c) {
    if (hidden.has(bodies[c])) continue;
    above.length = below.length = 0;
    for (let k = 0; k < 4; ++k) (height[cells[4 * c + k]] >= 0 ? above : below).push(cells[4 * c + k]);
    if (!above.length || !below.length) continue;
    ring.length = 0;
    if (above.length === 2) ring.push([above[0], below[0]], [above[0], below[1]], [above[1], below[1]], [above[1], below[0]]);
    else for (const one of above) for (const other of below) ring.push([one, other]);
    for (let k = 2; k < ring.length; ++k)
      for (const [from, to] of [ring[0], ring[k - 1], ring[k]]) {
        a.push(from);
        b.push(to);
        part.push(height[from] / (height[from] - height[to]));
      }
  }
  return { a: Uint32Array.from(a), b: Uint32Array.from(b), part: Float32Array.from(part) };
}
