// Decodes display meshes (QCD1) and the states of their faces (QCS1), little-endian, after the browser has unpacked gzip. It
// takes what app/display/display_format.cpp writes and refuses all else.
//
// A QCD1 is u32 vertices, faces, index bytes, groups; f64 origin x, y, z, step; for x, y, z the low bytes and then the high
// bytes of the zigzag differences to the vertex before, in steps; the indices to base 128, 0 for a new vertex and k for
// the k-th before the next new one; the groups. One pass, linear in the bytes. Throws Error for anything else.

import type { Vec3 } from "../link/documents";

export interface FaceGroup {
  kind: "skin" | "cap";
  cut: number; // of a cap; else -1
  first: number; // face
  faces: number;
}

export interface DisplayMesh {
  positions: Float32Array; // three per vertex, mm about the scan's centre
  indices: Uint32Array; // three per face
  groups: FaceGroup[];
  step: number; // of the grid, mm: half of it is how far a coordinate may be off by rounding
}

const LARGEST = 16383; // coordinate on the grid
const STATES_HEAD = 4 + 16; // with the mesh's id
const HEAD = 4 + 4 * 4 + 4 * 8;
const GROUP = 1 + 4 + 4 + 4;

// What becomes of a face, with the colours of the setup sheets (cam/job/sheet/setup_picture.cpp).
export const STATES = [
  { words: "reached", colour: "#e2d6be" },
  { words: "too narrow for the smallest tool", colour: "#a5c8eb" },
  { words: "steep", colour: "#fac300" },
  { words: "out of reach because of the holder", colour: "#691973" },
  { words: "hidden", colour: "#cd320f" },
  { words: "may stay", colour: "#969ba0" },
  { words: "base", colour: "#82868c" },
];

function bad(why: string): never {
  throw new Error(`The display mesh is damaged: ${why}.`);
}

function magic(view: DataView): string {
  return view.byteLength < 4 ? "" : String.fromCharCode(...[0, 1, 2, 3].map((i) => view.getUint8(i)));
}

export function decodeMesh(buffer: ArrayBuffer): DisplayMesh {
  const view = new DataView(buffer);
  if (view.byteLength < HEAD || magic(view) !== "QCD1") bad("it does not begin as one");
  const [vertices, faces, indexBytes, groups] = [4, 8, 12, 16].map((at) => view.getUint32(at, true)) as [number, number, number, number];
  const origin = [20, 28, 36].map((at) => view.getFloat64(at, true)) as Vec3;
  const step = view.getFloat64(44, true);
  if (view.byteLength !== HEAD + 6 * vertices + indexBytes + GROUP * groups) bad("it has not the length that its head says");
  if (![...origin, step, ...origin.map((value) => value + LARGEST * step)].every(Number.isFinite) || !(step > 0))
    bad("its grid is no grid");
  const bytes = new Uint8Array(buffer);
  const indexStart = HEAD + 6 * vertices;
  return {
    positions: decodePositions(bytes.subarray(HEAD, indexStart), vertices, origin, step),
    indices: decodeIndices(bytes.subarray(indexStart, indexStart + indexBytes), vertices, faces),
    groups: decodeGroups(view, indexStart + indexBytes, groups, faces),
    step,
  };
}

export function decodePositions(bytes: Uint8Array, vertices: number, origin: Vec3, step: number): Float32Array {
  const positions = new Float32Array(3 * vertices);
  for (let axis = 0; axis < 3; ++axis) {
    const low = 2 * axis * vertices;
    const high = low + vertices;
    let n = 0;
    for (let i = 0; i < vertices; ++i) {
      const zigzag = bytes[low + i]! | (bytes[high + i]! << 8);
      n += (zigzag >>> 1) ^ -(zigzag & 1);
      if (n < 0 || n > LARGEST) bad("a point is outside of the grid");
      positions[3 * i + axis] = origin[axis]! + step * n;
    }
  }
  return positions;
}

// A number to base 128, the lowest digit first, in as few bytes as it takes.
export function readCode(bytes: Uint8Array, cursor: { at: number }): number {
  let code = 0;
  for (let shift = 0; ; shift += 7) {
    if (cursor.at >= bytes.length || shift > 28) bad("a number does not end");
    const byte = bytes[cursor.at++]!;
    code += (byte & 127) * 2 ** shift;
    if (byte >= 128) continue;
    if (byte === 0 && shift > 0) bad("a number is longer than it needs to be");
    return code;
  }
}

function decodeIndices(bytes: Uint8Array, vertices: number, faces: number): Uint32Array {
  if (3 * faces > bytes.length) bad("it has fewer indices than its faces need");
  const indices = new Uint32Array(3 * faces);
  let next = 0;
  const cursor = { at: 0 };
  for (let i = 0; i < indices.length; ++i) {
    const back = readCode(bytes, cursor);
    if (back > next) bad("an index names no vertex");
    indices[i] = back === 0 ? next++ : next - back;
  }
  if (cursor.at !== bytes.length || next !== vertices) bad("its indices are not those of its vertices");
  for (let i = 0; i < indices.length; i += 3)
    if (indices[i] === indices[i + 1] || indices[i + 1] === indices[i + 2] || indices[i] === indices[i + 2])
      bad("a face has a corner twice");
  return indices;
}

function decodeGroups(view: DataView, start: number, count: number, faces: number): FaceGroup[] {
  const groups: FaceGroup[] = [];
  for (let i = 0, at = start; i < count; ++i, at += GROUP) {
    const kind = view.getUint8(at);
    const group: FaceGroup = {
      kind: kind === 0 ? "skin" : "cap",
      cut: view.getInt32(at + 1, true),
      first: view.getUint32(at + 5, true),
      faces: view.getUint32(at + 9, true),
    };
    const before = groups.at(-1);
    if (kind > 1 || group.faces === 0 || group.first !== (before ? before.first + before.faces : 0) || (kind === 0) !== (group.cut === -1))
      bad("a group is none of its faces");
    groups.push(group);
  }
  const last = groups.at(-1);
  if ((last ? last.first + last.faces : 0) !== faces) bad("its groups are not its faces");
  return groups;
}

// A byte per face, a place in STATES.
export function decodeStates(buffer: ArrayBuffer, faces: number): Uint8Array {
  const view = new DataView(buffer);
  if (magic(view) !== "QCS1" || view.byteLength !== STATES_HEAD + faces) bad("its states are not of its faces");
  return new Uint8Array(buffer, STATES_HEAD, faces);
}
