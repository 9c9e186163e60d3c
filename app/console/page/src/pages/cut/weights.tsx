// The weights of the terms, to try. They are kept by Keep weights, or with Accept; never by the slider alone.

import { areSame, termsOf } from "../../geometry/ranking";
import type { Terms } from "../../link/documents";
import { NumberField } from "../../parts/number_field";
import { titled } from "../../parts/words";

interface Props {
  kept: Terms;
  weights: Terms;
  off: boolean;
  onWeights: (weights: Terms) => void;
  onKeep: () => void;
}

const STEPS = 100;

export function WeightTable({ kept, weights, off, onWeights, onKeep }: Props) {
  const isKept = areSame(kept, weights);
  return (
    <details class="weights">
      <summary>
        <h2>Weights</h2>
        {!isKept && <span class="state warn"> tried, not kept</span>}
      </summary>
      {termsOf(kept).map((name) => {
        const most = Math.max(4 * kept[name]!, 1);
        const value = weights[name] ?? 0;
        const set = (next: number) => onWeights({ ...weights, [name]: next });
        return (
          <div key={name} class="weight">
            <NumberField label={titled(name)} value={value} min={0} onValue={set} />
            <input
              type="range"
              min={0}
              max={most}
              step={most / STEPS}
              value={Math.min(value, most)}
              aria-label={`${titled(name)}, weight`}
              onInput={(event) => set(Number(event.currentTarget.value))}
            />
          </div>
        );
      })}
      <p class="row">
        <button type="button" disabled={off || isKept} onClick={onKeep}>
          Keep weights
        </button>
        <button type="button" disabled={isKept} onClick={() => onWeights(kept)}>
          Back to those kept
        </button>
      </p>
      <p class="note">By how much tools tilt is fixed with the cell, and tools do not enter the ranking.</p>
    </details>
  );
}
