// The pages in Chromium, against `qchopper serve`, with what the command line says of the same project as the reference.

import assert from "node:assert/strict";
import { after, before } from "node:test";

import { assertAccessible, Console, launch, openWindow, windowTest } from "./console.mjs";

const server = new Console();
let browser;
let project; // id of a.qch

before(async () => {
  server.makeProject(4000);
  await server.start();
  browser = await launch();
  project = await server.projectId("a.qch");
});

after(async () => {
  await browser?.close();
  await server.end();
});

const cutPage = (options) => openWindow(browser, server, `cut/${project}`, options);
const rows = (page) => page.locator(".planes tbody tr");
const isExact = (page) => page.locator(".planes:not(.provisional) tbody tr").first().waitFor();

// Totals as the table shows them.
const totals = (page) => page.locator(".planes tbody tr td:last-child").allInnerTexts();
const shownTotals = (document) => document.proposal.planes.map((plane) => plane.terms.total.toFixed(3));

windowTest("Start shows scans and projects, and the key leaves the address at once", server, async (keep) => {
  const page = keep(await openWindow(browser, server));
  await page.getByRole("button", { name: "Check a.ply" }).waitFor();
  await page.getByRole("button", { name: "Open a.qch" }).waitFor();
  assert.equal(await page.evaluate(() => location.href.includes("key")), false);
  assert.match(await page.evaluate(() => sessionStorage.getItem("qchopper.key")), /^[0-9a-f]{32}$/);
  await assertAccessible(page);
});

windowTest("A window without a key says what to do, and one with a wrong key too", server, async (keep) => {
  const context = await browser.newContext();
  const page = keep(await context.newPage());
  page.faults = [];
  page.said = [];
  await page.goto(server.origin);
  await page.getByText("This window has no key. Open the link that qchopper serve printed.").waitFor();
  await page.goto(`${server.origin}/#key=${"0".repeat(32)}`);
  await page.getByText("The server refuses the key of this window.").waitFor();
});

