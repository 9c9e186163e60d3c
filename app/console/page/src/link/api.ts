// Requests to the server. A request that fails gives an ApiError with the server's own sentences, or with one of ours where
// the server was not heard.

import type { ErrorDocument, Hello } from "./documents";

export class ApiError extends Error {
  constructor(
    readonly status: number, // 0: no answer
    readonly what: string,
    readonly unchanged: string,
    readonly toDo: string,
    readonly id: string,
    readonly remedy: string | null,
  ) {
    super(what);
  }
}

let key: string | null = null;
let server = "";
let isSure = false; // that the same server is there: its stream of events has not broken since

export function useKey(newKey: string | null, ofServer: string): void {
  key = newKey;
  server = ofServer;
  isSure = true;
}

// The stream has broken: another server may have the address by now. The next request asks who is there before it sends the key.
export function beUnsure(): void {
  isSure = false;
}

async function demandSameServer(): Promise<void> {
  if (isSure) return;
  const hello = (await (await fetch("/api/hello", { cache: "no-store", credentials: "omit" })).json()) as Hello;
  if (hello.server !== server) key = null;
  isSure = key !== null;
  if (key === null)
    throw new ApiError(401, "The server was started again and has a new key", "Nothing was sent", "Open the link that it printed", "", null);
}

export function asError(status: number, document: ErrorDocument): ApiError {
  return new ApiError(
    status,
    document.what ?? document.error ?? "The server gave no reason.",
    document.unchanged ?? "",
    document.to_do ?? "",
    document.id ?? "",
    typeof document.remedy === "object" ? (document.remedy?.key ?? null) : (document.remedy ?? null),
  );
}

function notHeard(method: string): ApiError {
  return new ApiError(
    0,
    "The server does not answer.",
    method === "GET" ? "" : "Whether it took the request is not known; the page shows it when the server is back.",
    "Look whether qchopper serve still runs.",
    "",
    method === "GET" ? "try_again" : null,
  );
}

async function answer(method: string, path: string, more: Record<string, string> = {}, body: string | null = null): Promise<Response> {
  let response: Response;
  try {
    if (path !== "/api/hello") await demandSameServer();
    const given: Record<string, string> = key === null ? {} : { Authorization: `Bearer ${key}` };
    const headers = { ...given, ...more };
    response = await fetch(path, { method, headers, body, cache: "no-store", credentials: "omit" });
  } catch (error) {
    throw error instanceof ApiError ? error : notHeard(method);
  }
  if (response.ok) return response;
  const document = (await response.json().catch(() => ({}))) as ErrorDocument;
  throw asError(response.status, document);
}

export async function get<T>(path: string): Promise<T> {
  return (await answer("GET", path)).json() as Promise<T>;
}

export async function getBytes(path: string): Promise<ArrayBuffer> {
  return (await answer("GET", path)).arrayBuffer();
}

export async function getBlob(path: string): Promise<Blob> {
  return (await answer("GET", path)).blob();
}

export async function post<T>(path: string, body: unknown, revision?: string): Promise<T> {
  const more: Record<string, string> = {
    "Content-Type": "application/json",
    "X-Request-Id": crypto.randomUUID(),
  };
  if (revision !== undefined) more["If-Match"] = `"${revision}"`;
  const response = await answer("POST", path, more, JSON.stringify(body));
  return (await response.json().catch(() => ({}))) as T;
}

// A question about a project. Of those that wait in a lane the server answers the newest; each window has lanes of its own.
const windowId = crypto.randomUUID().slice(0, 8);

export async function ask<T>(project: string, kind: "rank" | "preview" | "setups" | "jobs", question: object): Promise<T> {
  return (await askWhole<{ document: T }>(project, kind, question)).document;
}

// With what stands beside the document.
export function askWhole<T>(project: string, kind: string, question: object): Promise<T> {
  return post<T>(`/api/projects/${project}/questions`, { lane: `${kind}-${windowId}`, [kind]: question });
}

export async function remove(path: string): Promise<void> {
  await answer("DELETE", path, { "X-Request-Id": crypto.randomUUID() });
}

// Opens a document in a window of its own. The window is opened by the click itself, before the server is asked: a browser
// blocks one that opens later.
export async function openInWindow(path: string): Promise<void> {
  const other = window.open("", "_blank");
  try {
    const ticket = await post<{ path: string }>("/api/tickets", { path });
    if (other) {
      other.opener = null;
      other.location.href = ticket.path;
    }
  } catch (error) {
    other?.close();
    throw error;
  }
}
