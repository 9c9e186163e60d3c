// Words and figures as the page shows them: states with a shape beside the word, sizes, times, names of the terms.

export const number = (value: number, digits: number): string =>
  value.toLocaleString("en-GB", { minimumFractionDigits: digits, maximumFractionDigits: digits });

export const count = (value: number): string => value.toLocaleString("en-GB");

// "1 joint", "1,200 joints"
export const counted = (value: number, one: string): string => `${count(value)} ${one}${value === 1 ? "" : "s"}`;

export const percent = (share: number): string => `${number(100 * share, 2)} %`;

export function volume(mm3: number): string {
  if (mm3 >= 1e6) return `${number(mm3 / 1e6, 3)} l`;
  return mm3 >= 1000 ? `${number(mm3 / 1000, 1)} ml` : `${number(mm3, 0)} mm3`;
}

export const sides = (box: readonly number[] | null): string => (box === null ? "" : `${box.map((side) => number(side, 0)).join(" x ")} mm`);

// A document names a file by the path that the command was given.
export const fileName = (path: string): string => path.slice(path.lastIndexOf("/") + 1);

export function bytes(value: number): string {
  if (value >= 1e6) return `${number(value / 1e6, 1)} MB`;
  return value >= 1000 ? `${number(value / 1000, 0)} kB` : `${count(value)} bytes`;
}

export function length(mm: number): string {
  if (mm >= 1000) return `${number(mm / 1000, 2)} m`;
  return mm >= 100 ? `${number(mm / 10, 1)} cm` : `${number(mm, mm >= 10 ? 1 : 2)} mm`;
}

// "1:04:10", "3:07"; seconds alone as "12 s".
export function time(seconds: number): string {
  const all = Math.round(seconds);
  if (all < 60) return `${all} s`;
  const two = (value: number) => String(value).padStart(2, "0");
  const minutes = Math.floor(all / 60);
  const rest = `${two(all % 60)}`;
  return minutes < 60 ? `${minutes}:${rest} min` : `${Math.floor(minutes / 60)}:${two(minutes % 60)}:${rest} h`;
}

// Of this computer's clock and zone.
export const moment = (ms: number): string =>
  new Date(ms).toLocaleString("en-GB", { day: "numeric", month: "short", year: "numeric", hour: "2-digit", minute: "2-digit", second: "2-digit" });

export const age = (ms: number): string => (ms < 10_000 ? `${number(ms / 1000, 1)} s ago` : `${time(ms / 1000)} ago`);

// "face_ratio" as "face ratio".
export const words = (key: string): string => key.replaceAll("_", " ");
export const titled = (key: string): string => words(key).replace(/^./, (letter) => letter.toUpperCase());

// Of a term in a table: the digits of the command line's.
export function term(name: string, value: number): string {
  if (name === "unreachable") return percent(value);
  if (name === "piece_count") return number(value, 0);
  return number(value, name === "structure" ? 6 : name === "face_ratio" ? 3 : 4);
}

export interface Sign {
  shape: string; // stands beside the word, for eyes that do not tell the colours apart
  kind: "calm" | "good" | "warn" | "bad";
}

const SIGNS: Record<string, Sign> = {
  idle: { shape: "○", kind: "calm" },
  waiting: { shape: "○", kind: "calm" },
  queued: { shape: "○", kind: "calm" },
  sending: { shape: "▷", kind: "calm" },
  asks: { shape: "?", kind: "warn" },
  suspended: { shape: "‖", kind: "warn" },
  completing: { shape: "▶", kind: "good" },
  clearing: { shape: "▷", kind: "calm" },
  resetting: { shape: "▷", kind: "calm" },
  starting: { shape: "▷", kind: "calm" },
  running: { shape: "▶", kind: "good" },
  execute: { shape: "▶", kind: "good" },
  carving: { shape: "▶", kind: "good" },
  stopping: { shape: "◼", kind: "warn" },
  stopped: { shape: "◼", kind: "warn" },
  holding: { shape: "‖", kind: "warn" },
  held: { shape: "‖", kind: "warn" },
  unholding: { shape: "▷", kind: "calm" },
  aborting: { shape: "✕", kind: "bad" },
  aborted: { shape: "✕", kind: "bad" },
  complete: { shape: "✓", kind: "good" },
  done: { shape: "✓", kind: "good" },
  ended: { shape: "◼", kind: "calm" },
  failed: { shape: "✕", kind: "bad" },
  lost: { shape: "✕", kind: "bad" },
  not_started: { shape: "✕", kind: "bad" },
  not_handed_over: { shape: "○", kind: "warn" },
  removed: { shape: "○", kind: "calm" },
  unknown: { shape: "?", kind: "bad" },
  ready: { shape: "✓", kind: "good" },
  positive: { shape: "✓", kind: "good" },
  negative: { shape: "✕", kind: "bad" },
  missing: { shape: "○", kind: "calm" },
};

export const sign = (state: string): Sign => SIGNS[state.toLowerCase()] ?? { shape: "•", kind: "calm" };

export const WORK_NAMES: Record<string, string> = {
  check: "Check the scan",
  repair: "Repair the scan",
  project: "Make the project",
  search: "Search on",
  prepare: "Prepare",
  try: "Try the plane",
  setups: "Compare bases",
  verify: "Verify",
  replay: "Replay",
  dry_run: "Dry run",
  export: "Export",
  guide: "Make the guide",
};

export const workName = (kind: string): string => WORK_NAMES[kind] ?? titled(kind);

// "37 of 120 planes evaluated"
export function progress(done: number, total: number, what: string): string {
  return total > 0 ? `${count(done)} of ${count(total)} ${what}` : done > 0 ? `${count(done)} ${what}` : what;
}
