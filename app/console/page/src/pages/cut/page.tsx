// Cut: the piece that is cut next, the planes that the engine proposes, a plane of one's own, and the decisions so far.

import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import { select, type Address } from "../../address";
import { flipped, isSame, moved, parsePlane, planeOf, planeText, asNumbers, type CutPlane } from "../../geometry/plane";
import { areSame, ranked } from "../../geometry/ranking";
import { post } from "../../link/api";
import type { Project, Terms } from "../../link/documents";
import { currentWork } from "../../link/state";
import { current, useProject, useStore } from "../../link/store";
import { useAsking } from "../../parts/asking";
import { ErrorBox, sentence } from "../../parts/error";
import { decide } from "../../parts/header";
import { useKey } from "../../parts/keys";
import { useMeshes } from "../../view/meshes";
import type { Solid } from "../../view/solids";
import { View } from "../../view/view";
import { ViewNote } from "../../view/note";
import { pieceColour } from "../../view/palette";
import { NewWithCuts } from "./again";
import { Decisions } from "./decisions";
import { nextSide, PlaneEditor, type EditorState } from "./plane_editor";
import { PlaneTable } from "./planes";
import { usePreview } from "./preview";
import { useRanking } from "./ranking";
import { PieceTree } from "./tree";
import { TriedBySetups } from "./tried";
import { WeightTable } from "./weights";

export function CutPage({ address, stale }: { address: Address; stale: boolean }) {
  const { project, error, retry } = useProject(address.id);
  if (project === null)
    return (
      <main>
        <h1>Cut</h1>
        {error === null && <p role="status">The project is being read.</p>}
        <ErrorBox error={error} actions={{ try_again: retry }} />
      </main>
    );
  return <Cutting project={project} address={address} stale={stale} />;
}

