// Display meshes of the server, decoded and kept: they are immutable under their ids.

import { useEffect, useState } from "preact/hooks";
import { decodeMesh, decodeStates, type DisplayMesh } from "../geometry/display_mesh";
import { decodeWay, type ToolWay } from "../geometry/tool_way";
import { ApiError, getBytes } from "../link/api";
import { asApiError } from "../parts/error";

const KEPT = 128; // meshes; of one project there are at most as many as pieces that were ever shown

const kept = new Map<string, Promise<unknown>>();

function once<T>(key: string, make: () => Promise<T>): Promise<T> {
  let value = kept.get(key) as Promise<T> | undefined;
  if (value === undefined) {
    value = make();
    kept.set(key, value);
    value.catch(() => kept.delete(key));
    if (kept.size > KEPT) kept.delete(kept.keys().next().value!);
  }
  return value;
}

export const readMesh = (id: string): Promise<DisplayMesh> =>
  once(id, async () => decodeMesh(await getBytes(`/api/meshes/${id}`)));

export const readStates = (id: string, states: string, faces: number): Promise<Uint8Array> =>
  once(`${id}/${states}`, async () => decodeStates(await getBytes(`/api/meshes/${id}/states/${states}`), faces));

export const readWay = (id: string): Promise<ToolWay> => once(id, async () => decodeWay(await getBytes(`/api/paths/${id}`)));

// The meshes of these ids that are there by now, and the first error. The map is another one when a mesh has come.
export function useMeshes(ids: string[]): { meshes: Map<string, DisplayMesh>; error: ApiError | null } {
  const [meshes, setMeshes] = useState(new Map<string, DisplayMesh>());
  const [error, setError] = useState<ApiError | null>(null);
  const key = ids.join(" ");
  useEffect(() => {
    let gone = false;
    setError(null);
    const wanted = key === "" ? [] : key.split(" ");
    void Promise.allSettled(wanted.map(readMesh)).then((results) => {
      if (gone) return;
      const found = new Map<string, DisplayMesh>();
      results.forEach((result, i) => {
        if (result.status === "fulfilled") found.set(wanted[i]!, result.value);
        else setError(asApiError(result.reason));
      });
      setMeshes(found);
    });
    return () => {
      gone = true;
    };
  }, [key]);
  return { meshes, error };
}

// The states of the faces, by mesh. `ids`: of the states, by the mesh's id.
export function useStates(
  ids: Record<string, string>,
  meshes: Map<string, DisplayMesh>,
): { states: Map<string, Uint8Array>; error: ApiError | null } {
  const [states, setStates] = useState(new Map<string, Uint8Array>());
  const [error, setError] = useState<ApiError | null>(null);
  const key = JSON.stringify(ids);
  useEffect(() => {
    let gone = false;
    setError(null);
    const wanted = Object.entries(ids).filter(([mesh]) => meshes.has(mesh));
    const read = ([mesh, id]: [string, string]) => readStates(mesh, id, meshes.get(mesh)!.indices.length / 3);
    void Promise.allSettled(wanted.map(read)).then((results) => {
      if (gone) return;
      const found = new Map<string, Uint8Array>();
      results.forEach((result, i) => {
        if (result.status === "fulfilled") found.set(wanted[i]![0], result.value);
        else setError(asApiError(result.reason));
      });
      setStates(found);
    });
    return () => {
      gone = true;
    };
  }, [key, meshes]);
  return { states, error };
}
