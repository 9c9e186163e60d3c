// Guide: the assembly guide is made, opened, printed, saved.

import { useState } from "preact/hooks";
import type { Address } from "../address";
import { getBlob, openInWindow, post } from "../link/api";
import type { Project } from "../link/documents";
import { currentWork } from "../link/state";
import { useProject, useStore } from "../link/store";
import { useAsking } from "../parts/asking";
import { ErrorBox } from "../parts/error";
import { Signed } from "../parts/signed";
import { useWork } from "../parts/work_result";
import { counted } from "../parts/words";

interface Made {
  pieces: number;
  joints: number;
  steps: number;
  assembly: { cut: number; moved: string[]; standing: string[]; joints: string[]; clear: boolean }[];
  held: string[]; // pieces that no glued face holds when they are moved
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
  const [last, setLast] = useState<{ of: string; made: Made } | null>(null);
  const made = last?.of === project.revision ? last.made : null; // a decision removes the guide
  const asking = useAsking();
  const { error, begin } = useWork<Made>((result) => setLast({ of: project.revision, made: result }));
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
        {made && `The guide is made: ${counted(made.pieces, "piece")}, ${counted(made.joints, "joint")}, ${counted(made.steps, "step")}.`}
      </p>
      <ErrorBox error={asking.error ?? error} actions={{ try_again: asking.again, make_guide: make }} onClose={asking.clear} />
      {made && made.assembly.length > 0 && <Steps made={made} />}
    </>
  );
}

function Steps({ made }: { made: Made }) {
  return (
    <table>
      <caption>Steps of the assembly</caption>
      <thead>
        <tr>
          <th scope="col">Step</th>
          <th scope="col">What is moved</th>
          <th scope="col">To what stands</th>
          <th scope="col">Joints that it closes</th>
          <th scope="col">Remarks</th>
        </tr>
      </thead>
      <tbody>
        {made.assembly.map((step, i) => (
          <tr key={i}>
            <th scope="row">{i + 1}</th>
            <td>{step.moved.join(", ")}</td>
            <td>{step.standing.join(", ")}</td>
            <td>{step.joints.join(", ")}</td>
            <td>
              {step.moved.some((piece) => made.held.includes(piece)) && <Signed state="missing" word="nothing holds it yet" />}
              {!step.clear && <Signed state="negative" word="the way is not clear" />}
            </td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}
