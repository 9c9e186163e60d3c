// The 3D view: pieces, plane, outline. It draws when something has changed and never by itself; nothing in it is animated.
// All figures come from the engine; what is seen here is the display mesh.

import type { CutPlane } from "../geometry/plane";
import type { Vec3 } from "../link/documents";
import type { Three } from "./load_three";
import { PlaneHandle } from "./plane_handle";
import { makeArrow, makePerson, makeSolid, type Solid, type SolidMesh } from "./solids";

export interface Picked {
  name: string; // of the solid
  face: number; // of its display mesh
  point: Vec3;
  normal: Vec3;
}

export interface Arrow {
  direction: Vec3;
  from: Vec3; // the tail
  length: number; // mm
  colour: string;
  rings: number; // around the shaft: a sign beside the colour
  isAway?: boolean; // it need not be in a view that is fitted
}

export interface Outline {
  segments: Float32Array; // six numbers each
  isProvisional: boolean; // drawn dashed
}

export type Side = "none" | "above" | "below";

export interface ViewEvents {
  onPlane: (plane: CutPlane, released: boolean) => void;
  onPick: (picked: Picked | null) => void;
  onStroke: ((picked: Picked, isFirst: boolean) => void) | null; // set: a drag on the surface paints
  onDrawn: () => void;
  onLost: () => void;
}

const FIELD_DEG = 32;
const TURN = Math.PI / 18;
const CLICK_PX = 4;

export class View3D {
  private readonly scene;
  private readonly camera;
  private readonly renderer;
  private readonly orbit;
  private readonly light;
  private readonly extras; // outline, person, places, arrows: made again when they change
  private readonly handle: PlaneHandle;
  private readonly watch: ResizeObserver;
  private meshes = new Map<string, { solid: Solid; object: SolidMesh }>();
  private queued = false;
  private hasFitted = false;
  private extent = { centre: [0, 0, 0] as Vec3, radius: 100 };
  frames = 0;

  // Throws Error where the browser gives no WebGL 2.
  constructor(
    private readonly three: Three,
    private readonly canvas: HTMLCanvasElement,
    private readonly events: ViewEvents,
    antialias: boolean,
  ) {
    this.renderer = new three.WebGLRenderer({ canvas, antialias });
    this.renderer.localClippingEnabled = true;
    this.renderer.setPixelRatio(antialias ? Math.min(devicePixelRatio, 2) : 1);
    this.scene = new three.Scene();
    this.scene.background = new three.Color("#eef1f4");
    this.camera = new three.PerspectiveCamera(FIELD_DEG, 1, 1, 10_000);
    this.camera.up.set(0, 0, 1);
    this.scene.add(new three.HemisphereLight("#ffffff", "#8a8f98", 1.6), this.camera);
    this.light = new three.DirectionalLight("#ffffff", 1.8);
    this.light.position.set(0.4, 0.6, 1);
    this.camera.add(this.light, this.light.target);
    this.extras = new three.Group();
    this.scene.add(this.extras);
    this.orbit = new three.OrbitControls(this.camera, canvas);
    this.orbit.enableDamping = false;
    this.orbit.zoomToCursor = true;
    this.orbit.addEventListener("change", () => this.draw());
    this.handle = new PlaneHandle(
      three,
      this.scene,
      this.camera,
      canvas,
      () => this.draw(),
      (dragging) => (this.orbit.enabled = !dragging),
      (plane, released) => this.events.onPlane(plane, released),
    );
    this.listen();
    this.watch = new ResizeObserver(() => this.resize());
    this.watch.observe(canvas.parentElement!);
    this.resize();
  }

  dispose(): void {
    this.watch.disconnect();
    this.handle.dispose();
    this.orbit.dispose();
    for (const { object } of this.meshes.values()) this.drop(object);
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }

