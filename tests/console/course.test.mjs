// The whole course by keyboard alone: from a scan without units to a job in the simulated cell, with one undo and one Hold, the
// guide opened, and the server killed twice on the way. With CONSOLE_PICTURES=FOLDER it writes the pictures of
// docs/user/console.md there (scripts/console pictures).
//
// The mouse is not touched: what is focused is found by Tab, pressed by Enter or Space, and chosen by arrows.

import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { copyFileSync, existsSync, mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before } from "node:test";

import { Console, launch, openWindow, pictures, pictureSettings, program, savePicture, windowTest } from "./console.mjs";

const server = new Console();
const FACES = pictures ? "30000" : "4000";
let browser;
let cell; // the process of the simulated cell, which outlives the server
let cellAddress;

before(async () => {
  server.run("sample", "femur", "--faces", FACES, "-o", "a.ply");
  copyFileSync(new URL("../../cells/foam-1.toml", import.meta.url), join(server.projects, "foam-1.toml"));
  mkdirSync(join(server.folder, "drop"));
  writeFileSync(join(server.folder, "key"), "0123456789abcdef0123456789abcdef\n", { mode: 0o600 });
  await startCell();
  await start();
  browser = await launch();
});

after(async () => {
  await browser?.close();
  cell?.kill("SIGKILL");
  await server.end();
});

async function startCell() {
  cell = spawn(program, ["cell-sim", "--listen", "127.0.0.1:0", "--consent", "ask", "--drop", join(server.folder, "drop"), "--speed", "4000", "--json"], {
    env: server.env(),
    stdio: ["pipe", "pipe", "ignore"],
  });
  cellAddress = await new Promise((done, fail) => {
    let out = "";
    cell.stdout.on("data", (data) => {
      out += data;
      const found = /"listening":\s*"([^"]+)"/.exec(out);
      if (found) done(found[1]);
    });
    cell.on("exit", (code) => fail(new Error(`the simulated cell ended with ${code}`)));
  });
}

// With the same address and key each time, so that the window is of the same server to its person.
function start() {
  const port = server.link ? new URL(server.link).port : "0";
  return server.start(`127.0.0.1:${port}`, "--key-file", join(server.folder, "key"), "--to", cellAddress, "--drop", join(server.folder, "drop"));
}

// A window that is worked by keys.
class Keys {
  constructor(page) {
    this.page = page;
  }

  // Tab until what is focused is the wanted element.
  async to(locator) {
    await locator.first().waitFor();
    const wanted = await locator.first().elementHandle();
    for (let i = 0; i < 250; ++i) {
      if (await wanted.evaluate((element) => element === document.activeElement)) return;
      await this.page.keyboard.press("Tab");
    }
    assert.fail(`Tab does not come to ${locator}`);
  }

  async press(locator, key = "Enter") {
    await locator.and(this.page.locator(":not(:disabled)")).first().waitFor();
    await this.to(locator);
    await this.page.keyboard.press(key);
  }

  button(name, options = {}) {
    return this.page.getByRole("button", { name, ...options });
  }

  async type(locator, text) {
    await this.to(locator);
    await this.page.keyboard.press("Control+a");
    await this.page.keyboard.type(text);
  }

  // A choice of a list by its first letters, as a browser takes them.
  async choose(locator, text) {
    await locator.locator("option", { hasText: text }).first().waitFor({ state: "attached" });
    await this.to(locator);
    await this.page.keyboard.type(text);
    assert.equal(await locator.evaluate((select) => select.selectedOptions[0].textContent), text);
  }

  async picture(name) {
    if (!pictures) return;
    await this.page.evaluate(() => document.activeElement.blur());
    await savePicture(this.page, name);
  }
}

// The person at the cell says yes as soon as it asks, which the page may show a moment before or after.
async function consent(page, words) {
  const seen = inQueue(page, words);
  const asked = setInterval(() => cell.stdin.write("consent yes\n"), 500);
  await seen.finally(() => clearInterval(asked));
}

const inQueue = (page, words) => page.getByRole("table", { name: "Queue" }).getByRole("cell", { name: words }).first().waitFor();

// The server is killed, is missed by the page, and is there again with another identity: the window asks for its link.
async function killAndComeBack(page) {
  await server.kill();
  await page.getByText(/The server does not answer|The server is silent/).first().waitFor();
  await start();
  await page.getByText("The server was started again and has a new key. Open the link that it printed.").waitFor();
  const address = await page.evaluate(() => location.hash.slice(2));
  await page.goto(`${server.link}&antialias=off&page=${encodeURIComponent(address)}`);
}

