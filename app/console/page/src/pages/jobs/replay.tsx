// The replay of a job: where the tool is at a time, the foam as of the stage before, and at the end the piece in the deviation
// that the proof found. Nothing of it is a figure of the proof: that has smaller cells.

import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import { linesTo, pointAt, tipAt, WAY_KINDS, type ToolWay } from "../../geometry/tool_way";
import type { ApiError } from "../../link/api";
import type { Replay, Vec3 } from "../../link/documents";
import { asApiError, ErrorBox } from "../../parts/error";
import { useKey } from "../../parts/keys";
import { Signed } from "../../parts/signed";
import { count, number, percent, time, volume } from "../../parts/words";
import { readWay, useMeshes, useStates } from "../../view/meshes";
import { orientationColour } from "../../view/palette";
import type { Arrow, Outline } from "../../view/scene";
import type { Solid } from "../../view/solids";
import { View } from "../../view/view";

// As the pictures of the setup sheets (app/pictures/deviation_picture.cpp).
const DEVIATIONS = [
  { words: "cut into by more than 0.25 mm", colour: "#a50026" },
  { words: "cut into by more than 0.05 mm", colour: "#f48c50" },
  { words: "up to 0.3 mm of foam", colour: "#e8e4d8" },
  { words: "up to 0.75 mm", colour: "#9ecae1" },
  { words: "up to 3 mm", colour: "#427ebe" },
  { words: "more foam", colour: "#142864" },
  { words: "given up by the program", colour: "#ffcd1e" },
];
const FOAM = "#e2d6be";
const SPEEDS = [1, 10, 60, 300];
const STEP_MS = 1000; // of the slider
const TICK_MS = 100;
const CALM_TICK_MS = 1000; // where the person wants little motion

export function ReplayPanel({ replay, onClose }: { replay: Replay; onClose: () => void }) {
  const end = Math.round(1000 * replay.time_s);
  const [ms, setMs] = useState(0);
  const [isColoured, setColoured] = useState(true);
  const { way, error } = useWay(replay.path);
  const playing = usePlaying(end, ms, setMs);
  const stage = stageAt(replay, ms);
  const goTo = (next: number) => setMs(1000 * replay.stages[Math.min(replay.stages.length - 1, Math.max(0, next))]!.seconds);
  // Back: to where this stage began, or to the one before where the tool stands there.
  const back = () => goTo(ms > 1000 * replay.stages[stage]!.seconds + 1 ? stage : stage - 1);
  useKey("play", playing.toggle);
  useKey("stage back", back);
  useKey("stage on", () => goTo(stage + 1));
  const isEnd = stage === replay.stages.length - 1;
  const shown = useShownSolids(replay, stage, isEnd && isColoured);
  const at = way === null ? null : placeAt(replay, way, ms);
  const first = replay.stages[stage]!.points;
  const outline = useMemo<Outline | null>(
    () => (way && at && !isEnd ? { segments: linesTo(way, first, at.point, at.tip), isProvisional: false } : null),
    [way, ms, first, isEnd],
  );
  const arrows = useMemo(() => (at && !isEnd ? [toolArrow(replay, at)] : []), [way, ms, isEnd]);
  const name = `piece ${replay.piece}${replay.parts > 1 ? `, part ${replay.part} of ${replay.parts}` : ""}`;
  return (
    <section class="replay" aria-label={`Replay of ${name}`}>
      <h2>Replay of {name}</h2>
      {!replay.positive && (
        <p>
          <Signed state="negative" word="The proof of this job is negative." /> What it found is listed by Verify.
        </p>
      )}
      <View label={`${shown.label} of ${name}, at ${time(ms / 1000)} of ${time(replay.time_s)}`} solids={shown.solids} outline={outline} arrows={arrows}>
        {replay.deviation && (
          <button type="button" aria-pressed={isColoured} disabled={!isEnd} onClick={() => setColoured(!isColoured)}>
            Deviation
          </button>
        )}
      </View>
      <label>
        Machine time
        <input
          type="range"
          min={0}
          max={STEP_MS * Math.ceil(end / STEP_MS)}
          step={STEP_MS}
          value={ms}
          aria-valuetext={`${time(ms / 1000)} of ${time(replay.time_s)}`}
          onInput={(event) => setMs(Math.min(end, Number(event.currentTarget.value)))}
        />
      </label>
      <p class="row">
        <button type="button" aria-pressed={playing.isOn} onClick={playing.toggle}>
          {playing.isOn ? "Pause" : "Play"}
        </button>
        <button type="button" disabled={ms === 0} onClick={back}>
          Stage back
        </button>
        <button type="button" disabled={isEnd} onClick={() => goTo(stage + 1)}>
          Stage on
        </button>
        <label class="row">
          Speed
          <select value={String(playing.speed)} onChange={(event) => playing.setSpeed(Number(event.currentTarget.value))}>
            {SPEEDS.map((speed) => (
              <option key={speed} value={String(speed)}>
                {speed === 1 ? "as the machine" : `${speed} times`}
              </option>
            ))}
          </select>
        </label>
        <button type="button" onClick={onClose}>
          Close the replay
        </button>
      </p>
      <Figures replay={replay} stage={stage} ms={ms} at={at} />
      {isEnd && isColoured && replay.deviation && <Legend />}
      <p class="note">
        Replayed in cells of {number(replay.cell_mm, 0)} mm, and drawn within {number(replay.stock_off_mm, 1)} mm of them: the figures of the proof
        count, which has cells of 0.25 mm.
      </p>
      <ErrorBox error={error ?? shown.error} />
    </section>
  );
}

interface Place {
  point: number; // of the way, to which the tip goes
  tip: Vec3;
  line: number;
  kind: string;
  section: Replay["sections"][0];
}