  setSolids(solids: Solid[]): void {
    const names = new Set(solids.map((solid) => solid.name));
    for (const [name, { object }] of this.meshes)
      if (!names.has(name)) {
        this.drop(object);
        this.meshes.delete(name);
      }
    for (const solid of solids) this.setSolid(solid);
    this.measure();
    if (!this.hasFitted && solids.length > 0) this.look([-0.6, -1, 0.45]);
    this.hasFitted ||= solids.length > 0;
    this.canvas.dataset["solids"] = String(solids.length);
    this.canvas.dataset["faces"] = String(solids.reduce((sum, solid) => sum + solid.mesh.indices.length / 3, 0));
    this.draw();
  }

  private setSolid(solid: Solid): void {
    const old = this.meshes.get(solid.name);
    const isSame =
      old !== undefined &&
      old.solid.mesh === solid.mesh &&
      old.solid.colour === solid.colour &&
      old.solid.states === solid.states;
    if (old && !isSame) this.drop(old.object);
    const object = isSame ? old.object : makeSolid(this.three, solid);
    if (!isSame) this.scene.add(object);
    object.position.set(...(solid.shift ?? [0, 0, 0]));
    object.material.transparent = solid.dim === true;
    object.material.opacity = solid.dim === true ? 0.22 : 1;
    object.material.depthWrite = solid.dim !== true;
    object.material.needsUpdate = true;
    this.meshes.set(solid.name, { solid, object });
  }

  // Hides a side of the plane of the solids that are not dim.
  hideSide(plane: CutPlane | null, side: Side): void {
    const clip: InstanceType<Three["Plane"]>[] = [];
    if (plane !== null && side !== "none") {
      const sign = side === "above" ? -1 : 1;
      const normal = new this.three.Vector3(...plane.normal).multiplyScalar(sign);
      clip.push(new this.three.Plane(normal, -sign * plane.offset));
    }
    for (const { solid, object } of this.meshes.values()) object.material.clippingPlanes = solid.dim ? [] : clip;
    this.draw();
  }

  // Before and after, parted by a plane x = at through the extent; `share` 0 shows all of the right one.
  part(share: number): void {
    const x = this.extent.centre[0] + (2 * share - 1) * this.extent.radius;
    for (const { solid, object } of this.meshes.values()) {
      if (solid.clip === undefined) continue;
      const sign = solid.clip === "left" ? -1 : 1;
      object.material.clippingPlanes = [new this.three.Plane(new this.three.Vector3(sign, 0, 0), -sign * x)];
    }
    this.draw();
  }

  setPlane(plane: CutPlane | null, around: string | null): void {
    const box = this.boxOf(around);
    this.handle.frame(box.centre, 1.7 * box.radius);
    this.handle.show(plane);
    this.draw();
  }

  setHandle(mode: "move" | "turn"): void {
    this.handle.setMode(mode);
    this.draw();
  }

  setExtras(outline: Outline | null, places: Vec3[], arrows: Arrow[], hasPerson: boolean): void {
    const { three } = this;
    this.extras.clear();
    if (outline && outline.segments.length > 0) this.extras.add(this.linesOf(outline));
    if (places.length > 0) {
      const geometry = new three.BufferGeometry();
      geometry.setAttribute("position", new three.BufferAttribute(Float32Array.from(places.flat()), 3));
      const material = new three.PointsMaterial({ color: "#b3261e", size: 9, sizeAttenuation: false, depthTest: false });
      this.extras.add(new three.Points(geometry, material));
    }
    for (const arrow of arrows)
      this.extras.add(makeArrow(three, arrow));
    this.canvas.dataset["arrows"] = String(arrows.length);
    this.measure();
    for (const { from, isAway } of arrows) {
      if (isAway) continue;
      const away = from.map((value, axis) => value - this.extent.centre[axis]!);
      this.extent.radius = Math.max(this.extent.radius, Math.hypot(...away));
    }
    if (hasPerson) this.extras.add(this.personBeside());
    this.draw();
  }

