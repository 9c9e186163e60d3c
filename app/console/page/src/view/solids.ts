// Display meshes as objects of three: skin in the colour of the piece, caps a little darker, or a colour per face by its state.

import type { DisplayMesh } from "../geometry/display_mesh";
import type { Vec3 } from "../link/documents";
import type { Three } from "./load_three";
import type { Arrow } from "./scene";

export interface Solid {
  name: string;
  mesh: DisplayMesh;
  colour: string; // "#rrggbb"
  states?: { of: Uint8Array; palette: string[] }; // a colour per face in place of `colour`
  shift?: Vec3; // mm, of pieces shown apart
  dim?: boolean; // not the one that is worked on
  clip?: "left" | "right"; // of before and after: the part of the picture that it takes
}

type Material = InstanceType<Three["MeshLambertMaterial"]>;
export type SolidMesh = InstanceType<Three["Mesh"]> & { material: Material };

const CAP_SHADE = 0.72;

// A colour per corner needs corners of its own; else vertices are shared. Shading is by face: the display mesh has no normals.
export function makeSolid(three: Three, solid: Solid): SolidMesh {
  const geometry = new three.BufferGeometry();
  const { positions, indices } = solid.mesh;
  const corners = new Float32Array(3 * indices.length);
  for (let i = 0; i < indices.length; ++i)
    for (let axis = 0; axis < 3; ++axis) corners[3 * i + axis] = positions[3 * indices[i]! + axis]!;
  geometry.setAttribute("position", new three.BufferAttribute(corners, 3));
  geometry.setAttribute("color", new three.BufferAttribute(colours(three, solid), 3, true));
  geometry.computeVertexNormals();
  geometry.computeBoundingBox();
  const material = new three.MeshLambertMaterial({ vertexColors: true, side: three.DoubleSide });
  const object = new three.Mesh(geometry, material) as unknown as SolidMesh;
  object.name = `piece/${solid.name}`;
  if (solid.shift) object.position.set(...solid.shift);
  return object;
}

// Three bytes per corner, linear light.
function colours(three: Three, solid: Solid): Uint8Array {
  const bytesOf = (text: string, shade = 1): [number, number, number] => {
    const colour = new three.Color(text).multiplyScalar(shade);
    return [colour.r, colour.g, colour.b].map((part) => Math.round(255 * part)) as [number, number, number];
  };
  const faces = solid.mesh.indices.length / 3;
  const bytes = new Uint8Array(9 * faces);
  const fill = (face: number, colour: [number, number, number]) => {
    for (let corner = 0; corner < 3; ++corner) bytes.set(colour, 9 * face + 3 * corner);
  };
  const skin = bytesOf(solid.colour);
  for (let face = 0; face < faces; ++face) fill(face, skin);
  const cap = bytesOf(solid.colour, CAP_SHADE);
  for (const group of solid.mesh.groups)
    if (group.kind === "cap") for (let i = 0; i < group.faces; ++i) fill(group.first + i, cap);
  if (solid.states) {
    const palette = solid.states.palette.map((text) => bytesOf(text));
    for (let face = 0; face < faces; ++face) fill(face, palette[solid.states.of[face]!] ?? skin);
  }
  return bytes;
}

// A person of 1.75 m, from simple solids: to judge the size of a scan by. Stands with its feet at the origin.
export function makePerson(three: Three): InstanceType<Three["Group"]> {
  const person = new three.Group();
  const material = new three.MeshLambertMaterial({ color: "#7a8794" });
  const part = (radius: number, height: number, x: number, z: number) => {
    const mesh = new three.Mesh(new three.CapsuleGeometry(radius, height - 2 * radius, 6, 16), material);
    mesh.rotation.x = Math.PI / 2;
    mesh.position.set(x, 0, z + height / 2);
    person.add(mesh);
  };
  part(85, 920, -90, 0);
  part(85, 920, 90, 0);
  part(150, 700, 0, 790);
  part(58, 230, 0, 1370);
  part(48, 620, -215, 780);
  part(48, 620, 215, 780);
  part(92, 250, 0, 1500);
  person.name = "person";
  return person;
}

// From the middle of the tail to the tip; the rings are from the tail on.
export function makeArrow(three: Three, { direction, from, length, colour, rings }: Arrow): InstanceType<Three["Group"]> {
  const arrow = new three.Group();
  const material = new three.MeshLambertMaterial({ color: colour });
  const shaft = new three.Mesh(new three.CylinderGeometry(0.02 * length, 0.02 * length, 0.75 * length, 12), material);
  shaft.position.y = 0.375 * length;
  const head = new three.Mesh(new three.ConeGeometry(0.07 * length, 0.25 * length, 16), material);
  head.position.y = 0.875 * length;
  arrow.add(shaft, head);
  for (let i = 0; i < rings; ++i) {
    const ring = new three.Mesh(new three.CylinderGeometry(0.05 * length, 0.05 * length, 0.03 * length, 16), material);
    ring.position.y = (0.06 + 0.07 * i) * length;
    arrow.add(ring);
  }
  arrow.quaternion.setFromUnitVectors(new three.Vector3(0, 1, 0), new three.Vector3(...direction).normalize());
  arrow.position.set(...from);
  return arrow;
}
