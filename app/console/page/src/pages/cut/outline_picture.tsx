// The outline of the section, drawn flat in the plane.

import { axesOf, dot } from "../../geometry/plane";
import type { Preview } from "../../link/documents";
import { length } from "../../parts/words";

const SIZE = 130;
const MARGIN = 6;

export function OutlinePicture({ preview }: { preview: Preview }) {
  const [u, v] = axesOf(preview.plane.normal);
  const loops = preview.loops.map((loop) => loop.map((point) => [dot(u, point), -dot(v, point)] as const));
  const all = loops.flat();
  if (all.length === 0) return null;
  let [left, top, right, bottom] = [Infinity, Infinity, -Infinity, -Infinity];
  for (const [x, y] of all) {
    left = Math.min(left, x);
    right = Math.max(right, x);
    top = Math.min(top, y);
    bottom = Math.max(bottom, y);
  }
  const scale = (SIZE - 2 * MARGIN) / Math.max(right - left, bottom - top, 1e-6);
  const path = loops
    .map((loop) => `M${loop.map(([x, y]) => `${at(x - left, scale)} ${at(y - top, scale)}`).join("L")}Z`)
    .join("");
  const words = `Outline of the section, ${length(right - left)} by ${length(bottom - top)}`;
  return (
    <svg viewBox={`0 0 ${SIZE} ${SIZE}`} width={SIZE} height={SIZE} role="img" aria-label={words} class="outline">
      <path d={path} fill-rule="evenodd" />
    </svg>
  );
}

const at = (value: number, scale: number): string => (MARGIN + value * scale).toFixed(1);
