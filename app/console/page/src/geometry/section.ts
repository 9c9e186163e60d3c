// The section of a display mesh by a plane: provisional, drawn dashed while the plane is dragged. A segment per crossed
// triangle, in no order. Linear in the faces.

import type { DisplayMesh } from "./display_mesh";
import type { CutPlane } from "./plane";

// Six numbers per segment, mm.
export function sectionOf(mesh: DisplayMesh, plane: CutPlane): Float32Array {
  const { positions, indices } = mesh;
  const [nx, ny, nz] = plane.normal;
  const heights = new Float64Array(positions.length / 3);
  for (let i = 0; i < heights.length; ++i)
    heights[i] = nx * positions[3 * i]! + ny * positions[3 * i + 1]! + nz * positions[3 * i + 2]! - plane.offset;
  const points: number[] = [];
  for (let face = 0; face < indices.length; face += 3) addSegment(points, positions, heights, indices, face);
  return Float32Array.from(points);
}

function addSegment(points: number[], positions: Float32Array, heights: Float64Array, indices: Uint32Array, face: number): void {
  const isAbove = [0, 1, 2].map((i) => heights[indices[face + i]!]! > 0);
  const above = Number(isAbove[0]) + Number(isAbove[1]) + Number(isAbove[2]);
  if (above === 0 || above === 3) return;
  const apex = isAbove.findIndex((side) => side === (above === 1));
  for (const other of [1, 2]) {
    const a = indices[face + apex]!;
    const b = indices[face + ((apex + other) % 3)]!;
    const t = heights[a]! / (heights[a]! - heights[b]!);
    for (let axis = 0; axis < 3; ++axis)
      points.push(positions[3 * a + axis]! + t * (positions[3 * b + axis]! - positions[3 * a + axis]!));
  }
}
