// The panel of the simulated cell that the server itself has started: its person and its switches. Never of another cell.

import { post } from "../../link/api";
import { useAsking } from "../../parts/asking";
import { ErrorBox } from "../../parts/error";

const LINES = [
  { line: "consent yes", words: "Consent: yes" },
  { line: "consent no", words: "Consent: no" },
  { line: "door open", words: "Open the door" },
  { line: "door closed", words: "Close the door" },
  { line: "estop press", words: "Press the red button" },
  { line: "estop release", words: "Release it" },
  { line: "panel local", words: "Local control" },
  { line: "panel remote", words: "Remote control" },
  { line: "block fresh", words: "A fresh block" },
  { line: "tool broken", words: "The tool breaks" },
  { line: "tool ok", words: "A new tool" },
];

export function SimulatorPanel({ off }: { off: boolean }) {
  const asking = useAsking();
  return (
    <section>
      <h2>Panel of the simulated cell</h2>
      <p class="note">What a person does at a real cell. Nothing moves.</p>
      <p class="row">
        {LINES.map(({ line, words }) => (
          <button
            key={line}
            type="button"
            disabled={off || asking.busy}
            onClick={() => asking.run(async () => void (await post("/api/simulator", { line })))}
          >
            {words}
          </button>
        ))}
      </p>
      <ErrorBox error={asking.error} onClose={asking.clear} />
    </section>
  );
}
