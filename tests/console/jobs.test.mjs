// From Prepare to a job in the simulated cell that the server starts, which asks; Hold, Resume; the guide.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { after, before } from "node:test";

import { assertAccessible, Console, launch, openWindow, windowTest } from "./console.mjs";

const server = new Console();
let browser;
let project;

before(async () => {
  server.makeProject(4000);
  server.run("segment", "a.qch", "--accept", "1");
  await server.start("127.0.0.1:0", "--cell-sim");
  browser = await launch();
  project = await server.projectId("a.qch");
});

after(async () => {
  await browser?.close();
  await server.end();
});

const open = (name) => openWindow(browser, server, `${name}/${project}`);
const inQueue = (page, words) => page.getByRole("cell", { name: words }).first().waitFor();

windowTest("Prepare makes jobs, and their table says what the command line says", server, async (keep) => {
  const page = keep(await open("jobs"));
  await page.getByRole("button", { name: "Prepare" }).click();
  await page.locator(".work strong", { hasText: "Prepare" }).waitFor();
  await page.getByRole("checkbox", { name: "Hand over piece B" }).waitFor();
  const made = server.run("prepare", "a.qch");
  for (const piece of made.pieces) await page.getByRole("checkbox", { name: `Hand over piece ${piece.name}` }).waitFor();
  await assertAccessible(page);
});

windowTest("Verify shows its findings, and a dry run its ends", server, async (keep) => {
  const page = keep(await open("jobs"));
  await page.getByRole("checkbox", { name: "Hand over piece B" }).waitFor();
  await page.getByRole("button", { name: "Verify" }).click();
  await page.getByText("Not every job is verified.").waitFor();
  await page.getByText("The job holds no robot program: the cell file describes no machine.").first().waitFor();
  await page.getByRole("button", { name: "Dry run" }).click();
  await page.getByText("Dry run: every job ran to its end").waitFor();
  await assertAccessible(page);
});

windowTest("The surface of a piece is shown by state, with words beside the colours", server, async (keep) => {
  const page = keep(await open("pieces"));
  await page.locator('canvas[data-solids="2"]').waitFor();
  await page.getByRole("button", { name: "Compare all bases" }).click();
  await page.getByRole("table", { name: "Tool orientations" }).waitFor();
  await page.getByRole("button", { name: "Surface by state" }).click();
  await page.getByRole("list", { name: "Colours of the surface" }).getByText("steep").waitFor();
  const setup = server.run("setup", "a.qch", "--piece", "B").pieces[0].setups;
  assert.equal(await page.getByRole("table", { name: "Bases of piece B" }).getByRole("row").count(), setup.length + 1);
  await assertAccessible(page);
});

windowTest("A real cell is named by hand: the focus is on Cancel, and Enter does nothing before", server, async (keep) => {
  const page = keep(await open("jobs"));
  let handed = 0;
  await page.route("**/dispatches", (route) => {
    ++handed;
    return route.abort();
  });
  // No real cell is here: of the server's own plan the kind alone is changed, for this window.
  await page.route("**/plans", async (route) => {
    const response = await route.fetch();
    return route.fulfill({ response, json: { ...(await response.json()), kind: "real" } });
  });
  await page.getByRole("checkbox", { name: "Hand over piece B" }).check();
  await page.getByRole("button", { name: "Hand over B" }).click();
  const dialog = page.getByRole("dialog", { name: "Hand over to the REAL CELL foam-1" });
  await dialog.waitFor();
  assert.equal(await page.evaluate(() => document.activeElement.textContent), "Cancel");
  const go = dialog.getByRole("button", { name: "Hand over to the real cell" });
  const name = dialog.getByRole("textbox", { name: "Type the name of the cell" });
  for (const typed of ["", "foam", "foam-1 ", "FOAM-1"]) {
    await name.fill(typed);
    await name.press("Enter");
    assert.equal(await go.isDisabled(), true, typed);
  }
  await assertAccessible(page);
  await name.fill("foam-1");
  await name.press("Enter");
  assert.equal(handed, 0);
  assert.equal(await go.isEnabled(), true);
  await dialog.getByRole("button", { name: "Cancel" }).click();
  await dialog.waitFor({ state: "detached" });
  assert.equal(handed, 0);
});

windowTest("A job goes to the simulated cell, which asks; Hold by key from another window; Resume; Stop asks once", server, async (keep) => {
  const page = keep(await open("jobs"));
  const other = keep(await openWindow(browser, server, `cut/${project}`, { context: page.context() }));
  await page.locator("footer").getByText("SIMULATED: nothing moves").waitFor();
  await page.getByRole("checkbox", { name: "Hand over piece B" }).check();
  await page.getByRole("button", { name: "Hand over B" }).click();
  await page.getByRole("dialog", { name: /SIMULATED: nothing moves/ }).waitFor();
  assert.equal(await page.evaluate(() => document.activeElement.textContent), "Cancel");
  await page.getByRole("button", { name: "Hand over, simulated" }).click();
  await inQueue(page, /asks at the cell/);
  await assertAccessible(page);
  await page.getByRole("button", { name: "Consent: yes" }).click();
  await inQueue(page, /carving/);
  await other.locator("footer").getByText(/Execute|Starting/).waitFor();
  await other.keyboard.press("F9");
  await inQueue(page, /held/);
  await page.locator("footer").getByText("Held", { exact: false }).first().waitFor();
  await page.getByRole("button", { name: "Resume" }).click();
  await page.getByRole("button", { name: "Consent: yes" }).click();
  await inQueue(page, /carving/);
  await page.locator("main").getByRole("button", { name: "Stop", exact: true }).click();
  const dialog = page.getByRole("dialog", { name: /^Stop the job in/ });
  await dialog.waitFor();
  assert.equal(await page.evaluate(() => document.activeElement.textContent), "Cancel");
  await assertAccessible(page);
  await dialog.getByRole("button", { name: "Stop" }).click();
  await inQueue(page, /ended/);
});

windowTest("The guide is made, opens in a window of its own, and is saved", server, async (keep) => {
  const page = keep(await open("guide"));
  await page.getByRole("button", { name: "Make the guide" }).click();
  await page.getByText(/The guide is made: 2 pieces/).waitFor();
  const step = page.getByRole("table", { name: "Steps of the assembly" }).getByRole("row").nth(1);
  assert.match(await step.innerText(), /^1\s+(B\s+C|C\s+B)\s+(B-C|C-B)\s*$/);
  await assertAccessible(page);
  const [popup] = await Promise.all([page.waitForEvent("popup"), page.getByRole("button", { name: "Open to print" }).click()]);
  await popup.waitForURL(/\/api\/t\//);
  await popup.waitForLoadState();
  assert.match(await popup.locator("body").innerText(), /piece/i);
  const [download] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "Save the PDF" }).click()]);
  assert.equal(download.suggestedFilename(), "a-guide.pdf");
  assert.deepEqual(readFileSync(await download.path()), readFileSync(join(server.projects, "a.qch/guide.pdf")));
  const [glb] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "Save the GLB" }).click()]);
  assert.equal(glb.suggestedFilename(), "a-guide.glb");
  const bytes = readFileSync(await glb.path());
  assert.deepEqual(bytes, readFileSync(join(server.projects, "a.qch/guide.glb")));
  assert.equal(bytes.toString("latin1", 0, 4), "glTF");
  assert.equal(bytes.readUInt32LE(8), bytes.length, "it is whole");
});
