// The cells, always at the bottom: kind, state, age of its reading, Hold. Hold is one click or F9, asks nothing, and can be
// asked even when the page has heard nothing of the server for a while.

import { useEffect, useState } from "preact/hooks";
import { post } from "../link/api";
import type { Cell, CommandDocument } from "../link/documents";
import { useStore } from "../link/store";
import { asApiError, ErrorBox, sentence } from "./error";
import type { ApiError } from "../link/api";
import { useKey } from "./keys";
import { Signed } from "./signed";
import { age, percent, time } from "./words";

export const KIND_WORDS = {
  real: "REAL CELL",
  simulated: "SIMULATED: nothing moves",
  unknown: "KIND UNKNOWN: take it for real",
} as const;

export function CellBar({ stale, now }: { stale: boolean; now: number }) {
  const { state, lastTick } = useStore();
  const cells = state?.cells ?? [];
  return (
    <footer aria-label="Cells">
      {stale && (
        <p class="staleness" role="status">
          <span aria-hidden="true">✕ </span>
          <strong>The server is silent{lastTick > 0 ? ` since ${time((now - lastTick) / 1000)}` : ""}.</strong> What is shown is
          as it was then. Hold may not arrive: press the red button at the cell.
        </p>
      )}
      {cells.length === 0 && (
        <p class="cell">No cell is known here. This page is no safety device: what stops the machine is the red button.</p>
      )}
      {cells.map((cell) => (
        <CellLine key={cell.id} cell={cell} stale={stale} />
      ))}
    </footer>
  );
}

function CellLine({ cell, stale }: { cell: Cell; stale: boolean }) {
  const { hold, said, error } = useHold(cell);
  useKey("hold", hold);
  return (
    <div class={`cell ${cell.kind}`} data-cell={cell.id}>
      <strong>{cell.name}</strong>
      <span class={`kind ${cell.kind}`}>{KIND_WORDS[cell.kind]}</span>
      <span class={stale ? "grey" : ""}>
        <Signed state={cell.link === "connected" ? cell.state : "unknown"} word={stateWord(cell)} />
        {cell.progress !== null && ` ${percent(cell.progress)}`}
        {cell.elapsed_s !== null && `, ${time(cell.elapsed_s)}`}
        {cell.remaining_s !== null && `, about ${time(cell.remaining_s)} left`}
        {cell.program_chunk !== null && `, chunk ${cell.program_chunk}, line ${cell.program_line}, tool ${cell.tool}`}
      </span>
      <ReadAge cell={cell} />
      <span class="note">In danger press the red button at the cell.</span>
      <span role="status">{said}</span>
      <ErrorBox error={error} />
      <button type="button" class="hold" onClick={hold} aria-keyshortcuts="F9">
        <span aria-hidden="true">‖ </span>Hold
      </button>
    </div>
  );
}

function stateWord(cell: Cell): string {
  if (cell.link === "never") return "not reached yet";
  if (cell.link === "lost") return `unknown, the link is lost; it was ${cell.state}`;
  return cell.asks ? `${cell.state}; a person at the cell is asked` : cell.state;
}

// Counts on from when the reading came.
function ReadAge({ cell }: { cell: Cell }) {
  const [came, setCame] = useState(performance.now());
  useEffect(() => setCame(performance.now()), [cell]);
  if (cell.read_ms_ago === null) return null;
  return <span>read {age(cell.read_ms_ago + Math.max(0, performance.now() - came))}</span>;
}

// Every press is a request of its own, also while one is under way: none is lost to a slow answer.
function useHold(cell: Cell) {
  const [said, setSentence] = useState("");
  const [error, setError] = useState<ApiError | null>(null);
  const hold = () => {
    setSentence("Hold is sent.");
    setError(null);
    post<CommandDocument>(`/api/cells/${cell.id}/commands`, { command: "hold" })
      .then((answer) => setSentence(`Hold: ${sentence(answer.why)} ${sentence(answer.to_do ?? "")}`))
      .catch((reason: unknown) => {
        setSentence("");
        setError(asApiError(reason));
      });
  };
  return { hold, said, error };
}
