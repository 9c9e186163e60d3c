// The page's parts without a browser: decoder, planes, section, provisional order, events, addresses, keys.

import assert from "node:assert/strict";
import { test } from "node:test";

import * as page from "../../build/console/parts.mjs";
import { encodeMesh, icosphere, randomNumbers } from "./meshes.mjs";

test("a display mesh is decoded to what was encoded", () => {
  for (const level of [0, 1, 3]) {
    const mesh = icosphere(level, 80);
    const caps = Math.floor(mesh.faces.length / 4);
    const groups = [
      { kind: "skin", cut: -1, first: 0, faces: mesh.faces.length - caps },
      { kind: "cap", cut: 7, first: mesh.faces.length - caps, faces: caps },
    ];
    const { buffer, order, step } = encodeMesh(mesh, groups);
    const decoded = page.decodeMesh(buffer);
    assert.equal(decoded.positions.length, 3 * mesh.vertices.length);
    assert.deepEqual(decoded.groups, groups);
    assert.equal(decoded.step, step);
    mesh.faces.forEach((face, f) =>
      face.forEach((vertex, corner) => {
        const index = decoded.indices[3 * f + corner];
        assert.equal(order[index], vertex);
        for (let axis = 0; axis < 3; ++axis)
          assert.ok(Math.abs(decoded.positions[3 * index + axis] - mesh.vertices[vertex][axis]) <= 0.5 * step + 1e-4);
      }),
    );
  }
});

test("a mesh that is cut off anywhere, or has a byte changed in its head, is refused and never hangs", () => {
  const { buffer } = encodeMesh(icosphere(1, 80));
  for (let length = 0; length < buffer.byteLength; ++length)
    assert.throws(() => page.decodeMesh(buffer.slice(0, length)), /damaged/, `of ${length} bytes`);
  for (let at = 0; at < 20; ++at) {
    const changed = new Uint8Array(buffer.slice(0));
    changed[at] ^= 0x41;
    assert.throws(() => page.decodeMesh(changed.buffer), /damaged/, `byte ${at}`);
  }
});

test("a mesh with random bytes changed is refused, or its indices are those of vertices", () => {
  const { buffer } = encodeMesh(icosphere(1, 80));
  const random = randomNumbers(17);
  let refused = 0;
  for (let i = 0; i < 3000; ++i) {
    const changed = new Uint8Array(buffer.slice(0));
    changed[52 + Math.floor(random() * (changed.length - 52))] = Math.floor(256 * random());
    try {
      const { indices, positions } = page.decodeMesh(changed.buffer);
      assert.ok(indices.every((index) => index < positions.length / 3));
      assert.ok(positions.every(Number.isFinite));
    } catch (error) {
      assert.match(error.message, /damaged/);
      ++refused;
    }
  }
  assert.ok(refused > 100, `${refused} refused`);
});

test("states are a byte per face after the id of the mesh, and no other number of them", () => {
  const bytes = new Uint8Array([0x51, 0x43, 0x53, 0x31, ...new Array(16).fill(9), 0, 1, 4]);
  assert.deepEqual([...page.decodeStates(bytes.buffer, 3)], [0, 1, 4]);
  for (const faces of [2, 4]) assert.throws(() => page.decodeStates(bytes.buffer, faces), /damaged/);
});

test("the section of a ball lies in the plane and is as long as the circle", () => {
  const radius = 80;
  const mesh = page.decodeMesh(encodeMesh(icosphere(5, radius)).buffer);
  const random = randomNumbers(3);
  for (let i = 0; i < 20; ++i) {
    const normal = page.normalised([random() - 0.5, random() - 0.5, random() - 0.5]);
    const offset = (random() - 0.5) * 1.6 * radius;
    const segments = page.sectionOf(mesh, { normal, offset });
    let length = 0;
    for (let s = 0; s < segments.length; s += 6) {
      const [a, b] = [segments.slice(s, s + 3), segments.slice(s + 3, s + 6)];
      for (const point of [a, b]) assert.ok(Math.abs(page.dot(normal, point) - offset) < 1e-3);
      length += Math.hypot(...[0, 1, 2].map((axis) => a[axis] - b[axis]));
    }
    const circle = 2 * Math.PI * Math.sqrt(radius ** 2 - offset ** 2);
    assert.ok(Math.abs(length / circle - 1) < 0.01, `${length} for ${circle}`);
  }
  assert.equal(page.sectionOf(mesh, { normal: [0, 0, 1], offset: 2 * radius }).length, 0);
});

