// Guide: the assembly guide is made, opened, printed, saved.

import { useState } from "preact/hooks";
import type { Address } from "../address";
import { getBlob, openInWindow, post } from "../link/api";
import type { Project } from "../link/documents";
import { currentWork } from "../link/state";
import { useProject, useStore } from "../link/store";
import { useAsking } from "../parts/asking";
import { ErrorBox, sentence } from "../parts/error";
import { useWork } from "../parts/work_result";
import { count } from "../parts/words";

interface Made {
  pieces: number;
  joints: number;
  steps: number;
}

const FILES = [
  { file: "guide.html", words: "Open to print", opens: true },
  { file: "guide.pdf", words: "Save the PDF", opens: false },
  { file: "guide.glb", words: "Save the GLB", opens: false },
];

export function GuidePage({ address, stale }: { address: Address; stale: boolean }) {
  const { project, error, retry } = useProject(address.id);
  return (
    <main>
      <h1>Assembly guide{project ? ` of ${project.name}` : ""}</h1>
      <ErrorBox error={error} actions={{ try_again: retry }} />
      {project && <Guide project={project} stale={stale} />}
    </main>
  );
}

function Guide({ project, stale }: { project: Project; stale: boolean }) {
  const { state } = useStore();
  const [made, setMade] = useState<Made | null>(null);
  const asking = useAsking();
  const { error, begin } = useWork<Made>(setMade);
  const off = stale || (state?.read_only ?? true) || asking.busy || (state ? currentWork(state) !== null : true);
  const make = () =>
    asking.run(async () =>
      begin((await post<{ work: string }>(`/api/projects/${project.id}/work`, { kind: "guide" }, project.revision)).work),
    );
  const path = (file: string) => `/api/projects/${project.id}/outputs/${file}`;
  const save = async (file: string) => {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(await getBlob(path(file)));
    link.download = `${project.name.replace(/\.qch$/, "")}-${file}`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
  };
  const steps = project.prepare?.assembly ?? [];
  return (
    <>
      {project.stage !== "done" && <p>The guide is made of a prepared project: press Prepare on the page Jobs.</p>}
      <p class="row">
        <button type="button" class="main" disabled={off || project.stage !== "done"} onClick={make}>
          Make the guide
        </button>
        {FILES.map(({ file, words, opens }) => (
          <button
            key={file}
            type="button"
            disabled={project.stage !== "done" || asking.busy}
            onClick={() => asking.run(() => (opens ? openInWindow(path(file)) : save(file)))}
          >
            {words}
          </button>
        ))}
      </p>
      <p role="status">
        {made && `The guide is made: ${count(made.pieces)} pieces, ${count(made.joints)} joints, ${count(made.steps)} steps.`}
      </p>
      <ErrorBox error={asking.error ?? error} actions={{ try_again: asking.again, make_guide: make }} onClose={asking.clear} />
      {steps.length > 0 && (
        <table>
          <caption>Steps of the assembly</caption>
          <thead>
            <tr>
              <th scope="col">Step</th>
              <th scope="col">What is done</th>
            </tr>
          </thead>
          <tbody>
            {steps.map((step, i) => (
              <tr key={i}>
                <th scope="row">{i + 1}</th>
                <td>{sentence(`${step.moved.join(", ")} is joined to ${step.standing.join(", ")} at cut ${step.cut}`)}</td>
              </tr>
            ))}
          </tbody>
        </table>
      )}
    </>
  );
}
