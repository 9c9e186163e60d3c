// Begin: cell, preset, name, and the project is made.

import { useEffect, useState } from "preact/hooks";
import { go } from "../../address";
import { get, post } from "../../link/api";
import type { Check, Choices, Files, MadeProject } from "../../link/documents";
import { useAsking } from "../../parts/asking";
import { ErrorBox, sentence } from "../../parts/error";
import { NumberField } from "../../parts/number_field";
import { useWork } from "../../parts/work_result";
import { fileName, length } from "../../parts/words";
import { nameProblem, projectName } from "./names";
import { chosen, type RepairChoices } from "./repair";
import { mmOf } from "./scales";
import type { Stroke } from "./strokes";

interface Props {
  check: Check;
  units: string | null;
  scale: number;
  fragment: number; // mm3; 0: as the engine does
  choices: RepairChoices;
  strokes: Stroke[];
  cutsOf: string; // the id of the project whose cuts are made again; empty: none
  off: boolean;
  onScale: (scale: number) => void;
}

export function BeginPanel(props: Props) {
  const { check, units, scale, fragment, choices, strokes, off, onScale } = props;
  const [offered, setOffered] = useState<Choices | null>(null);
  const [files, setFiles] = useState<Files | null>(null);
  const [typed, setTyped] = useState<string | null>(null); // null: as proposed
  const [cutsOf, setCutsOf] = useState(props.cutsOf);
  const [cell, setCell] = useState("");
  const [preset, setPreset] = useState(props.cutsOf === "" ? "carve" : "");
  const [isSizeRight, setSizeRight] = useState(false);
  const asking = useAsking();
  const [made, setMade] = useState<MadeProject | null>(null); // with something to be told
  const { work, error, begin } = useWork<MadeProject>((result) => {
    if (result.project !== "" && result.segment.notes.length === 0) go("cut", result.project);
    else setMade(result);
  });
  useEffect(() => {
    get<Choices>("/api/choices").then(setOffered, () => undefined);
    get<Files>("/api/files").then(setFiles, () => undefined);
  }, []);
  const withCuts = files?.projects.filter((one) => (one.cuts ?? 0) > 0) ?? [];
  const taken = files?.projects.map((one) => one.name) ?? [];
  const name = typed ?? freeName(nameOf(check.inspect.file), taken);
  const make = () =>
    asking.run(async () => {
      setMade(null);
      const body = {
        check: check.check,
        name: projectName(name),
        units,
        scale,
        cell: cell === "" ? null : cell,
        ...(preset === "" ? {} : { preset }),
        ...(cutsOf === "" ? {} : { cuts_of: cutsOf }),
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
  const problem = nameProblem(projectName(name), taken);
  const missing =
    units === null
      ? "Choose the units first."
      : problem !== ""
        ? problem
        : isUnusual && !isSizeRight
          ? "Say that the size is right."
          : "";
  const sentenceOf = (list: Choices["cells"] | undefined, chosen: string) => list?.find((one) => one.name === chosen)?.sentence ?? "";
  return (
    <section>
      <h2>Begin</h2>
      <label>
        Name of the project <input type="text" value={name} aria-invalid={problem !== ""} onInput={(event) => setTyped(event.currentTarget.value)} />
      </label>
      {withCuts.length > 0 && (
        <label>
          Cuts{" "}
          <select
            value={cutsOf}
            onChange={(event) => {
              setCutsOf(event.currentTarget.value);
              setPreset(event.currentTarget.value === "" ? "carve" : "");
            }}
          >
            <option value="">none yet</option>
            {withCuts.map((one) => (
              <option key={one.id} value={one.id}>
                those of {one.name}
              </option>
            ))}
          </select>
        </label>
      )}
      {cutsOf !== "" && <p class="note">Its cuts are made again on this scan, as it is painted now; setups and jobs are not taken over.</p>}
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
          {cutsOf !== "" && <option value="">the weights of that project</option>}
          {(offered?.presets ?? [{ name: "carve", sentence: "" }]).map((one) => (
            <option key={one.name} value={one.name}>
              {one.name}
            </option>
          ))}
        </select>
      </label>
      <p class="note">{sentenceOf(offered?.presets, preset)}</p>
      <NumberField label="Enlarge by the factor" min={1e-6} value={scale} onValue={onScale} />
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
      {made && <Told made={made} />}
      <ErrorBox error={asking.error ?? error} actions={{ try_again: asking.again }} onClose={asking.clear} />
    </section>
  );
}

// What is to be told of the cuts that were made again.
function Told({ made }: { made: MadeProject }) {
  const { notes, demand_met } = made.segment;
  return (
    <div role="status">
      <p class={demand_met ? "" : "state warn"}>
        {!demand_met && <span aria-hidden="true">⚠ </span>}
        {notes.map(sentence).join(" ")}
      </p>
      {made.project !== "" && (
        <button type="button" onClick={() => go("cut", made.project)}>
          Open the project
        </button>
      )}
    </div>
  );
}

// "femur 2" where there is a project femur.
function freeName(name: string, taken: readonly string[]): string {
  const isTaken = (one: string) => taken.includes(`${one}.qch`);
  for (let n = 2, one = name; ; ++n) {
    if (!isTaken(one)) return one;
    one = `${name} ${n}`;
  }
}

// "femur.ply" as "femur".
const nameOf = (file: string): string => fileName(file).replace(/\.gz$/i, "").replace(/\.[^.]+$/, "");
