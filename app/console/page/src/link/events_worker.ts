// The SharedWorker: one stream of events for all windows. A browser opens six connections to a server at most, and streams
// of several windows would leave none for Hold.

import { EventStream, type LinkState, type StreamEvent } from "./event_stream";
import type { FromWorker, ToWorker } from "./events";

const ports = new Set<MessagePort>();
let stream: EventStream | null = null;
let link: LinkState = "lost";

function tell(message: FromWorker): void {
  for (const port of ports) port.postMessage(message);
}

function follow(server: string, key: string): void {
  stream?.close();
  stream = new EventStream(
    server,
    key,
    (event: StreamEvent) => tell({ event }),
    (state) => {
      link = state;
      tell({ link: state });
    },
  );
}

(self as unknown as { onconnect: (event: MessageEvent) => void }).onconnect = (event) => {
  const port = event.ports[0]!;
  ports.add(port);
  port.onmessage = (message: MessageEvent<ToWorker>) => {
    if ("leave" in message.data) {
      ports.delete(port);
      return;
    }
    const { server, key } = message.data;
    // A window with a new key of the same server ends a refusal; another window of the same key gets the state as it is.
    if (stream === null || link === "refused" || link === "other server") follow(server, key);
    else port.postMessage({ link } satisfies FromWorker);
  };
};
