// Painting: strokes of points with a radius, on the side that was seen. The worker marks the faces of the imported scan by
// them; painting ends with Begin.

import type { Vec3 } from "../../link/documents";
import { NumberField } from "../../parts/number_field";
import { length } from "../../parts/words";
import type { Picked } from "../../view/scene";

export type Surface = "ignore" | "no_cut" | "clear";

export interface Stroke {
  surface: Surface;
  radius_mm: number;
  points: [number, number, number, number, number, number][]; // place, then the normal of the side that was painted
}

export const SURFACES: { surface: Surface; words: string }[] = [
  { surface: "ignore", words: "may stay" },
  { surface: "no_cut", words: "must not be cut" },
  { surface: "clear", words: "neither" },
];

const NEXT = 0.4; // of the radius: a point nearer to the last one is left out

export function withPoint(strokes: Stroke[], brush: Brush, picked: Picked, isFirst: boolean): Stroke[] {
  if (brush.surface === null) return strokes;
  const point: Stroke["points"][0] = [...picked.point, ...picked.normal];
  const last = strokes.at(-1);
  if (isFirst || !last) return [...strokes, { surface: brush.surface, radius_mm: brush.radius, points: [point] }];
  const before = last.points.at(-1)!;
  const step = Math.hypot(...([0, 1, 2] as const).map((i) => point[i] - before[i]));
  if (step < NEXT * last.radius_mm) return strokes;
  return [...strokes.slice(0, -1), { ...last, points: [...last.points, point] }];
}

// The state of each face of the display mesh: 0 neither, 1 may stay, 2 must not be cut. Faces times points.
export function painted(positions: Float32Array, indices: Uint32Array, strokes: Stroke[]): Uint8Array {
  const states = new Uint8Array(indices.length / 3);
  if (strokes.length === 0) return states;
  for (let face = 0; face < states.length; ++face) {
    const { middle, normal } = faceOf(positions, indices, face);
    for (const stroke of strokes)
      if (stroke.points.some((point) => isNear(point, stroke.radius_mm, middle, normal)))
        states[face] = stroke.surface === "ignore" ? 1 : stroke.surface === "no_cut" ? 2 : 0;
  }
  return states;
}

function isNear(point: Stroke["points"][0], radius: number, middle: Vec3, normal: Vec3): boolean {
  const [x, y, z, nx, ny, nz] = point;
  const away = (middle[0] - x) ** 2 + (middle[1] - y) ** 2 + (middle[2] - z) ** 2;
  return away <= radius * radius && nx * normal[0] + ny * normal[1] + nz * normal[2] > 0;
}

function faceOf(positions: Float32Array, indices: Uint32Array, face: number): { middle: Vec3; normal: Vec3 } {
  const at = (corner: number, axis: number) => positions[3 * indices[3 * face + corner]! + axis]!;
  const middle = [0, 1, 2].map((axis) => (at(0, axis) + at(1, axis) + at(2, axis)) / 3) as Vec3;
  const a = [0, 1, 2].map((axis) => at(1, axis) - at(0, axis)) as Vec3;
  const b = [0, 1, 2].map((axis) => at(2, axis) - at(0, axis)) as Vec3;
  return { middle, normal: [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]] };
}

export interface Brush {
  surface: Surface | null; // null: a drag turns the view
  radius: number;
}

interface Props {
  brush: Brush;
  strokes: Stroke[];
  onBrush: (brush: Brush) => void;
  onStrokes: (strokes: Stroke[]) => void;
  missed: boolean; // nothing was in the middle of the view
  onMiddle: () => void; // paints what is in the middle of the view
}

export function BrushPanel({ brush, strokes, onBrush, onStrokes, missed, onMiddle }: Props) {
  return (
    <fieldset>
      <legend>Paint</legend>
      <div class="row">
        <button type="button" aria-pressed={brush.surface === null} onClick={() => onBrush({ ...brush, surface: null })}>
          Turn the view
        </button>
        {SURFACES.map(({ surface, words }) => (
          <button
            key={surface}
            type="button"
            aria-pressed={brush.surface === surface}
            onClick={() => onBrush({ ...brush, surface })}
          >
            {words}
          </button>
        ))}
      </div>
      <div class="row">
        <NumberField label="Radius" unit="mm" min={0.1} value={brush.radius} onValue={(radius) => onBrush({ ...brush, radius })} />
        <button type="button" disabled={brush.surface === null} onClick={onMiddle}>
          Paint the middle of the view
        </button>
        <button type="button" disabled={strokes.length === 0} onClick={() => onStrokes(strokes.slice(0, -1))}>
          Take the last stroke back
        </button>
      </div>
      <p class="note" role="status">
        {missed && "The scan is not in the middle of the view: turn it, or Fit. "}
        {strokes.length === 0 ? "Nothing is painted." : strokes.length === 1 ? "1 stroke." : `${strokes.length} strokes.`} Grey may stay; red must not be cut. Painting
        ends with Begin.
      </p>
      {strokes.length > 0 && (
        <table>
          <caption>Strokes</caption>
          <tbody>
            {strokes.map((stroke, i) => (
              <tr key={i}>
                <th scope="row">{i + 1}</th>
                <td>{SURFACES.find((one) => one.surface === stroke.surface)?.words}</td>
                <td class="figure">{length(stroke.radius_mm)}</td>
                <td class="figure">
                  {stroke.points.length} {stroke.points.length === 1 ? "point" : "points"}
                </td>
                <td>
                  <button type="button" class="quiet" aria-label={`Remove stroke ${i + 1}`} onClick={() => onStrokes(strokes.filter((one) => one !== stroke))}>
                    Remove
                  </button>
                </td>
              </tr>
            ))}
          </tbody>
        </table>
      )}
    </fieldset>
  );
}
