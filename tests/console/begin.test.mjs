// Begin on the page Check: solids and fragments, names of projects, the cuts of another project, painting without a pointer.

import assert from "node:assert/strict";
import { readFileSync, readdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before } from "node:test";

import { assertAccessible, Console, launch, openWindow, windowTest } from "./console.mjs";

const server = new Console();
let browser;
let project;

before(async () => {
  server.makeProject(3000, false);
  server.run("segment", "a.qch", "--plane", "1,0,0,0");
  server.run("segment", "a.qch", "--weights", "fragility=11");
  writeFileSync(join(server.projects, "boxes.stl"), boxes([100, 40, 20, 2]));
  await server.start();
  browser = await launch();
  project = await server.projectId("a.qch");
});

after(async () => {
  await browser?.close();
  await server.end();
});

// A binary STL of cubes of these sides beside each other.
function boxes(sides) {
  const faces = [
    [0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4], [2, 6, 3], [3, 6, 7], [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5],
  ];
  const file = Buffer.alloc(84 + 50 * faces.length * sides.length);
  file.writeUInt32LE(faces.length * sides.length, 80);
  let at = 84;
  let x = 0;
  for (const side of sides) {
    for (const face of faces) {
      face.forEach((corner, i) => {
        const point = [x + (corner & 1) * side, ((corner >> 1) & 1) * side, (corner >> 2) * side];
        point.forEach((value, axis) => file.writeFloatLE(value, at + 12 + 12 * i + 4 * axis));
      });
      at += 50;
    }
    x += side + 50;
  }
  return file;
}

async function checked(page, scan) {
  await page.getByRole("button", { name: `Check ${scan}` }).click();
  await page.getByRole("button", { name: /^mm / }).click();
  await page.getByText("Units: mm, as chosen").waitFor();
}

