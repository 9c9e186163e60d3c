// New project with these cuts: the scan is checked again, so that it can be painted otherwise, and Begin makes the cuts of this
// project on it.

import { useRef } from "preact/hooks";
import { go } from "../../address";
import { ApiError, get, post } from "../../link/api";
import type { Check, Files, Project } from "../../link/documents";
import { useAsking } from "../../parts/asking";
import { ErrorBox } from "../../parts/error";
import { useWork } from "../../parts/work_result";

export function NewWithCuts({ project, off }: { project: Project; off: boolean }) {
  const asking = useAsking();
  const checked = useRef(""); // the id of the scan
  const { error, begin } = useWork<Check>((result) => go("check", result.check, { scan: checked.current, cuts: project.id }));
  if (project.segment.cuts.length === 0) return null;
  const check = () =>
    asking.run(async () => {
      const files = await get<Files>("/api/files");
      const name = files.projects.find((one) => one.id === project.id)?.scan;
      const scan = files.scans.find((one) => one.name === name);
      if (!scan) throw new ApiError(404, `The folder has no scan ${name ?? ""} any more`, "Nothing was changed", "Put it there again", "", "try_again");
      checked.current = scan.id;
      begin((await post<{ work: string }>("/api/checks", { scan: scan.id })).work);
    });
  return (
    <>
      <button type="button" disabled={off || asking.busy} onClick={check}>
        New project with these cuts
      </button>
      <p class="note">The scan is painted again, and the cuts of this project are made on it; this one stays as it is.</p>
      <ErrorBox error={asking.error ?? error} actions={{ try_again: asking.again }} onClose={asking.clear} />
    </>
  );
}
