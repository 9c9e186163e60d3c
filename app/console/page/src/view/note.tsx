// How far what is seen may be from what is cut. All figures are the engine's.

import type { Project } from "../link/documents";
import { number } from "../parts/words";

export function ViewNote({ project }: { project: Project }) {
  const known = project.pieces.map((piece) => piece.deviation_mm).filter((value): value is number => value !== undefined);
  if (project.pieces.length === 0) return <p class="note">The server has made no view of the pieces. The tables are complete.</p>;
  return (
    <p class="note">
      {known.length === 0
        ? "The view shows simplified meshes; all figures are the engine's."
        : `The view deviates from the pieces by up to ${number(Math.max(...known), 2)} mm; all figures are the engine's.`}
    </p>
  );
}
