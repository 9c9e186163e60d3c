// Faults of the scan by kind, with a count; Show marks their places in the view.

import type { Check, Inspect, Vec3 } from "../../link/documents";
import { count, words } from "../../parts/words";

const KINDS = [
  "inside_out",
  "open_edges",
  "non_manifold_edges",
  "touching_edges",
  "inconsistent_edges",
  "non_manifold_vertices",
  "repeated_faces",
  "collapsed_faces",
  "faces_without_area",
  "faces_without_corners",
  "unreferenced_vertices",
] as const;

// In the units of the file.
export const placesOf = (check: Check, kind: string): Vec3[] =>
  check.inspect.places?.find((place) => place.kind === kind)?.points ?? [];

export function faultsOf(inspect: Inspect): { kind: string; count: number }[] {
  const listed = KINDS.map((kind) => ({ kind: kind as string, count: Number(inspect[kind] ?? 0) }));
  const crossing = inspect["self_intersections"];
  const pairs = typeof crossing === "object" && crossing !== null ? Number((crossing as { pairs?: number }).pairs ?? 0) : 0;
  const open = inspect["open_components"] as { count: number } | undefined;
  const fragments = inspect["fragments"] as { count: number } | undefined;
  return [
    { kind: "holes", count: inspect.holes.length },
    { kind: "open_components", count: open?.count ?? 0 },
    { kind: "fragments", count: fragments?.count ?? 0 },
    ...listed,
    { kind: "self_intersections", count: pairs },
  ].filter((fault) => fault.count > 0);
}

interface Props {
  check: Check;
  shown: string;
  onShow: (kind: string) => void;
}

export function FaultTable({ check, shown, onShow }: Props) {
  const faults = faultsOf(check.inspect);
  if (faults.length === 0) return <p>No fault was found.</p>;
  return (
    <table>
      <caption>Faults by kind</caption>
      <thead>
        <tr>
          <th scope="col">Kind</th>
          <th scope="col" class="figure">
            Count
          </th>
          <th scope="col">
            <span class="unseen">Places</span>
          </th>
        </tr>
      </thead>
      <tbody>
        {faults.map(({ kind, count: n }) => {
          const places = placesOf(check, kind).length;
          return (
            <tr key={kind}>
              <th scope="row">{words(kind)}</th>
              <td class="figure">{count(n)}</td>
              <td>
                {places > 0 ? (
                  <button
                    type="button"
                    aria-pressed={shown === kind}
                    aria-label={`Show ${words(kind)}`}
                    onClick={() => onShow(shown === kind ? "" : kind)}
                  >
                    Show {places < n ? `the first ${places}` : ""}
                  </button>
                ) : (
                  "no places"
                )}
              </td>
            </tr>
          );
        })}
      </tbody>
    </table>
  );
}
