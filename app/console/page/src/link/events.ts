// Events for this window: from the SharedWorker, or from a stream of its own where the browser has none.

import { EventStream, type LinkState, type StreamEvent } from "./event_stream";

export type ToWorker = { server: string; key: string } | { leave: true };
export type FromWorker = { event: StreamEvent } | { link: LinkState };

export interface Listener {
  onEvent: (event: StreamEvent) => void;
  onLink: (state: LinkState) => void;
}

// Returns what ends it.
export function listen(server: string, key: string, listener: Listener): () => void {
  if (typeof SharedWorker === "undefined") {
    const stream = new EventStream(server, key, listener.onEvent, listener.onLink);
    return () => stream.close();
  }
  // Named by the server: a worker of a server that has ended is never asked again.
  const { port } = new SharedWorker("/events.js", { type: "module", name: `qchopper ${server}` });
  port.onmessage = (message: MessageEvent<FromWorker>) => {
    if ("event" in message.data) listener.onEvent(message.data.event);
    else listener.onLink(message.data.link);
  };
  port.postMessage({ server, key } satisfies ToWorker);
  const leave = () => port.postMessage({ leave: true } satisfies ToWorker);
  addEventListener("pagehide", leave);
  return () => {
    removeEventListener("pagehide", leave);
    leave();
    port.close();
  };
}
