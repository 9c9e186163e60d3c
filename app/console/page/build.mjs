// Builds the page: `node build.mjs SOURCE MODULES OUT`. SOURCE is this folder, MODULES the node_modules made by npm ci
// from its lock file, OUT the folder to fill. Called by scripts/console, which checks the types before.
//
// The outputs depend on nothing else: no time, no path of a computer.

import { createHash } from "node:crypto";
import { copyFileSync, mkdirSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join, relative, resolve } from "node:path";
import { gzipSync } from "node:zlib";

const [source, modules, out] = process.argv.slice(2).map((path) => resolve(path));
const esbuild = createRequire(join(modules, "package.json"))("esbuild");

const common = {
  absWorkingDir: source,
  bundle: true,
  minify: true,
  format: "esm",
  target: "es2022",
  charset: "utf8",
  legalComments: "none",
  jsx: "automatic",
  jsxImportSource: "preact",
  nodePaths: [modules],
  logLevel: "warning",
};

function notices() {
  const parts = ["page.js and three.js contain the following libraries.\n"];
  for (const name of ["preact", "three"]) {
    const { version } = JSON.parse(readFileSync(join(modules, name, "package.json"), "utf8"));
    parts.push(`${name} ${version}\n\n${readFileSync(join(modules, name, "LICENSE"), "utf8").trim()}\n`);
  }
  return parts.join("\n----------------------------------------\n\n");
}

function filesBelow(folder) {
  return readdirSync(folder, { withFileTypes: true })
    .flatMap((entry) => (entry.isDirectory() ? filesBelow(join(folder, entry.name)) : [join(folder, entry.name)]))
    .sort();
}

const sha256 = (path) => createHash("sha256").update(readFileSync(path)).digest("hex");

mkdirSync(out, { recursive: true });
// three stands in a file of its own: it changes with its version alone, and the tables do not wait for it.
await esbuild.build({ ...common, entryPoints: { three: "src/view/three.ts" }, outdir: out });
await esbuild.build({ ...common, entryPoints: { page: "src/main.tsx" }, outdir: out });
await esbuild.build({ ...common, entryPoints: { events: "src/link/events_worker.ts" }, outdir: out });
for (const name of ["icon.svg", "index.html", "page.css"]) copyFileSync(join(source, name), join(out, name));
writeFileSync(join(out, "NOTICES"), notices());

// The list that tests/architecture/console_page_test.py compares without node.
const inputs = [
  ...["build.mjs", "icon.svg", "index.html", "package-lock.json", "package.json", "page.css", "tsconfig.json"].map((name) => join(source, name)),
  ...filesBelow(join(source, "src")).filter((path) => !path.endsWith(".md")),
];
const outputs = filesBelow(out).filter((path) => !path.endsWith(".md") && !path.endsWith("SOURCES.sha256"));
const lines = [
  ...inputs.map((path) => `${sha256(path)}  ${relative(source, path)}`),
  ...outputs.map((path) => `${sha256(path)}  dist/${relative(out, path)}`),
];
writeFileSync(join(out, "SOURCES.sha256"), lines.join("\n") + "\n");

let all = 0;
for (const path of outputs) {
  const packed = gzipSync(readFileSync(path), { level: 9 }).length;
  if (!path.endsWith("NOTICES")) all += packed;
  console.log(`${relative(out, path).padEnd(12)} ${String(packed).padStart(7)} bytes gzip`);
}
console.log(`${"page".padEnd(12)} ${String(all).padStart(7)} bytes gzip`);
