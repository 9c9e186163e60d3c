// Waits for a work that this page began: its result comes with an event.

import { useEffect, useRef, useState } from "preact/hooks";
import { asError, type ApiError } from "../link/api";
import type { Work } from "../link/documents";
import { isOver } from "../link/state";
import { useStore } from "../link/store";

export interface Begun {
  work: Work | null; // as it is
  error: ApiError | null;
  begin: (id: string) => void;
}

// `onDone` is called once with the result.
export function useWork<T>(onDone: (result: T) => void): Begun {
  const { state } = useStore();
  const [id, setId] = useState<string | null>(null);
  const [error, setError] = useState<ApiError | null>(null);
  const told = useRef<string | null>(null);
  const work = state?.work.find((one) => one.id === id) ?? null;
  useEffect(() => {
    if (work === null || !isOver(work) || told.current === work.id) return;
    told.current = work.id;
    if (work.state === "done") onDone(work.result as T);
    else setError(whyOver(work));
  }, [work]);
  return {
    work,
    error,
    begin: (next) => {
      setError(null);
      setId(next);
    },
  };
}

function whyOver(work: Work): ApiError | null {
  if (work.error) return asError(500, work.error);
  if (work.state === "stopped") return null;
  return asError(500, {
    what: work.state === "lost" ? "The process that worked has ended" : "The work failed",
    unchanged: "What was saved before is kept",
    to_do: "Begin it again",
    remedy: "try_again",
  });
}
