// The decisions so far, oldest first, and the way back to one of them. What is taken back stays for Redo.

import type { Project } from "../../link/documents";
import { sentence } from "../../parts/error";

interface Props {
  project: Project;
  off: boolean;
  onBack: (n: number) => void;
}

export function Decisions({ project, off, onBack }: Props) {
  const { history } = project;
  if (history === undefined) return null;
  return (
    <section aria-labelledby="decisions-title">
      <h2 id="decisions-title">Decisions</h2>
      {history.length === 0 && <p>None yet.</p>}
      <ol class="decisions">
        {history.map((words, i) => (
          <li key={i}>
            {sentence(words)}
            {i + 1 < history.length && (
              <button type="button" class="quiet" disabled={off} onClick={() => onBack(i + 1)} aria-label={`Back to decision ${i + 1}: ${words}`}>
                Back to here
              </button>
            )}
          </li>
        ))}
      </ol>
    </section>
  );
}