test("a plane keeps every digit in the address", () => {
  const random = randomNumbers(5);
  for (let i = 0; i < 200; ++i) {
    const plane = { normal: page.normalised([random() - 0.5, random(), random()]), offset: 300 * (random() - 0.5) };
    assert.ok(page.isSame(page.parsePlane(page.planeText(plane)), plane));
  }
  for (const text of ["", "1,2,3", "0,0,0,5", "a,0,0,1", "1,0,0,Infinity", "1,0,0,1,1"]) assert.equal(page.parsePlane(text), null, text);
  assert.deepEqual(page.parsePlane("0,0,2,5"), { normal: [0, 0, 1], offset: 5 });
});

test("a plane that is flipped twice is the same, and its axes are at right angles", () => {
  const random = randomNumbers(6);
  for (let i = 0; i < 100; ++i) {
    const normal = page.normalised([random() - 0.5, random() - 0.5, random() - 0.5]);
    const plane = { normal, offset: random() };
    assert.ok(page.isSame(page.flipped(page.flipped(plane)), plane));
    const [u, v] = page.axesOf(normal);
    for (const [a, b, expected] of [[u, u, 1], [v, v, 1], [u, v, 0], [u, normal, 0], [v, normal, 0]])
      assert.ok(Math.abs(page.dot(a, b) - expected) < 1e-12);
  }
});

const plane = (k, terms) => ({ k, normal: [0, 0, 1], offset_mm: k, terms });

test("with the engine's weights the order and totals are the engine's", () => {
  const planes = [plane(1, { a: 1, b: 0, total: 0.7 }), plane(2, { a: 0, b: 1, total: 0.9 })];
  const rows = page.ranked(planes, { a: 1, b: 1 }, { b: 1, a: 1 });
  assert.deepEqual(rows.map(({ plane: { k }, total }) => [k, total]), [[1, 0.7], [2, 0.9]]);
});

test("with other weights the order is that of the weighted sums, and planes with the same sum keep theirs", () => {
  const random = randomNumbers(7);
  const planes = Array.from({ length: 60 }, (_, i) => plane(i + 1, { a: random(), b: Math.round(random()), c: 0, total: i }));
  const weights = { a: 0.25, b: 3, c: 100 };
  const rows = page.ranked(planes, weights, { a: 1, b: 1, c: 1 });
  const sum = ({ terms }) => 0.25 * terms.a + 3 * terms.b;
  assert.deepEqual(rows.map(({ plane: { k } }) => k).sort((x, y) => x - y), planes.map(({ k }) => k));
  rows.forEach(({ plane: row, total }, i) => {
    assert.ok(Math.abs(total - sum(row)) < 1e-12);
    if (i > 0) assert.ok(rows[i - 1].total <= total);
  });
  const flat = page.ranked(planes, { a: 0, b: 0, c: 1 }, weights);
  assert.deepEqual(flat.map(({ plane: { k } }) => k), planes.map(({ k }) => k));
});

test("events are the same however the stream is cut into chunks", () => {
  const text = 'id: s-1\nevent: tick\ndata: {}\n\n:\n\nid: s-2\nevent: work\ndata: {"id":"w","n":[1]}\n\nevent: reset\ndata: {}\n\nid: s-3\ndata: no json\n\n';
  const whole = new page.EventParser().push(text);
  assert.deepEqual(whole, [
    { id: "s-1", name: "tick", data: {} },
    { id: "s-2", name: "work", data: { id: "w", n: [1] } },
    { id: "", name: "reset", data: {} },
  ]);
  for (let size = 1; size < 12; ++size) {
    const parser = new page.EventParser();
    const parts = [];
    for (let at = 0; at < text.length; at += size) parts.push(...parser.push(text.slice(at, at + size)));
    assert.deepEqual(parts, whole, `chunks of ${size}`);
  }
});

