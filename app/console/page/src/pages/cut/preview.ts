// What a plane would make: asked of the engine when the plane has come to rest; until then the outline is the section of the
// display mesh, and provisional.

import { useEffect, useMemo, useState } from "preact/hooks";
import type { DisplayMesh } from "../../geometry/display_mesh";
import { asNumbers, planeText, type CutPlane } from "../../geometry/plane";
import { sectionOf } from "../../geometry/section";
import { ask, type ApiError } from "../../link/api";
import type { Preview, Project, Segment, Vec3 } from "../../link/documents";
import { useSettled } from "../../parts/asking";
import { asApiError } from "../../parts/error";
import type { Outline } from "../../view/scene";

const REST_MS = 120;

export interface Previewed {
  preview: Preview | null; // of this plane, exact
  notes: string[]; // why there is none
  outline: Outline | null;
  error: ApiError | null;
  again: () => void;
}

export function usePreview(
  project: Project,
  piece: string,
  plane: CutPlane | null,
  isDragging: boolean,
  isBusy: boolean,
  mesh: DisplayMesh | null,
): Previewed {
  const [found, setFound] = useState<{ key: string; preview: Preview | null; notes: string[] } | null>(null);
  const [error, setError] = useState<ApiError | null>(null);
  const [tries, setTries] = useState(0);
  const keyNow = plane === null ? "" : `${project.revision} ${piece} ${planeText(plane)}`;
  const key = useSettled(isDragging ? "" : keyNow, REST_MS);
  useEffect(() => {
    if (key === "" || key !== keyNow || plane === null || isBusy) return;
    let gone = false;
    setError(null);
    ask<Segment>(project.id, "preview", { piece, plane: asNumbers(plane) })
      .then((segment) => gone || setFound({ key, preview: segment.preview ?? null, notes: segment.notes }))
      .catch((reason: unknown) => gone || setError(asApiError(reason)));
    return () => {
      gone = true;
    };
  }, [key, isBusy, tries]);
  const isOfThis = found !== null && found.key === keyNow;
  const preview = isOfThis ? found.preview : null;
  const outline = useMemo<Outline | null>(() => {
    if (plane === null) return null;
    if (preview !== null) return { segments: segmentsOf(preview.loops), isProvisional: false };
    return mesh === null ? null : { segments: sectionOf(mesh, plane), isProvisional: true };
  }, [plane, preview, mesh]);
  return { preview, notes: isOfThis ? found.notes : [], outline, error, again: () => setTries((n) => n + 1) };
}

function segmentsOf(loops: Vec3[][]): Float32Array {
  const points: number[] = [];
  for (const loop of loops) loop.forEach((point, i) => points.push(...point, ...loop[(i + 1) % loop.length]!));
  return Float32Array.from(points);
}
