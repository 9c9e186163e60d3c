// How far what is seen may be from what is cut. All figures are the engine's.

import type { Project } from "../link/documents";
import { number } from "../parts/words";

export function ViewNote({ project }: { project: Project }) {
  if (project.drawn.length === 0) return <p class="note">The server draws the pieces. The tables are complete.</p>;
  const deviation = Math.max(...project.drawn.map((piece) => piece.deviation_mm));
  return (
    <p class="note">
      The view deviates from the pieces by up to {number(deviation, 2)} mm; all figures are the engine's.
    </p>
  );
}
