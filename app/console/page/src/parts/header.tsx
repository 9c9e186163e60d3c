// What is always at the top: pages, Undo and Redo by name, the work that runs with its Stop.

import { ApiError, post, remove } from "../link/api";
import { formatAddress, PAGES, type Address } from "../address";
import type { Project, Segment, Summary, Work } from "../link/documents";
import { currentWork } from "../link/state";
import { readProject, useStore } from "../link/store";
import { useAsking } from "./asking";
import { ErrorBox } from "./error";
import { useKey } from "./keys";
import { progress, time, workName } from "./words";

const TITLES = { start: "Start", check: "Check", cut: "Cut", pieces: "Pieces", jobs: "Jobs", guide: "Guide" } as const;

// Which project the pages about a project show: that of the address, else the one that was last shown.
let lastProject = "";
let lastCheck = "";

export function Header({ address, stale, onKeys }: { address: Address; stale: boolean; onKeys: () => void }) {
  const { state } = useStore();
  if (address.page === "check" && address.id !== "") lastCheck = address.id;
  else if (address.page !== "start" && address.id !== "") lastProject = address.id;
  const project = state?.projects.find((one) => one.id === lastProject) ?? null;
  return (
    <header>
      <div class="bar">
        <span class="name">QChopper</span>
        <nav aria-label="Pages">
          {PAGES.map((page) => {
            const id = page === "start" ? "" : page === "check" ? lastCheck : lastProject;
            const isHere = page === address.page;
            if (page !== "start" && id === "" && !isHere)
              return (
                <span key={page} class="page off">
                  {TITLES[page]}
                </span>
              );
            return (
              <a key={page} class="page" href={formatAddress({ page, id, selection: {} })} aria-current={isHere ? "page" : undefined}>
                {TITLES[page]}
              </a>
            );
          })}
        </nav>
        <span class="what">{address.page === "start" ? (state?.folder ?? "") : (project?.name ?? "")}</span>
        <button type="button" class="quiet" onClick={onKeys} aria-keyshortcuts="?">
          Keys
        </button>
      </div>
      {state && (
        <div class="bar second">
          {project && !["start", "check"].includes(address.page) && <UndoRedo project={project} stale={stale} />}
          <WorkBar work={currentWork(state)} stale={stale} />
        </div>
      )}
    </header>
  );
}

interface Decided {
  revision: string;
  done: string;
  document: Segment;
}

// Takes a decision on the project as this window shows it, and reads it again.
export async function decide(project: Pick<Project, "id" | "revision">, decision: unknown): Promise<string> {
  try {
    const { done } = await post<Decided>(`/api/projects/${project.id}/decisions`, decision, project.revision);
    await readProject(project.id, true);
    return done;
  } catch (error) {
    if (error instanceof ApiError && error.status === 412) void readProject(project.id, true).catch(() => undefined);
    throw error;
  }
}

function UndoRedo({ project, stale }: { project: Summary; stale: boolean }) {
  const asking = useAsking();
  const undo = () => asking.run(async () => void (await decide(project, { undo: project.undo })));
  const redo = () => asking.run(async () => void (await decide(project, { redo: project.redo })));
  const off = stale || asking.busy;
  useKey("undo", off || project.undo === null ? null : undo);
  useKey("redo", off || project.redo === null ? null : redo);
  return (
    <div class="row">
      <button type="button" disabled={off || project.undo === null} onClick={undo} aria-keyshortcuts="Control+Z">
        {project.undo ?? "Nothing to undo"}
      </button>
      <button type="button" disabled={off || project.redo === null} onClick={redo} aria-keyshortcuts="Control+Shift+Z">
        {project.redo ?? "Nothing to redo"}
      </button>
      <ErrorBox error={asking.error} actions={{ try_again: asking.again, show: asking.clear }} onClose={asking.clear} />
    </div>
  );
}

export function WorkBar({ work, stale }: { work: Work | null; stale: boolean }) {
  const asking = useAsking();
  if (work === null)
    return (
      <p class="work" role="status">
        No work runs.
      </p>
    );
  const stop = () => asking.run(() => remove(`/api/work/${work.id}`));
  const done = work.total > 0 ? { value: Math.min(work.done, work.total), max: work.total } : {};
  return (
    <div class="work row">
      {/* Only the name is spoken: figures change too often for that. */}
      <span role="status">
        <strong>{workName(work.kind)}</strong>
        {work.state === "queued" && " waits"}
        {work.state === "stopping" && " stops; what is saved stays"}
      </span>
      <progress aria-label={workName(work.kind)} {...done} />
      <span title={work.messages.at(-1) ?? ""}>{progress(work.done, work.total, work.what)}</span>
      <span>
        {time(work.elapsed_s)}
        {work.remaining_s !== null && `, about ${time(work.remaining_s)} left`}
      </span>
      <button type="button" disabled={stale || asking.busy || work.state === "stopping"} onClick={stop}>
        Stop
      </button>
      <ErrorBox error={asking.error} onClose={asking.clear} />
    </div>
  );
}
