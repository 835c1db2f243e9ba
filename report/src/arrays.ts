// Arrays of the page, as python/scabo/report/packing.py packs them: base64 of zlib of the bytes of equal significance.
// They are unpacked when they are first needed; the last ones used are kept.

export type Unpacked = Float32Array | Uint32Array | Uint8Array;

const kept = new Map<string, Promise<Unpacked>>();
let keptBytes = 0;
const MOST_BYTES = 400e6;

export function has(name: string): boolean {
  return document.getElementById(name) !== null;
}

export function floats(name: string): Promise<Float32Array> {
  return unpacked(name) as Promise<Float32Array>;
}
export function whole(name: string): Promise<Uint32Array> {
  return unpacked(name) as Promise<Uint32Array>;
}
export function bytes(name: string): Promise<Uint8Array> {
  return unpacked(name) as Promise<Uint8Array>;
}

function unpacked(name: string): Promise<Unpacked> {
  const known = kept.get(name);
  if (known) {
    kept.delete(name); // and to the end: the least recently used ones stand first
    kept.set(name, known);
    return known;
  }
  const made = unpack(name);
  kept.set(name, made);
  void made.then((values) => {
    keptBytes += values.byteLength;
    for (const [old, array] of kept) {
      if (keptBytes <= MOST_BYTES || old === name) break;
      kept.delete(old);
      void array.then((gone) => (keptBytes -= gone.byteLength));
    }
  });
  return made;
}

async function unpack(name: string): Promise<Unpacked> {
  const element = document.getElementById(name);
  if (!element) throw new Error(`the page has no array '${name}'`);
  const kind = element.dataset.kind!;
  const planes = await inflated(decoded(element.textContent!));
  if (kind === "u1") return planes;
  const count = planes.length / 4;
  const joined = new Uint8Array(planes.length);
  for (let k = 0; k < 4; ++k) {
    const plane = planes.subarray(k * count, (k + 1) * count);
    for (let i = 0, at = k; i < count; ++i, at += 4) joined[at] = plane[i];
  }
  if (kind === "f4") return new Float32Array(joined.buffer);
  const values = new Uint32Array(joined.buffer);
  for (let i = 1; i < count; ++i) values[i] += values[i - 1];
  return values;
}

function decoded(text: string): Uint8Array<ArrayBuffer> {
  const characters = atob(text);
  const data = new Uint8Array(characters.length);
  for (let i = 0; i < data.length; ++i) data[i] = characters.charCodeAt(i);
  return data;
}

async function inflated(data: Uint8Array<ArrayBuffer>): Promise<Uint8Array<ArrayBuffer>> {
  const stream = new Blob([data]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}