windowTest("Solids are listed by volume, and what is smaller than one is called fragments and becomes some", server, async (keep) => {
  const page = keep(await openWindow(browser, server));
  await checked(page, "boxes.stl");
  const { largest_solids: solids } = server.run("inspect", "boxes.stl", "--units", "mm");
  assert.deepEqual(solids.map((solid) => Math.round(solid.volume)), [1_000_000, 64_000, 8_000, 8]);
  const table = page.getByRole("table", { name: "Solids by volume" });
  const becomes = async () => (await table.locator("tbody tr").allInnerTexts()).map((row) => /a piece|a fragment/.exec(row)[0]);
  assert.deepEqual(await becomes(), ["a piece", "a piece", "a piece", "a fragment"]);
  await table.getByRole("button", { name: "From here on fragments: smaller than solid 2" }).click();
  assert.deepEqual(await becomes(), ["a piece", "a piece", "a fragment", "a fragment"]);
  await assertAccessible(page);
  await page.getByRole("button", { name: "Begin" }).click();
  await page.waitForURL(/#\/cut\//);
  const made = server.run("segment", "boxes.qch");
  assert.deepEqual(made.pieces.map((piece) => Math.round(piece.volume_mm3)).sort((a, b) => b - a), [1_000_000, 64_000]);
  assert.equal(made.fragments, 2);
});

windowTest("A name in any script is taken, and a wrong one is refused at once with a sentence", server, async (keep) => {
  const page = keep(await openWindow(browser, server));
  await checked(page, "a.ply");
  const name = page.getByRole("textbox", { name: "Name of the project" });
  const begin = page.getByRole("button", { name: "Begin" });
  // A free one is proposed, as soon as it is known which are taken.
  await page.waitForFunction((input) => input.value === "a 2", await name.elementHandle());
  for (const [typed, sentence] of [["a", "A project of this name is there already."], ["../a", "Let the name begin with a letter or a digit."], ["a/b", "Leave out “/”"], ["a\u202eb", "Leave out the character U+202E"], ["x".repeat(81), "Give the project a shorter name."]]) {
    await name.fill(typed);
    await page.getByText(sentence).waitFor();
    assert.equal(await begin.isDisabled(), true, typed);
  }
  await assertAccessible(page);
  await name.fill("Scha\u0308del 頭骨 3");
  await begin.click();
  await page.waitForURL(/#\/cut\//);
  await page.locator("h1", { hasText: "Cut Schädel 頭骨 3.qch" }).waitFor({ state: "attached" });
  assert.ok(readdirSync(server.projects).includes("Schädel 頭骨 3.qch"));
  await page.getByRole("link", { name: "Start" }).click();
  await page.getByRole("button", { name: "Open Schädel 頭骨 3.qch" }).click();
  await page.locator(".planes tbody tr").first().waitFor();
});

windowTest("A new project with the cuts of another one is painted again, by keys, and has these cuts", server, async (keep) => {
  const page = keep(await openWindow(browser, server, `cut/${project}`));
  const before = readFileSync(join(server.projects, "a.qch/project.json"));
  await page.getByRole("button", { name: "New project with these cuts" }).click();
  await page.waitForURL(/#\/check\//);
  await page.getByRole("button", { name: /^mm / }).click();
  await page.getByText("Units: mm, as chosen").waitFor();
  const cuts = page.getByRole("combobox", { name: "Cuts" });
  assert.equal(await cuts.evaluate((select) => select.selectedOptions[0].textContent), "those of a.qch");
  await page.locator('canvas[data-solids="1"]').waitFor();
  await page.getByRole("button", { name: "must not be cut" }).click();
  await page.keyboard.press("7");
  await page.getByRole("button", { name: "Paint the middle of the view" }).press("Enter");
  await page.getByRole("table", { name: "Strokes" }).getByText("must not be cut").waitFor();
  await assertAccessible(page);
  await page.getByRole("textbox", { name: "Name of the project" }).fill("again");
  await page.getByRole("button", { name: "Begin" }).click();
  await page.getByRole("button", { name: "Undo cut 1 on piece A" }).or(page.getByRole("button", { name: "Open the project" })).first().waitFor();
  const [first, again] = [server.run("segment", "a.qch"), server.run("segment", "again.qch")];
  assert.deepEqual(again.cuts.map((cut) => [cut.normal, cut.offset_mm]), first.cuts.map((cut) => [cut.normal, cut.offset_mm]));
  assert.deepEqual(again.pieces, first.pieces);
  assert.equal(again.weights.fragility, 11);
  assert.ok(again.no_cut.points > 0, "what was painted is there");
  assert.deepEqual(readFileSync(join(server.projects, "a.qch/project.json")), before);
});

windowTest("Cuts that do not fit the scan are told where Begin is, and no project is made", server, async (keep) => {
  const page = keep(await openWindow(browser, server));
  await checked(page, "boxes.stl");
  await page.getByRole("combobox", { name: "Cuts" }).selectOption("those of a.qch");
  await page.getByRole("textbox", { name: "Name of the project" }).fill("other");
  await page.getByRole("button", { name: "Begin" }).click();
  await page.getByText(/plan/i).first().waitFor();
  assert.equal(await page.getByRole("button", { name: "Open the project" }).count(), 0);
  assert.equal(readdirSync(server.projects).includes("other.qch"), false);
  await assertAccessible(page);
});

windowTest("Where nothing is in the middle of the view a sentence says so, and nothing is painted", server, async (keep) => {
  const page = keep(await openWindow(browser, server));
  await checked(page, "boxes.stl"); // between the boxes, seen from the front
  await page.locator('canvas[data-solids="1"]').waitFor();
  await page.getByRole("button", { name: "may stay" }).click();
  await page.keyboard.press("1");
  const paint = page.getByRole("button", { name: "Paint the middle of the view" });
  await paint.press("Enter");
  await page.getByText("The scan is not in the middle of the view: turn it, or Fit. Nothing is painted.").waitFor();
  await page.keyboard.press("3"); // from the side the large one is there
  await paint.press("Enter");
  await page.getByText("1 stroke.").waitFor();
  assert.equal(await page.getByText("The scan is not in the middle").count(), 0);
});