function Cutting({ project, address, stale }: { project: Project; address: Address; stale: boolean }) {
  const { state } = useStore();
  const kept = project.segment.weights;
  const [weights, setWeights] = useState<Terms>(kept);
  const [editor, setEditor] = useState<EditorState>({ step: 1, hide: "none", handle: "move" });
  const [dragged, setDragged] = useState<CutPlane | null>(null);
  const [done, setDone] = useState("");
  const asking = useAsking();
  useEffect(() => setWeights(kept), [JSON.stringify(kept)]);

  const work = state ? currentWork(state) : null;
  const isBusy = stale || work !== null;
  const wanted = address.selection["piece"] ?? "";
  const named = project.segment.pieces.some((one) => one.name === wanted) ? wanted : "";
  const ranking = useRanking(project, named, weights, isBusy);
  const proposal = ranking.segment?.proposal;
  const piece = named !== "" ? named : (proposal?.piece ?? "");
  const planes = useMemo(
    () => ranked(proposal?.planes ?? [], weights, ranking.weights),
    [proposal, weights, ranking.weights],
  );
  const first = planes[0];
  // A plane of one's own stands in the address with its piece, and goes when another window has cut that piece.
  const planeInAddress = named === "" ? "" : (address.selection["plane"] ?? "");
  const chosen = useMemo(() => parsePlane(planeInAddress), [planeInAddress]);
  const best = useMemo(() => (first ? planeOf(first.plane) : null), [first?.plane]);
  const plane = dragged ?? chosen ?? best;

  const { meshes, error: meshError } = useMeshes(project.drawn.map((one) => one.mesh));
  const solids = useMemo(() => solidsOf(project, meshes, piece), [project, meshes, piece]);
  const mesh = solids.find((solid) => solid.name === piece)?.mesh ?? null;
  const shown = piece === "" ? null : plane;
  const preview = usePreview(project, piece, shown, dragged !== null, isBusy, mesh);

  // The newest one, also before it is drawn: a key that is held down moves it several times in between.
  const newest = useRef(plane);
  newest.current = plane;
  const setPlane = (next: CutPlane) => {
    newest.current = next;
    setDragged(null);
    select({ piece, plane: planeText(next) });
  };
  const place = plane === null ? -1 : planes.findIndex((row) => isSame(planeOf(row.plane), plane));
  const isTried = !areSame(kept, weights);
  const off = isBusy || asking.busy || (state?.read_only ?? true);

  const accept = () =>
    asking.run(async () => {
      if (plane === null) return;
      // The weights first: the place in the ranking is that by them.
      let now: Pick<Project, "id" | "revision"> = project;
      if (isTried && place >= 0) {
        await decide(now, { weights });
        now = current().projects.get(project.id) ?? now;
      }
      const k = place >= 0 ? (planes[place]!.plane.k ?? place + 1) : undefined;
      const cut = { piece, plane: asNumbers(plane), ...(k === undefined ? {} : { k }) };
      setDone(await decide(now, { cut }));
      select({ piece: "", plane: "" });
    });
  const keep = () => asking.run(async () => setDone(await decide(project, { weights })));
  const discard = (name: string) =>
    asking.run(async () => {
      setDone(await decide(project, { discard: { pieces: [name] } }));
      select({ piece: "", plane: "" });
    });
  const search = () =>
    asking.run(async () => void (await post(`/api/projects/${project.id}/work`, { kind: "search" }, project.revision)));

  const change = (how: (plane: CutPlane) => CutPlane) => newest.current && setPlane(how(newest.current));
  useKey("plane back", () => change((one) => moved(one, -editor.step)));
  useKey("plane on", () => change((one) => moved(one, editor.step)));
  useKey("flip", () => change(flipped));
  useKey("hide", () => setEditor({ ...editor, hide: nextSide(editor.hide) }));

  const isProvisional = place >= 0 && !ranking.isExact;
  return (
    <main class="cut">
      <h1 class="unseen">Cut {project.name}</h1>
      <div class="left">
        <PieceTree project={project} piece={piece} off={off} onPiece={(name) => select({ piece: name, plane: "" })} onDiscard={discard} />
        <Decisions project={project} off={off} onBack={(n) => asking.run(async () => setDone(await decide(project, { back_to: n })))} />
        <NewWithCuts project={project} off={off} />
      </div>
      <div class="middle">
        <View
          label={viewLabel(project, piece, shown !== null, preview.outline?.isProvisional ?? false)}
          solids={solids}
          plane={shown}
          around={piece}
          handle={editor.handle}
          hide={editor.hide}
          outline={preview.outline}
          onPlane={(next, released) => (released ? setPlane(next) : setDragged(next))}
          onPick={(picked) => picked && select({ piece: picked.name, plane: "" })}
        />
        <ViewNote project={project} />
        <ErrorBox error={meshError} />
      </div>
      <div class="right">
        <p role="status" class="done">
          {sentence(done)}
        </p>
        <ErrorBox
          error={asking.error}
          actions={{ try_again: asking.again, show: asking.clear, read_again: asking.clear, search }}
          onClose={asking.clear}
        />
        <h2>{piece === "" ? "Planes" : `Planes for piece ${piece}`}</h2>
        <Reason project={project} isWorking={work !== null} hasProposal={proposal !== undefined} notes={ranking.segment?.notes ?? []} />
        <ErrorBox error={ranking.error} actions={{ try_again: ranking.again }} />
        {proposal && (
          <PlaneTable
            planes={planes}
            weights={weights}
            isExact={ranking.isExact}
            plane={plane}
            candidates={proposal.candidates}
            onPlane={setPlane}
          />
        )}
        <div class="row">
          <button type="button" class="main" disabled={off || plane === null || piece === "" || isProvisional} onClick={accept}>
            {place >= 0 ? `Accept plane ${place + 1}` : "Accept this plane"}
          </button>
          <button type="button" disabled={off} onClick={search}>
            Search on
          </button>
          {isProvisional && <span class="note">Accept waits for the exact order.</span>}
        </div>
        {plane !== null && piece !== "" && (
          <PlaneEditor plane={plane} preview={preview.preview} notes={preview.notes} editor={editor} onPlane={setPlane} onEditor={setEditor} />
        )}
        {preview.preview !== null && shown !== null && <TriedBySetups project={project} piece={piece} plane={shown} off={off} />}
        <ErrorBox error={preview.error} actions={{ try_again: preview.again }} />
        <WeightTable kept={kept} weights={weights} off={off} onWeights={setWeights} onKeep={keep} />
        {project.segment.warnings.map((warning) => (
          <p key={warning} class="state warn">
            <span aria-hidden="true">⚠ </span>
            {warning}
          </p>
        ))}
      </div>
    </main>
  );
}

function Reason(props: { project: Project; isWorking: boolean; hasProposal: boolean; notes: string[] }) {
  const { project, isWorking, hasProposal, notes } = props;
  if (hasProposal) return null;
  if (isWorking) return <p role="status">The planes come when the work is over.</p>;
  if (notes.length > 0) return <p role="status">{notes.map(sentence).join(" ")}</p>;
  if (project.stage !== "cutting")
    return (
      <p role="status">
        The search has ended{project.segment.ended_because ? `: ${project.segment.ended_because}` : ""}. Choose a piece to cut it further.
      </p>
    );
  return <p role="status">The engine evaluates planes.</p>;
}

function solidsOf(project: Project, meshes: Map<string, Solid["mesh"]>, piece: string): Solid[] {
  return project.drawn.flatMap(({ name, mesh: id }) => {
    const mesh = meshes.get(id);
    const colour = pieceColour(project.segment.pieces, name);
    return mesh ? [{ name, mesh, colour, dim: piece !== "" && name !== piece }] : [];
  });
}

function viewLabel(project: Project, piece: string, hasPlane: boolean, isProvisional: boolean): string {
  const what = `${project.segment.pieces.length} pieces of ${project.name}`;
  if (!hasPlane) return what;
  return `${what}; piece ${piece} with the plane and its ${isProvisional ? "provisional " : ""}outline`;
}

