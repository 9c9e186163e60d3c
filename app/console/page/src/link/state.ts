// What the page knows of the server, and how an event changes it. Pure: tests/console/parts_test.mjs runs it in node.

import type { Cell, QueueEntry, State, Summary, Work } from "./documents";
import { numberOf, type StreamEvent } from "./event_stream";

export interface Known extends State {
  cells: Cell[];
  queue: QueueEntry[];
  notices: { id: string; sentence: string }[]; // newest first
}

const KEPT_NOTICES = 20;
const KEPT_WORK = 64;

export function known(state: State): Known {
  return { ...state, cells: state.cells ?? [], queue: state.queue ?? [], notices: [] };
}

function replaced<T extends { id: string }>(list: T[], item: T): T[] {
  const at = list.findIndex((one) => one.id === item.id);
  return at < 0 ? [...list, item] : list.map((one, i) => (i === at ? item : one));
}

function withNotice(state: Known, id: string, sentence: string): Known {
  return { ...state, notices: [{ id, sentence }, ...state.notices].slice(0, KEPT_NOTICES) };
}

// The state after an event. An event that the state already contains changes nothing.
export function after(state: Known, event: StreamEvent): Known {
  if (event.id !== "" && numberOf(event.id) <= numberOf(state.event)) return state;
  const next = event.id === "" ? state : { ...state, event: event.id };
  switch (event.name) {
    case "project": {
      const { by, sentence, ...summary } = event.data as Summary & { by?: string; sentence?: string };
      const known = next.projects.find((one) => one.id === summary.id);
      const changed = { ...next, projects: replaced(next.projects, { ...known, ...summary }) };
      const words = changeWords(known, summary, by ?? "", sentence ?? "");
      return words === "" ? changed : withNotice(changed, event.id, words);
    }
    case "work":
      return { ...next, work: replaced(next.work, event.data as Work).slice(-KEPT_WORK) };
    case "cell":
      return { ...next, cells: replaced(next.cells, event.data as Cell) };
    case "queue":
      return { ...next, ...(event.data as { queue: QueueEntry[]; paused?: boolean }) };
    case "notice":
      return withNotice(next, event.id, (event.data as { sentence: string }).sentence);
    default:
      return next;
  }
}

// What is told of a change. Of one by the command line the server knows the newest decision alone, by its undo.
function changeWords(known: Summary | undefined, now: Summary, by: string, sentence: string): string {
  const name = known?.name ?? now.name;
  if (by !== "command line") return sentence === "" ? "" : `${name}: ${sentence}`;
  if (known === undefined || known.revision === now.revision) return "";
  const newest = sentence.replace(/^Undo /, "");
  return `The command line has changed ${name}: ${newest === "" ? "no decision is in force" : `the newest decision is ${newest}`}.`;
}

export const isOver = (work: Work): boolean => ["stopped", "done", "failed", "lost"].includes(work.state);

// The work that has the worker; of those that wait, the first.
export function currentWork(state: Known): Work | null {
  const open = state.work.filter((work) => !isOver(work));
  return open.find((work) => work.state !== "queued") ?? open[0] ?? null;
}
