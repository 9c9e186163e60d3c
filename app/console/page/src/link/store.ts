// The one store of the page: reads /api/state, follows the events, and tells the components. The server is asked for the state
// only after the stream is open; events that came in between are applied to it by their numbers.

import { useEffect, useRef, useState } from "preact/hooks";
import { ApiError, askWhole, beUnsure, get, useKey } from "./api";
import type { DrawnPiece, Hello, Project, State } from "./documents";
import { listen } from "./events";
import type { LinkState, StreamEvent } from "./event_stream";
import { hasKey, keyFor } from "./key";
import { after, isOver, known, type Known } from "./state";

export type Link = "starting" | "connected" | "lost" | "no key" | "other server" | "refused";

export interface Store {
  link: Link;
  hello: Hello | null;
  state: Known | null;
  lastTick: number; // performance.now() of the last sign of life; 0: none yet
  projects: Map<string, Project>; // read from the server, as they were at their revision
  error: ApiError | null; // the newest that no component shows itself
}

export const STALE_MS = 6000;

let store: Store = { link: "starting", hello: null, state: null, lastTick: 0, projects: new Map(), error: null };
const listeners = new Set<() => void>();

export const current = (): Store => store;

export function change(part: Partial<Store>): void {
  store = { ...store, ...part };
  for (const listener of listeners) listener();
}

export function useStore(): Store {
  const [, redraw] = useState(0);
  useEffect(() => {
    const listener = () => redraw((n) => n + 1);
    listeners.add(listener);
    listener();
    return () => void listeners.delete(listener);
  }, []);
  return store;
}

// Nothing was heard of the server for six seconds: what is shown may be old, and nothing but Hold may be asked.
export function isStale(now = performance.now()): boolean {
  const isOver = store.link === "no key" || store.link === "other server" || store.link === "refused";
  return isOver || now - store.lastTick > STALE_MS;
}

let waiting: StreamEvent[] | null = null; // events before the state is there; null: none are kept
let reading = 0;

async function readState(): Promise<void> {
  const mine = ++reading;
  waiting = [];
  try {
    const state = await get<State>("/api/state");
    if (mine !== reading) return;
    const events = waiting ?? [];
    waiting = null;
    change({
      state: events.reduce(after, { ...known(state), notices: store.state?.notices ?? [] }),
      link: "connected",
      lastTick: performance.now(),
    });
  } catch (error) {
    if (mine !== reading) return;
    if (error instanceof ApiError && error.status === 401) change({ link: "refused" });
    else setTimeout(() => mine === reading && void readState(), 1000);
  }
}

function onEvent(event: StreamEvent): void {
  store = { ...store, lastTick: performance.now() };
  if (event.name === "reset") void readState();
  else if (waiting !== null) waiting.push(event);
  else if (store.state) change({ state: after(store.state, event) });
}

function onLink(state: LinkState): void {
  if (state === "open") {
    if (store.state === null) void readState();
    else change({ link: "connected", lastTick: performance.now() });
  } else {
    beUnsure();
    change({ link: state });
  }
}

let leave: (() => void) | null = null;

// Also called when the address brings a new key.
export async function start(): Promise<void> {
  leave?.();
  leave = null;
  if (!hasKey()) return change({ link: "no key" });
  let hello: Hello;
  try {
    hello = await get<Hello>("/api/hello");
  } catch {
    change({ link: "lost" });
    setTimeout(() => void start(), 2000);
    return;
  }
  const key = keyFor(hello.server);
  useKey(key, hello.server);
  if (key === null) return change({ link: "other server", hello });
  change({ hello, state: store.hello?.server === hello.server ? store.state : null, link: "starting" });
  leave = listen(hello.server, key, { onEvent, onLink });
}

// A project that work has is told without its document.
type Read = Omit<Project, "segment" | "drawn"> & { segment: Project["segment"] | null };

const reads = new Map<string, Promise<Project>>();

// Reads a project, unless the store has it at the revision that the server last told.
export async function readProject(id: string, again = false): Promise<Project> {
  const kept = store.projects.get(id);
  const told = store.state?.projects.find((one) => one.id === id)?.revision;
  if (!again && kept && (told === undefined || told === kept.revision)) return kept;
  const running = reads.get(id);
  if (running && !again) return running;
  const read = get<Read>(`/api/projects/${id}`)
    .then((answer) => {
      const before = store.projects.get(id);
      const segment = answer.segment ?? before?.segment;
      if (!segment) throw new ApiError(423, "Work has the project", "", "It is shown when the work is over", "", "try_again");
      const project = { ...answer, segment, drawn: before?.drawn ?? [] };
      change({ projects: new Map(store.projects).set(id, project) });
      if (answer.segment) void draw(project);
      return project;
    })
    .finally(() => reads.delete(id));
  reads.set(id, read);
  return read;
}

// Asked after the document, because to draw pieces for the first time can take as long as to cut them.
async function draw({ id, revision }: Project): Promise<void> {
  try {
    const answer = await askWhole<{ revision: string; pieces: DrawnPiece[] }>(id, "display", {});
    const project = store.projects.get(id);
    if (project?.revision !== revision || answer.revision !== revision) return;
    change({ projects: new Map(store.projects).set(id, { ...project, drawn: answer.pieces }) });
  } catch (reason) {
    // 423: work has begun, and at its end the project is read again.
    if (reason instanceof ApiError && reason.status !== 423) change({ error: reason });
  }
}

// The project, read again when another window or the command line has changed it.
export function useProject(id: string): { project: Project | null; error: ApiError | null; retry: () => void } {
  const { projects, state } = useStore();
  const [error, setError] = useState<ApiError | null>(null);
  const [tries, setTries] = useState(0);
  const told = state?.projects.find((one) => one.id === id);
  // Read again at the end of work as well: while it runs the server tells less.
  const works = state?.work.some((one) => one.of === id && !isOver(one)) ?? false;
  const worked = useRef(works);
  const mark = `${told?.revision ?? ""} ${told?.stage ?? ""} ${works}`;
  useEffect(() => {
    let gone = false;
    if (id === "" || state === null) return;
    const isAgain = tries > 0 || (worked.current && !works);
    worked.current = works;
    readProject(id, isAgain)
      .then(() => gone || setError(null))
      .catch((reason: unknown) => gone || !(reason instanceof ApiError) || setError(reason));
    return () => {
      gone = true;
    };
  }, [id, mark, tries, state === null]);
  return { project: projects.get(id) ?? null, error, retry: () => setTries((n) => n + 1) };
}