function placeAt(replay: Replay, way: ToolWay, ms: number): Place | null {
  if (way.ms.length === 0) return null;
  const point = pointAt(way, ms);
  let passed = 0;
  const section = replay.sections.find((one) => (passed += one.points) > point) ?? replay.sections.at(-1)!;
  return { point, tip: tipAt(way, point, ms), line: way.lines[point]!, kind: WAY_KINDS[way.kinds[point]!]!, section };
}

// The last one that is reached: the foam never shows what is not removed yet.
function stageAt(replay: Replay, ms: number): number {
  let stage = 0;
  while (stage + 1 < replay.stages.length && Math.floor(1000 * replay.stages[stage + 1]!.seconds) <= ms) ++stage;
  return stage;
}

function toolArrow(replay: Replay, { tip, section }: Place): Arrow {
  const axis = replay.tool_axes[section.orientation - 1] ?? ([0, 0, 1] as Vec3);
  const length = 60;
  const from = tip.map((value, i) => value + length * axis[i]!) as Vec3;
  const direction = axis.map((value) => -value) as Vec3;
  return { direction, from, length, colour: orientationColour(section.orientation - 1), rings: section.orientation, isAway: true };
}

function useWay(id: string): { way: ToolWay | null; error: ApiError | null } {
  const [way, setWay] = useState<ToolWay | null>(null);
  const [error, setError] = useState<ApiError | null>(null);
  useEffect(() => {
    let gone = false;
    readWay(id).then(
      (found) => gone || setWay(found),
      (reason: unknown) => gone || setError(asApiError(reason)),
    );
    return () => {
      gone = true;
    };
  }, [id]);
  return { way, error };
}

// Until its own mesh is there, a stage shows the one before.
function useShownSolids(replay: Replay, stage: number, isPiece: boolean): { solids: Solid[]; label: string; error: ApiError | null } {
  const piece = isPiece ? replay.deviation : null;
  const id = piece?.mesh ?? replay.stages[stage]!.mesh;
  const next = replay.stages[stage + 1]?.mesh;
  const { meshes, error } = useMeshes([...new Set([id, ...(next === undefined ? [] : [next])])]);
  const { states, error: stateError } = useStates(piece ? { [piece.mesh]: piece.classes } : NO_STATES, meshes);
  const last = useRef<{ solids: Solid[]; label: string }>({ solids: [], label: "The block" });
  return useMemo(() => {
    const mesh = meshes.get(id);
    const of = piece ? states.get(piece.mesh) : undefined;
    if (mesh && (!piece || of)) {
      const palette = DEVIATIONS.map((one) => one.colour);
      last.current = {
        solids: [{ name: "stock", mesh, colour: FOAM, ...(of ? { states: { of, palette } } : {}) }],
        label: piece ? "The deviation" : `Stage ${stage} of ${replay.stages.length - 1}`,
      };
    }
    return { ...last.current, error: error ?? stateError };
  }, [id, meshes, states, error, stateError, piece]);
}

const NO_STATES: Record<string, string> = {};

interface Playing {
  isOn: boolean;
  toggle: () => void;
  speed: number;
  setSpeed: (speed: number) => void;
}

// Time goes on by what has passed since the last tick, to the end, and begins anew there.
function usePlaying(end: number, ms: number, setMs: (change: (old: number) => number) => void): Playing {
  const [isOn, setOn] = useState(false);
  const [speed, setSpeed] = useState(60);
  const isOver = ms >= end;
  useEffect(() => {
    if (!isOn) return;
    let last = performance.now();
    const tick = matchMedia("(prefers-reduced-motion: reduce)").matches ? CALM_TICK_MS : TICK_MS;
    const timer = setInterval(() => {
      const now = performance.now();
      const passed = speed * (now - last);
      last = now;
      setMs((old) => Math.min(end, old + passed));
    }, tick);
    return () => clearInterval(timer);
  }, [isOn, speed, end]);
  useEffect(() => {
    if (isOver) setOn(false);
  }, [isOver]);
  return {
    isOn,
    toggle: () => {
      if (!isOn && isOver) setMs(() => 0);
      setOn(!isOn);
    },
    speed,
    setSpeed,
  };
}

function Figures({ replay, stage, ms, at }: { replay: Replay; stage: number; ms: number; at: Place | null }) {
  const tool = replay.tools.find((one) => one.number === at?.section.tool);
  const removed = replay.stages[stage]!.removed_mm3;
  const rows: [string, string][] = [
    ["Stage", `${stage} of ${replay.stages.length - 1}`],
    ["Passed", time(ms / 1000)],
    ["Left", time(Math.max(0, replay.time_s - ms / 1000))],
    ["Removed up to this stage", `${volume(removed)}${replay.removed_mm3 > 0 ? `, ${percent(removed / replay.removed_mm3)}` : ""}`],
    ["Program", at ? `${at.section.file}, line ${count(at.line)}` : "-"],
    ["Tool", at ? `${at.section.tool}${tool ? ` (${tool.name})` : ""}, orientation ${at.section.orientation}` : "-"],
    ["What it does", at ? at.kind : "-"],
  ];
  return (
    <table>
      <caption class="unseen">Where the program is</caption>
      <tbody>
        {rows.map(([name, value]) => (
          <tr key={name}>
            <th scope="row">{name}</th>
            <td>{value}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

function Legend() {
  return (
    <ul class="legend" aria-label="Colours of the deviation">
      {DEVIATIONS.map(({ words, colour }) => (
        <li key={words}>
          <span class="patch" style={{ backgroundColor: colour }} aria-hidden="true" />
          {words}
        </li>
      ))}
    </ul>
  );
}