windowTest("A scan is checked, gets units, and becomes a project", server, async (keep) => {
  const page = keep(await openWindow(browser, server));
  await page.getByRole("button", { name: "Check a.ply" }).click();
  await page.getByText("Choose the units first.").waitFor();
  assert.equal(await page.getByRole("button", { name: "Begin" }).isDisabled(), true);
  await assertAccessible(page);
  const inspected = server.run("inspect", "a.ply", "--units", "mm");
  await page.getByRole("button", { name: `mm ${inspected.size_text}` }).click();
  await page.getByText("Units: mm, as chosen").waitFor();
  await page.getByText(inspected.size_text).first().waitFor();
  await page.getByRole("textbox", { name: "Name of the project" }).fill("from the page");
  await page.getByRole("combobox", { name: "Cell" }).selectOption("foam-1");
  await page.getByRole("button", { name: "Begin" }).click();
  await page.waitForURL(/#\/cut\//);
  await rows(page).first().waitFor();
  assert.equal(server.run("segment", "from the page.qch").pieces[0].faces, inspected.faces);
});

windowTest("The planes are those of the command line, and Accept cuts by the chosen one", server, async (keep) => {
  const page = keep(await cutPage());
  await isExact(page);
  const proposed = server.run("segment", "a.qch", "--step", "--top", "40");
  assert.deepEqual(await totals(page), shownTotals(proposed));
  await rows(page).nth(2).click();
  await page.getByText("Exact.").waitFor();
  await page.getByRole("button", { name: "Accept plane 3" }).click();
  await page.getByRole("button", { name: "Undo cut 1 on piece A" }).waitFor();
  const now = server.run("segment", "a.qch");
  assert.equal(now.cuts.length, 1);
  await page.getByRole("listitem").filter({ hasText: /^Cut 1 on piece A/ }).waitFor();
  assert.deepEqual(now.cuts[0].normal, proposed.proposal.planes[2].normal);
  assert.equal(now.cuts[0].offset_mm, proposed.proposal.planes[2].offset_mm);
  for (const piece of now.pieces) await page.locator(".leaf", { hasText: piece.name }).first().waitFor();
  await assertAccessible(page);
});

windowTest("Undo and Redo are named, have keys, and every window sees them", server, async (keep) => {
  const page = keep(await cutPage());
  const other = keep(await cutPage({ context: page.context() }));
  await other.getByRole("button", { name: "Undo cut 1 on piece A" }).waitFor();
  await page.getByRole("button", { name: "Undo cut 1 on piece A" }).waitFor();
  await page.keyboard.press("Control+z");
  await page.getByRole("button", { name: "Redo cut 1 on piece A" }).waitFor();
  await other.getByRole("button", { name: "Redo cut 1 on piece A" }).waitFor();
  assert.equal(server.run("segment", "a.qch").cuts.length, 0);
  await other.keyboard.press("Control+Shift+Z");
  await page.getByRole("button", { name: "Undo cut 1 on piece A" }).waitFor();
  assert.equal(server.run("segment", "a.qch").cuts.length, 1);
});

windowTest("What the command line does is shown, and told with a sentence", server, async (keep) => {
  const page = keep(await cutPage());
  await page.getByRole("button", { name: "Undo cut 1 on piece A" }).waitFor();
  server.run("segment", "a.qch", "--undo");
  await page.getByRole("button", { name: "Redo cut 1 on piece A" }).waitFor();
  await page.getByRole("link", { name: "Start" }).click();
  await page.getByText("The command line has changed a.qch: no decision is in force.").waitFor();
});

windowTest("A decision on an older revision is refused, and says so", server, async (keep) => {
  const page = keep(await cutPage());
  await isExact(page);
  await page.route("**/decisions", (route) => route.continue({ headers: { ...route.request().headers(), "if-match": '"0123456789abcdef"' } }));
  await page.getByRole("button", { name: "Accept plane 1" }).click();
  const error = page.getByRole("alert").filter({ hasText: "changed" });
  await error.getByText("Nothing was changed.").waitFor();
  await error.getByRole("button", { name: "Show" }).click();
  await error.waitFor({ state: "detached" });
  assert.equal(server.run("segment", "a.qch").cuts.length, 0);
});

windowTest("A moved weight gives a provisional order at once, then the exact one; Keep weights decides", server, async (keep) => {
  const page = keep(await cutPage());
  await isExact(page);
  const before = server.run("segment", "a.qch", "--step", "--top", "40");
  let release;
  const held = new Promise((done) => (release = done));
  await page.route("**/questions", async (route) => {
    if (route.request().postData().includes('"rank"')) await held;
    await route.continue();
  });
  await page.locator("details.weights summary").click();
  await page.getByRole("textbox", { name: "Fragility" }).fill("30");
  await page.locator(".planes.provisional").waitFor();
  await page.getByText("Provisional order").waitFor();
  assert.equal(await page.getByRole("button", { name: /^Accept plane/ }).isDisabled(), true);
  const weights = { ...before.weights, fragility: 30 };
  const sums = before.proposal.planes.map(({ terms }) => Object.entries(weights).reduce((sum, [name, weight]) => sum + weight * terms[name], 0));
  assert.deepEqual(await totals(page), sums.sort((a, b) => a - b).map((sum) => sum.toFixed(3)));
  assert.equal(await page.locator(".planes .scroll").evaluate((element) => getComputedStyle(element).borderTopStyle), "dashed");
  await assertAccessible(page);
  // The focus stays on its row when the exact order comes.
  const row = page.locator(".planes input[type=radio]").nth(4);
  await row.focus();
  await page.evaluate(() => (window.focused = document.activeElement));
  release();
  await isExact(page);
  assert.equal(await page.evaluate(() => document.activeElement === document.body), false);
  assert.equal(await page.evaluate(() => !window.focused.isConnected || document.activeElement === window.focused), true);
  assert.deepEqual(await totals(page), shownTotals(server.run("segment", "a.qch", "--step", "--top", "40", "--try-weights", "fragility=30")));
  assert.equal(server.run("segment", "a.qch").weights.fragility, before.weights.fragility, "a slider decides nothing");
  await page.getByRole("button", { name: "Keep weights" }).click();
  await page.getByRole("button", { name: "Keep weights", disabled: true }).waitFor();
  assert.equal(server.run("segment", "a.qch").weights.fragility, 30);
  server.run("segment", "a.qch", "--undo");
});

windowTest("A plane is typed, nudged and flipped, and what it makes is the engine's", server, async (keep) => {
  const page = keep(await cutPage());
  await isExact(page);
  const offset = page.getByRole("textbox", { name: "Offset" });
  for (const [name, value] of [["Normal x", "1"], ["Normal y", "0"], ["Normal z", "0"]]) await page.getByRole("textbox", { name }).fill(value);
  await offset.fill("12");
  await page.keyboard.press("]"); // typed, not a key: the field has the focus
  assert.match(await offset.inputValue(), /\]/);
  await offset.fill("12");
  await offset.blur();
  await page.getByText("Exact.").waitFor();
  await page.locator("h2", { hasText: "Planes for piece" }).click();
  await page.keyboard.press("]");
  await page.keyboard.press("]");
  assert.equal(await offset.inputValue(), "14");
  await page.getByText("Exact.").waitFor();
  const { preview } = server.run("segment", "a.qch", "--preview", "1,0,0,14");
  const shown = await page.locator(".makes tbody tr").allInnerTexts();
  assert.deepEqual(shown.map((row) => row.split("\t")[0]), preview.makes.map((made) => made.side));
  preview.makes.forEach((made, i) => assert.match(shown[i], new RegExp(made.faces.toLocaleString("en-GB"))));
  await page.keyboard.press("x");
  assert.equal(await offset.inputValue(), "-14");
  await page.getByText("Exact.").waitFor();
  // Sides are named by the normal that is shown.
  const turned = await page.locator(".makes tbody tr").allInnerTexts();
  const facesOf = (texts, side) => texts.filter((row) => row.startsWith(side)).map((row) => row.split("\t").slice(1).join(" ")).sort();
  assert.deepEqual(facesOf(turned, "above"), facesOf(shown, "below"));
  await page.keyboard.press("h");
  await page.getByRole("button", { name: "Above is hidden" }).waitFor();
  await page.getByRole("button", { name: "Accept this plane" }).waitFor();
});