const state = () =>
  page.known({ event: "s-10", read_only: false, dispatch: "none", simulator: false, folder: "f", projects: [{ id: "p", name: "a.qch", revision: "1" }], checks: [], work: [] });
const work = (id, state) => ({ id, state, kind: "search", of: "p" });

test("an event that the state has already changes nothing; each later one counts once", () => {
  const now = state();
  assert.equal(page.after(now, { id: "s-10", name: "work", data: work("w1", "running") }), now);
  const next = page.after(now, { id: "s-11", name: "work", data: work("w1", "running") });
  assert.equal(next.work.length, 1);
  assert.equal(page.after(next, { id: "s-11", name: "work", data: work("w2", "running") }), next);
  assert.equal(page.currentWork(next).id, "w1");
  const queued = page.after(next, { id: "s-12", name: "work", data: work("w0", "queued") });
  assert.equal(page.currentWork(queued).id, "w1");
  const over = page.after(queued, { id: "s-13", name: "work", data: work("w1", "stopped") });
  assert.equal(over.work.length, 2);
  assert.equal(page.currentWork(over).id, "w0");
});

test("a change by another is told with its sentence, and keeps what the event leaves out", () => {
  const next = page.after(state(), { id: "s-11", name: "project", data: { id: "p", revision: "2", by: "command line", sentence: "Undo cut 3 on piece B" } });
  assert.deepEqual(next.projects, [{ id: "p", name: "a.qch", revision: "2" }]);
  assert.deepEqual(next.notices, [{ id: "s-11", sentence: "The command line has changed a.qch: the newest decision is cut 3 on piece B." }]);
});

test("a server that tells of no cells has none", () => {
  assert.deepEqual(page.known({ event: "s-1", projects: [], work: [] }).cells, []);
});

test("an address names page and selection, and comes back the same", () => {
  for (const address of [
    { page: "start", id: "", selection: {} },
    { page: "cut", id: "P-1/ä?", selection: { piece: "B", plane: "0,0,1,12.5" } },
    { page: "check", id: "c1", selection: {} },
  ])
    assert.deepEqual(page.parseAddress(page.formatAddress(address)), address);
  for (const fragment of ["", "#", "#/", "#/nothing/x", "#key=abc", "#/__proto__"])
    assert.deepEqual(page.parseAddress(fragment), { page: "start", id: "", selection: {} }, fragment);
  assert.equal(page.parseAddress("#/cut/%E0%A4%A").id, "");
});

const press = (key, more = {}) => page.keyOf({ key, ctrlKey: false, metaKey: false, altKey: false, shiftKey: false, ...more })?.action;

test("keys do what their list says, and none of them moves a machine", () => {
  assert.equal(press("?", { shiftKey: true }), "help");
  assert.equal(press("F9"), "hold");
  assert.equal(press("z", { ctrlKey: true }), "undo");
  assert.equal(press("Z", { ctrlKey: true, shiftKey: true }), "redo");
  assert.equal(press("z"), undefined);
  assert.equal(press("h", { ctrlKey: true }), undefined);
  assert.equal(press("x", { altKey: true }), undefined);
  const actions = new Set(page.KEYS.map((key) => key.action));
  for (const action of ["start", "resume", "unhold", "accept", "dispatch", "hand over", "clear"]) assert.ok(!actions.has(action));
});

