// Repair of the scan, to look at before the project begins: choices as of the command repair, before and after by a slider.

import { useState } from "preact/hooks";
import { post } from "../../link/api";
import type { RepairResult } from "../../link/documents";
import { useAsking } from "../../parts/asking";
import { ErrorBox } from "../../parts/error";
import { NumberField } from "../../parts/number_field";
import { useWork } from "../../parts/work_result";
import { count, length, words } from "../../parts/words";

export interface RepairChoices {
  fill: "auto" | "flat" | "fair" | "none";
  snap_borders_mm: number;
  smooth_pen_grooves: boolean;
  resolve_self_intersections: boolean;
  alpha_wrap_mm: number;
}

export const NO_CHOICES: RepairChoices = {
  fill: "auto",
  snap_borders_mm: 0,
  smooth_pen_grooves: false,
  resolve_self_intersections: false,
  alpha_wrap_mm: 0,
};

// What differs from the usual: a length of 0 is none, and would ask for the units.
export const chosen = (choices: RepairChoices): Partial<RepairChoices> =>
  Object.fromEntries(Object.entries(choices).filter(([key, value]) => value !== NO_CHOICES[key as keyof RepairChoices]));

const FILLS = { auto: "small holes flat, large ones fair", flat: "flat", fair: "fair", none: "not at all" };

interface Props {
  check: string;
  off: boolean;
  choices: RepairChoices;
  result: RepairResult | null;
  share: number;
  onChoices: (choices: RepairChoices) => void;
  onResult: (result: RepairResult | null) => void;
  onShare: (share: number) => void;
}

export function RepairPanel(props: Props) {
  const { check, off, choices, result, share, onChoices, onResult, onShare } = props;
  const asking = useAsking();
  const { work, error, begin } = useWork<RepairResult>(onResult);
  const [open, setOpen] = useState(false);
  const repair = () =>
    asking.run(async () => begin((await post<{ work: string }>(`/api/checks/${check}/repair`, chosen(choices))).work));
  const set = (part: Partial<RepairChoices>) => onChoices({ ...choices, ...part });
  const runs = work !== null && ["queued", "running", "stopping"].includes(work.state);
  return (
    <details open={open} onToggle={(event) => setOpen(event.currentTarget.open)}>
      <summary>
        <h2>Repair</h2>
      </summary>
      <label>
        Close holes{" "}
        <select value={choices.fill} onChange={(event) => set({ fill: event.currentTarget.value as RepairChoices["fill"] })}>
          {Object.entries(FILLS).map(([value, text]) => (
            <option key={value} value={value}>
              {text}
            </option>
          ))}
        </select>
      </label>
      <NumberField label="Snap borders within" unit="mm" min={0} value={choices.snap_borders_mm} onValue={(snap_borders_mm) => set({ snap_borders_mm })} />
      <Box label="Smooth pen grooves" value={choices.smooth_pen_grooves} onValue={(smooth_pen_grooves) => set({ smooth_pen_grooves })} />
      <Box label="Resolve self-intersections" value={choices.resolve_self_intersections} onValue={(resolve_self_intersections) => set({ resolve_self_intersections })} />
      <NumberField label="Alpha wrap, last resort, ball of" unit="mm" min={0} value={choices.alpha_wrap_mm} onValue={(alpha_wrap_mm) => set({ alpha_wrap_mm })} />
      <p class="row">
        <button type="button" disabled={off || runs || asking.busy} onClick={repair}>
          Repair
        </button>
      </p>
      <ErrorBox error={asking.error ?? error} actions={{ try_again: asking.again }} onClose={asking.clear} />
      {result && <Repaired result={result} share={share} onShare={onShare} />}
    </details>
  );
}

function Box({ label, value, onValue }: { label: string; value: boolean; onValue: (value: boolean) => void }) {
  return (
    <label class="box">
      <input type="checkbox" checked={value} onChange={(event) => onValue(event.currentTarget.checked)} /> {label}
    </label>
  );
}

function Repaired({ result, share, onShare }: { result: RepairResult; share: number; onShare: (share: number) => void }) {
  const { repair } = result;
  const steps = repair.steps.filter((step) => step.count > 0);
  return (
    <>
      <p role="status">
        <strong>{repair.verdict}</strong> {count(repair.faces_in)} faces before, {count(repair.faces)} after.
        {repair.hausdorff_distance && ` The surface moved by ${length(repair.hausdorff_distance.largest)} at most.`}
      </p>
      <label>
        Before and after
        <input type="range" min={0} max={1} step={0.01} value={share} onInput={(event) => onShare(Number(event.currentTarget.value))} />
      </label>
      {steps.length > 0 && (
        <table>
          <caption>What was done</caption>
          <tbody>
            {steps.map((step) => (
              <tr key={step.step}>
                <th scope="row">{words(step.step)}</th>
                <td class="figure">{count(step.count)}</td>
                <td>{step.description}</td>
              </tr>
            ))}
          </tbody>
        </table>
      )}
      {repair.warnings.map((warning) => (
        <p key={warning} class="state warn">
          ⚠ {warning}
        </p>
      ))}
    </>
  );
}
