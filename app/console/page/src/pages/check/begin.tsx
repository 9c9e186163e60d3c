// Begin: cell, preset, name, and the project is made.

import { useEffect, useState } from "preact/hooks";
import { go } from "../../address";
import { get, post } from "../../link/api";
import type { Check, Choices } from "../../link/documents";
import { useAsking } from "../../parts/asking";
import { ErrorBox } from "../../parts/error";
import { NumberField } from "../../parts/number_field";
import { useWork } from "../../parts/work_result";
import { fileName, length } from "../../parts/words";
import { chosen, type RepairChoices } from "./repair";
import { mmOf } from "./scales";
import type { Stroke } from "./strokes";

interface Props {
  check: Check;
  units: string | null;
  choices: RepairChoices;
  strokes: Stroke[];
  off: boolean;
}

const isSafeName = (name: string): boolean => /^[\p{L}\p{N}][\p{L}\p{N} ._-]{0,99}$/u.test(name);

export function BeginPanel({ check, units, choices, strokes, off }: Props) {
  const [offered, setOffered] = useState<Choices | null>(null);
  const [name, setName] = useState(nameOf(check.inspect.file));
  const [cell, setCell] = useState("");
  const [preset, setPreset] = useState("carve");
  const [scale, setScale] = useState(1);
  const [fragment, setFragment] = useState(0);
  const [isSizeRight, setSizeRight] = useState(false);
  const asking = useAsking();
  const { work, error, begin } = useWork<{ project: string }>(({ project }) => go("cut", project));
  useEffect(() => {
    get<Choices>("/api/choices").then(setOffered, () => undefined);
  }, []);
  const make = () =>
    asking.run(async () => {
      const body = {
        check: check.check,
        name,
        units,
        scale,
        cell: cell === "" ? null : cell,
        preset,
        ...(isUnusual && isSizeRight ? { size_ok: true } : {}),
        ...(fragment > 0 ? { fragment_volume_mm3: fragment } : {}),
        repair: chosen(choices),
        ...(strokes.length > 0 ? { strokes } : {}),
      };
      begin((await post<{ work: string }>("/api/projects", body)).work);
    });
  const runs = work !== null && ["queued", "running", "stopping"].includes(work.state);
  const longest = Math.max(...check.inspect.size) * mmOf(units) * scale;
  const isUnusual = units !== null && (longest < 10 || longest > 20_000); // as the command line asks too
  const missing =
    units === null
      ? "Choose the units first."
      : !isSafeName(name)
        ? "Give the project a name of letters and digits."
        : isUnusual && !isSizeRight
          ? "Say that the size is right."
          : "";
  const sentenceOf = (list: Choices["cells"] | undefined, chosen: string) => list?.find((one) => one.name === chosen)?.sentence ?? "";
  return (
    <section>
      <h2>Begin</h2>
      <label>
        Name of the project <input type="text" value={name} maxLength={100} onInput={(event) => setName(event.currentTarget.value)} />
      </label>
      <label>
        Cell{" "}
        <select value={cell} onChange={(event) => setCell(event.currentTarget.value)}>
          <option value="">none yet</option>
          {offered?.cells.map((one) => (
            <option key={one.name} value={one.name}>
              {one.name}
            </option>
          ))}
        </select>
      </label>
      <p class="note">{cell === "" ? "Without a cell the tool has no radius and tilts by up to 60 degrees." : sentenceOf(offered?.cells, cell)}</p>
      <label>
        Preset{" "}
        <select value={preset} onChange={(event) => setPreset(event.currentTarget.value)}>
          {(offered?.presets ?? [{ name: "carve", sentence: "" }]).map((one) => (
            <option key={one.name} value={one.name}>
              {one.name}
            </option>
          ))}
        </select>
      </label>
      <p class="note">{sentenceOf(offered?.presets, preset)}</p>
      <NumberField label="Enlarge by the factor" min={1e-6} value={scale} onValue={setScale} />
      <NumberField label="Solids are fragments below" unit="mm3" min={0} value={fragment} onValue={setFragment} />
      <p class="note">0: a hundred-thousandth of the volume of the scan.</p>
      {isUnusual && (
        <label class="box">
          <input type="checkbox" checked={isSizeRight} onChange={(event) => setSizeRight(event.currentTarget.checked)} /> A length of{" "}
          {length(longest)} is right
        </label>
      )}
      <p class="row">
        <button type="button" class="main" disabled={off || missing !== "" || runs || asking.busy} onClick={make}>
          Begin
        </button>
        <span role="status">{missing}</span>
      </p>
      <ErrorBox error={asking.error ?? error} actions={{ try_again: asking.again }} onClose={asking.clear} />
    </section>
  );
}

// "femur.ply" as "femur".
const nameOf = (file: string): string => fileName(file).replace(/\.gz$/i, "").replace(/\.[^.]+$/, "");
