// The plane in the view, with the handle that moves it along its normal or turns it.

import { dot, scaled, type CutPlane } from "../geometry/plane";
import type { Vec3 } from "../link/documents";
import type { Three } from "./load_three";

type Camera = InstanceType<Three["PerspectiveCamera"]>;
type Scene = InstanceType<Three["Scene"]>;

const PLACE = 0.01; // mm: a dragged plane comes to rest on such places

export class PlaneHandle {
  private readonly body;
  private readonly controls;
  private readonly helper;
  private isDragging = false;
  private centre: Vec3 = [0, 0, 0];

  constructor(
    three: Three,
    private readonly scene: Scene,
    camera: Camera,
    canvas: HTMLCanvasElement,
    onChange: () => void,
    onDrag: (dragging: boolean) => void,
    private readonly onPlane: (plane: CutPlane, released: boolean) => void,
  ) {
    this.body = new three.Group();
    this.body.name = "plane";
    const square = new three.PlaneGeometry(1, 1);
    const fill = new three.MeshBasicMaterial({
      color: "#1f5fa8",
      opacity: 0.16,
      transparent: true,
      side: three.DoubleSide,
      depthWrite: false,
    });
    const edge = new three.LineSegments(new three.EdgesGeometry(square), new three.LineBasicMaterial({ color: "#1f5fa8" }));
    this.body.add(new three.Mesh(square, fill), edge);
    this.controls = new three.TransformControls(camera, canvas);
    this.controls.setSpace("local");
    this.controls.setSize(1.1);
    this.controls.attach(this.body);
    this.helper = this.controls.getHelper();
    this.controls.addEventListener("change", onChange);
    this.controls.addEventListener("dragging-changed", (event) => {
      this.isDragging = event.value === true;
      onDrag(this.isDragging);
      if (!this.isDragging) this.onPlane(this.read(), true);
    });
    this.controls.addEventListener("objectChange", () => this.onPlane(this.read(), false));
    this.setMode("move");
    this.show(null);
  }

  // Whether the pointer is on the handle: a click there picks nothing.
  get isHeld(): boolean {
    return this.isDragging || this.controls.axis !== null;
  }

  setMode(mode: "move" | "turn"): void {
    const turns = mode === "turn";
    this.controls.setMode(turns ? "rotate" : "translate");
    this.controls.showX = turns;
    this.controls.showY = turns;
    this.controls.showZ = !turns;
  }

  // The square is laid around the point of the plane that is nearest to `centre`.
  frame(centre: Vec3, size: number): void {
    this.centre = centre;
    this.body.scale.set(size, size, 1);
  }

  show(plane: CutPlane | null): void {
    if (this.isDragging) return;
    this.scene.remove(this.body, this.helper);
    this.controls.enabled = plane !== null;
    if (plane === null) return;
    this.scene.add(this.body, this.helper);
    const rise = plane.offset - dot(plane.normal, this.centre);
    const at = this.centre.map((value, i) => value + rise * plane.normal[i]!) as Vec3;
    this.body.position.set(...at);
    this.body.up.set(0, 0, 1);
    const [x, y, z] = plane.normal;
    this.body.quaternion.setFromUnitVectors(this.body.up.clone(), this.body.up.clone().set(x, y, z));
    this.body.updateMatrixWorld();
  }

  dispose(): void {
    this.scene.remove(this.body, this.helper);
    this.controls.dispose();
  }

  private read(): CutPlane {
    const axis = this.body.up.clone().set(0, 0, 1).applyQuaternion(this.body.quaternion);
    const raw: Vec3 = [axis.x, axis.y, axis.z];
    const normal = scaled(raw, 1 / Math.sqrt(dot(raw, raw)));
    const { x, y, z } = this.body.position;
    return { normal, offset: Math.round(dot(normal, [x, y, z]) / PLACE) * PLACE };
  }
}
