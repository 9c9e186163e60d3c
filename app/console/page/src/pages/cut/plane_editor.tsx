// The plane as numbers: typed, nudged, flipped; which side is hidden; and what it would make.

import { dot, flipped, moved, normalised, type CutPlane } from "../../geometry/plane";
import type { Preview, Vec3 } from "../../link/documents";
import { NumberField } from "../../parts/number_field";
import { count, counted, length, volume } from "../../parts/words";
import type { Side } from "../../view/scene";
import { OutlinePicture } from "./outline_picture";

export interface EditorState {
  step: number; // mm
  hide: Side;
  handle: "move" | "turn";
}

interface Props {
  plane: CutPlane;
  preview: Preview | null;
  notes: string[];
  editor: EditorState;
  onPlane: (plane: CutPlane) => void;
  onEditor: (editor: EditorState) => void;
}

export const nextSide = (side: Side): Side => (side === "none" ? "above" : side === "above" ? "below" : "none");

export function PlaneEditor({ plane, preview, notes, editor, onPlane, onEditor }: Props) {
  const setAxis = (axis: number) => (value: number) => {
    const raw = plane.normal.map((old, i) => (i === axis ? value : old)) as Vec3;
    const normal = normalised(raw);
    if (normal) onPlane({ ...plane, normal });
  };
  return (
    <fieldset class="editor">
      <legend>Plane</legend>
      <div class="row">
        {(["x", "y", "z"] as const).map((axis, i) => (
          <NumberField key={axis} label={`Normal ${axis}`} value={plane.normal[i]!} min={-1} max={1} onValue={setAxis(i)} />
        ))}
        <NumberField label="Offset" unit="mm" value={plane.offset} onValue={(offset) => onPlane({ ...plane, offset })} />
      </div>
      <div class="row">
        <NumberField label="Step" unit="mm" min={0.01} value={editor.step} onValue={(step) => onEditor({ ...editor, step })} />
        <button type="button" onClick={() => onPlane(moved(plane, -editor.step))} aria-keyshortcuts="[">
          Back
        </button>
        <button type="button" onClick={() => onPlane(moved(plane, editor.step))} aria-keyshortcuts="]">
          On
        </button>
        <button type="button" onClick={() => onPlane(flipped(plane))} aria-keyshortcuts="X">
          Flip
        </button>
        <button
          type="button"
          aria-keyshortcuts="H"
          onClick={() => onEditor({ ...editor, hide: nextSide(editor.hide) })}
        >
          {editor.hide === "none" ? "Hide a side" : editor.hide === "above" ? "Above is hidden" : "Below is hidden"}
        </button>
        <button
          type="button"
          onClick={() => onEditor({ ...editor, handle: editor.handle === "move" ? "turn" : "move" })}
        >
          {editor.handle === "move" ? "Handle moves" : "Handle turns"}
        </button>
      </div>
      {preview ? <Makes preview={preview} plane={plane} /> : <NotYet notes={notes} />}
    </fieldset>
  );
}

function NotYet({ notes }: { notes: string[] }) {
  if (notes.length > 0) return <p role="status">{notes.join(" ")}</p>;
  return (
    <p role="status" class="provisional">
      The outline is <strong>provisional</strong>: it is that of the view. The engine computes what the plane makes.
    </p>
  );
}

function Makes({ preview, plane }: { preview: Preview; plane: CutPlane }) {
  // The engine may have turned the normal round; sides are named by the one that is shown.
  const isTurned = dot(preview.plane.normal, plane.normal) < 0;
  const side = (name: "above" | "below") => (isTurned ? (name === "above" ? "below" : "above") : name);
  return (
    <div class="makes">
      <OutlinePicture preview={preview} />
      <div>
        <p role="status">
          {counted(preview.loops.length, "outline")} of {length(preview.length_mm)}.
          Exact.
        </p>
        {preview.sections_cross && (
          <p class="state warn">
            <span aria-hidden="true">⚠ </span>Sections cross: the piece runs through itself there, and the caps would overlap.
          </p>
        )}
        <table>
          <caption>What it makes</caption>
          <thead>
            <tr>
              <th scope="col">Side</th>
              <th scope="col" class="figure">
                Volume
              </th>
              <th scope="col" class="figure">
                Faces
              </th>
              <th scope="col">Kind</th>
            </tr>
          </thead>
          <tbody>
            {preview.makes.map((made, i) => (
              <tr key={i}>
                <th scope="row">{side(made.side)}</th>
                <td class="figure">{volume(made.volume_mm3)}</td>
                <td class="figure">{count(made.faces)}</td>
                <td>{made.fragment ? "fragment" : "piece"}</td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
    </div>
  );
}
