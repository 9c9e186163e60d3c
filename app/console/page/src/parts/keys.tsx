// The keys of the page: one table, which the list under ? shows and the listener obeys. No key starts a motion; F9 holds.

import { useEffect } from "preact/hooks";
import { Dialog } from "./dialog";

export type KeyAction =
  | "help"
  | "hold"
  | "undo"
  | "redo"
  | "fit"
  | "front"
  | "side"
  | "top"
  | "turn left"
  | "turn right"
  | "turn up"
  | "turn down"
  | "zoom in"
  | "zoom out"
  | "plane back"
  | "plane on"
  | "flip"
  | "hide"
  | "play"
  | "stage back"
  | "stage on";

interface Key {
  key: string; // of KeyboardEvent, lower case
  control?: boolean;
  shift?: boolean;
  shown: string;
  action: KeyAction;
  what: string;
  inLists?: false; // arrows belong to a list that has the focus
}

export const KEYS: Key[] = [
  { key: "?", shown: "?", action: "help", what: "Show this list" },
  { key: "f9", shown: "F9", action: "hold", what: "Hold every cell that carves" },
  { key: "z", control: true, shift: false, shown: "Ctrl+Z", action: "undo", what: "Undo the last decision" },
  { key: "z", control: true, shift: true, shown: "Ctrl+Shift+Z", action: "redo", what: "Redo it" },
  { key: "f", shown: "F", action: "fit", what: "Fit everything into the view" },
  { key: "1", shown: "1", action: "front", what: "View from the front" },
  { key: "3", shown: "3", action: "side", what: "View from the side" },
  { key: "7", shown: "7", action: "top", what: "View from the top" },
  { key: "arrowleft", shown: "←", action: "turn left", what: "Turn the view to the left", inLists: false },
  { key: "arrowright", shown: "→", action: "turn right", what: "Turn the view to the right", inLists: false },
  { key: "arrowup", shown: "↑", action: "turn up", what: "Turn the view up", inLists: false },
  { key: "arrowdown", shown: "↓", action: "turn down", what: "Turn the view down", inLists: false },
  { key: "+", shown: "+", action: "zoom in", what: "Zoom in" },
  { key: "-", shown: "-", action: "zoom out", what: "Zoom out" },
  { key: "[", shown: "[", action: "plane back", what: "Move the plane back by the step" },
  { key: "]", shown: "]", action: "plane on", what: "Move the plane on by the step" },
  { key: "x", shown: "X", action: "flip", what: "Flip the plane" },
  { key: "h", shown: "H", action: "hide", what: "Hide one side of the plane, the other, none" },
  { key: "p", shown: "P", action: "play", what: "Play the replay, or pause it" },
  { key: ",", shown: ",", action: "stage back", what: "Go back to the stage before in the replay" },
  { key: ".", shown: ".", action: "stage on", what: "Go on to the next stage in the replay" },
];

const handlers = new Map<KeyAction, (() => void)[]>();

// The newest component that handles an action gets it.
export function useKey(action: KeyAction, run: (() => void) | null): void {
  useEffect(() => {
    if (run === null) return;
    const list = handlers.get(action) ?? [];
    handlers.set(action, [...list, run]);
    return () => void handlers.set(action, (handlers.get(action) ?? []).filter((one) => one !== run));
  });
}

// Letters in a list of choices choose.
const isTyping = (element: Element | null): boolean =>
  element instanceof HTMLTextAreaElement ||
  element instanceof HTMLSelectElement ||
  (element instanceof HTMLInputElement && !["range", "checkbox", "radio", "button"].includes(element.type));

const ownsArrows = (element: Element | null): boolean =>
  element instanceof HTMLInputElement || element instanceof HTMLSelectElement || element?.closest("table,[role=slider]") != null;

export function keyOf(event: Pick<KeyboardEvent, "key" | "ctrlKey" | "metaKey" | "altKey" | "shiftKey">): Key | undefined {
  if (event.altKey) return undefined;
  const control = event.ctrlKey || event.metaKey;
  return KEYS.find(
    (one) =>
      one.key === event.key.toLowerCase() &&
      (one.control ?? false) === control &&
      (one.shift === undefined || one.shift === event.shiftKey),
  );
}

function onKeyDown(event: KeyboardEvent): void {
  const key = keyOf(event);
  if (key === undefined) return;
  // Hold works everywhere; all else is off while typing, and where a dialog asks.
  if (key.action !== "hold" && (isTyping(document.activeElement) || document.querySelector("dialog[open]"))) return;
  if (key.inLists === false && ownsArrows(document.activeElement)) return;
  const run = handlers.get(key.action)?.at(-1);
  if (run === undefined || event.repeat && key.action === "hold") return;
  event.preventDefault();
  run();
}

export const listenToKeys = (): void => addEventListener("keydown", onKeyDown);

export function KeyList({ onClose }: { onClose: () => void }) {
  return (
    <Dialog title="Keys" onClose={onClose}>
      <p>Keys do nothing while you type. No key starts a motion.</p>
      <table>
        <tbody>
          {KEYS.map((key) => (
            <tr key={key.shown}>
              <th scope="row">
                <kbd>{key.shown}</kbd>
              </th>
              <td>{key.what}</td>
            </tr>
          ))}
        </tbody>
      </table>
      <p class="row">
        <button type="button" onClick={onClose}>
          Close
        </button>
      </p>
    </Dialog>
  );
}
