// The link to the server in its rarer forms: a browser without SharedWorker, and a stream of events that cannot be resumed.

import assert from "node:assert/strict";
import { after, before } from "node:test";

import { Console, launch, openWindow, windowTest } from "./console.mjs";

const server = new Console();
let browser;
let project;

before(async () => {
  server.makeProject(2000, false);
  await server.start();
  browser = await launch();
  project = await server.projectId("a.qch");
});

after(async () => {
  await browser?.close();
  await server.end();
});

// The stream is then the window's own, and its requests are seen here.
const withoutWorker = (page) =>
  page.addInitScript(() => {
    delete globalThis.SharedWorker;
  });

windowTest("Without SharedWorker each window has a stream of its own, and decisions of another window are seen", server, async (keep) => {
  const streams = [];
  const watch = async (page) => {
    await withoutWorker(page);
    page.on("request", (request) => request.url().includes("/api/events") && streams.push(page));
  };
  const page = keep(await openWindow(browser, server, `cut/${project}`, { before: watch }));
  const other = keep(await openWindow(browser, server, `cut/${project}`, { before: watch, context: page.context() }));
  for (const window of [page, other]) {
    assert.equal(await window.evaluate(() => typeof SharedWorker), "undefined");
    await window.locator(".planes:not(.provisional) tbody tr").first().waitFor();
  }
  assert.deepEqual(new Set(streams), new Set([page, other]));
  await page.getByRole("button", { name: "Accept plane 1" }).click();
  await other.getByRole("button", { name: "Undo cut 1 on piece A" }).waitFor();
  // No tick is missed: nothing is called silent.
  await page.waitForTimeout(7000);
  assert.equal(await page.getByText(/The server is silent/).count(), 0);
  server.run("segment", "a.qch", "--undo");
  for (const window of [page, other]) await window.getByRole("button", { name: "Redo cut 1 on piece A" }).waitFor();
});

windowTest("After a reset the page reads the state: what it has missed is shown", server, async (keep) => {
  const asked = [];
  let isForgotten = false;
  let resets = 0;
  const watch = async (page) => {
    await withoutWorker(page);
    page.on("request", (request) => asked.push(new URL(request.url()).pathname));
    // The server is asked for an event that it has never had, as after so many that the kept ones do not reach back.
    await page.route("**/api/events*", (route) => {
      const url = new URL(route.request().url());
      if (!isForgotten || !url.searchParams.has("after")) return route.continue();
      ++resets;
      url.searchParams.set("after", url.searchParams.get("after").replace(/-\d+$/, "-999999"));
      return route.continue({ url: url.href });
    });
  };
  const page = keep(await openWindow(browser, server, `cut/${project}`, { before: watch }));
  await page.getByRole("button", { name: "Redo cut 1 on piece A" }).waitFor();
  const readings = () => asked.filter((path) => path === "/api/state").length;
  const before = readings();
  isForgotten = true;
  server.server.kill("SIGSTOP");
  server.run("segment", "a.qch", "--redo"); // while the page hears nothing
  await page.getByText(/The server is silent/).waitFor();
  await page.waitForTimeout(6000); // until its stream is given up, ten seconds after the last event
  server.server.kill("SIGCONT");
  await page.getByRole("button", { name: "Undo cut 1 on piece A" }).waitFor();
  await page.getByText(/The server is silent/).waitFor({ state: "detached" });
  assert.equal(resets, 1);
  assert.equal(readings(), before + 1);
  // It goes on from there.
  server.run("segment", "a.qch", "--undo");
  await page.getByRole("button", { name: "Redo cut 1 on piece A" }).waitFor();
  assert.equal(readings(), before + 1);
});