test("a stroke marks faces near it on its side, and a later one takes the mark away", () => {
  const mesh = page.decodeMesh(encodeMesh(icosphere(3, 80)).buffer);
  const top = [0, 0, 80, 0, 0, 1];
  const stroke = (surface, radius_mm) => ({ surface, radius_mm, points: [top] });
  const marked = page.painted(mesh.positions, mesh.indices, [stroke("ignore", 40)]);
  const few = page.painted(mesh.positions, mesh.indices, [stroke("ignore", 40), stroke("clear", 20)]);
  const all = page.painted(mesh.positions, mesh.indices, [stroke("no_cut", 1000)]);
  const count = (states, value) => states.filter((one) => one === value).length;
  assert.ok(count(marked, 1) > 20 && count(marked, 1) < marked.length / 4);
  assert.ok(count(few, 1) < count(marked, 1) && count(few, 1) > 0);
  assert.ok(Math.abs(count(all, 2) / all.length - 0.5) < 0.05, "only the side that faces the stroke");
});

test("figures are written as the command line writes them", () => {
  assert.equal(page.percent(0.0084), "0.84 %");
  assert.equal(page.volume(1263577.8), "1.264 l");
  assert.equal(page.length(1820), "1.82 m");
  assert.equal(page.length(344.6), "34.5 cm");
  assert.equal(page.time(3850), "1:04:10 h");
  assert.equal(page.progress(37, 120, "cuts evaluated"), "37 of 120 cuts evaluated");
});

test("arrows of tool orientations point into the piece, end outside of it, and move with it", () => {
  const { vertices } = icosphere(3, 80);
  const positions = Float32Array.from(vertices.flatMap(([x, y, z]) => [x + 5, 2 * y, 0.5 * z - 7]));
  const { middle, radius } = page.extentOf(positions);
  assert.ok(radius > 80 && radius < 300);
  const axes = [[0, 0, 1], [0.6, 0, 0.8], [-0.48, 0.64, 0.6], [0, -1, 0]];
  const shift = [10, 20, 30];
  const still = page.toolArrows(axes, positions, [0, 0, 0]);
  page.toolArrows(axes, positions, shift).forEach((arrow, i) => {
    assert.deepEqual(arrow.direction, axes[i].map((part) => -part));
    arrow.from.forEach((value, axis) => assert.ok(Math.abs(value - still[i].from[axis] - shift[axis]) < 1e-9));
    const tip = still[i].from.map((value, axis) => value + arrow.length * arrow.direction[axis]);
    const along = (point) => point[0] * axes[i][0] + point[1] * axes[i][1] + point[2] * axes[i][2];
    let highest = -Infinity;
    for (let p = 0; p < positions.length; p += 3) highest = Math.max(highest, along(positions.subarray(p, p + 3)));
    const gap = along(tip) - highest;
    assert.ok(gap > 0 && gap < 0.1 * radius, `${gap}`);
    // Through the middle of the piece.
    const beside = tip.map((value, axis) => value - middle[axis] - (along(tip) - along(middle)) * axes[i][axis]);
    assert.ok(Math.hypot(...beside) < 1e-6);
  });
  assert.deepEqual(page.toolArrows([], positions, shift), []);
  assert.deepEqual(page.extentOf(new Float32Array(0)), { middle: [0, 0, 0], radius: 0 });
});

test("a name is taken if the server takes it, and else a sentence says what is wrong", () => {
  for (const name of ["a", "Schädel 3", "ä", "череп", "頭骨 1", "Skull 2.5 of_B-7", "a".repeat(80), "頭".repeat(66), "नमस्ते"]) assert.equal(page.nameProblem(name, []), "", name);
  const wrong = {
    "": /^Give the project a name/,
    " a": /begin with/,
    "-rf": /begin with/,
    ".a": /begin with/,
    _a: /begin with/,
    "\u0301a": /begin with/,
    "a/b": /^Leave out “\/”/,
    "a\nb": /U\+000A/,
    "a\0b": /U\+0000/,
    "a\u202eb": /U\+202E/,
    "a\u00a0b": /U\+00A0/,
    "a\u00adb": /U\+00AD/,
    "a\u3164b": /U\+3164/,
    "<b>": /begin with/,
    "a<b>": /“<”/,
    "a'b": /“'”/,
    "a\u{1f480}b": /Leave out/,
    ["a".repeat(81)]: /shorter/,
    ["頭".repeat(67)]: /shorter/,
  };
  for (const [name, sentence] of Object.entries(wrong)) assert.match(page.nameProblem(name, []), sentence, JSON.stringify(name));
  assert.equal(page.nameProblem("a", ["a.qch"]), "A project of this name is there already.");
  assert.equal(page.projectName(" Scha\u0308del 3 "), "Schädel 3");
});

