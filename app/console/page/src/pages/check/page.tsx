// Check: the scan beside a person, what is wrong with it, repair, painting, and Begin.

import { useEffect, useMemo, useState } from "preact/hooks";
import { go, type Address } from "../../address";
import { get, post, type ApiError } from "../../link/api";
import type { Check, RepairResult, Vec3 } from "../../link/documents";
import { currentWork } from "../../link/state";
import { useStore } from "../../link/store";
import { useAsking } from "../../parts/asking";
import { asApiError, ErrorBox, sentence } from "../../parts/error";
import { useWork } from "../../parts/work_result";
import { count, fileName } from "../../parts/words";
import { useMeshes } from "../../view/meshes";
import type { Solid } from "../../view/solids";
import { View } from "../../view/view";
import { BeginPanel } from "./begin";
import { FaultTable, placesOf } from "./faults";
import { NO_CHOICES, RepairPanel, type RepairChoices } from "./repair";
import { mmOf, scaledMesh, sizeIn, unitName } from "./scales";
import { SolidTable } from "./solids";
import { BrushPanel, painted, withPoint, type Brush, type Stroke } from "./strokes";

const SCAN_COLOUR = "#e3d9c6";
const PALETTE = [SCAN_COLOUR, "#969ba0", "#cd320f"];
const NO_PLACES: Vec3[] = [];

export function CheckPage({ address, stale }: { address: Address; stale: boolean }) {
  const [check, setCheck] = useState<Check | null>(null);
  const [error, setError] = useState<ApiError | null>(null);
  useEffect(() => {
    setCheck(null);
    setError(null);
    get<Check>(`/api/checks/${address.id}`).then(setCheck, (reason: unknown) => setError(asApiError(reason)));
  }, [address.id]);
  if (check === null)
    return (
      <main>
        <h1>Check</h1>
        {error === null && <p role="status">The check is being read.</p>}
        <ErrorBox error={error} />
        {error !== null && (
          <button type="button" onClick={() => go("start")}>
            Choose a scan
          </button>
        )}
      </main>
    );
  return <Checked key={check.check} check={check} selection={address.selection} stale={stale} />;
}

