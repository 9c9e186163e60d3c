// A number to type. What is typed stays as it is until the field is left; every whole number in it counts at once.

import { useState } from "preact/hooks";

interface Props {
  label: string;
  value: number;
  onValue: (value: number) => void;
  unit?: string;
  min?: number;
  max?: number;
  disabled?: boolean;
  unseenLabel?: boolean;
}

export function NumberField({ label, value, onValue, unit, min, max, disabled, unseenLabel }: Props) {
  const [text, setText] = useState<string | null>(null); // null: not being typed in
  const isGood = (number: number) =>
    Number.isFinite(number) && (min === undefined || number >= min) && (max === undefined || number <= max);
  const typed = text === null ? value : text.trim() === "" ? NaN : Number(text.replace(",", "."));
  return (
    <label class="number">
      <span class={unseenLabel ? "unseen" : ""}>{label}</span>
      <input
        type="text"
        inputMode="decimal"
        value={text ?? shown(value)}
        disabled={disabled ?? false}
        aria-invalid={!isGood(typed)}
        onInput={(event) => {
          const next = event.currentTarget.value;
          setText(next);
          const number = next.trim() === "" ? NaN : Number(next.replace(",", "."));
          if (isGood(number) && number !== value) onValue(number);
        }}
        onBlur={() => setText(null)}
        onKeyDown={(event) => event.key === "Enter" && setText(null)}
      />
      {unit !== undefined && <span class="unit">{unit}</span>}
    </label>
  );
}

const shown = (value: number): string => String(Math.round(value * 1e6) / 1e6);
