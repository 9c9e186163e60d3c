// Pieces: apart by a slider, and of the chosen one block, tool orientations, margins and all bases with their figures.

import { useEffect, useMemo, useState } from "preact/hooks";
import { select, type Address } from "../address";
import { askWhole } from "../link/api";
import type { Project, Reach, Setup, SetupDocument, Vec3 } from "../link/documents";
import { currentWork } from "../link/state";
import { useProject, useStore } from "../link/store";
import { useAsking } from "../parts/asking";
import { ErrorBox, sentence } from "../parts/error";
import { decide } from "../parts/header";
import { Signed } from "../parts/signed";
import { count, length, number, percent, sides, volume, words } from "../parts/words";
import { STATES, type DisplayMesh } from "../geometry/display_mesh";
import { useMeshes, useStates } from "../view/meshes";
import { ViewNote } from "../view/note";
import { pieceColour } from "../view/palette";
import type { Solid } from "../view/solids";
import { View } from "../view/view";

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
  const chosen = address.selection["piece"] ?? project.pieces[0]?.name ?? "";
  const off = stale || (state?.read_only ?? true) || (state ? currentWork(state) !== null : true);
  const { meshes, error } = useMeshes(project.pieces.map((one) => one.mesh));
  const [byState, setByState] = useState(false);
  const [laid, setLaid] = useState<Laid>({}); // by piece: what was asked
  useEffect(() => setLaid({}), [project.revision]);
  const { states, error: stateError } = useStates(byState ? stateIds(project, laid) : NO_STATES, meshes);
  const solids = useMemo(() => exploded(project, meshes, states, apart), [project, meshes, states, apart]);
  return (
    <main class="pieces">
      <h1 class="unseen">Pieces of {project.name}</h1>
      <div class="left">
        <PieceList project={project} chosen={chosen} />
      </div>
      <div class="middle">
        <View label={`${project.pieces.length} pieces of ${project.name}, apart`} solids={solids} onPick={(picked) => picked && select({ piece: picked.name })}>
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
        <Prepared project={project} piece={chosen} />
        <Bases
          key={`${chosen} ${project.revision}`}
          project={project}
          piece={chosen}
          off={off}
          found={laid[chosen]?.setups ?? null}
          onFound={(found) => setLaid((old) => ({ ...old, [chosen]: found }))}
        />
      </div>
    </main>
  );
}

