// The view as a component: keeps the scene equal to its properties, and says in words what it shows. Where there is no WebGL 2
// it says so; the tables have the same choices.

import type { ComponentChildren } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import type { CutPlane } from "../geometry/plane";
import type { Vec3 } from "../link/documents";
import { wantsAntialias } from "../link/key";
import { useKey } from "../parts/keys";
import { loadThree } from "./load_three";
import { View3D, type Arrow, type Outline, type Picked, type Side } from "./scene";
import type { Solid } from "./solids";

interface Props {
  label: string; // what is shown, for those who do not see it
  solids: Solid[];
  plane?: CutPlane | null;
  around?: string | null; // the solid that the plane cuts
  handle?: "move" | "turn";
  hide?: Side;
  share?: number; // of before and after
  outline?: Outline | null;
  places?: Vec3[];
  arrows?: Arrow[];
  person?: boolean;
  middle?: number; // when it grows, a stroke of one point is painted in the middle of the view
  onMiddle?: (isPainted: boolean) => void;
  onPlane?: (plane: CutPlane, released: boolean) => void;
  onPick?: (picked: Picked | null) => void;
  onStroke?: ((picked: Picked, isFirst: boolean) => void) | null;
  children?: ComponentChildren;
}

const NONE: never[] = [];

export function View(props: Props) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const view = useRef<View3D | null>(null);
  const latest = useRef(props);
  latest.current = props;
  const [isReady, setReady] = useState(false);
  const [trouble, setTrouble] = useState("");

  useEffect(() => {
    let gone = false;
    loadThree()
      .then((three) => {
        if (gone || !canvas.current) return;
        view.current = new View3D(
          three,
          canvas.current,
          {
            onPlane: (plane, released) => latest.current.onPlane?.(plane, released),
            onPick: (picked) => latest.current.onPick?.(picked),
            get onStroke() {
              return latest.current.onStroke ?? null;
            },
            onDrawn: () => undefined,
            onLost: () => setTrouble("The browser has ended the 3D view. Read the page again to have it back."),
          },
          wantsAntialias(),
        );
        setReady(true);
      })
      .catch(() => setTrouble("This browser gives no 3D view: WebGL 2 is missing or switched off."));
    return () => {
      gone = true;
      view.current?.dispose();
      view.current = null;
    };
  }, []);

  const { solids, plane = null, around = null, handle = "move", hide = "none", share, outline = null } = props;
  const { places = NONE, arrows = NONE, person = false } = props;
  useEffect(() => view.current?.setSolids(solids), [isReady, solids]);
  useEffect(() => view.current?.setExtras(outline, places, arrows, person), [isReady, outline, places, arrows, person, solids]);
  // The person comes and goes: what is there is fitted again, and never else.
  const isFull = person && solids.length > 0;
  useEffect(() => view.current?.fit(), [isReady, isFull]);
  useEffect(() => view.current?.setPlane(plane, around), [isReady, plane, around, solids]);
  useEffect(() => view.current?.setHandle(handle), [isReady, handle]);
  useEffect(() => view.current?.hideSide(plane, hide), [isReady, plane, hide, solids]);
  useEffect(() => {
    if (share !== undefined) view.current?.part(share);
  }, [isReady, share, solids]);
  const { middle = 0 } = props;
  useEffect(() => {
    if (middle > 0) props.onMiddle?.(view.current?.strokeMiddle() ?? false);
  }, [middle]);
  useViewKeys(view);

  return (
    <div class="view">
      <div class={props.onStroke ? "picture aim" : "picture"}>
        <canvas ref={canvas} role="img" aria-label={props.label} tabIndex={0} hidden={trouble !== ""} />
        {trouble !== "" && (
          <p class="wait" role="status">
            {trouble} The tables beside it have the same choices.
          </p>
        )}
      </div>
      <div class="row tools">
        <button type="button" onClick={() => view.current?.fit()}>
          Fit
        </button>
        <button type="button" onClick={() => view.current?.view("front")}>
          Front
        </button>
        <button type="button" onClick={() => view.current?.view("side")}>
          Side
        </button>
        <button type="button" onClick={() => view.current?.view("top")}>
          Top
        </button>
        {props.children}
      </div>
    </div>
  );
}

function useViewKeys(view: { current: View3D | null }): void {
  useKey("fit", () => view.current?.fit());
  useKey("front", () => view.current?.view("front"));
  useKey("side", () => view.current?.view("side"));
  useKey("top", () => view.current?.view("top"));
  useKey("turn left", () => view.current?.turn(1, 0));
  useKey("turn right", () => view.current?.turn(-1, 0));
  useKey("turn up", () => view.current?.turn(0, 1));
  useKey("turn down", () => view.current?.turn(0, -1));
  useKey("zoom in", () => view.current?.zoom(1 / 1.15));
  useKey("zoom out", () => view.current?.zoom(1.15));
}
