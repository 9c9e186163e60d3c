// Keeps the focus where it is when rows of a table change their places: the browser drops it from a row that moves.

import { useLayoutEffect } from "preact/hooks";

export function useKeptFocus(): void {
  const focused = document.activeElement;
  useLayoutEffect(() => {
    if (focused instanceof HTMLElement && focused.isConnected && document.activeElement !== focused)
      focused.focus({ preventScroll: true });
  });
}