// QCP1 as app/display/display_path.cpp writes it.
function encodeWay({ points, ms, lines, kinds }, step = 0.5) {
  const codes = [];
  const put = (value) => {
    for (; value >= 128; value = Math.floor(value / 128)) codes.push((value % 128) + 128);
    codes.push(value);
  };
  ms.forEach((value, i) => put(value - (ms[i - 1] ?? 0)));
  lines.forEach((value, i) => {
    const difference = value - (lines[i - 1] ?? 0);
    put(difference >= 0 ? 2 * difference : -2 * difference - 1);
  });
  const n = points.length;
  const bytes = new Uint8Array(44 + 7 * n + codes.length);
  const view = new DataView(bytes.buffer);
  [..."QCP1"].forEach((letter, i) => (bytes[i] = letter.charCodeAt(0)));
  view.setUint32(4, n, true);
  view.setUint32(8, codes.length, true);
  [0, 0, 0, step].forEach((value, i) => view.setFloat64(12 + 8 * i, value, true));
  for (let axis = 0; axis < 3; ++axis)
    points.forEach((point, i) => {
      const difference = point[axis] - (points[i - 1]?.[axis] ?? 0);
      const code = difference >= 0 ? 2 * difference : -2 * difference - 1;
      bytes[44 + 2 * axis * n + i] = code & 255;
      bytes[44 + 2 * axis * n + n + i] = code >> 8;
    });
  bytes.set(kinds, 44 + 6 * n);
  bytes.set(codes, 44 + 7 * n);
  return bytes.buffer;
}

const way = {
  points: [[0, 0, 0], [200, 0, 0], [200, 16383, 40], [10, 16383, 40]],
  ms: [0, 1000, 1000, 701000],
  lines: [12, 13, 2_000_000, 4],
  kinds: [0, 2, 4, 1],
};

test("the way of a tool is decoded to what was encoded, and tells where the tip is when", () => {
  const decoded = page.decodeWay(encodeWay(way));
  assert.deepEqual([...decoded.ms], way.ms);
  assert.deepEqual([...decoded.lines], way.lines);
  assert.deepEqual([...decoded.kinds], way.kinds);
  assert.deepEqual([...decoded.positions], way.points.flat().map((x) => 0.5 * x));
  assert.equal(page.pointAt(decoded, 0), 0);
  assert.equal(page.pointAt(decoded, 1), 1);
  assert.equal(page.pointAt(decoded, 1000), 1);
  assert.equal(page.pointAt(decoded, 1001), 3);
  assert.equal(page.pointAt(decoded, 1e9), 3);
  assert.deepEqual(page.tipAt(decoded, 1, 250), [25, 0, 0]);
  assert.deepEqual(page.tipAt(decoded, 2, 1000), [100, 8191.5, 20], "a line that takes no time is passed");
  assert.deepEqual([...page.linesTo(decoded, 1, 1, [25, 0, 0])], [0, 0, 0, 25, 0, 0]);
  assert.equal(page.linesTo(decoded, 0, 3, [5, 0, 0]).length, 18);
});

test("a way that is cut off, longer or of unknown kinds is refused", () => {
  const buffer = encodeWay(way);
  for (let length = 0; length < buffer.byteLength; ++length)
    assert.throws(() => page.decodeWay(buffer.slice(0, length)), /damaged/, `of ${length} bytes`);
  const longer = new Uint8Array(buffer.byteLength + 1);
  longer.set(new Uint8Array(buffer));
  assert.throws(() => page.decodeWay(longer.buffer), /damaged/);
  assert.throws(() => page.decodeWay(encodeWay({ ...way, kinds: [0, 2, 5, 1] })), /kind/);
});
