// The tree of pieces: a piece that was cut holds those that it was cut into. Each has a row with its volume and what is out of
// reach of it; the one that is cut next is marked.

import type { Project, Segment } from "../../link/documents";
import { count, percent, volume } from "../../parts/words";
import { pieceColour } from "../../view/palette";

interface Props {
  project: Project;
  piece: string; // that is worked on
  off: boolean;
  onPiece: (name: string) => void;
  onDiscard: (name: string) => void;
}

export function PieceTree(props: Props) {
  const { segment } = props.project;
  const made = new Set(segment.cuts.flatMap((cut) => cut.pieces));
  const roots = [...segment.cuts.map((cut) => cut.piece), ...segment.pieces.map((one) => one.name)].filter(
    (name, i, all) => !made.has(name) && all.indexOf(name) === i,
  );
  return (
    <section class="tree" aria-labelledby="tree-title">
      <h2 id="tree-title">Pieces</h2>
      <ul>
        {roots.map((name) => (
          <Node key={name} name={name} {...props} />
        ))}
      </ul>
      {segment.fragments > 0 && <p>{count(segment.fragments)} fragments: solids too small to be pieces.</p>}
      {segment.discarded.length > 0 && <p>Discarded: {segment.discarded.map(nameOf).join(", ")}</p>}
    </section>
  );
}

const nameOf = (piece: { name: string } | string): string => (typeof piece === "string" ? piece : piece.name);

function Node({ name, ...props }: Props & { name: string }) {
  const { segment } = props.project;
  const cut = segment.cuts.find((one) => one.piece === name);
  if (cut === undefined) return <Leaf name={name} segment={segment} {...props} />;
  return (
    <li>
      <span class="parted">
        {name}, cut {cut.number}
      </span>
      <ul>
        {cut.pieces.map((child) => (
          <Node key={child} name={child} {...props} />
        ))}
      </ul>
    </li>
  );
}

function Leaf({ name, segment, piece, off, onPiece, onDiscard }: Props & { name: string; segment: Segment }) {
  const leaf = segment.pieces.find((one) => one.name === name);
  const colour = pieceColour(segment.pieces, name);
  if (leaf === undefined) return <li class="parted">{name}, discarded</li>;
  const isChosen = name === piece;
  return (
    <li>
      <button type="button" class="leaf" aria-pressed={isChosen} onClick={() => onPiece(name)}>
        <span class="patch" style={{ backgroundColor: colour }} aria-hidden="true" />
        <strong>{name}</strong> {volume(leaf.volume_mm3)}
        <small>
          {count(leaf.faces)} faces
          {leaf.unreachable_all_directions !== undefined && (
            <>
              <br />
              {percent(leaf.unreachable_all_directions)} out of reach from all directions
            </>
          )}
        </small>
      </button>
      {isChosen && segment.pieces.length > 1 && (
        <button type="button" class="quiet" disabled={off} onClick={() => onDiscard(name)}>
          Discard {name}
        </button>
      )}
    </li>
  );
}
