// What was handed over and carved, and when: the jobs of the journals of all cells, the newest first. Only read.

import { useEffect, useState } from "preact/hooks";
import { get, type ApiError } from "../../link/api";
import type { JournalDocument, JournalJob } from "../../link/documents";
import { asApiError, ErrorBox } from "../../parts/error";
import { Signed } from "../../parts/signed";
import { moment, time } from "../../parts/words";

const MOST = 100;

interface Props {
  pieces: Map<string, string>; // by the SHA-256 of their job files, as far as they are known here
  mark: string; // the journals are read again when it changes
}

export function CarvedTable({ pieces, mark }: Props) {
  const [journals, setJournals] = useState<JournalDocument["journals"] | null>(null);
  const [error, setError] = useState<ApiError | null>(null);
  useEffect(() => {
    let gone = false;
    get<JournalDocument>("/api/journal").then(
      (found) => gone || (setJournals(found.journals), setError(null)),
      (reason: unknown) => gone || setError(asApiError(reason)),
    );
    return () => {
      gone = true;
    };
  }, [mark]);
  const rows = (journals ?? [])
    .flatMap((journal) => journal.jobs.map((job) => ({ job, cell: cellWords(journal) })))
    .sort((a, b) => b.job.created_ms - a.job.created_ms);
  return (
    <section>
      <h2>What was carved</h2>
      <ErrorBox error={error} />
      {journals !== null && rows.length === 0 && <p>No job was handed to a cell yet.</p>}
      {rows.length > 0 && (
        <table>
          <caption class="unseen">Jobs of the journals of cells</caption>
          <thead>
            <tr>
              <th scope="col">Piece</th>
              <th scope="col">Cell</th>
              <th scope="col">Handed over</th>
              <th scope="col">Started</th>
              <th scope="col">Ended</th>
              <th scope="col">How</th>
            </tr>
          </thead>
          <tbody>
            {rows.slice(0, MOST).map(({ job, cell }) => (
              <tr key={`${cell} ${job.job_id}`}>
                <th scope="row">
                  {pieces.get(job.sha256) ?? job.file}
                  {job.parts > 1 && `, part ${job.part} of ${job.parts}`}
                </th>
                <td>{cell}</td>
                <td>{moment(job.created_ms)}</td>
                <td>{job.started_ms === null ? "-" : moment(job.started_ms)}</td>
                <td>
                  {job.ended_ms === null ? "-" : moment(job.ended_ms)}
                  {job.ended_ms !== null && job.started_ms !== null && `, after ${time((job.ended_ms - job.started_ms) / 1000)}`}
                </td>
                <td>
                  <How job={job} />
                </td>
              </tr>
            ))}
          </tbody>
        </table>
      )}
      {rows.length > MOST && <p class="note">The newest {MOST} of {rows.length}.</p>}
    </section>
  );
}

const STATES: Record<JournalJob["state"], string> = {
  ended: "ended",
  open: "not ended yet",
  not_started: "not started",
  unknown: "UNKNOWN: ask the cell",
};

function How({ job }: { job: JournalJob }) {
  if (job.state === "ended") return <Signed state={job.result === "complete" ? "complete" : "stopped"} word={job.result ?? "ended"} />;
  return <Signed state={job.state === "open" ? "running" : job.state} word={STATES[job.state]} />;
}

const cellWords = ({ simulated, cell_id, endpoint }: JournalDocument["journals"][0]): string =>
  simulated ? `simulated ${cell_id}, ${endpoint}` : `REAL CELL ${cell_id}`;