windowTest("A plane is tried by the setups of its pieces, with areas by state", server, async (keep) => {
  const page = keep(await cutPage());
  await isExact(page);
  await page.getByText("Exact.").waitFor();
  await page.getByRole("button", { name: "Try by setups" }).click();
  await page.getByRole("table", { name: /^Piece above/ }).waitFor();
  await page.getByRole("table", { name: /^Piece below/ }).getByText("reached").waitFor();
  const { preview } = server.run("segment", "a.qch", "--preview", "1", "--setups");
  for (const { side, areas_mm2 } of preview.milled_pieces.pieces)
    await page.getByRole("table", { name: new RegExp(`^Piece ${side}`) }).getByText(`${(areas_mm2.reached / 100).toLocaleString("en-GB", { minimumFractionDigits: 1, maximumFractionDigits: 1 })} cm2`).first().waitFor();
  await assertAccessible(page);
});

windowTest("A plane beside the piece is refused with a sentence", server, async (keep) => {
  const page = keep(await cutPage());
  await isExact(page);
  await page.getByRole("textbox", { name: "Offset" }).fill("5000");
  await page.getByRole("alert").filter({ hasText: /\w{4,}/ }).first().waitFor();
  assert.equal(server.run("segment", "a.qch").cuts.length, 0);
});

windowTest("Work shows its count and time, Stop ends it, and what is saved stays", server, async (keep) => {
  const page = keep(await cutPage());
  await isExact(page);
  await page.getByRole("button", { name: "Search on" }).click();
  await page.locator(".work strong", { hasText: "Search on" }).waitFor();
  await page.locator(".work progress").waitFor();
  await page.getByRole("button", { name: "Stop", exact: true }).click();
  await page.getByText("No work runs.").waitFor();
  await isExact(page).catch(() => undefined); // the search may have come to its end
  while (server.run("segment", "a.qch").cuts.length > 0) server.run("segment", "a.qch", "--undo");
});

windowTest("Keys are listed under ?, and the dialog gives the focus back", server, async (keep) => {
  const page = keep(await openWindow(browser, server));
  await page.getByRole("button", { name: "Keys" }).focus();
  await page.keyboard.press("?");
  await page.getByRole("dialog", { name: "Keys" }).waitFor();
  await page.getByText("No key starts a motion.").waitFor();
  await assertAccessible(page);
  await page.keyboard.press("Escape");
  await page.getByRole("dialog").waitFor({ state: "detached" });
  assert.equal(await page.evaluate(() => document.activeElement.textContent), "Keys");
});

