// Arrows for the tool orientations of a piece: along each the tool comes in, with its tip just outside of the piece.

import type { Vec3 } from "../link/documents";

export interface ToolArrow {
  direction: Vec3; // unit vector; into the piece, against the tool axis
  from: Vec3; // its tail, mm
  length: number; // mm
}

const GAP = 0.06; // of the piece's radius, between tip and piece
const LENGTH = 0.7; // of the radius

// Of the box of the points; radius: half of its diagonal. The scan's centre is the origin.
export function extentOf(positions: Float32Array): { middle: Vec3; radius: number } {
  const low: Vec3 = [Infinity, Infinity, Infinity];
  const high: Vec3 = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < positions.length; ++i) {
    low[i % 3] = Math.min(low[i % 3]!, positions[i]!);
    high[i % 3] = Math.max(high[i % 3]!, positions[i]!);
  }
  if (low[0] > high[0]) return { middle: [0, 0, 0], radius: 0 };
  const middle = low.map((value, axis) => (value + high[axis]!) / 2) as Vec3;
  return { middle, radius: Math.hypot(...low.map((value, axis) => (high[axis]! - value) / 2)) };
}

// `axes`: from the tip into the spindle, in the frame of the points, which are moved by `shift`. O(axes x points).
export function toolArrows(axes: readonly Vec3[], positions: Float32Array, shift: Vec3): ToolArrow[] {
  const { middle, radius } = extentOf(positions);
  const length = LENGTH * radius;
  return axes.map((axis) => {
    const reach = height(axis, positions, middle) + GAP * radius + length;
    return { direction: axis.map((part) => -part) as Vec3, from: middle.map((value, i) => value + shift[i]! + reach * axis[i]!) as Vec3, length };
  });
}

// How far the points go from the middle along the axis.
function height(axis: Vec3, positions: Float32Array, middle: Vec3): number {
  let highest = 0;
  for (let i = 0; i < positions.length; i += 3) {
    const along = (positions[i]! - middle[0]) * axis[0] + (positions[i + 1]! - middle[1]) * axis[1] + (positions[i + 2]! - middle[2]) * axis[2];
    highest = Math.max(highest, along);
  }
  return highest;
}
