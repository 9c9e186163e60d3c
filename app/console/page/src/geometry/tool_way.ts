// Decodes the way of a tool (QCP1), little-endian, after the browser has unpacked gzip, and says where the tool is when. It takes
// what app/display/display_path.cpp writes and refuses all else.
//
// A QCP1 is u32 points, u32 bytes of the last part; f64 origin x, y, z, step; the points as those of a QCD1; a kind for each,
// u8; then numbers to base 128: the ms from the point before, and the zigzag differences of the lines of the program. One pass,
// linear in the bytes. Throws Error for anything else.

import type { Vec3 } from "../link/documents";
import { decodePositions, readCode } from "./display_mesh";

export interface ToolWay {
  positions: Float32Array; // three per point, mm in the coordinates of the setup
  ms: Uint32Array; // since the program began, when the tip is there
  lines: Uint32Array; // of the file of the program
  kinds: Uint8Array; // places in WAY_KINDS: how the tip comes there
}

export const WAY_KINDS = ["goes to another place", "the tool is changed", "goes over the foam", "at the feed of cuts, in air", "cuts"];

const HEAD = 4 + 2 * 4 + 4 * 8;
const POINT = 6 + 1;

function bad(why: string): never {
  throw new Error(`The way of the tool is damaged: ${why}.`);
}

export function decodeWay(buffer: ArrayBuffer): ToolWay {
  const view = new DataView(buffer);
  const bytes = new Uint8Array(buffer);
  if (bytes.length < HEAD || String.fromCharCode(...bytes.subarray(0, 4)) !== "QCP1") bad("it does not begin as one");
  const count = view.getUint32(4, true);
  const codeBytes = view.getUint32(8, true);
  if (bytes.length !== HEAD + POINT * count + codeBytes) bad("it has not the length that its head says");
  const origin = [12, 20, 28].map((at) => view.getFloat64(at, true)) as Vec3;
  const step = view.getFloat64(36, true);
  if (![...origin, step].every(Number.isFinite) || !(step > 0)) bad("its grid is no grid");
  const kinds = bytes.slice(HEAD + 6 * count, HEAD + POINT * count);
  if (kinds.some((kind) => kind >= WAY_KINDS.length)) bad("a move is of no kind");
  const codes = bytes.subarray(HEAD + POINT * count);
  const cursor = { at: 0 };
  const ms = new Uint32Array(count);
  for (let i = 0, now = 0; i < count; ++i) {
    now += readCode(codes, cursor);
    if (now > 0xffffffff) bad("a time is too large");
    ms[i] = now;
  }
  const lines = new Uint32Array(count);
  for (let i = 0, line = 0; i < count; ++i) {
    const code = readCode(codes, cursor);
    line += code % 2 === 0 ? code / 2 : -(code + 1) / 2;
    if (line < 0 || line > 0x7fffffff) bad("a line is none");
    lines[i] = line;
  }
  if (cursor.at !== codes.length) bad("there are more bytes than its points need");
  return { positions: decodePositions(bytes.subarray(HEAD, HEAD + 6 * count), count, origin, step), ms, lines, kinds };
}

// The first point that the tip has not passed at a time, at most the last one. O(log points).
export function pointAt(way: ToolWay, ms: number): number {
  let low = 0;
  let high = Math.max(0, way.ms.length - 1);
  while (low < high) {
    const middle = (low + high) >> 1;
    if (way.ms[middle]! < ms) low = middle + 1;
    else high = middle;
  }
  return low;
}

export const pointOf = (way: ToolWay, i: number): Vec3 => [0, 1, 2].map((axis) => way.positions[3 * i + axis]!) as Vec3;

// The tip on its way to point i, as if it went there evenly.
export function tipAt(way: ToolWay, i: number, ms: number): Vec3 {
  const to = pointOf(way, i);
  if (i === 0) return to;
  const from = pointOf(way, i - 1);
  const whole = way.ms[i]! - way.ms[i - 1]!;
  const share = whole > 0 ? Math.min(1, Math.max(0, (ms - way.ms[i - 1]!) / whole)) : 1;
  return from.map((value, axis) => value + share * (to[axis]! - value)) as Vec3;
}

// From a point on to the tip: six numbers a line.
export function linesTo(way: ToolWay, first: number, i: number, tip: Vec3): Float32Array {
  const from = Math.max(1, Math.min(first, i));
  const lines = new Float32Array(6 * Math.max(0, i - from + 1));
  for (let k = from; k <= i && k < way.ms.length; ++k) {
    lines.set(way.positions.subarray(3 * k - 3, 3 * k), 6 * (k - from));
    lines.set(k === i ? tip : way.positions.subarray(3 * k, 3 * k + 3), 6 * (k - from) + 3);
  }
  return lines;
}
