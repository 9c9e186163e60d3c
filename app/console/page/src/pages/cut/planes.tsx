// The table of planes, best first, with every term. While a weight moves its order is the sum of the terms that are there:
// dashed, and called provisional.

import { isSame, planeOf, type CutPlane } from "../../geometry/plane";
import { termsOf, type RankedPlane } from "../../geometry/ranking";
import type { Terms } from "../../link/documents";
import { useKeptFocus } from "../../parts/kept_focus";
import { number, term, titled } from "../../parts/words";

interface Props {
  planes: RankedPlane[];
  weights: Terms;
  isExact: boolean;
  plane: CutPlane | null;
  candidates: number;
  onPlane: (plane: CutPlane) => void;
}

export function PlaneTable({ planes, weights, isExact, plane, candidates, onPlane }: Props) {
  useKeptFocus();
  const terms = termsOf(weights);
  return (
    <div class={`planes ${isExact ? "" : "provisional"}`}>
      <p role="status">
        {isExact ? (
          <>
            The {planes.length} best of {candidates} planes that were evaluated whole, best first.
          </>
        ) : (
          <>
            <strong>Provisional order</strong> by the weights as they stand; the engine evaluates the planes again.
          </>
        )}
      </p>
      <div class="scroll" tabIndex={0} role="region" aria-label="Planes, best first">
        <table>
          <caption class="unseen">Planes, best first{isExact ? "" : ", provisional"}</caption>
          <thead>
            <tr>
              <th scope="col">Plane</th>
              {terms.map((name) => (
                <th key={name} scope="col" class="figure" title={`Weight ${weights[name]}`}>
                  {titled(name)}
                </th>
              ))}
              <th scope="col" class="figure">
                Total
              </th>
            </tr>
          </thead>
          <tbody>
            {planes.map(({ plane: row, total }, place) => {
              const own = planeOf(row);
              const isChosen = plane !== null && isSame(own, plane);
              return (
                <tr key={`${own.normal.join()} ${own.offset}`} class={isChosen ? "chosen" : ""} onClick={() => onPlane(own)}>
                  <th scope="row">
                    <label>
                      <input
                        type="radio"
                        name="plane"
                        checked={isChosen}
                        onChange={() => onPlane(own)}
                        aria-label={`Plane ${place + 1}, total ${number(total, 3)}${row.sections_cross ? ", sections cross" : ""}`}
                      />{" "}
                      {place + 1}
                      {row.sections_cross && <span title="Sections cross: the piece runs through itself there"> ⚠</span>}
                    </label>
                  </th>
                  {terms.map((name) => (
                    <td key={name} class="figure">
                      {term(name, row.terms[name] ?? 0)}
                    </td>
                  ))}
                  <td class="figure">
                    <strong>{number(total, 3)}</strong>
                  </td>
                </tr>
              );
            })}
          </tbody>
        </table>
      </div>
    </div>
  );
}