  fit(): void {
    const direction = this.camera.position.clone().sub(this.orbit.target);
    this.look([direction.x, direction.y, direction.z]);
  }

  // From the front (-y), the side (+x), the top (+z).
  view(from: "front" | "side" | "top"): void {
    this.look({ front: [0, -1, 0], side: [1, 0, 0], top: [0, -1e-4, 1] }[from] as Vec3);
  }

  turn(left: number, up: number): void {
    const { three } = this;
    const arm = this.camera.position.clone().sub(this.orbit.target);
    const radius = arm.length();
    const height = Math.max(0.01, Math.min(Math.PI - 0.01, Math.acos(arm.z / radius) - up * TURN));
    const around = Math.atan2(arm.y, arm.x) - left * TURN;
    arm.copy(new three.Vector3(Math.sin(height) * Math.cos(around), Math.sin(height) * Math.sin(around), Math.cos(height)));
    this.camera.position.copy(this.orbit.target).addScaledVector(arm, radius);
    this.orbit.update();
    this.draw();
  }

  zoom(factor: number): void {
    const arm = this.camera.position.clone().sub(this.orbit.target).multiplyScalar(factor);
    this.camera.position.copy(this.orbit.target).add(arm);
    this.orbit.update();
    this.draw();
  }

  draw(): void {
    if (this.queued) return;
    this.queued = true;
    requestAnimationFrame(() => {
      this.queued = false;
      this.renderer.render(this.scene, this.camera);
      this.canvas.dataset["frames"] = String(++this.frames);
      this.events.onDrawn();
    });
  }

  private look(direction: Vec3): void {
    const { centre, radius } = this.extent;
    const target = new this.three.Vector3(...centre);
    const field = (Math.PI / 180) * FIELD_DEG;
    const narrow = Math.min(1, this.camera.aspect);
    const distance = (1.08 * radius) / Math.sin(Math.atan(Math.tan(field / 2) * narrow));
    this.orbit.target.copy(target);
    this.camera.position.copy(new this.three.Vector3(...direction).normalize().multiplyScalar(distance).add(target));
    this.orbit.update();
    this.draw();
  }

  private measure(): void {
    this.extent = this.boxOf(null);
    const { radius } = this.extent;
    this.camera.near = radius / 100;
    this.camera.far = radius * 60 + 20_000;
    this.camera.updateProjectionMatrix();
  }

  // Of one solid, or of all.
  private boxOf(name: string | null): { centre: Vec3; radius: number } {
    const low: Vec3 = [Infinity, Infinity, Infinity];
    const high: Vec3 = [-Infinity, -Infinity, -Infinity];
    for (const [key, { object }] of this.meshes) {
      const box = object.geometry.boundingBox;
      if ((name !== null && name !== key && this.meshes.has(name)) || box === null || box.isEmpty()) continue;
      for (let axis = 0; axis < 3; ++axis) {
        const shift = object.position.getComponent(axis);
        low[axis] = Math.min(low[axis]!, box.min.getComponent(axis) + shift);
        high[axis] = Math.max(high[axis]!, box.max.getComponent(axis) + shift);
      }
    }
    if (low[0] > high[0]) return { centre: [0, 0, 0], radius: 100 };
    const centre = low.map((value, i) => (value + high[i]!) / 2) as Vec3;
    return { centre, radius: Math.hypot(...low.map((value, i) => (high[i]! - value) / 2)) || 1 };
  }

  private linesOf({ segments, isProvisional }: Outline) {
    const { three } = this;
    const geometry = new three.BufferGeometry();
    geometry.setAttribute("position", new three.BufferAttribute(segments, 3));
    const dash = this.extent.radius / 60;
    const material = isProvisional
      ? new three.LineDashedMaterial({ color: "#a03000", dashSize: dash, gapSize: dash, depthTest: false })
      : new three.LineBasicMaterial({ color: "#a03000", depthTest: false });
    const lines = new three.LineSegments(geometry, material);
    lines.computeLineDistances();
    lines.renderOrder = 2;
    return lines;
  }

