// Asking the server from a component: one request at a time, its error, and the sentence of what was done.

import { useEffect, useRef, useState } from "preact/hooks";
import type { ApiError } from "../link/api";
import { asApiError } from "./error";

export interface Asking {
  busy: boolean;
  error: ApiError | null;
  run: (ask: () => Promise<void>) => void;
  again: () => void; // the request that failed, as a new one
  clear: () => void;
}

export function useAsking(): Asking {
  const [busy, setBusy] = useState(false);
  const [error, setError] = useState<ApiError | null>(null);
  const last = useRef<(() => Promise<void>) | null>(null);
  const running = useRef(false);
  const alive = useRef(true);
  useEffect(() => () => void (alive.current = false), []);
  const run = (ask: () => Promise<void>) => {
    if (running.current) return;
    running.current = true;
    last.current = ask;
    setBusy(true);
    setError(null);
    ask()
      .catch((reason: unknown) => alive.current && setError(asApiError(reason)))
      .finally(() => {
        running.current = false;
        if (alive.current) setBusy(false);
      });
  };
  return { busy, error, run, again: () => last.current && run(last.current), clear: () => setError(null) };
}

// The value after it has stayed the same for `ms`.
export function useSettled<T>(value: T, ms: number): T {
  const [settled, setSettled] = useState(value);
  useEffect(() => {
    const timer = setTimeout(() => setSettled(value), ms);
    return () => clearTimeout(timer);
  }, [value, ms]);
  return settled;
}
