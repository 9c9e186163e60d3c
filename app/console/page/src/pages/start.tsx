// Start: scans and projects of the folder, who writes, the cells.

import { useEffect, useState } from "preact/hooks";
import { go } from "../address";
import { get, post, type ApiError } from "../link/api";
import type { Check, Files } from "../link/documents";
import { useStore } from "../link/store";
import { useAsking } from "../parts/asking";
import { asApiError, ErrorBox } from "../parts/error";
import { useWork } from "../parts/work_result";
import { bytes, count } from "../parts/words";

export function StartPage({ stale }: { stale: boolean }) {
  const { state } = useStore();
  const [files, setFiles] = useState<Files | null>(null);
  const [error, setError] = useState<ApiError | null>(null);
  const read = () => {
    setError(null);
    get<Files>("/api/files").then(setFiles, (reason: unknown) => setError(asApiError(reason)));
  };
  // Read again when a project of the folder has changed.
  const mark = state?.projects.map((project) => project.revision).join() ?? "";
  useEffect(read, [mark]);
  return (
    <main class="start">
      <h1>{files ? `Folder ${files.folder}` : "Start"}</h1>
      <ErrorBox error={error} actions={{ try_again: read }} />
      {files && <Projects files={files} />}
      {files && <Scans files={files} off={stale || (state?.read_only ?? true)} />}
      {state && state.notices.length > 0 && (
        <section>
          <h2>What happened</h2>
          <ul role="status">
            {state.notices.map((notice) => (
              <li key={notice.id}>{notice.sentence}</li>
            ))}
          </ul>
        </section>
      )}
    </main>
  );
}

const STAGES: Record<string, string> = { cutting: "is being cut", cut: "cut, not prepared", done: "prepared" };

function Projects({ files }: { files: Files }) {
  const { state } = useStore();
  return (
    <section>
      <h2>Projects</h2>
      {files.projects.length === 0 && <p>The folder holds no project. Check a scan to make one.</p>}
      {files.projects.length > 0 && (
        <table>
          <caption class="unseen">Projects of the folder</caption>
          <thead>
            <tr>
              <th scope="col">Project</th>
              <th scope="col">Scan</th>
              <th scope="col">Stage</th>
              <th scope="col" class="figure">
                Cuts
              </th>
              <th scope="col" class="figure">
                Pieces
              </th>
              <th scope="col">Who writes now</th>
              <th scope="col">
                <span class="unseen">Action</span>
              </th>
            </tr>
          </thead>
          <tbody>
            {files.projects.map((project) => {
              const open = state?.projects.find((one) => one.id === project.id);
              return (
                <tr key={project.id}>
                  <th scope="row">{project.name}</th>
                  {project.problem ? (
                    <td colSpan={5}>
                      <span aria-hidden="true">✕ </span>
                      {project.problem}
                    </td>
                  ) : (
                    <>
                      <td>{project.scan}</td>
                      <td>{STAGES[project.stage ?? ""] ?? project.stage}</td>
                      <td class="figure">{count(project.cuts ?? 0)}</td>
                      <td class="figure">{count(project.pieces ?? 0)}</td>
                      <td>{open?.writer ?? "nobody"}</td>
                    </>
                  )}
                  <td>
                    {!project.problem && (
                      <button type="button" onClick={() => go("cut", project.id)} aria-label={`Open ${project.name}`}>
                        Open
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

function Scans({ files, off }: { files: Files; off: boolean }) {
  const asking = useAsking();
  const [checked, setChecked] = useState("");
  const { work, error, begin } = useWork<Check>((result) => go("check", result.check, { scan: checked }));
  const check = (scan: string) =>
    asking.run(async () => {
      setChecked(scan);
      begin((await post<{ work: string }>("/api/checks", { scan })).work);
    });
  const runs = work !== null && (work.state === "running" || work.state === "queued");
  return (
    <section>
      <h2>Scans</h2>
      <ErrorBox error={asking.error ?? error} actions={{ try_again: asking.again }} onClose={asking.clear} />
      {files.scans.length === 0 && <p>The folder holds no scan: PLY, STL, OBJ, OFF, glTF, GLB or 3MF.</p>}
      {files.scans.length > 0 && (
        <table>
          <caption class="unseen">Scans of the folder</caption>
          <thead>
            <tr>
              <th scope="col">Scan</th>
              <th scope="col" class="figure">
                Size of the file
              </th>
              <th scope="col">
                <span class="unseen">Action</span>
              </th>
            </tr>
          </thead>
          <tbody>
            {files.scans.map((scan) => (
              <tr key={scan.id}>
                <th scope="row">{scan.name}</th>
                <td class="figure">{bytes(scan.bytes)}</td>
                <td>
                  <button type="button" disabled={off || asking.busy || runs} onClick={() => check(scan.id)} aria-label={`Check ${scan.name}`}>
                    Check
                  </button>
                </td>
              </tr>
            ))}
          </tbody>
        </table>
      )}
    </section>
  );
}
