// The 3D view in Chromium: the pieces that the server sends are drawn, turn by keys, are picked, and the plane is dragged.

import assert from "node:assert/strict";
import { after, before } from "node:test";

import { Console, launch, openWindow, windowTest } from "./console.mjs";

const server = new Console();
let browser;
let project;

before(async () => {
  server.makeProject(8000);
  server.run("segment", "a.qch", "--accept", "1");
  await server.start();
  browser = await launch();
  project = await server.projectId("a.qch");
});

after(async () => {
  await browser?.close();
  await server.end();
});

const canvasOf = (page) => page.locator("canvas[role=img]");
const drawn = (page, solids) => page.locator(`canvas[data-solids="${solids}"]`).waitFor();

// The picture of the view, as colours: how many there are, and the one in the middle.
async function colours(page) {
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  const png = (await canvasOf(page).screenshot()).toString("base64");
  return page.evaluate(async (text) => {
    const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
    const image = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
    const canvas = new OffscreenCanvas(image.width, image.height).getContext("2d");
    canvas.drawImage(image, 0, 0);
    const { data } = canvas.getImageData(0, 0, image.width, image.height);
    const all = new Set();
    let sum = 0;
    for (let i = 0; i < data.length; i += 4) {
      const colour = (data[i] << 16) | (data[i + 1] << 8) | data[i + 2];
      all.add(colour);
      sum = (Math.imul(sum, 31) + colour) | 0;
    }
    return { count: all.size, sum, width: image.width, height: image.height };
  }, png);
}

windowTest("The pieces are drawn, and keys turn, fit and show them from three sides", server, async (keep) => {
  const page = keep(await openWindow(browser, server, `pieces/${project}`));
  await drawn(page, 2);
  assert.match(await canvasOf(page).getAttribute("aria-label"), /2 pieces of a\.qch/);
  const first = await colours(page);
  assert.ok(first.count > 50, `${first.count} colours`);
  const seen = new Set([first.sum]);
  for (const key of ["1", "3", "7", "ArrowDown", "ArrowLeft", "ArrowDown", "+", "-", "f"]) {
    await page.keyboard.press(key);
    const now = await colours(page);
    assert.ok(now.count > 50, `${now.count} colours after ${key}`);
    if (key !== "f") assert.ok(!seen.has(now.sum) || key === "-", `${key} shows nothing new`);
    seen.add(now.sum);
  }
  const slider = page.getByRole("slider", { name: "Apart" });
  const before = (await colours(page)).sum;
  await slider.fill("1");
  assert.notEqual((await colours(page)).sum, before);
});

windowTest("A click on a piece chooses it", server, async (keep) => {
  const page = keep(await openWindow(browser, server, `pieces/${project}`));
  await drawn(page, 2);
  await page.keyboard.press("7");
  const chosen = new Set();
  const box = await canvasOf(page).boundingBox();
  for (let x = 0.2; x < 0.8; x += 0.1)
    for (let y = 0.3; y < 0.7; y += 0.05) {
      await page.mouse.click(box.x + x * box.width, box.y + y * box.height);
      chosen.add(await page.evaluate(() => new URLSearchParams(location.hash.split("?")[1]).get("piece")));
    }
  chosen.delete(null);
  assert.deepEqual([...chosen].sort(), ["B", "C"]);
});

windowTest("A dragged plane has a provisional outline, and the exact one when it is released", server, async (keep) => {
  const page = keep(await openWindow(browser, server, `cut/${project}`));
  await drawn(page, 2);
  await page.locator(".planes:not(.provisional) tbody tr").first().waitFor();
  for (const [name, value] of [["Normal x", "1"], ["Normal y", "0"], ["Normal z", "0"], ["Offset", "0"]]) await page.getByRole("textbox", { name }).fill(value);
  await page.getByText("Exact.").waitFor();
  await page.getByRole("textbox", { name: "Offset" }).blur();
  await page.keyboard.press("1");
  await colours(page);
  // The handle is an arrow along the normal, which is along x in the view from the front; where it is is sought by the pointer.
  const box = await canvasOf(page).boundingBox();
  const middle = { x: box.x + box.width / 2, y: box.y + box.height / 2 };
  const offset = () => page.getByRole("textbox", { name: "Offset" }).inputValue();
  let dragged = false;
  for (let dx = 20; dx <= 120 && !dragged; dx += 10)
    for (let dy = -120; dy <= 120 && !dragged; dy += 15) {
      await page.mouse.move(middle.x + dx, middle.y + dy);
      await page.mouse.down();
      await page.mouse.move(middle.x + dx + 12, middle.y + dy, { steps: 3 });
      if ((await offset()) !== "0") {
        dragged = true;
        await page.getByText("The outline is provisional").waitFor();
      }
      await page.mouse.up();
      if (!dragged) await page.keyboard.press("1");
    }
  assert.ok(dragged, "the handle was not found");
  const value = Number(await offset());
  assert.ok(value > 0, `${value}`);
  await page.getByText("Exact.").waitFor();
  const { preview } = server.run("segment", "a.qch", "--piece", await page.evaluate(() => new URLSearchParams(location.hash.split("?")[1]).get("piece")), "--preview", `1,0,0,${value}`);
  assert.equal((await page.locator(".makes tbody tr").count()), preview.makes.length);
});

