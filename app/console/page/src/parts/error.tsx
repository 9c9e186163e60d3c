// An error as the operator reads it: what happened, what is unchanged, what to do, an id to quote; and a button where the
// page can do what the remedy asks for.

import { ApiError } from "../link/api";

export interface Remedy {
  label: string;
  run: () => void;
}

// The remedies by their keys: the words of the page where those of the command line name an option, and the words on the button.
// Who shows the error says what a button does; a key that stands not here leaves the sentence that came with it. The first group
// are keys of the engine (app/report/command_line_text.cpp), the second one those of the server and the page.
const REMEDIES: Record<string, { words?: string; label?: string }> = {
  give_unit: { words: "Choose the units of the file", label: "Choose units" },
  leave_unit: { words: "Take the units that the file names; if it is wrong, save it in a format without units, such as PLY" },
  check_unit: { words: "Choose other units, or export the scan again", label: "Choose units" },
  leave_scale: { words: "Enlarge by the factor 1" },
  help_of_repair: { words: "Change the choices of the repair" },
  mask: { words: "Paint what may stay before the project begins" },
  smaller_fragments: { words: "Check the scan, or begin again with a smaller volume of fragments" },
  see_ranking: { words: "See the table of planes", label: "Show" },
  taken_back: { words: "All cuts and discarded pieces are taken back; Undo brings them again", label: "Undo" },
  give_cell: { words: "Begin the project with a cell", label: "Choose a cell" },
  name_cell: { words: "Begin the project with a cell", label: "Choose a cell" },
  give_cell_file: { words: "Begin the project with a cell", label: "Choose a cell" },
  go_on_with_prepare: { label: "Prepare" },
  go_on_by_search: { label: "Search on" },
  accept_unreachable: { words: "Tick that what is out of reach is accepted, if the foam that stays there may stay", label: "Accept it" },
  asks_accept_unreachable: { words: "Tick that what is out of reach is accepted, if the foam that stays there may stay", label: "Accept it" },
  carve_again: { words: "Tick that what was carved before is carved again", label: "Carve again" },
  look_then_carve_again: { words: "Look at the cell. The file is carved once more only if that is ticked" },
  look_for_piece: { words: "Look for the piece or a block that is cut. Where neither is there, tick to carve again" },
  look_at_cell: { words: "Look at the cell" },
  see_cell: { words: "See what the cell shows" },
  try_again_later: { words: "Try again when it has ended", label: "Try again" },

  try_again: { label: "Try again" },
  show: { label: "Show" },
};

export type RemedyActions = Partial<Record<string, () => void>>;

// What may have stood in the place of the error before it stays for a reader of screens: role=alert speaks what is put in.
export function ErrorBox({ error, actions = {}, onClose }: { error: ApiError | null; actions?: RemedyActions; onClose?: () => void }) {
  if (error === null) return <div role="alert" />;
  const key = remedyOf(error);
  const run = key === null ? undefined : actions[key];
  return (
    <div role="alert" class="error">
      <p>
        <span aria-hidden="true">✕ </span>
        <strong>{sentence(error.what)}</strong> {sentence(error.unchanged)} {sentence((key !== null && REMEDIES[key]?.words) || error.toDo)}
      </p>
      <p class="row">
        {run && (
          <button type="button" onClick={run}>
            {REMEDIES[key!]?.label ?? "Try again"}
          </button>
        )}
        {onClose && (
          <button type="button" class="quiet" onClick={onClose}>
            Close
          </button>
        )}
        {error.id !== "" && <small>{error.id}</small>}
      </p>
    </div>
  );
}

// A stale revision is shown and the project read again, whether the server names that remedy or not.
function remedyOf(error: ApiError): string | null {
  return error.remedy ?? (error.status === 412 ? "show" : error.status === 423 || error.status === 0 ? "try_again" : null);
}

export function sentence(text: string): string {
  if (text === "") return "";
  const capital = text.replace(/^./, (letter) => letter.toUpperCase());
  return /[.!?]$/.test(capital) ? capital : `${capital}.`;
}

export const asApiError = (reason: unknown): ApiError =>
  reason instanceof ApiError ? reason : new ApiError(0, String(reason), "Nothing was changed", "Read the page again", "", null);
