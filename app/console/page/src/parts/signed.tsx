// A state: its shape, its word, its colour.

import { sign } from "./words";

export function Signed({ state, word = state }: { state: string; word?: string }) {
  const { shape, kind } = sign(state);
  return (
    <span class={`state ${kind}`}>
      <span aria-hidden="true">{shape}</span> {word}
    </span>
  );
}