windowTest("Check to cut by keyboard alone", server, async (keep) => {
  const page = keep(await cutPage());
  await isExact(page);
  const focusOn = async (selector) => {
    for (let i = 0; i < 80; ++i) {
      await page.keyboard.press("Tab");
      if (await page.evaluate((wanted) => document.activeElement.matches(wanted), selector)) return;
    }
    assert.fail(`Tab comes to no ${selector}`);
  };
  await focusOn(".planes input[type=radio]");
  await page.keyboard.press("ArrowDown");
  await page.getByRole("button", { name: "Accept plane 2" }).waitFor();
  await focusOn("button.main");
  await page.keyboard.press("Enter");
  await page.getByRole("button", { name: "Undo cut 1 on piece A" }).waitFor();
  await page.keyboard.press("Control+z");
  await page.getByRole("button", { name: "Redo cut 1 on piece A" }).waitFor();
});

windowTest("Back to a decision takes the later ones back, and Redo brings them", server, async (keep) => {
  server.run("segment", "a.qch", "--plane", "1,0,0,0");
  server.run("segment", "a.qch", "--plane", "0,0,1,0", "--piece", "B");
  const page = keep(await cutPage());
  await page.getByRole("button", { name: "Undo cut 2 on piece B" }).waitFor();
  await page.getByRole("button", { name: /^Back to decision .*cut 1 on piece A/ }).click();
  await page.getByRole("button", { name: "Undo cut 1 on piece A" }).waitFor();
  await page.getByRole("button", { name: "Redo cut 2 on piece B" }).waitFor();
  assert.equal(server.run("segment", "a.qch").cuts.length, 1);
  server.run("segment", "a.qch", "--undo");
});

windowTest("A piece is discarded and comes back", server, async (keep) => {
  server.run("segment", "a.qch", "--plane", "1,0,0,0");
  const page = keep(await cutPage());
  const name = server.run("segment", "a.qch").pieces[1].name;
  await page.getByRole("button", { name: new RegExp(`^${name} `) }).click();
  await page.getByRole("button", { name: `Discard ${name}` }).click();
  await page.getByText(`Discarded: ${name}`, { exact: true }).waitFor();
  assert.deepEqual(server.run("segment", "a.qch").pieces.map((piece) => piece.name).includes(name), false);
  server.run("segment", "a.qch", "--undo");
  await page.getByText(`Discarded: ${name}`, { exact: true }).waitFor({ state: "detached" });
  server.run("segment", "a.qch", "--undo");
});

for (const name of ["pieces", "jobs", "guide"])
  windowTest(`The page ${name} is accessible, before anything is prepared`, server, async (keep) => {
    const page = keep(await openWindow(browser, server, `${name}/${project}`));
    await page.locator("h1").waitFor({ state: "attached" });
    await page.getByText("No work runs.").waitFor();
    await page.waitForTimeout(300);
    await assertAccessible(page);
  });

for (const name of ["start", "check", "cut", "pieces", "jobs", "guide"])
  windowTest(`The page ${name} has no sideways scrolling at 200 % of 1280 x 800`, server, async (keep) => {
    const settings = { viewport: { width: 640, height: 400 }, deviceScaleFactor: 2, reducedMotion: "reduce" };
    const address = name === "start" ? "" : name === "check" ? "check/C1" : `${name}/${project}`;
    const page = keep(await openWindow(browser, server, address, { settings }));
    await page.getByText("No work runs.").waitFor();
    if (name === "cut") await isExact(page);
    await page.waitForTimeout(200);
    const { wide, moves } = await page.evaluate(() => ({
      wide: document.scrollingElement.scrollWidth - document.scrollingElement.clientWidth,
      moves: document.getAnimations().length,
    }));
    assert.equal(wide, 0);
    assert.equal(moves, 0);
  });

windowTest("Without WebGL 2 the page says so, and the tables cut", server, async (keep) => {
  const before = (page) =>
    page.addInitScript(() => {
      HTMLCanvasElement.prototype.getContext = () => null;
    });
  const page = keep(await cutPage({ before }));
  await page.getByText("WebGL 2 is missing or switched off. The tables beside it have the same choices.").waitFor();
  await isExact(page);
  await page.getByRole("button", { name: "Accept plane 1" }).click();
  await page.getByRole("button", { name: "Undo cut 1 on piece A" }).waitFor();
  server.run("segment", "a.qch", "--undo");
});
