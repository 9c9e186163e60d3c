// The solids of the scan by volume, and below which volume one is a fragment: too small to become a piece.

import type { Inspect } from "../../link/documents";
import { NumberField } from "../../parts/number_field";
import { count, volume } from "../../parts/words";
import { mmOf } from "./scales";

const SHARE = 1e-5; // of all: the engine's own limit

interface Props {
  inspect: Inspect;
  scale: number;
  limit: number; // mm3; 0: the engine's own
  onLimit: (mm3: number) => void;
}

export function SolidTable({ inspect, scale, limit, onLimit }: Props) {
  const shells = Number(inspect["shells"] ?? 0);
  const cavities = Number(inspect["cavities"] ?? 0);
  const { largest_solids: solids, solid_count } = inspect;
  const unit = (mmOf(inspect.units) * scale) ** 3;
  const hasUnits = inspect.units !== null;
  const effective = limit > 0 ? limit : SHARE * inspect.volume * unit;
  return (
    <section>
      <h2>What the scan holds</h2>
      <p>
        {count(shells)} {shells === 1 ? "shell" : "shells"}, {count(cavities)} {cavities === 1 ? "cavity" : "cavities"},{" "}
        {count(solid_count)} closed {solid_count === 1 ? "solid" : "solids"}.
        {solid_count === 0 && " A scan with holes has no solid before it is repaired."}
      </p>
      {hasUnits && solid_count > 0 && (
        <>
          <NumberField label="Solids are fragments below" unit="mm3" min={0} value={limit} onValue={onLimit} />
          <p class="note">0: a hundred-thousandth of the volume of the scan.</p>
        </>
      )}
      {solid_count > 0 && (
        <div class={solids.length > 12 ? "scroll" : ""} {...(solids.length > 12 ? { tabIndex: 0, role: "group", "aria-label": "Solids by volume" } : {})}>
          <table>
            <caption>
              Solids by volume{solids.length < solid_count ? `, the ${solids.length} largest` : ""}
            </caption>
            <thead>
              <tr>
                <th scope="col">Solid</th>
                <th scope="col" class="figure">
                  Volume
                </th>
                <th scope="col" class="figure">
                  Faces
                </th>
                <th scope="col">Becomes</th>
              </tr>
            </thead>
            <tbody>
              {solids.map((solid, i) => (
                <tr key={i}>
                  <th scope="row">{i + 1}</th>
                  <td class="figure">{hasUnits ? volume(solid.volume * unit) : `${count(solid.volume)} unit³`}</td>
                  <td class="figure">{count(solid.faces)}</td>
                  <td>
                    {hasUnits && solid.volume * unit < effective ? "a fragment" : "a piece"}
                    {hasUnits && i > 0 && (
                      <button
                        type="button"
                        class="quiet"
                        aria-label={`From here on fragments: smaller than solid ${i}`}
                        onClick={() => onLimit(solids[i - 1]!.volume * unit)}
                      >
                        From here on fragments
                      </button>
                    )}
                  </td>
                </tr>
              ))}
            </tbody>
          </table>
        </div>
      )}
    </section>
  );
}
