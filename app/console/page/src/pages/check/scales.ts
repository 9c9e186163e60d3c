// Units that a scan without units may be in, each with the size that it gives.

import type { DisplayMesh } from "../../geometry/display_mesh";
import type { Inspect } from "../../link/documents";
import { length } from "../../parts/words";

const MM: Record<string, number> = { um: 0.001, mm: 1, cm: 10, m: 1000, in: 25.4, ft: 304.8 };
const NAMES: Record<string, string> = { um: "µm", mm: "mm", cm: "cm", m: "m", in: "inch", ft: "foot" };

export const unitName = (unit: string): string => NAMES[unit] ?? unit;
export const mmOf = (unit: string | null): number => MM[unit ?? ""] ?? 1;

export const sizeIn = (inspect: Inspect, unit: string): string =>
  inspect.size.map((side) => length(side * mmOf(unit))).join(" x ");

const scaled = new WeakMap<DisplayMesh, Map<number, DisplayMesh>>();

// The mesh of a scan is in the units of the file; the view is in mm. One value per mesh and factor.
export function scaledMesh(mesh: DisplayMesh, factor: number): DisplayMesh {
  if (factor === 1) return mesh;
  const kept = scaled.get(mesh) ?? new Map<number, DisplayMesh>();
  scaled.set(mesh, kept);
  const known = kept.get(factor) ?? { ...mesh, positions: mesh.positions.map((value) => value * factor), step: mesh.step * factor };
  kept.set(factor, known);
  return known;
}
