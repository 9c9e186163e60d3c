// Meshes for the tests, and QCD1 written as app/display/display_format.cpp writes it.

// Numbers of [0, 1), the same ones for a seed (mulberry32).
export function randomNumbers(seed) {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

// A ball of 20 * 4^level faces.
export function icosphere(level, radius) {
  const g = (1 + Math.sqrt(5)) / 2;
  let vertices = [[-1, g, 0], [1, g, 0], [-1, -g, 0], [1, -g, 0], [0, -1, g], [0, 1, g], [0, -1, -g], [0, 1, -g], [g, 0, -1], [g, 0, 1], [-g, 0, -1], [-g, 0, 1]];
  let faces = [[0, 11, 5], [0, 5, 1], [0, 1, 7], [0, 7, 10], [0, 10, 11], [1, 5, 9], [5, 11, 4], [11, 10, 2], [10, 7, 6], [7, 1, 8], [3, 9, 4], [3, 4, 2], [3, 2, 6], [3, 6, 8], [3, 8, 9], [4, 9, 5], [2, 4, 11], [6, 2, 10], [8, 6, 7], [9, 8, 1]];
  for (let i = 0; i < level; ++i) {
    const middles = new Map();
    const middle = (a, b) => {
      const key = a < b ? `${a} ${b}` : `${b} ${a}`;
      if (!middles.has(key)) {
        middles.set(key, vertices.length);
        vertices.push([0, 1, 2].map((axis) => (vertices[a][axis] + vertices[b][axis]) / 2));
      }
      return middles.get(key);
    };
    faces = faces.flatMap(([a, b, c]) => {
      const [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
      return [[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]];
    });
  }
  vertices = vertices.map((v) => v.map((x) => (radius * x) / Math.hypot(...v)));
  return { vertices, faces };
}

export function encodeMesh({ vertices, faces }, groups = [{ kind: "skin", cut: -1, first: 0, faces: faces.length }]) {
  const low = [0, 1, 2].map((axis) => Math.min(...vertices.map((v) => v[axis])));
  const high = [0, 1, 2].map((axis) => Math.max(...vertices.map((v) => v[axis])));
  const step = Math.max(...high.map((value, axis) => value - low[axis])) / 16383;
  const places = new Map();
  const order = [];
  const codes = [];
  for (const vertex of faces.flat()) {
    let code = places.has(vertex) ? order.length - places.get(vertex) : 0;
    if (code === 0) {
      places.set(vertex, order.length);
      order.push(vertex);
    }
    for (; code >= 128; code = Math.floor(code / 128)) codes.push((code % 128) + 128);
    codes.push(code);
  }
  const buffer = new ArrayBuffer(52 + 6 * order.length + codes.length + 13 * groups.length);
  const view = new DataView(buffer);
  [..."QCD1"].forEach((letter, i) => view.setUint8(i, letter.charCodeAt(0)));
  [order.length, faces.length, codes.length, groups.length].forEach((value, i) => view.setUint32(4 + 4 * i, value, true));
  [...low, step].forEach((value, i) => view.setFloat64(20 + 8 * i, value, true));
  let at = 52;
  for (let axis = 0; axis < 3; ++axis) {
    let before = 0;
    order.forEach((vertex, i) => {
      const n = Math.round((vertices[vertex][axis] - low[axis]) / step);
      const zigzag = n >= before ? 2 * (n - before) : 2 * (before - n) - 1;
      before = n;
      view.setUint8(at + i, zigzag & 255);
      view.setUint8(at + order.length + i, zigzag >> 8);
    });
    at += 2 * order.length;
  }
  codes.forEach((code) => view.setUint8(at++, code));
  for (const group of groups) {
    view.setUint8(at, group.kind === "skin" ? 0 : 1);
    view.setInt32(at + 1, group.cut, true);
    view.setUint32(at + 5, group.first, true);
    view.setUint32(at + 9, group.faces, true);
    at += 13;
  }
  return { buffer, order, step };
}
