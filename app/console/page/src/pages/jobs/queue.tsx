// The queue: what waits, runs and has ended, in its order.

import { post } from "../../link/api";
import type { QueueEntry } from "../../link/documents";
import { useStore } from "../../link/store";
import { useAsking } from "../../parts/asking";
import { ErrorBox, sentence } from "../../parts/error";
import { Signed } from "../../parts/signed";
import { percent, time } from "../../parts/words";

const STATE_WORDS: Record<QueueEntry["state"], string> = {
  waiting: "waiting",
  sending: "sending",
  asks: "asks at the cell",
  carving: "carving",
  held: "held",
  ended: "ended",
  not_started: "not started",
  unknown: "UNKNOWN: ask the cell",
  removed: "removed",
  not_handed_over: "not handed over",
};

export function QueueTable({ queue, off }: { queue: QueueEntry[]; off: boolean }) {
  const { state } = useStore();
  const asking = useAsking();
  const ask = (body: object) => asking.run(async () => void (await post("/api/queue", body)));
  const isPaused = state?.paused ?? false;
  const cellOf = (entry: QueueEntry) => state?.cells.find((cell) => cell.id === entry.cell);
  return (
    <section>
      <h2>Queue</h2>
      <p class="row">
        <button type="button" disabled={off || isPaused || queue.length === 0} onClick={() => ask({ action: "pause" })}>
          Pause after this one
        </button>
        <button type="button" disabled={off || queue.length === 0} onClick={() => ask({ action: "go_on" })}>
          Go on
        </button>
        <span role="status">{isPaused ? "Paused: the next job is not begun." : ""}</span>
      </p>
      <ErrorBox error={asking.error} onClose={asking.clear} />
      {queue.length === 0 && <p>Nothing is in the queue.</p>}
      {queue.length > 0 && (
        <table>
          <caption class="unseen">Queue</caption>
          <thead>
            <tr>
              <th scope="col">Piece</th>
              <th scope="col">Cell</th>
              <th scope="col">State</th>
              <th scope="col">Progress</th>
              <th scope="col">
                <span class="unseen">Action</span>
              </th>
            </tr>
          </thead>
          <tbody>
            {queue.map((entry) => {
              const cell = cellOf(entry);
              const runs = entry.state === "carving" || entry.state === "held";
              return (
                <tr key={entry.id}>
                  <th scope="row">
                    {entry.piece}
                    {entry.part > 1 && `, part ${entry.part}`}
                  </th>
                  <td>{cell?.name ?? entry.cell}</td>
                  <td>
                    <Signed state={entry.state} word={STATE_WORDS[entry.state]} /> {sentence(entry.why)}
                    {entry.state === "asks" && " The question is answered at the panel of the cell, not here."}
                  </td>
                  <td>
                    {runs && cell && cell.progress !== null && percent(cell.progress)}
                    {runs && cell && cell.elapsed_s !== null && `, ${time(cell.elapsed_s)}`}
                    {runs && cell && cell.remaining_s !== null && `, about ${time(cell.remaining_s)} left`}
                  </td>
                  <td>
                    {entry.state === "waiting" && (
                      <button
                        type="button"
                        disabled={off}
                        onClick={() => ask({ action: "remove", entry: entry.id })}
                        aria-label={`Remove piece ${entry.piece}`}
                      >
                        Remove
                      </button>
                    )}
                  </td>
                </tr>
              );
            })}
          </tbody>
        </table>
      )}
    </section>
  );
}