  private personBeside() {
    const person = makePerson(this.three);
    const box = this.boxOf(null);
    let floor = Infinity;
    let right = -Infinity;
    for (const { object } of this.meshes.values()) {
      floor = Math.min(floor, object.geometry.boundingBox!.min.z);
      right = Math.max(right, object.geometry.boundingBox!.max.x);
    }
    if (!Number.isFinite(floor)) [floor, right] = [0, 0];
    person.position.set(right + 400, box.centre[1], floor);
    const top = Math.max(box.centre[2] + box.radius, floor + 1750);
    const left = box.centre[0] - box.radius;
    this.extent = {
      centre: [(left + right + 700) / 2, box.centre[1], (floor + top) / 2],
      radius: Math.hypot((right + 700 - left) / 2, box.radius, (top - floor) / 2),
    };
    return person;
  }

  private listen(): void {
    const { canvas } = this;
    let down: { x: number; y: number } | null = null;
    let painting = false;
    canvas.addEventListener(
      "pointerdown",
      (event) => {
        down = { x: event.clientX, y: event.clientY };
        const hit = this.events.onStroke && event.button === 0 && !event.shiftKey ? this.pick(event) : null;
        if (hit === null) return;
        painting = true;
        this.orbit.enabled = false;
        this.events.onStroke?.(hit, true);
      },
      { capture: true },
    );
    canvas.addEventListener("pointermove", (event) => {
      const hit = painting ? this.pick(event) : null;
      if (hit) this.events.onStroke?.(hit, false);
    });
    addEventListener("pointerup", (event) => {
      if (painting) {
        painting = false;
        this.orbit.enabled = true;
      } else if (event.target === canvas && down && !this.handle.isHeld && event.button === 0) {
        if (Math.hypot(event.clientX - down.x, event.clientY - down.y) <= CLICK_PX) this.events.onPick(this.pick(event));
      }
      down = null;
    });
    canvas.addEventListener("webglcontextlost", () => this.events.onLost());
  }

  private pick(event: PointerEvent): Picked | null {
    const area = this.canvas.getBoundingClientRect();
    return this.pickAt((2 * (event.clientX - area.left)) / area.width - 1, 1 - (2 * (event.clientY - area.top)) / area.height);
  }

  // As a click there would, for those who have no pointer. False: nothing is there.
  strokeMiddle(): boolean {
    const hit = this.pickAt(0, 0);
    if (hit) this.events.onStroke?.(hit, true);
    return hit !== null;
  }

  // The face at a place of the picture, each coordinate from -1 to 1. Linear in the faces shown.
  private pickAt(x: number, y: number): Picked | null {
    const { three } = this;
    const at = new three.Vector2(x, y);
    const ray = new three.Raycaster();
    ray.setFromCamera(at, this.camera);
    for (const hit of ray.intersectObjects([...this.meshes.values()].map(({ object }) => object), false)) {
      const found = [...this.meshes.values()].find(({ object }) => object === hit.object);
      if (!found || !hit.face) continue;
      const isHidden = (found.object.material.clippingPlanes ?? []).some((plane) => plane.distanceToPoint(hit.point) < 0);
      if (isHidden) continue;
      const { normal } = hit.face;
      return {
        name: found.solid.name,
        face: hit.faceIndex ?? 0,
        point: [hit.point.x, hit.point.y, hit.point.z],
        normal: [normal.x, normal.y, normal.z],
      };
    }
    return null;
  }

  private resize(): void {
    const parent = this.canvas.parentElement;
    if (!parent) return;
    const width = Math.max(1, parent.clientWidth);
    const height = Math.max(1, parent.clientHeight);
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  private drop(object: SolidMesh): void {
    this.scene.remove(object);
    object.geometry.dispose();
    object.material.dispose();
  }
}
