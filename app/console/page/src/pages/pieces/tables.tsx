// Tables of one setup of a piece: its block and what it leaves, its tool orientations, its margins.

import type { Reach, Setup } from "../../link/documents";
import { Signed } from "../../parts/signed";
import { count, length, number, percent, sides } from "../../parts/words";
import { orientationColour } from "../../view/palette";

export function SetupTable({ setup }: { setup: Setup }) {
  const { reach } = setup;
  const area = (mm2: number) => `${count(Math.round(mm2))} mm2`;
  return (
    <table>
      <caption>Setup, {setup.base_description}</caption>
      <tbody>
        <Row name="Block" value={setup.block === null ? "none is large enough" : `${setup.block}, ${sides(setup.block_mm)}`} />
        {reach && <Row name="Out of reach" value={percent(reach.unreachable_share)} />}
        {reach && <Row name="Hidden" value={area(reach.hidden_mm2)} />}
        {reach && <Row name="Steep" value={area(reach.steep_mm2)} />}
        {reach && <Row name="Too narrow" value={area(reach.too_narrow_mm2)} />}
        {reach && <Row name="Because of the holder" value={area(reach.holder_mm2)} />}
      </tbody>
    </table>
  );
}

// Each has an arrow in the view, of its colour and with as many rings as its number.
export function Orientations({ setup, reach }: { setup: Setup; reach: Reach }) {
  return (
    <>
      <table>
        <caption>Tool orientations, {setup.base_description}</caption>
        <thead>
          <tr>
            <th scope="col">Number</th>
            <th scope="col" class="figure">
              Tilt
            </th>
            <th scope="col" class="figure">
              Tool axis
            </th>
            <th scope="col" class="figure">
              Surface gained
            </th>
            <th scope="col" class="figure">
              Depth
            </th>
          </tr>
        </thead>
        <tbody>
          {reach.orientations.map((one, i) => (
            <tr key={i}>
              <th scope="row">
                <span class="patch" style={{ backgroundColor: orientationColour(i) }} aria-hidden="true" /> {i + 1}
              </th>
              <td class="figure">{number(one.tilt_deg, 0)}°</td>
              <td class="figure">{one.tool_axis.map((part) => number(part, 3)).join(", ")}</td>
              <td class="figure">{percent(one.gained_share)}</td>
              <td class="figure">{length(one.depth_mm)}</td>
            </tr>
          ))}
        </tbody>
      </table>
      <p class="note">An arrow in the view shows where the tool comes in, with as many rings as its number. Axes are in the frame of the scan.</p>
    </>
  );
}

export function Margins({ setup, margins }: { setup: Setup; margins: Record<string, number> }) {
  const rows = Object.entries(margins);
  const least = rows.reduce<[string, number] | null>((least, row) => (least === null || row[1] < least[1] ? row : least), null);
  if (least === null) return null;
  return (
    <details>
      <summary>
        Margins: the least {length(least[1])}, {least[0]}
      </summary>
      <table>
        <caption>Margins, {setup.base_description}</caption>
        <tbody>
          {rows.map(([name, value]) => (
            <tr key={name}>
              <th scope="row">{name}</th>
              <td class="figure">{value < 0 ? <Signed state="failed" word={`${length(-value)} are missing`} /> : length(value)}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </details>
  );
}

const Row = ({ name, value }: { name: string; value: string }) => (
  <tr>
    <th scope="row">{name}</th>
    <td>{value}</td>
  </tr>
);
