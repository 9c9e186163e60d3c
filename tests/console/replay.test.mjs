// A job is replayed on the page, by keyboard alone; its time is that of the proof.

import assert from "node:assert/strict";
import { copyFileSync, rmSync } from "node:fs";
import { join } from "node:path";
import { after, before } from "node:test";
import { fileURLToPath } from "node:url";

import { assertAccessible, Console, launch, openWindow, pictures, pictureSettings, savePicture, windowTest } from "./console.mjs";

const cells = fileURLToPath(new URL("../../cells", import.meta.url));
const server = new Console();
let browser;
let project;

// A small vertebra, so that its programs are made in seconds.
before(async () => {
  server.run("sample", "vertebra", "--faces", "2000", "-o", "a.ply");
  copyFileSync(join(cells, "kr60-ha.toml"), join(server.projects, "kr60-ha.toml"));
  server.run("segment", "a.ply", "--units", "mm", "--scale", "0.25", "--size-ok", "--cell", "kr60-ha.toml", "-o", "a.qch");
  server.run("prepare", "a.qch");
  await server.start("127.0.0.1:0");
  browser = await launch();
  project = await server.projectId("a.qch");
});

after(async () => {
  await browser?.close();
  await server.end();
});

const open = () => openWindow(browser, server, `jobs/${project}`, { settings: pictureSettings });
const figure = (page, name) => page.getByRole("table", { name: "Where the program is" }).getByRole("row", { name: new RegExp(`^${name} `) }).getByRole("cell");
const canvas = (page, label) => page.getByRole("img", { name: label });

async function replay(page, piece) {
  const button = page.getByRole("button", { name: `Replay piece ${piece}` });
  await button.focus();
  await page.keyboard.press("Enter");
  const region = page.getByRole("region", { name: `Replay of piece ${piece}` });
  await region.waitFor();
  return region;
}

windowTest("A job is replayed by keyboard: slider, play, stages, the deviation at the end", server, async (keep) => {
  const page = keep(await open());
  const region = await replay(page, "C");
  await canvas(page, /^Stage 0 of \d+ of piece C, at 0 s/).waitFor();
  await page.locator('.replay canvas[data-solids="1"]').waitFor();
  const slider = region.getByRole("slider", { name: "Machine time" });
  const verified = server.run("verify", "a.qch", "--piece", "C").jobs[0];
  const proven = verified.figures.time_s ?? verified.figures.find?.((one) => one.key === "time_s").value;
  assert.equal(Number(await slider.getAttribute("max")), 1000 * Math.ceil(proven));

  await slider.focus();
  for (let i = 0; i < 5; ++i) await page.keyboard.press("ArrowRight");
  assert.equal(await figure(page, "Passed").innerText(), "5 s");
  assert.match(await figure(page, "Program").innerText(), /\.src, line \d+/);
  assert.match(await figure(page, "Tool").innerText(), /^\d+ \(.+\), orientation \d+$/);
  const stage = Number.parseInt(await figure(page, "Stage").innerText(), 10);
  await page.keyboard.press(".");
  assert.equal(Number.parseInt(await figure(page, "Stage").innerText(), 10), stage + 1);
  await canvas(page, new RegExp(`^Stage ${stage + 1} of`)).waitFor();
  assert.ok(Number(await page.locator(".replay canvas").getAttribute("data-arrows")) === 1, "the tool is there");
  await page.keyboard.press(",");
  assert.equal(Number.parseInt(await figure(page, "Stage").innerText(), 10), stage);

  const before = Number(await slider.inputValue());
  await page.keyboard.press("p");
  await region.getByRole("button", { name: "Pause", exact: true }).waitFor();
  await page.waitForFunction((from) => Number(document.querySelector(".replay input[type=range]").value) > from, before + 10_000);
  await page.keyboard.press("p");
  await region.getByRole("button", { name: "Play", exact: true }).waitFor();
  const paused = await slider.inputValue();
  await page.waitForTimeout(400);
  assert.equal(await slider.inputValue(), paused, "it stands");

  if (pictures) {
    for (let i = 0; i < 10; ++i) await page.keyboard.press(".");
    await region.evaluate((all) => all.scrollIntoView());
    await page.waitForTimeout(1000); // until the stage is there
    await savePicture(page, "replay");
  }
  await slider.focus();
  await page.keyboard.press("End");
  assert.equal(await figure(page, "Left").innerText(), "0 s");
  await canvas(page, /^The deviation of piece C/).waitFor();
  await region.getByRole("list", { name: "Colours of the deviation" }).getByText("given up by the program").waitFor();
  await assertAccessible(page);
  const coloured = region.getByRole("button", { name: "Deviation" });
  await coloured.focus();
  await page.keyboard.press("Enter");
  await canvas(page, /^Stage \d+ of \d+ of piece C/).waitFor();
  await region.getByRole("button", { name: "Close the replay" }).focus();
  await page.keyboard.press("Enter");
  await region.waitFor({ state: "detached" });
});

windowTest("A job whose proof is negative is replayed, and it is said", server, async (keep) => {
  const page = keep(await open());
  await replay(page, "B");
  await page.getByText("The proof of this job is negative.").waitFor();
});

windowTest("A job that is not proven is not replayed: the page says what to do", server, async (keep) => {
  rmSync(join(server.projects, "a.qch/jobs/C.verdict.json"));
  const page = keep(await open());
  await page.getByRole("button", { name: "Replay piece C" }).click();
  await page.getByText(/The job of piece C is not proven/).waitFor();
});