windowTest("A hidden side is not drawn", server, async (keep) => {
  const page = keep(await openWindow(browser, server, `cut/${project}`));
  await drawn(page, 2);
  await page.getByText("Exact.").waitFor();
  await page.locator("h2", { hasText: "Planes for piece" }).click();
  const sums = [];
  for (let i = 0; i < 4; ++i) {
    sums.push((await colours(page)).sum);
    await page.keyboard.press("h");
  }
  assert.equal(new Set(sums.slice(0, 3)).size, 3);
  assert.equal(sums[3], sums[0]);
});

windowTest("What is painted is coloured, can be taken back, and goes with Begin", server, async (keep) => {
  const page = keep(await openWindow(browser, server));
  await page.getByRole("button", { name: "Check a.ply" }).click();
  await page.getByRole("button", { name: /^mm/ }).click();
  await page.getByText("Units: mm, as chosen").waitFor();
  await drawn(page, 1);
  await page.getByRole("button", { name: "must not be cut" }).click();
  await page.keyboard.press("1");
  const before = await colours(page);
  const box = await canvasOf(page).boundingBox();
  const middle = { x: box.x + box.width / 2, y: box.y + box.height / 2 };
  await page.mouse.move(middle.x - 60, middle.y + 60);
  await page.mouse.down();
  await page.mouse.move(middle.x + 60, middle.y + 60, { steps: 8 });
  await page.mouse.up();
  await page.mouse.move(middle.x, middle.y - 20);
  await page.mouse.down();
  await page.mouse.move(middle.x, middle.y + 60, { steps: 8 });
  await page.mouse.up();
  const strokes = Number(/(\d+) strokes?\./.exec(await page.getByText(/\d strokes?\./).innerText())[1]);
  assert.notEqual((await colours(page)).sum, before.sum);
  let body;
  await page.route("**/api/projects", (route) => {
    body = route.request().postDataJSON();
    return route.abort();
  });
  await page.getByRole("button", { name: "Begin" }).click();
  await page.getByText("The server does not answer.").waitFor();
  assert.equal(body.strokes.length, strokes);
  for (const stroke of body.strokes) {
    assert.equal(stroke.surface, "no_cut");
    assert.equal(stroke.radius_mm, 10);
    for (const point of stroke.points) {
      assert.equal(point.length, 6);
      assert.ok(Math.abs(Math.hypot(...point.slice(3)) - 1) < 1e-3);
    }
  }
  for (let i = body.strokes.length; i > 0; --i) await page.getByRole("button", { name: "Take the last stroke back" }).click();
  await page.getByText("Nothing is painted.").waitFor();
});

windowTest("The scan stands beside a person, and its faults are shown in their places", server, async (keep) => {
  server.run("sample", "vertebra", "--faces", "3000", "--holes", "2", "-o", "holes.ply");
  const page = keep(await openWindow(browser, server));
  await page.getByRole("button", { name: "Check holes.ply" }).click();
  await drawn(page, 1);
  await page.getByRole("button", { name: /^cm/ }).click();
  await page.getByText("Units: cm, as chosen").waitFor();
  await drawn(page, 1);
  assert.match(await canvasOf(page).getAttribute("aria-label"), /beside a person of 1\.75 m/);
  const without = await colours(page);
  await page.getByRole("button", { name: "Show holes" }).click();
  await page.getByRole("button", { name: "Show holes", pressed: true }).waitFor();
  assert.notEqual((await colours(page)).sum, without.sum);
  const inspected = server.run("inspect", "holes.ply", "--units", "cm");
  assert.ok(inspected.holes.length > 0);
  assert.equal(await page.getByRole("row", { name: /^holes/ }).getByRole("cell").first().innerText(), String(inspected.holes.length));
});

windowTest("A repair is shown before and after, parted by a slider", server, async (keep) => {
  const page = keep(await openWindow(browser, server));
  await page.getByRole("button", { name: "Check a.ply" }).click();
  await page.getByText("What the scan holds").waitFor();
  await page.locator("summary", { hasText: "Repair" }).click();
  await page.getByRole("button", { name: "Repair", exact: true }).click();
  await drawn(page, 2);
  const share = page.getByRole("slider", { name: "Before and after" });
  const middle = await colours(page);
  await share.fill("1");
  assert.notEqual((await colours(page)).sum, middle.sum);
  await page.getByText("closed: a solid").waitFor();
});
