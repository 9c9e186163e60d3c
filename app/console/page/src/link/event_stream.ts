// The server's events: a stream read by fetch, which can send the key, unlike EventSource. It goes on by ?after= where it was
// broken, so that every event is given once and in order.

export interface StreamEvent {
  id: string;
  name: string;
  data: unknown;
}

export type LinkState = "open" | "lost" | "other server" | "refused";

// Splits a text/event-stream into events; what a chunk leaves unfinished waits for the next. Linear in the text.
export class EventParser {
  private rest = "";

  push(text: string): StreamEvent[] {
    this.rest += text;
    const events: StreamEvent[] = [];
    for (let end = this.rest.indexOf("\n\n"); end >= 0; end = this.rest.indexOf("\n\n")) {
      const event = parse(this.rest.slice(0, end));
      this.rest = this.rest.slice(end + 2);
      if (event) events.push(event);
    }
    return events;
  }
}

function parse(frame: string): StreamEvent | null {
  let id = "";
  let name = "message";
  let data = "";
  for (const line of frame.split("\n")) {
    const colon = line.indexOf(":");
    if (colon <= 0) continue; // a comment, or no field
    const value = line.slice(colon + 1).replace(/^ /, "").replace(/\r$/, "");
    const field = line.slice(0, colon);
    if (field === "id") id = value;
    else if (field === "event") name = value;
    else if (field === "data") data += value;
  }
  if (data === "") return null;
  try {
    return { id, name, data: JSON.parse(data) as unknown };
  } catch {
    return null;
  }
}

// "1f3a9c02-17" is event 17 of that server.
export function numberOf(id: string): number {
  const number = Number(id.slice(id.lastIndexOf("-") + 1));
  return Number.isFinite(number) ? number : -1;
}

const FIRST_WAIT_MS = 500;
const LONGEST_WAIT_MS = 4000;
const SILENT_MS = 10_000; // five ticks: the connection is dead even if it is not closed

// Follows one server until close(). Never sends the key to another: it asks hello before each new try.
export class EventStream {
  private last = "";
  private closed = false;
  private abort: AbortController | null = null;
  private wake: (() => void) | null = null;

  constructor(
    private readonly server: string,
    private readonly key: string,
    private readonly onEvent: (event: StreamEvent) => void,
    private readonly onLink: (state: LinkState) => void,
  ) {
    void this.run();
  }

  close(): void {
    this.closed = true;
    this.abort?.abort();
    this.wake?.();
  }

  private async run(): Promise<void> {
    let wait = FIRST_WAIT_MS;
    while (!this.closed) {
      const outcome = await this.read().catch(() => "lost" as const);
      if (this.closed) return;
      this.onLink(outcome);
      if (outcome !== "lost") return;
      await new Promise<void>((done) => {
        this.wake = done;
        setTimeout(done, wait);
      });
      wait = this.last === "" ? Math.min(2 * wait, LONGEST_WAIT_MS) : FIRST_WAIT_MS;
    }
  }

  private async read(): Promise<LinkState> {
    this.abort = new AbortController();
    const { signal } = this.abort;
    const hello = (await (await fetch("/api/hello", { cache: "no-store", signal })).json()) as { server: string };
    if (hello.server !== this.server) return "other server";
    const after = this.last === "" ? "" : `?after=${this.last}`;
    const response = await fetch(`/api/events${after}`, {
      headers: { Authorization: `Bearer ${this.key}` },
      cache: "no-store",
      signal,
    });
    if (response.status === 401 || response.status === 403) return "refused";
    if (!response.ok || response.body === null) return "lost";
    this.onLink("open");
    await this.readEvents(response.body);
    return "lost";
  }

  private async readEvents(body: ReadableStream<Uint8Array>): Promise<void> {
    const reader = body.getReader();
    const decoder = new TextDecoder();
    const parser = new EventParser();
    for (;;) {
      const silent = setTimeout(() => this.abort?.abort(), SILENT_MS);
      const { done, value } = await reader.read().finally(() => clearTimeout(silent));
      if (done) return;
      for (const event of parser.push(decoder.decode(value, { stream: true }))) {
        if (event.id !== "") this.last = event.id;
        this.onEvent(event);
      }
    }
  }
}
