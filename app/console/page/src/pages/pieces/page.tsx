// Pieces: apart by a slider, and of the chosen one block, tool orientations as arrows, margins and all bases with their figures.

import { useEffect, useMemo, useState } from "preact/hooks";
import { select, type Address } from "../../address";
import { extentOf, toolArrows } from "../../geometry/tool_arrows";
import type { Project, Setup, Vec3 } from "../../link/documents";
import { currentWork } from "../../link/state";
import { useProject, useStore } from "../../link/store";
import { ErrorBox } from "../../parts/error";
import { Signed } from "../../parts/signed";
import { counted, percent, volume } from "../../parts/words";
import { STATES, type DisplayMesh } from "../../geometry/display_mesh";
import { useMeshes, useStates } from "../../view/meshes";
import { ViewNote } from "../../view/note";
import { orientationColour, pieceColour } from "../../view/palette";
import type { Arrow } from "../../view/scene";
import type { Solid } from "../../view/solids";
import { View } from "../../view/view";
import { Bases, type Laid } from "./bases";
import { Margins, Orientations, SetupTable } from "./tables";

export function PiecesPage({ address, stale }: { address: Address; stale: boolean }) {
  const { project, error, retry } = useProject(address.id);
  if (project === null)
    return (
      <main>
        <h1>Pieces</h1>
        {error === null && <p role="status">The project is being read.</p>}
        <ErrorBox error={error} actions={{ try_again: retry }} />
      </main>
    );
  return <Shown project={project} address={address} stale={stale} />;
}

function Shown({ project, address, stale }: { project: Project; address: Address; stale: boolean }) {
  const { state } = useStore();
  const [apart, setApart] = useState(0.4);
  const chosen = address.selection["piece"] ?? project.segment.pieces[0]?.name ?? "";
  const off = stale || (state?.read_only ?? true) || (state ? currentWork(state) !== null : true);
  const { meshes, error } = useMeshes(project.drawn.map((one) => one.mesh));
  const [byState, setByState] = useState(false);
  const [laid, setLaid] = useState<Record<string, Laid>>({}); // by piece: what was asked
  const [looked, setLooked] = useState<{ piece: string; base: number } | null>(null); // a base that is looked at
  useEffect(() => setLaid({}), [project.revision]);
  const base = looked?.piece === chosen ? looked.base : null;
  const setup = setupShown(laid, chosen, base);
  const { states, error: stateError } = useStates(byState ? stateIds(project, laid) : NO_STATES, meshes);
  const solids = useMemo(() => exploded(project, meshes, states, apart), [project, meshes, states, apart]);
  const arrows = useMemo(() => arrowsOf(setup, solids.find((solid) => solid.name === chosen)), [setup, solids, chosen]);
  return (
    <main class="pieces">
      <h1 class="unseen">Pieces of {project.name}</h1>
      <div class="left">
        <PieceList project={project} chosen={chosen} laid={laid} />
      </div>
      <div class="middle">
        <View label={labelOf(project, chosen, arrows.length)} solids={solids} arrows={arrows} onPick={(picked) => picked && select({ piece: picked.name })}>
          <label class="row">
            Apart
            <input type="range" min={0} max={1} step={0.02} value={apart} onInput={(event) => setApart(Number(event.currentTarget.value))} />
          </label>
          <button type="button" aria-pressed={byState} disabled={Object.keys(laid).length === 0} onClick={() => setByState(!byState)}>
            Surface by state
          </button>
        </View>
        {byState && <Legend />}
        <ViewNote project={project} />
        <ErrorBox error={error ?? stateError} />
      </div>
      <div class="right">
        <h2>Piece {chosen}</h2>
        <Bases
          key={chosen}
          project={project}
          piece={chosen}
          off={off}
          found={laid[chosen] ?? null}
          looked={base}
          onFound={(found) => setLaid((old) => ({ ...old, [chosen]: found }))}
          onLook={(number) => setLooked(number === null ? null : { piece: chosen, base: number })}
        />
        {setup && <SetupTable setup={setup} />}
        {setup?.reach && <Orientations setup={setup} reach={setup.reach} />}
        {setup?.margins_mm && <Margins setup={setup} margins={setup.margins_mm} />}
      </div>
    </main>
  );
}

