// Jobs: what is prepared and proven, the hand-over, the queue, the cells' commands.

import { useEffect, useState } from "preact/hooks";
import type { Address } from "../../address";
import { ask, openInWindow, post, type ApiError } from "../../link/api";
import type { JobsDocument, PlannedJob, Project, Replay, VerifyDocument } from "../../link/documents";
import { currentWork } from "../../link/state";
import { useProject, useStore } from "../../link/store";
import { useAsking, type Asking } from "../../parts/asking";
import { asApiError, ErrorBox, sentence } from "../../parts/error";
import { Signed } from "../../parts/signed";
import { useWork } from "../../parts/work_result";
import { count, sides, time } from "../../parts/words";
import { CarvedTable } from "./carved";
import { CellPanels } from "./cells";
import { HandOver } from "./hand_over";
import { QueueTable } from "./queue";
import { ReplayPanel } from "./replay";
import { SimulatorPanel } from "./simulator";

export function JobsPage({ address, stale }: { address: Address; stale: boolean }) {
  const { project, error, retry } = useProject(address.id);
  const { state } = useStore();
  const [planned, setPlanned] = useState<PlannedJob[]>([]);
  const queue = state?.queue ?? [];
  const pieces = new Map([...queue, ...planned].map((one) => [one.job, one.piece]));
  const mark = queue.map((entry) => `${entry.id} ${entry.state}`).join();
  return (
    <main class="jobs">
      <h1>Jobs{project ? ` of ${project.name}` : ""}</h1>
      <ErrorBox error={error} actions={{ try_again: retry }} />
      {project && <ProjectJobs project={project} stale={stale} onJobs={setPlanned} />}
      {state && <QueueTable queue={state.queue} off={stale} />}
      {state && <CellPanels cells={state.cells} stale={stale} />}
      {state?.simulator && <SimulatorPanel off={stale} />}
      {state && <CarvedTable pieces={pieces} mark={mark} />}
    </main>
  );
}

// The jobs as they would be handed over: asked again when the project has changed or work has ended.
function useJobs(project: Project, isWorking: boolean): { jobs: JobsDocument | null; error: ApiError | null } {
  const [jobs, setJobs] = useState<JobsDocument | null>(null);
  const [error, setError] = useState<ApiError | null>(null);
  const isPrepared = project.stage === "done";
  useEffect(() => {
    let gone = false;
    setError(null);
    if (!isPrepared) setJobs(null);
    if (!isPrepared || isWorking) return;
    ask<JobsDocument>(project.id, "jobs", {})
      .then((found) => gone || setJobs(found))
      .catch((reason: unknown) => gone || setError(asApiError(reason)));
    return () => {
      gone = true;
    };
  }, [project.id, project.revision, isPrepared, isWorking]);
  return { jobs, error };
}

interface ProjectProps {
  project: Project;
  stale: boolean;
  onJobs: (jobs: PlannedJob[]) => void;
}

function ProjectJobs({ project, stale, onJobs }: ProjectProps) {
  const { state } = useStore();
  const [chosen, setChosen] = useState<string[]>([]);
  const asking = useAsking();
  const isWorking = state ? currentWork(state) !== null : true;
  const off = stale || (state?.read_only ?? true) || isWorking || asking.busy;
  const { jobs, error } = useJobs(project, isWorking);
  const [replay, setReplay] = useState<Replay | null>(null);
  const replaying = useWork<Replay>(setReplay);
  useEffect(() => setReplay(null), [project.id, project.revision]);
  const beginReplay = ({ piece, part }: PlannedJob) =>
    asking.run(async () => {
      setReplay(null);
      const body = { kind: "replay", piece, part };
      replaying.begin((await post<{ work: string }>(`/api/projects/${project.id}/work`, body, project.revision)).work);
    });
  useEffect(() => onJobs(jobs?.jobs ?? []), [jobs]);
  const toggle = (piece: string) =>
    setChosen((old) => (old.includes(piece) ? old.filter((one) => one !== piece) : [...old, piece]));
  const names = [...new Set(jobs?.jobs.map((job) => job.piece) ?? [])];
  const pieces = chosen.filter((piece) => names.includes(piece));
  return (
    <section>
      <h2>Parts</h2>
      <WorkButtons project={project} off={off} asking={asking} />
      <ErrorBox error={error} />
      {project.stage !== "done" && <p>No job is there yet: Prepare sets the pieces up and writes their jobs.</p>}
      {jobs !== null && jobs.jobs.length === 0 && <p>The project has no job for the cell.</p>}
      {jobs !== null && jobs.jobs.length > 0 && (
        <JobTable jobs={jobs.jobs} project={project} chosen={pieces} onToggle={toggle} asking={asking} off={off} onReplay={beginReplay} />
      )}
      <ErrorBox error={replaying.error} actions={{ try_again: asking.again, show: asking.clear }} />
      {replay && <ReplayPanel key={replay.job} replay={replay} onClose={() => setReplay(null)} />}
      {jobs?.refused.map((why) => (
        <p key={why} class="state warn">
          <span aria-hidden="true">⚠ </span>
          {sentence(why)}
        </p>
      ))}
      <HandOver project={project} pieces={pieces} off={off} />
    </section>
  );
}

interface TableProps {
  jobs: PlannedJob[];
  project: Project;
  chosen: string[];
  onToggle: (piece: string) => void;
  asking: Asking;
  off: boolean;
  onReplay: (job: PlannedJob) => void;
}