function Checked({ check, selection, stale }: { check: Check; selection: Record<string, string>; stale: boolean }) {
  const { state } = useStore();
  const { inspect } = check;
  const [shown, setShown] = useState("");
  const [choices, setChoices] = useState<RepairChoices>(NO_CHOICES);
  const [repaired, setRepaired] = useState<RepairResult | null>(null);
  const [share, setShare] = useState(0.5);
  const [strokes, setStrokes] = useState<Stroke[]>([]);
  const [scale, setScale] = useState(1);
  const [fragment, setFragment] = useState(0);
  const [middle, setMiddle] = useState(0); // how often the middle of the view was painted
  const [missed, setMissed] = useState(false); // nothing was there to be painted
  const [brush, setBrush] = useState<Brush>({ surface: null, radius: 10 });
  const off = stale || (state?.read_only ?? true) || (state ? currentWork(state) !== null : true);

  const { meshes, error } = useMeshes(repaired ? [repaired.before, repaired.after] : check.mesh ? [check.mesh] : []);
  const solids = useMemo<Solid[]>(() => {
    const inMm = (id: string | undefined) => {
      const mesh = meshes.get(id ?? "");
      return mesh && scaledMesh(mesh, mmOf(inspect.units));
    };
    const scan = inMm(repaired?.before ?? check.mesh);
    const after = inMm(repaired?.after);
    if (!scan) return [];
    if (after) {
      return [
        { name: "before", mesh: scan, colour: "#c9b08f", clip: "left" },
        { name: "after", mesh: after, colour: SCAN_COLOUR, clip: "right" },
      ];
    }
    if (strokes.length === 0) return [{ name: "scan", mesh: scan, colour: SCAN_COLOUR }];
    return [{ name: "scan", mesh: scan, colour: SCAN_COLOUR, states: { of: painted(scan.positions, scan.indices, strokes), palette: PALETTE } }];
  }, [meshes, repaired, strokes]);
  const places = useMemo(
    () => (shown === "" ? NO_PLACES : placesOf(check, shown).map((point) => point.map((value) => value * mmOf(inspect.units)) as Vec3)),
    [shown, check],
  );
  return (
    <main class="check">
      <h1 class="unseen">Check {fileName(inspect.file)}</h1>
      <div class="left">
        <Verdict check={check} />
        <Units check={check} selection={selection} off={off} />
        <FaultTable check={check} shown={shown} onShow={setShown} />
        <SolidTable inspect={inspect} scale={scale} limit={fragment} onLimit={setFragment} />
      </div>
      <div class="middle">
        <View
          label={`The scan ${fileName(inspect.file)}, ${inspect.size_text ?? "of unknown units"}, beside a person of 1.75 m`}
          solids={solids}
          places={places}
          person={inspect.units !== null && repaired === null && strokes.length === 0 && brush.surface === null}
          middle={middle}
          onMiddle={(isPainted) => setMissed(!isPainted)}
          {...(repaired ? { share } : {})}
          onStroke={
            brush.surface === null ? null : (picked, isFirst) => setStrokes((old) => withPoint(old, brush, picked, isFirst))
          }
        />
        <p class="note">The person beside it is 1.75 m tall. The view shows a simplified mesh; all figures are the engine's.</p>
        <ErrorBox error={error} />
      </div>
      <div class="right">
        <RepairPanel
          check={check.check}
          off={off}
          choices={choices}
          result={repaired}
          share={share}
          onChoices={setChoices}
          onResult={setRepaired}
          onShare={setShare}
        />
        {repaired === null ? (
          <BrushPanel brush={brush} strokes={strokes} onBrush={setBrush} onStrokes={setStrokes} missed={missed} onMiddle={() => setMiddle(middle + 1)} />
        ) : (
          <button type="button" onClick={() => setRepaired(null)}>
            Show the scan as it is
          </button>
        )}
        <BeginPanel
          check={check}
          units={inspect.units}
          scale={scale}
          fragment={fragment}
          choices={choices}
          strokes={strokes}
          cutsOf={selection["cuts"] ?? ""}
          off={off}
          onScale={setScale}
        />
      </div>
    </main>
  );
}

function Verdict({ check: { inspect } }: { check: Check }) {
  return (
    <section>
      <h2>{fileName(inspect.file)}</h2>
      <p>
        <strong>{inspect.size_text ?? "The file has no units."}</strong>
        <br />
        {count(inspect.faces)} faces, {inspect.format}
      </p>
      <p>
        Verdict: <strong>{inspect.verdict}</strong>
      </p>
      {inspect.reasons.map((reason) => (
        <p key={reason}>{sentence(reason)}</p>
      ))}
      {inspect.warnings.map((warning) => (
        <p key={warning} class="state warn">
          <span aria-hidden="true">⚠ </span>
          {warning}
        </p>
      ))}
    </section>
  );
}

// A file without units: a button each, with the size that it gives. The scan is checked again in those.
function Units({ check, selection, off }: { check: Check; selection: Record<string, string>; off: boolean }) {
  const scan = selection["scan"] ?? "";
  const { inspect } = check;
  const asking = useAsking();
  const { work, error, begin } = useWork<Check>((result) => go("check", result.check, selection));
  if (inspect.units_in_file !== null) return <p>Units: {unitName(inspect.units_in_file)}, as the file says.</p>;
  const choose = (units: string) =>
    asking.run(async () =>
      begin((await post<{ work: string }>("/api/checks", { scan, units })).work),
    );
  const runs = work !== null && ["queued", "running"].includes(work.state);
  return (
    <fieldset>
      <legend>{inspect.units === null ? "What is one unit of the file?" : `Units: ${unitName(inspect.units)}, as chosen`}</legend>
      {["mm", "cm", "m", "in"].map((unit) => (
        <button
          key={unit}
          type="button"
          class="wide"
          aria-pressed={inspect.units === unit}
          disabled={off || asking.busy || runs || scan === ""}
          onClick={() => choose(unit)}
        >
          <strong>{unitName(unit)}</strong> {sizeIn(inspect, unit)}
        </button>
      ))}
      <ErrorBox error={asking.error ?? error} actions={{ try_again: asking.again }} onClose={asking.clear} />
    </fieldset>
  );
}