function PieceList({ project, chosen, laid }: { project: Project; chosen: string; laid: Record<string, Laid> }) {
  return (
    <section>
      <h2>Pieces</h2>
      <ul class="plain">
        {project.segment.pieces.map((piece) => {
          const made = laid[piece.name]?.setups[0];
          return (
            <li key={piece.name}>
              <button type="button" class="leaf" aria-pressed={piece.name === chosen} onClick={() => select({ piece: piece.name })}>
                <span
                  class="patch"
                  style={{ backgroundColor: pieceColour(project.segment.pieces, piece.name) }}
                  aria-hidden="true"
                />
                <strong>{piece.name}</strong> {volume(piece.volume_mm3)}
                <small>
                  {made ? (
                    <>
                      <Signed state={made.fits ? "ready" : "failed"} word={made.fits ? "fits" : "does not fit"} />
                      {made.reach && `, ${percent(made.reach.unreachable_share)} out of reach`}
                    </>
                  ) : (
                    counted(piece.faces, "face")
                  )}
                </small>
              </button>
            </li>
          );
        })}
      </ul>
    </section>
  );
}

const NO_STATES: Record<string, string> = {};

// By the id of the mesh.
const stateIds = (project: Project, laid: Record<string, Laid>): Record<string, string> =>
  Object.fromEntries(
    project.drawn.flatMap((piece) => {
      const states = laid[piece.name]?.states;
      return states ? [[piece.mesh, states]] : [];
    }),
  );

// The base that is looked at, else the one in force, as far as the engine has said it.
function setupShown(laid: Record<string, Laid>, piece: string, base: number | null): Setup | null {
  const setups = laid[piece]?.setups ?? [];
  return setups.find((one) => one.base_number === base) ?? setups[0] ?? null;
}

const NO_ARROWS: Arrow[] = [];

function arrowsOf(setup: Setup | null, solid: Solid | undefined): Arrow[] {
  if (!setup?.reach || !solid) return NO_ARROWS;
  const axes = setup.reach.orientations.map((one) => one.tool_axis);
  return toolArrows(axes, solid.mesh.positions, solid.shift ?? [0, 0, 0]).map((arrow, i) => ({ ...arrow, colour: orientationColour(i), rings: i + 1 }));
}

function labelOf(project: Project, piece: string, orientations: number): string {
  const what = `${project.segment.pieces.length} pieces of ${project.name}, apart`;
  if (orientations === 0) return what;
  return `${what}; arrows at piece ${piece} for ${orientations} tool orientation${orientations > 1 ? "s" : ""}`;
}

// Each piece is moved away from the middle of all by its share.
function exploded(project: Project, meshes: Map<string, DisplayMesh>, states: Map<string, Uint8Array>, apart: number): Solid[] {
  return project.drawn.flatMap(({ name, mesh: id }) => {
    const mesh = meshes.get(id);
    const colour = pieceColour(project.segment.pieces, name);
    if (!mesh) return [];
    const of = states.get(id);
    const shift = extentOf(mesh.positions).middle.map((value) => value * apart) as Vec3;
    return [{ name, mesh, colour, shift, ...(of ? { states: paletteOf(of) } : {}) }];
  });
}

// One value per array of states: the view makes a solid again when it is another.
const palettes = new WeakMap<Uint8Array, NonNullable<Solid["states"]>>();

function paletteOf(of: Uint8Array): NonNullable<Solid["states"]> {
  const kept = palettes.get(of) ?? { of, palette: STATES.map((state) => state.colour) };
  palettes.set(of, kept);
  return kept;
}

function Legend() {
  return (
    <ul class="legend" aria-label="Colours of the surface">
      {STATES.map(({ words, colour }) => (
        <li key={words}>
          <span class="patch" style={{ backgroundColor: colour }} aria-hidden="true" />
          {words}
        </li>
      ))}
    </ul>
  );
}
