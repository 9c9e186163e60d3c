// A plane: normal of length 1 and the distance along it from the scan's centre, mm. "Above" is the side that the normal
// points to.

import type { PlaneDocument, Vec3 } from "../link/documents";

export interface CutPlane {
  normal: Vec3;
  offset: number;
}

export const dot = (a: Vec3, b: Vec3): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a: Vec3, b: Vec3): Vec3 => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
export const scaled = (a: Vec3, s: number): Vec3 => [a[0] * s, a[1] * s, a[2] * s];

export function normalised(a: Vec3): Vec3 | null {
  const length = Math.sqrt(dot(a, a));
  return Number.isFinite(length) && length > 1e-9 ? scaled(a, 1 / length) : null;
}

export const planeOf = (document: PlaneDocument): CutPlane => ({ normal: document.normal, offset: document.offset_mm });
export const asNumbers = (plane: CutPlane): [number, number, number, number] => [...plane.normal, plane.offset];
export const flipped = (plane: CutPlane): CutPlane => ({ normal: scaled(plane.normal, -1), offset: -plane.offset });
export const moved = (plane: CutPlane, by: number): CutPlane => ({ ...plane, offset: plane.offset + by });

export const isSame = (a: CutPlane, b: CutPlane): boolean =>
  asNumbers(a).every((value, i) => Object.is(value + 0, asNumbers(b)[i]! + 0));

// Two unit vectors in the plane, at right angles.
export function axesOf(normal: Vec3): [Vec3, Vec3] {
  const least = [0, 1, 2].reduce((a, b) => (Math.abs(normal[b]!) < Math.abs(normal[a]!) ? b : a));
  const other: Vec3 = [0, 0, 0];
  other[least] = 1;
  const u = normalised(cross(other, normal))!;
  return [u, cross(normal, u)];
}

// The plane as it stands in the address: "0,0,1,12.5", every digit kept.
export const planeText = (plane: CutPlane): string => asNumbers(plane).join(",");

export function parsePlane(text: string): CutPlane | null {
  const numbers = text.split(",").map(Number);
  if (text === "" || numbers.length !== 4 || !numbers.every(Number.isFinite)) return null;
  const [x, y, z, offset] = numbers as [number, number, number, number];
  const length = Math.hypot(x, y, z);
  if (length < 1e-9) return null;
  if (Math.abs(length - 1) < 1e-12) return { normal: [x, y, z], offset };
  return { normal: scaled([x, y, z], 1 / length), offset };
}
