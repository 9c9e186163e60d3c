// How the pieces of a plane would be milled, before it is decided: asked for by a button, because it takes seconds.

import { useEffect, useState } from "preact/hooks";
import { STATES } from "../../geometry/display_mesh";
import { asNumbers, planeText, type CutPlane } from "../../geometry/plane";
import { ask } from "../../link/api";
import type { MilledPiece, Project, Segment } from "../../link/documents";
import { useAsking } from "../../parts/asking";
import { ErrorBox } from "../../parts/error";
import { Signed } from "../../parts/signed";
import { count, number, percent, words } from "../../parts/words";

const COLOURS: Record<string, string> = Object.fromEntries(
  ["reached", "too_narrow", "steep", "holder", "hidden", "ignored", "base"].map((key, i) => [key, STATES[i]!.colour]),
);

export function TriedBySetups({ project, piece, plane, off }: { project: Project; piece: string; plane: CutPlane; off: boolean }) {
  const [found, setFound] = useState<MilledPiece[] | null>(null);
  const asking = useAsking();
  const key = `${project.revision} ${piece} ${planeText(plane)}`;
  useEffect(() => setFound(null), [key]);
  const tryIt = () =>
    asking.run(async () => {
      const segment = await ask<Segment>(project.id, "preview", { piece, plane: asNumbers(plane), setups: true });
      setFound(segment.preview?.milled_pieces?.pieces ?? []);
    });
  return (
    <>
      <p class="row">
        <button type="button" disabled={off || asking.busy} onClick={tryIt}>
          Try by setups
        </button>
        <span role="status">{asking.busy ? "The engine sets the pieces up." : ""}</span>
      </p>
      <ErrorBox error={asking.error} actions={{ try_again: asking.again }} onClose={asking.clear} />
      {found?.map((milled) => (
        <Milled key={milled.name} milled={milled} />
      ))}
    </>
  );
}

function Milled({ milled }: { milled: MilledPiece }) {
  const setup = milled.setups[0];
  return (
    <table>
      <caption>
        Piece {milled.side}: {setup?.base_description ?? "no base"}, block {setup?.block ?? "none"},{" "}
        {count(setup?.reach?.orientations.length ?? 0)} orientations,{" "}
        {setup?.reach ? `${percent(setup.reach.unreachable_share)} out of reach` : "out of reach not known"}{" "}
        <Signed state={milled.fits ? "ready" : "failed"} word={milled.fits ? "fits" : "does not fit"} />
      </caption>
      <tbody>
        {Object.entries(milled.areas_mm2)
          .filter(([, area]) => area > 0)
          .map(([state, area]) => (
            <tr key={state}>
              <th scope="row">
                <span class="patch" style={{ backgroundColor: COLOURS[state] ?? "#ffffff" }} aria-hidden="true" />
                {words(state)}
              </th>
              <td class="figure">{number(area / 100, 1)} cm2</td>
            </tr>
          ))}
      </tbody>
    </table>
  );
}