function JobTable({ jobs, project, chosen, onToggle, asking, off, onReplay }: TableProps) {
  return (
    <table>
      <caption class="unseen">Jobs of {project.name}</caption>
      <thead>
        <tr>
          <th scope="col">Hand over</th>
          <th scope="col">Piece and part</th>
          <th scope="col">Block</th>
          <th scope="col" class="figure">
            Machine time
          </th>
          <th scope="col">Proof</th>
          <th scope="col">Replay and papers</th>
        </tr>
      </thead>
      <tbody>
        {jobs.map((job) => (
          <tr key={job.job}>
            <td>
              {/* Parts of a piece go one after the other: they are chosen together. */}
              {job.part === 1 && (
                <input
                  type="checkbox"
                  checked={chosen.includes(job.piece)}
                  onChange={() => onToggle(job.piece)}
                  aria-label={`Hand over piece ${job.piece}`}
                />
              )}
            </td>
            <th scope="row">
              {job.piece}
              {job.parts > 1 && `, part ${job.part} of ${job.parts}`}
            </th>
            <td>{sides(job.block_mm)}</td>
            <td class="figure">{job.time_s > 0 ? time(job.time_s) : "not known"}</td>
            <td>
              <Signed state={job.proven ? "positive" : "missing"} word={job.proven ? "proven" : "not proven"} />
            </td>
            <td class="row">
              <button type="button" class="quiet" disabled={off} aria-label={`Replay ${nameOf(job)}`} onClick={() => onReplay(job)}>
                Replay
              </button>
              {PAPERS.map(({ file, words }) => (
                <button
                  key={file}
                  type="button"
                  class="quiet"
                  aria-label={`${words} of piece ${job.piece}`}
                  onClick={() => asking.run(() => openInWindow(fileOf(project, job, file)))}
                >
                  {words}
                </button>
              ))}
            </td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

const nameOf = (job: PlannedJob): string => `piece ${job.piece}${job.parts > 1 ? `, part ${job.part}` : ""}`;

const PAPERS = [
  { file: "setup.html", words: "Setup sheet" },
  { file: "details.html", words: "Details" },
];

const fileOf = (project: Project, job: PlannedJob, file: string): string =>
  `/api/projects/${project.id}/jobs/${job.file.replace(/\.qjob$/, "")}/files/${file}`;

function WorkButtons({ project, off, asking }: { project: Project; off: boolean; asking: Asking }) {
  const [verified, setVerified] = useState<VerifyDocument | null>(null);
  const [dry, setDry] = useState<DryRun | null>(null);
  const prepare = useWork<unknown>(() => undefined);
  const verify = useWork<VerifyDocument>(setVerified);
  const dryRun = useWork<DryRun>(setDry);
  const begin = (kind: string, begun: { begin: (id: string) => void }) =>
    asking.run(async () =>
      begun.begin((await post<{ work: string }>(`/api/projects/${project.id}/work`, { kind }, project.revision)).work),
    );
  const error = asking.error ?? prepare.error ?? verify.error ?? dryRun.error;
  return (
    <>
      <p class="row">
        <button type="button" disabled={off} onClick={() => begin("prepare", prepare)}>
          Prepare
        </button>
        <button type="button" disabled={off || project.stage !== "done"} onClick={() => begin("verify", verify)}>
          Verify
        </button>
        <button type="button" disabled={off || project.stage !== "done"} onClick={() => begin("dry_run", dryRun)}>
          Dry run
        </button>
      </p>
      <ErrorBox error={error} actions={{ try_again: asking.again, show: asking.clear, go_on_with_prepare: () => begin("prepare", prepare) }} onClose={asking.clear} />
      {verified && <Findings verified={verified} />}
      {dry && <DryRuns dry={dry} />}
    </>
  );
}

function Findings({ verified }: { verified: VerifyDocument }) {
  const rows = verified.jobs.flatMap((job) => job.findings.map((finding) => ({ piece: job.piece, ...finding })));
  return (
    <>
      <p role="status">
        <Signed state={verified.all_positive ? "positive" : "negative"} word={verified.all_positive ? "All jobs are verified." : "Not every job is verified."} />
      </p>
      {rows.length > 0 && (
        <table>
          <caption>Findings</caption>
          <thead>
            <tr>
              <th scope="col">Piece</th>
              <th scope="col">File and line</th>
              <th scope="col">Finding</th>
            </tr>
          </thead>
          <tbody>
            {rows.map((row, i) => (
              <tr key={i}>
                <th scope="row">{row.piece}</th>
                <td>{row.file === "" ? "-" : `${row.file}:${count(row.line)}`}</td>
                <td>{sentence(row.text)}</td>
              </tr>
            ))}
          </tbody>
        </table>
      )}
    </>
  );
}

interface DryRun {
  all_complete: boolean;
  jobs: { piece: string; ended_complete: boolean; why: string; to_do: string; elapsed_s: number }[];
}

function DryRuns({ dry }: { dry: DryRun }) {
  return (
    <table>
      <caption>Dry run: {dry.all_complete ? "every job ran to its end" : "not every job ran to its end"}</caption>
      <tbody>
        {dry.jobs.map((job, i) => (
          <tr key={i}>
            <th scope="row">{job.piece}</th>
            <td>
              <Signed state={job.ended_complete ? "complete" : "failed"} />
            </td>
            <td>
              {sentence(job.why)} {sentence(job.to_do)}
            </td>
            <td class="figure">{time(job.elapsed_s)} in the simulated cell</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}
