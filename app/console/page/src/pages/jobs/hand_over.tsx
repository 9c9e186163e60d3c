// The hand-over: the server makes a plan, the operator sees what it names, and says yes. For a real cell its name is typed, the
// focus is on Cancel, and Enter does nothing before. Nothing moves before the person at the cell consents.

import { useState } from "preact/hooks";
import { post } from "../../link/api";
import type { Plan, Project } from "../../link/documents";
import { useStore } from "../../link/store";
import { useAsking } from "../../parts/asking";
import { Dialog } from "../../parts/dialog";
import { ErrorBox } from "../../parts/error";
import { Signed } from "../../parts/signed";
import { sides, time } from "../../parts/words";

export function HandOver({ project, pieces, off }: { project: Project; pieces: string[]; off: boolean }) {
  const { state } = useStore();
  const [again, setAgain] = useState(false);
  const [accept, setAccept] = useState(false);
  const [plan, setPlan] = useState<Plan | null>(null);
  const asking = useAsking();
  const ask = () =>
    asking.run(async () => {
      const body = { pieces, again, accept_unreachable: accept };
      setPlan(await post<Plan>(`/api/projects/${project.id}/plans`, body, project.revision));
    });
  if (state === null || state.dispatch === "none") return <p class="note">This server hands no job over.</p>;
  return (
    <div>
      <p class="row">
        <button type="button" class="main" disabled={off || asking.busy || pieces.length === 0} onClick={ask}>
          Hand over {pieces.length > 0 ? pieces.join(", ") : ""}
        </button>
        <label class="box">
          <input type="checkbox" checked={again} onChange={(event) => setAgain(event.currentTarget.checked)} /> also what was carved before
        </label>
        <label class="box">
          <input type="checkbox" checked={accept} onChange={(event) => setAccept(event.currentTarget.checked)} /> accept what is out of reach
        </label>
      </p>
      <ErrorBox
        error={asking.error}
        actions={{
          try_again: asking.again,
          show: asking.clear,
          carve_again: () => setAgain(true),
          accept_unreachable: () => setAccept(true),
          asks_accept_unreachable: () => setAccept(true),
        }}
        onClose={asking.clear}
      />
      {plan && <PlanDialog plan={plan} onClose={() => setPlan(null)} />}
    </div>
  );
}

function PlanDialog({ plan, onClose }: { plan: Plan; onClose: () => void }) {
  const [typed, setTyped] = useState("");
  const asking = useAsking();
  const isReal = plan.kind === "real";
  const mayGo = !isReal || typed === plan.cell;
  const go = () =>
    asking.run(async () => {
      await post("/api/dispatches", { plan: plan.plan, ...(isReal ? { typed } : {}) });
      onClose();
    });
  return (
    <Dialog title={isReal ? `Hand over to the REAL CELL ${plan.cell}` : `Hand over to ${plan.cell}, SIMULATED: nothing moves`} onClose={onClose}>
      <table>
        <caption>In this order</caption>
        <thead>
          <tr>
            <th scope="col">Piece</th>
            <th scope="col">Block</th>
            <th scope="col" class="figure">
              Machine time
            </th>
            <th scope="col">Proof</th>
            <th scope="col">Job file</th>
          </tr>
        </thead>
        <tbody>
          {plan.jobs.map((job) => (
            <tr key={job.job}>
              <th scope="row">
                {job.piece}
                {job.part > 1 && `, part ${job.part}`}
              </th>
              <td>{sides(job.block_mm)}</td>
              <td class="figure">{time(job.time_s)}</td>
              <td>
                <Signed state={job.proven ? "positive" : "missing"} word={job.proven ? "proven" : "not proven"} />
              </td>
              <td>
                <code>{job.job.slice(0, 12)}</code>
              </td>
            </tr>
          ))}
        </tbody>
      </table>
      <p>Nothing moves before the person at the cell consents. The plan holds for two minutes.</p>
      {isReal && (
        <label>
          Type the name of the cell
          <input
            type="text"
            value={typed}
            autocomplete="off"
            onInput={(event) => setTyped(event.currentTarget.value)}
            onKeyDown={(event) => event.key === "Enter" && event.preventDefault()}
          />
        </label>
      )}
      <ErrorBox error={asking.error} />
      <p class="row">
        <button type="button" autofocus onClick={onClose}>
          Cancel
        </button>
        <button type="button" class={isReal ? "danger" : "main"} disabled={!mayGo || asking.busy} onClick={go}>
          {isReal ? "Hand over to the real cell" : "Hand over, simulated"}
        </button>
      </p>
    </Dialog>
  );
}
