// Starts `qchopper serve` in a folder of its own and Chromium, for the tests of the pages.
//
// A test that fails leaves a picture, what the page and the server said, and the page's text in build/console/failures. There are
// no second tries. Nothing of the user's own state is touched: the server gets state folders in the same temporary folder.

import assert from "node:assert/strict";
import { spawn, spawnSync } from "node:child_process";
import { createHash } from "node:crypto";
import { copyFileSync, existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { fileURLToPath } from "node:url";

const root = fileURLToPath(new URL("../..", import.meta.url));
const modules = createRequire(join(root, "build/console/package.json"));
const { chromium } = modules("playwright-core");
const axe = readFileSync(modules.resolve("axe-core/axe.min.js"), "utf8");

export const program = process.env.QCHOPPER ?? join(root, "build/release/qchopper");
const browserProgram = process.env.CHROMIUM ?? "/usr/bin/chromium";
const failures = join(root, "build/console/failures");

// Of whatever a test waits for: for a machine with much else to do. What has to be quick is measured apart.
const LIMIT_MS = 120_000;

// llvmpipe: three to five times faster than Chromium's own renderer.
const ARGS = ["--use-gl=angle", "--use-angle=gl-egl", "--ignore-gpu-blocklist"];

export class Console {
  constructor() {
    this.folder = mkdtempSync(join(tmpdir(), "pages-test-"));
    this.projects = join(this.folder, "projects");
    mkdirSync(this.projects);
    this.log = "";
  }

  // Runs the program in the folder; its JSON document. While the server's worker has the project the program ends with 75:
  // try again later.
  run(...words) {
    for (let i = 0; ; ++i) {
      const { stdout, stderr, status } = spawnSync(program, [...words, "--json"], { cwd: this.projects, env: this.env(), encoding: "utf8", maxBuffer: 1 << 28 });
      if (status === 75 && i < 60) {
        spawnSync("sleep", ["0.5"]);
        continue;
      }
      assert.ok(status === 0 || status === 1, `${words.join(" ")}: ${status}\n${stderr}`);
      return JSON.parse(stdout);
    }
  }

  // The project a.qch of a sample vertebra, of foam-1 with `isOfCell`.
  makeProject(faces, isOfCell = true) {
    this.run("sample", "vertebra", "--faces", String(faces), "-o", "a.ply");
    if (isOfCell) copyFileSync(join(root, "cells/foam-1.toml"), join(this.projects, "foam-1.toml"));
    this.run("segment", "a.ply", "--units", "mm", ...(isOfCell ? ["--cell", "foam-1.toml"] : []), "-o", "a.qch");
  }

  // The id of a project by which pages and requests name it.
  async projectId(name) {
    const headers = { Authorization: `Bearer ${new URL(this.link).hash.slice("#key=".length)}` };
    const files = await (await fetch(`${this.origin}/api/files`, { headers })).json();
    return files.projects.find((one) => one.name === name).id;
  }

  env() {
    return { ...process.env, XDG_STATE_HOME: join(this.folder, "state"), XDG_CACHE_HOME: join(this.folder, "cache"), XDG_RUNTIME_DIR: this.folder };
  }

  async start(listen = "127.0.0.1:0", ...options) {
    this.server = spawn(program, ["serve", ".", "--listen", listen, ...options], { cwd: this.projects, env: this.env() });
    this.server.stderr.on("data", (data) => (this.log += data));
    this.link = await new Promise((done, fail) => {
      let out = "";
      this.server.stdout.on("data", (data) => {
        out += data;
        const link = /http:\S+/.exec(out);
        if (link) done(link[0]);
      });
      this.server.on("exit", (status) => fail(new Error(`the server ended with ${status}: ${this.log}`)));
    });
    this.origin = new URL(this.link).origin;
    const hello = await (await fetch(`${this.origin}/api/hello`)).json();
    const ours = createHash("sha256").update(readFileSync(join(root, "app/console/page/dist/page.js"))).digest("hex");
    assert.equal(hello.page, ours, "the program holds another page: build it");
  }

  async kill(signal = "SIGKILL") {
    const ended = new Promise((done) => this.server.on("exit", done));
    this.server.kill(signal);
    await ended;
  }

  async end() {
    if (this.server?.exitCode === null && this.server.signalCode === null) await this.kill("SIGTERM");
    rmSync(this.folder, { recursive: true, force: true });
  }
}

export async function launch(...more) {
  assert.ok(existsSync(browserProgram), `${browserProgram} is missing: scripts/install console`);
  return chromium.launch({ executablePath: browserProgram, timeout: LIMIT_MS, args: [...ARGS, ...(process.getuid() === 0 ? ["--no-sandbox"] : []), ...more] });
}

// A window. What it must never do is kept in `faults`: errors of scripts, violations of the policy, requests elsewhere.
export async function openWindow(browser, server, address = "", options = {}) {
  const context = options.context ?? (await browser.newContext({ viewport: { width: 1280, height: 800 }, ...options.settings }));
  context.setDefaultTimeout(LIMIT_MS);
  const page = await context.newPage();
  page.faults = [];
  page.said = [];
  page.on("pageerror", (error) => page.faults.push(error.stack ?? error.message));
  page.on("console", (message) => {
    page.said.push(`${message.type()}: ${message.text()}`);
    if (/Content Security Policy/.test(message.text())) page.faults.push(message.text());
  });
  page.on("request", (request) => {
    if (!request.url().startsWith(server.origin) && !/^(blob|data|about):/.test(request.url())) page.faults.push(`asked ${request.url()}`);
  });
  if (options.before) await options.before(page);
  await page.goto(`${server.link}&antialias=off${address === "" ? "" : `&page=${encodeURIComponent(address)}`}`);
  return page;
}

export async function assertAccessible(page) {
  const found = await page.evaluate(
    ([text]) => {
      // Evaluated here and not by the page, whose policy forbids it.
      if (!globalThis.axe) (0, eval)(text);
      return globalThis.axe.run(document, { runOnly: ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"] });
    },
    [axe],
  );
  const words = found.violations.map((one) => `${one.id}: ${one.help}\n  ${one.nodes.map((node) => node.html).join("\n  ")}`);
  assert.deepEqual(words, []);
}

// A test with windows: they are closed after it, and pictured first where it fails.
export function windowTest(name, server, run) {
  test(name, async (t) => {
    const pages = [];
    const keep = (page) => {
      pages.push(page);
      return page;
    };
    try {
      await run(keep, t);
      for (const page of pages) assert.deepEqual(page.faults, []);
    } catch (error) {
      await keepFailure(name, pages, server, error);
      throw error;
    } finally {
      for (const page of pages) await page.context().close();
    }
  });
}

async function keepFailure(name, pages, server, error) {
  const folder = join(failures, name.replace(/[^\w]+/g, "-"));
  mkdirSync(folder, { recursive: true });
  for (const [i, page] of pages.entries()) {
    await page.screenshot({ path: join(folder, `window-${i}.png`) }).catch(() => undefined);
    const text = await page.locator("body").innerText().catch(() => "");
    writeFileSync(join(folder, `window-${i}.txt`), [page.url(), ...page.faults, ...page.said, text].join("\n"));
  }
  writeFileSync(join(folder, "server.txt"), `${error.stack}\n\n${server?.log ?? ""}`);
}

// The folder for pictures of docs/user/console.md (scripts/console pictures); undefined: none are asked for.
export const pictures = process.env.CONSOLE_PICTURES;
export const pictureSettings = pictures ? { viewport: { width: 1200, height: 720 }, deviceScaleFactor: 0.75 } : {};

export async function savePicture(page, name) {
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  writeFileSync(join(pictures, `console-${name}.png`), await page.screenshot());
}