function PieceList({ project, chosen }: { project: Project; chosen: string }) {
  return (
    <section>
      <h2>Pieces</h2>
      <ul class="plain">
        {project.segment.pieces.map((piece) => {
          const made = project.prepare?.pieces.find((one) => one.name === piece.name);
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
                    `${count(piece.faces)} faces`
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

function Prepared({ project, piece }: { project: Project; piece: string }) {
  const made = project.prepare?.pieces.find((one) => one.name === piece);
  if (!made) return null;
  return (
    <>
      <table>
        <caption>As prepared</caption>
        <tbody>
          <Row name="Base" value={made.base_description} />
          <Row name="Block" value={made.block === null ? "none is large enough" : `${made.block}, ${sides(made.block_mm)}`} />
          <Row name="Box of the piece" value={sides(made.box_mm)} />
          {made.reach && <Row name="Out of reach" value={percent(made.reach.unreachable_share)} />}
          {made.reach && <Row name="Hidden" value={`${count(Math.round(made.reach.hidden_mm2))} mm2`} />}
          {made.reach && <Row name="Steep" value={`${count(Math.round(made.reach.steep_mm2))} mm2`} />}
          {made.reach && <Row name="Too narrow" value={`${count(Math.round(made.reach.too_narrow_mm2))} mm2`} />}
          {made.reach && <Row name="Because of the holder" value={`${count(Math.round(made.reach.holder_mm2))} mm2`} />}
        </tbody>
      </table>
      {made.reach && <Orientations reach={made.reach} />}
      <details>
        <summary>Margins</summary>
        <table>
          <caption class="unseen">Margins</caption>
          <tbody>
            {Object.entries(made.margins_mm).map(([name, value]) => (
              <Row key={name} name={name} value={length(value)} />
            ))}
          </tbody>
        </table>
      </details>
    </>
  );
}

function Orientations({ reach }: { reach: Reach }) {
  return (
    <table>
      <caption>Tool orientations</caption>
      <thead>
        <tr>
          <th scope="col">Number</th>
          <th scope="col" class="figure">
            Tilt
          </th>
          <th scope="col" class="figure">
            Surface gained
          </th>
          <th scope="col" class="figure">
            Depth
          </th>
        </tr>
      </thead>
      <tbody>
        {reach.orientations.map((one, i) => (
          <tr key={i}>
            <th scope="row">{i + 1}</th>
            <td class="figure">{number(one.tilt_deg, 0)} degrees</td>
            <td class="figure">{percent(one.gained_share)}</td>
            <td class="figure">{length(one.depth_mm)}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

const Row = ({ name, value }: { name: string; value: string }) => (
  <tr>
    <th scope="row">{name}</th>
    <td>{value}</td>
  </tr>
);

// What the engine said of a piece: all its bases, the one in force first, and the id of the states of its surface by that.
type Laid = Record<string, { setups: Setup[]; states: string | null }>;

const NO_STATES: Record<string, string> = {};

// By the id of the mesh.
const stateIds = (project: Project, laid: Laid): Record<string, string> =>
  Object.fromEntries(
    project.pieces.flatMap((piece) => {
      const states = laid[piece.name]?.states;
      return states ? [[piece.mesh, states]] : [];
    }),
  );

interface BasesProps {
  project: Project;
  piece: string;
  off: boolean;
  found: Setup[] | null;
  onFound: (found: Laid[string]) => void;
}

// All bases are asked for: computing them takes the engine a while.
function Bases({ project, piece, off, found, onFound }: BasesProps) {
  const [done, setDone] = useState("");
  const asking = useAsking();
  const compare = () =>
    asking.run(async () => {
      const answer = await askWhole<{ document: SetupDocument; states?: string }>(project.id, "setups", { piece });
      const setups = answer.document.pieces.find((one) => one.name === piece)?.setups ?? [];
      onFound({ setups, states: answer.states ?? null });
    });
  const order = (setup: object) => asking.run(async () => setDone(await decide(project, { setup: { piece, ...setup } })));
  return (
    <section>
      <h2>Bases</h2>
      <p class="row">
        <button type="button" disabled={off || asking.busy} onClick={compare}>
          Compare all bases
        </button>
        <button type="button" disabled={off || asking.busy} onClick={() => order({ automatic: true })}>
          Automatic again
        </button>
      </p>
      <p role="status">{sentence(done)}</p>
      <ErrorBox error={asking.error} actions={{ try_again: asking.again, show: asking.clear }} onClose={asking.clear} />
      {found?.[0]?.reach && !project.prepare && <Orientations reach={found[0].reach} />}
      {found && (
        <table>
          <caption class="unseen">Bases of piece {piece}</caption>
          <thead>
            <tr>
              <th scope="col">Base</th>
              <th scope="col">Block</th>
              <th scope="col" class="figure">
                Out of reach
              </th>
              <th scope="col" class="figure">
                Orientations
              </th>
              <th scope="col">Fits</th>
              <th scope="col">
                <span class="unseen">Choose</span>
              </th>
            </tr>
          </thead>
          <tbody>
            {found.map((setup) => (
              <tr key={setup.base_number}>
                <th scope="row">{words(setup.base_description)}</th>
                <td>{setup.block ?? "none"}</td>
                <td class="figure">{setup.reach ? percent(setup.reach.unreachable_share) : "not known"}</td>
                <td class="figure">{setup.reach?.orientations.length ?? 0}</td>
                <td>
                  <Signed state={setup.fits ? "ready" : "failed"} word={setup.fits ? "fits" : "does not fit"} />
                </td>
                <td>
                  <button
                    type="button"
                    disabled={off || asking.busy}
                    aria-label={`Choose ${setup.base_description}`}
                    onClick={() => order({ base: setup.base_number })}
                  >
                    Choose
                  </button>
                </td>
              </tr>
            ))}
          </tbody>
        </table>
      )}
    </section>
  );
}

// Each piece is moved away from the middle of all by its share.
function exploded(project: Project, meshes: Map<string, DisplayMesh>, states: Map<string, Uint8Array>, apart: number): Solid[] {
  return project.pieces.flatMap(({ name, mesh: id }) => {
    const mesh = meshes.get(id);
    const colour = pieceColour(project.segment.pieces, name);
    if (!mesh) return [];
    const of = states.get(id);
    const shift = middleOf(mesh.positions).map((value) => value * apart) as Vec3;
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

// Of the box; the scan's centre is the origin.
function middleOf(positions: Float32Array): Vec3 {
  return [0, 1, 2].map((axis) => {
    let low = Infinity;
    let high = -Infinity;
    for (let i = axis; i < positions.length; i += 3) {
      low = Math.min(low, positions[i]!);
      high = Math.max(high, positions[i]!);
    }
    return low > high ? 0 : (low + high) / 2;
  }) as Vec3;
}
