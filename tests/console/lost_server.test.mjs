// A server that falls silent, ends, and is started again: what the page shows, disables, and never sends.

import assert from "node:assert/strict";
import { after, before } from "node:test";

import { assertAccessible, Console, launch, openWindow, windowTest } from "./console.mjs";

const server = new Console();
let browser;

before(async () => {
  server.run("sample", "vertebra", "--faces", "2000", "-o", "a.ply");
  await server.start();
  browser = await launch();
});

after(async () => {
  await browser?.close();
  await server.end();
});

windowTest("A server that is stopped for a while is shown as silent, and comes back by itself", server, async (keep) => {
  const page = keep(await openWindow(browser, server));
  await page.getByRole("button", { name: "Check a.ply" }).waitFor();
  server.server.kill("SIGSTOP");
  await page.getByText(/The server is silent/).waitFor();
  await page.getByText("Hold may not arrive: press the red button at the cell.").waitFor();
  assert.equal(await page.getByRole("button", { name: "Check a.ply" }).isDisabled(), true);
  await assertAccessible(page);
  server.server.kill("SIGCONT");
  await page.getByText(/The server is silent/).waitFor({ state: "detached" });
  assert.equal(await page.getByRole("button", { name: "Check a.ply" }).isEnabled(), true);
});

windowTest("A request on its way when the server is another one is not sent", server, async (keep) => {
  // The window reads the events itself, so that what it asks passes through its own fetch.
  const before = (page) => page.addInitScript(() => delete globalThis.SharedWorker);
  const page = keep(await openWindow(browser, server, "", { before }));
  const check = page.getByRole("button", { name: "Check a.ply" });
  await check.waitFor();
  const port = new URL(server.link).port;
  // Requests wait until the other server is there. Those of the stream of events, which alone can be aborted, never get
  // there: the page must learn of the other server by its request.
  await page.evaluate(() => {
    const ask = window.fetch;
    const isOtherThere = new Promise((done) => (window.letGo = done));
    window.sent = [];
    window.fetch = async (path, options) => {
      const isOfStream = options?.signal !== undefined;
      window.sent.push({ path, isOfStream, key: options?.headers?.Authorization ?? null });
      await (isOfStream ? new Promise(() => undefined) : isOtherThere);
      return ask(path, options);
    };
  });
  await server.kill();
  await page.waitForFunction(() => window.sent.some((one) => one.isOfStream));
  await check.click();
  await page.waitForFunction(() => window.sent.some((one) => !one.isOfStream));
  await server.start(`127.0.0.1:${port}`);
  await page.evaluate(() => window.letGo());
  await page.getByText("The server was started again and has a new key").first().waitFor();
  const sent = await page.evaluate(() => window.sent);
  assert.deepEqual(sent.filter((one) => one.key !== null), []);
  assert.deepEqual(sent.filter((one) => one.path !== "/api/hello"), []);
});

windowTest("A server that was started again gets no key, and the page asks for its link", server, async (keep) => {
  const page = keep(await openWindow(browser, server));
  await page.getByRole("button", { name: "Check a.ply" }).waitFor();
  const port = new URL(server.link).port;
  await server.kill();
  const sent = [];
  page.on("request", (request) => sent.push(request));
  await server.start(`127.0.0.1:${port}`);
  await page.getByText("The server was started again and has a new key. Open the link that it printed.").waitFor();
  await page.reload();
  await page.getByText("The server was started again and has a new key. Open the link that it printed.").waitFor();
  assert.ok(sent.some((request) => request.url().endsWith("/api/hello")));
  for (const request of sent) assert.equal((await request.allHeaders()).authorization, undefined, request.url());
  // Its link makes the same window whole again.
  await page.goto(server.link);
  await page.getByRole("button", { name: "Check a.ply" }).waitFor();
});
