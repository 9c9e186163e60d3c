// All bases of a piece with their figures, and the decisions on its setup: another base, fewer orientations, automatic again.

import { useEffect, useState } from "preact/hooks";
import { askWhole } from "../../link/api";
import type { Project, Setup, SetupDocument } from "../../link/documents";
import { useAsking } from "../../parts/asking";
import { ErrorBox, sentence } from "../../parts/error";
import { decide } from "../../parts/header";
import { NumberField } from "../../parts/number_field";
import { Signed } from "../../parts/signed";
import { percent, words } from "../../parts/words";

// What the engine said of a piece: all its bases, the one in force first, what was decided of them, and the id of the states
// of its surface by the one in force.
export interface Laid {
  setups: Setup[];
  ordered: SetupDocument["pieces"][0]["ordered"];
  states: string | null;
}

interface Props {
  project: Project;
  piece: string;
  off: boolean;
  found: Laid | null;
  looked: number | null; // the number of the base that is looked at
  onFound: (found: Laid) => void;
  onLook: (base: number | null) => void;
}

// All bases are asked for: computing them takes the engine a while, but not those of a prepared piece, which it keeps.
export function Bases({ project, piece, off, found, looked, onFound, onLook }: Props) {
  const [done, setDone] = useState("");
  const asking = useAsking();
  const compare = () =>
    asking.run(async () => {
      const answer = await askWhole<{ document: SetupDocument; states?: string }>(project.id, "setups", { piece });
      const { setups = [], ordered = null } = answer.document.pieces.find((one) => one.name === piece) ?? {};
      onFound({ setups, ordered, states: answer.states ?? null });
    });
  const order = (setup: object) =>
    asking.run(async () => {
      setDone(await decide(project, { setup: { piece, ...setup } }));
      onLook(null);
    });
  const isOff = off || asking.busy;
  const inForce = found?.setups[0];
  const mayAsk = project.stage === "done" && found === null && !off;
  useEffect(() => {
    if (mayAsk) compare();
  }, [mayAsk]);
  return (
    <section>
      <h2>Bases</h2>
      <p class="row">
        <button type="button" disabled={isOff} onClick={compare}>
          Compare all bases
        </button>
        <button type="button" disabled={isOff} onClick={() => order({ automatic: true })}>
          Automatic again
        </button>
      </p>
      {inForce?.reach && <Fewer key={inForce.reach.orientations.length} now={inForce.reach.orientations.length} off={isOff} onOrder={(orientations) => order({ orientations })} />}
      <p role="status">{sentence(done)}</p>
      <ErrorBox error={asking.error} actions={{ try_again: asking.again, show: asking.clear }} onClose={asking.clear} />
      {found?.ordered && <p>By decision: {orderedWords(found.ordered)}.</p>}
      {found && (
        <table>
          <caption class="unseen">Bases of piece {piece}</caption>
          <thead>
            <tr>
              <th scope="col">Base</th>
              <th scope="col">Block</th>
              <th scope="col" class="figure">
                Out of reach
              </th>
              <th scope="col" class="figure">
                Orientations
              </th>
              <th scope="col">Fits</th>
              <th scope="col">
                <span class="unseen">Look and choose</span>
              </th>
            </tr>
          </thead>
          <tbody>
            {found.setups.map((setup) => (
              <BaseRow key={setup.base_number} setup={setup} isLooked={setup.base_number === looked} off={isOff} onLook={onLook} onOrder={order} />
            ))}
          </tbody>
        </table>
      )}
    </section>
  );
}

interface RowProps {
  setup: Setup;
  isLooked: boolean;
  off: boolean;
  onLook: (base: number | null) => void;
  onOrder: (setup: object) => void;
}

function BaseRow({ setup, isLooked, off, onLook, onOrder }: RowProps) {
  return (
    <tr>
      <th scope="row">{words(setup.base_description)}</th>
      <td>{setup.block ?? "none"}</td>
      <td class="figure">{setup.reach ? percent(setup.reach.unreachable_share) : "not known"}</td>
      <td class="figure">{setup.reach?.orientations.length ?? 0}</td>
      <td>
        <Signed state={setup.fits ? "ready" : "failed"} word={setup.fits ? "fits" : "does not fit"} />
      </td>
      <td class="row">
        <button type="button" class="quiet" aria-pressed={isLooked} aria-label={`Show ${setup.base_description}`} onClick={() => onLook(isLooked ? null : setup.base_number)}>
          Show
        </button>
        <button type="button" disabled={off} aria-label={`Choose ${setup.base_description}`} onClick={() => onOrder({ base: setup.base_number })}>
          Choose
        </button>
      </td>
    </tr>
  );
}

function Fewer({ now, off, onOrder }: { now: number; off: boolean; onOrder: (orientations: number) => void }) {
  const [most, setMost] = useState(now);
  const isWhole = Number.isInteger(most);
  return (
    <p class="row">
      <NumberField label="Tool orientations at most" min={1} value={most} onValue={setMost} />
      <button type="button" disabled={off || !isWhole} onClick={() => onOrder(most)}>
        {isWhole ? `Take at most ${most}` : "Give a whole number"}
      </button>
    </p>
  );
}

function orderedWords({ base_number, max_directions, tools }: NonNullable<Laid["ordered"]>): string {
  return [
    ...(base_number === null ? [] : [`base ${base_number}`]),
    ...(max_directions === null ? [] : [`at most ${max_directions} tool orientation${max_directions === 1 ? "" : "s"}`]),
    ...(tools === null ? [] : [`tools ${tools.join(", ")}`]),
  ].join(", ");
}