windowTest("From a scan to a carved piece and its guide by keyboard alone, with the server killed twice on the way", server, async (keep) => {
  const settings = { viewport: { width: 1200, height: 720 }, ...pictureSettings };
  let pointers = 0;
  const watch = async (page) => {
    await page.exposeFunction("pointerUsed", () => ++pointers);
    await page.addInitScript(() => addEventListener("pointerdown", () => globalThis.pointerUsed(), { capture: true }));
  };
  const page = keep(await openWindow(browser, server, "", { settings, before: watch }));
  const keys = new Keys(page);

  // Open, units, repair.
  await keys.button("Check a.ply").waitFor();
  await keys.picture("start");
  await keys.press(keys.button("Check a.ply"));
  await keys.press(keys.button(/^mm /));
  await page.getByText("Units: mm, as chosen").waitFor();
  await page.locator('canvas[data-solids="1"]').waitFor();
  await keys.picture("check");
  await keys.press(page.locator("summary", { hasText: "Repair" }));
  await keys.press(keys.button("Repair", { exact: true }));
  await page.getByText("closed: a solid").waitFor();
  await keys.press(keys.button("Show the scan as it is"));

  // Paint: the middle of the view, turned by arrows in between.
  await keys.press(keys.button("must not be cut"));
  await keys.press(keys.button("Paint the middle of the view"));
  await page.getByText("1 stroke.").waitFor();
  await page.keyboard.press("ArrowLeft");
  await page.keyboard.press("ArrowLeft");
  await page.keyboard.press("Enter");
  await page.getByText("2 strokes.").waitFor();
  await keys.press(keys.button("Remove stroke 1"));
  await page.getByText("1 stroke.").waitFor();

  // Begin.
  await keys.type(page.getByRole("textbox", { name: "Name of the project" }), "Fémur/1");
  await page.getByText("Leave out “/”: a name has letters, digits, spaces, full stops, _ and -.").waitFor();
  await keys.type(page.getByRole("textbox", { name: "Name of the project" }), "Fémur 3");
  await keys.choose(page.getByRole("combobox", { name: "Cell", exact: true }), "foam-1");
  await keys.press(keys.button("Begin"));
  await page.waitForURL(/#\/cut\//);
  await page.locator(".planes:not(.provisional) tbody tr").first().waitFor();

  // Cut by a plane of the table that is moved; weights; undo; the server is killed, and what was answered is there.
  await keys.to(page.locator(".planes input[type=radio]"));
  await page.keyboard.press("ArrowDown");
  await page.getByText("Exact.").waitFor();
  await page.keyboard.press("]");
  await keys.button("Accept this plane").waitFor();
  await page.getByText("Exact.").waitFor();
  await keys.picture("cut");
  await keys.press(keys.button("Accept this plane"));
  await keys.button("Undo cut 1 on piece A").waitFor();
  await killAndComeBack(page);
  await keys.button("Undo cut 1 on piece A").waitFor();
  await keys.press(page.locator("details.weights summary"));
  await keys.type(page.getByRole("textbox", { name: "Fragility" }), "7");
  await keys.press(keys.button("Keep weights"));
  await keys.button(/^Undo .*weights/).waitFor();
  await page.locator("h1").waitFor({ state: "attached" });
  await keys.to(keys.button("Keys"));
  await page.keyboard.press("Control+z");
  await keys.button("Undo cut 1 on piece A").waitFor();
  const { cuts, weights } = server.run("segment", "Fémur 3.qch");
  assert.equal(cuts.length, 1);
  assert.notEqual(weights.fragility, 7);

  // Prepare, dry run.
  await keys.press(page.getByRole("link", { name: "Jobs" }));
  await keys.press(keys.button("Prepare"));
  const choice = page.getByRole("checkbox", { name: /^Hand over piece / }).first(); // of what Prepare may have cut further
  await choice.waitFor();
  const piece = (await choice.getAttribute("aria-label")).split(" ").at(-1);
  await keys.press(keys.button("Dry run"));
  await page.getByText("Dry run: every job ran to its end").waitFor();
  if (pictures) {
    await keys.press(page.getByRole("link", { name: "Pieces" }));
    await page.locator("canvas[data-arrows]:not([data-arrows='0'])").waitFor();
    await page.keyboard.press("f");
    await keys.picture("pieces");
    await keys.press(page.getByRole("link", { name: "Jobs" }));
  }

  // Hand over to the simulated cell, which asks; Hold by F9; the server is killed and follows again; Resume.
  await keys.press(choice, "Space");
  await keys.press(page.getByRole("checkbox", { name: "accept what is out of reach" }), "Space");
  await keys.press(keys.button(`Hand over ${piece}`));
  await keys.press(keys.button("Hand over, simulated"));
  await inQueue(page, /asks at the cell/);
  await keys.picture("jobs");
  await consent(page, /carving/);
  await page.keyboard.press("F9");
  await inQueue(page, /held/);
  await killAndComeBack(page);
  await inQueue(page, /held/);
  await keys.press(keys.button("Resume"));
  await consent(page, /carving|ended/);
  await inQueue(page, /ended/);
  const carved = page.getByRole("table", { name: "Jobs of the journals of cells" }).getByRole("row").nth(1);
  await carved.getByText("complete").waitFor();
  assert.equal((await carved.innerText()).split("\t")[0], piece);
  assert.equal(server.run("cell", "status", "--to", cellAddress).store.starts_total, 1);

  // The guide.
  await keys.press(page.getByRole("link", { name: "Guide" }));
  await keys.press(keys.button("Make the guide"));
  await page.getByText(/The guide is made: \d+ pieces/).waitFor();
  await keys.picture("guide");
  const popup = page.waitForEvent("popup");
  await keys.press(keys.button("Open to print"));
  const guide = await popup;
  await guide.waitForURL(/\/api\/t\//);
  await guide.waitForLoadState();
  assert.match(await guide.locator("body").innerText(), /Assembly guide: a\.ply[^]*Step 1 of/);
  assert.ok(existsSync(join(server.projects, "Fémur 3.qch/guide.pdf")));
  assert.equal(pointers, 0, "a pointer was used");
});
