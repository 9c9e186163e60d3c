// The page Pieces: tool orientations as arrows, margins and bases are those of `setup --json`; fewer orientations are decided.

import assert from "node:assert/strict";
import { after, before } from "node:test";

import { assertAccessible, Console, launch, openWindow, windowTest } from "./console.mjs";

const server = new Console();
let browser;
let project;

before(async () => {
  server.makeProject(4000);
  server.run("segment", "a.qch", "--accept", "1");
  await server.start();
  browser = await launch();
  project = await server.projectId("a.qch");
});

after(async () => {
  await browser?.close();
  await server.end();
});

const setupsOf = (piece) => server.run("setup", "a.qch", "--piece", piece).pieces[0];
const arrows = (page, n) => page.locator(`canvas[data-arrows="${n}"]`).waitFor();
const shownAxis = ({ tool_axis }) => tool_axis.map((part) => part.toLocaleString("en-GB", { minimumFractionDigits: 3, maximumFractionDigits: 3 })).join(", ");
const axesInTable = (page) => page.getByRole("table", { name: /^Tool orientations/ }).locator("tbody tr td:nth-child(3)").allInnerTexts();

async function compared(page, piece) {
  await page.getByRole("button", { name: new RegExp(`^${piece} `) }).click();
  await page.getByRole("button", { name: "Compare all bases" }).click();
  await page.getByRole("table", { name: `Bases of piece ${piece}` }).waitFor();
}

windowTest("Each tool orientation has an arrow and a row, of the base in force and of one that is looked at", server, async (keep) => {
  const page = keep(await openWindow(browser, server, `pieces/${project}`));
  await page.locator('canvas[data-solids="2"]').waitFor();
  await arrows(page, 0);
  for (const piece of ["B", "C"]) {
    await compared(page, piece);
    const { setups } = setupsOf(piece);
    await arrows(page, setups[0].reach.orientations.length);
    assert.deepEqual(await axesInTable(page), setups[0].reach.orientations.map(shownAxis));
    assert.match(await page.locator("canvas[role=img]").getAttribute("aria-label"), new RegExp(`arrows at piece ${piece} for ${setups[0].reach.orientations.length} tool orientation`));
    const cuts = server.run("segment", "a.qch").cuts;
    for (const setup of setups) {
      // Straight up from the cap of a cut is along the normal of the cut: axes are in the frame of the scan, as its planes.
      const cut = cuts.find((one) => one.number === setup.base_cut);
      const [up] = setup.reach.orientations;
      if (cut) assert.ok(Math.abs(Math.abs(cut.normal.reduce((sum, part, i) => sum + part * up.tool_axis[i], 0)) - 1) < 1e-6);
      await page.getByRole("button", { name: `Show ${setup.base_description}`, exact: true }).click();
      await arrows(page, setup.reach.orientations.length);
      assert.deepEqual(await axesInTable(page), setup.reach.orientations.map(shownAxis), setup.base_description);
      await page.getByRole("table", { name: `Setup, ${setup.base_description}` }).waitFor();
    }
  }
  await assertAccessible(page);
});

windowTest("Margins are those of the engine, the least one first of all", server, async (keep) => {
  const page = keep(await openWindow(browser, server, `pieces/${project}?piece=B`));
  await compared(page, "B");
  const [setup] = setupsOf("B").setups;
  const summary = page.locator("summary", { hasText: "Margins" });
  const [name] = Object.entries(setup.margins_mm).sort((a, b) => a[1] - b[1])[0];
  assert.ok((await summary.innerText()).endsWith(name), await summary.innerText());
  await summary.click();
  const rows = await page.getByRole("table", { name: /^Margins/ }).getByRole("row").allInnerTexts();
  assert.deepEqual(rows.map((row) => row.split("\t")[0]), Object.keys(setup.margins_mm));
  await assertAccessible(page);
});

windowTest("Fewer orientations are a decision, which is shown, undone, and left to the program again", server, async (keep) => {
  const page = keep(await openWindow(browser, server, `pieces/${project}?piece=B`));
  await compared(page, "B");
  const before = setupsOf("B").setups[0].reach.orientations.length;
  assert.ok(before > 1, "the test needs a piece with several");
  const most = page.getByRole("textbox", { name: "Tool orientations at most" });
  assert.equal(await most.inputValue(), String(before));
  await most.fill("1.5");
  assert.equal(await page.getByRole("button", { name: "Give a whole number" }).isDisabled(), true);
  await most.fill("1");
  await page.getByRole("button", { name: "Take at most 1", exact: true }).click();
  await page.getByText("The setup of piece B is changed.").waitFor();
  assert.deepEqual(setupsOf("B").ordered, { base_number: null, max_directions: 1, tools: null });
  await compared(page, "B");
  await page.getByText("By decision: at most 1 tool orientation.").waitFor();
  await arrows(page, 1);
  await page.getByRole("button", { name: /^Undo setup of piece B/ }).click();
  await page.getByRole("button", { name: /^Redo setup of piece B/ }).waitFor();
  assert.equal(setupsOf("B").ordered, null);
  assert.equal(setupsOf("B").setups[0].reach.orientations.length, before);
});
