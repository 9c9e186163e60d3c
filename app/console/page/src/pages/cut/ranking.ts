// The ranking of planes for a piece: asked of the engine whenever project, piece or weights have changed and come to rest.

import { useEffect, useState } from "preact/hooks";
import { ask, type ApiError } from "../../link/api";
import type { Project, Segment, Terms } from "../../link/documents";
import { areSame } from "../../geometry/ranking";
import { useSettled } from "../../parts/asking";
import { asApiError } from "../../parts/error";

const TOP = 40;
const REST_MS = 250;

export interface Ranking {
  segment: Segment | null; // with the proposal; null: none yet
  weights: Terms; // by which the engine ranked it
  isExact: boolean; // it is of this project, piece and weights
  error: ApiError | null;
  again: () => void;
}


interface Found {
  revision: string;
  piece: string; // asked for; "": the one that the rules choose
  settled: string; // weights
  segment: Segment;
}

export function useRanking(project: Project, piece: string, weights: Terms, isBusy: boolean): Ranking {
  const [found, setFound] = useState<Found | null>(null);
  const [error, setError] = useState<ApiError | null>(null);
  const [tries, setTries] = useState(0);
  const now = JSON.stringify(weights);
  const settled = useSettled(now, REST_MS);
  const { id, revision } = project;
  // What was asked for without a name is also that of the piece that it was for.
  const isOfThis =
    found !== null && found.revision === revision && (found.piece === piece || found.segment.proposal?.piece === piece);
  const isNone = project.stage !== "cutting" && piece === ""; // the search has ended
  const isNeeded = !isBusy && !isNone && !(isOfThis && found.settled === settled);
  useEffect(() => {
    if (!isNeeded) return;
    let gone = false;
    const asked = JSON.parse(settled) as Terms;
    const rank = {
      ...(piece === "" ? {} : { piece }),
      top: TOP,
      ...(areSame(asked, project.segment.weights) ? {} : { weights: asked }),
    };
    ask<Segment>(id, "rank", rank)
      .then((segment) => {
        if (gone) return;
        setError(null);
        setFound({ revision, piece, settled, segment });
      })
      .catch((reason: unknown) => gone || setError(asApiError(reason)));
    return () => {
      gone = true;
    };
  }, [isNeeded, id, revision, piece, settled, tries]);
  return {
    segment: isOfThis ? found.segment : null,
    weights: isOfThis ? (JSON.parse(found.settled) as Terms) : project.segment.weights,
    isExact: isOfThis && found.settled === now,
    error,
    again: () => setTries((n) => n + 1),
  };
}
