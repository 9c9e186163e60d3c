// The colours of pieces, as the pictures of the command line have them (segment/picture/colour.cpp).

const PALETTE = [
  "#5590e2",
  "#f4c02a",
  "#26b587",
  "#ca61a3",
  "#eee283",
  "#214b9f",
  "#f13a1e",
  "#b7e4d2",
  "#832465",
  "#7fa74e",
  "#a0c3f4",
  "#685540",
];

// Of a tool orientation by its place; they differ in lightness too.
const ORIENTATIONS = ["#7a1f1f", "#1f5fa8", "#1d6b34", "#8a4b00", "#5b2a86", "#00656b"];

export const orientationColour = (place: number): string => ORIENTATIONS[place % ORIENTATIONS.length]!;

// Of a project's piece by its place in the list.
export const pieceColour = (pieces: { name: string }[], name: string): string =>
  PALETTE[Math.max(0, pieces.findIndex((piece) => piece.name === name)) % PALETTE.length]!;
