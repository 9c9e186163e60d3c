// Commands to a cell beside Hold. Each names the job that it means; Stop and Abort ask once.

import { useState } from "preact/hooks";
import { post } from "../../link/api";
import type { Cell, CommandDocument } from "../../link/documents";
import { useAsking } from "../../parts/asking";
import { KIND_WORDS } from "../../parts/cell_bar";
import { Confirm } from "../../parts/dialog";
import { ErrorBox, sentence } from "../../parts/error";
import { Signed } from "../../parts/signed";
import { time } from "../../parts/words";

export function CellPanels({ cells, stale }: { cells: Cell[]; stale: boolean }) {
  return (
    <section>
      <h2>Cells</h2>
      {cells.length === 0 && <p>No cell is known here.</p>}
      {cells.map((cell) => (
        <CellPanel key={cell.id} cell={cell} off={stale} />
      ))}
    </section>
  );
}

type Command = "unhold" | "stop" | "abort" | "clear" | "reset";

const LABELS: Record<Command, string> = { unhold: "Resume", stop: "Stop", abort: "Abort", clear: "Clear", reset: "Reset" };

function CellPanel({ cell, off }: { cell: Cell; off: boolean }) {
  const [asked, setAsked] = useState<Command | null>(null);
  const [done, setDone] = useState("");
  const asking = useAsking();
  const stopping = useAsking(); // Resume and Clear wait for the person at the cell; Stop and Abort do not wait for them
  const by = (command: Command) => (command === "stop" || command === "abort" ? stopping : asking);
  const send = (command: Command) =>
    by(command).run(async () => {
      const body = { command, ...(cell.job === null ? {} : { job: cell.job }) };
      const answer = await post<CommandDocument>(`/api/cells/${cell.id}/commands`, body);
      setDone(`${LABELS[command]}: ${sentence(answer.why)} ${sentence(answer.to_do ?? "")}`);
    });
  const press = (command: Command) => (command === "stop" || command === "abort" ? setAsked(command) : send(command));
  return (
    <div class={`panel ${cell.kind}`}>
      <p>
        <strong>{cell.name}</strong>, {cell.address}, <span class={`kind ${cell.kind}`}>{KIND_WORDS[cell.kind]}</span>{" "}
        <Signed state={cell.state} />
        {cell.job !== null && (
          <>
            , job <code>{cell.job.slice(0, 12)}</code>
          </>
        )}
      </p>
      <p class="row">
        {(Object.keys(LABELS) as Command[]).map((command) => (
          <button
            key={command}
            type="button"
            class={command === "abort" || command === "stop" ? "danger" : ""}
            disabled={off || by(command).busy || cell.link !== "connected"}
            onClick={() => press(command)}
          >
            {LABELS[command]}
          </button>
        ))}
      </p>
      <p role="status">{done}</p>
      <ErrorBox error={asking.error} onClose={asking.clear} />
      <ErrorBox error={stopping.error} onClose={stopping.clear} />
      {asked !== null && (
        <Confirm title={`${LABELS[asked]} the job in ${cell.name}?`} action={LABELS[asked]} onYes={() => send(asked)} onClose={() => setAsked(null)}>
          <p>
            The piece is carved again from a new block then.
            {cell.elapsed_s !== null && ` It has run for ${time(cell.elapsed_s)}`}
            {cell.remaining_s !== null && `, about ${time(cell.remaining_s)} are left`}
            {cell.elapsed_s !== null && "."} This is no emergency stop: that is the red button.
          </p>
        </Confirm>
      )}
    </div>
  );
}
