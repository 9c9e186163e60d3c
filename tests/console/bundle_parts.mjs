// Bundles what parts.test.mjs tests, for node: `node bundle_parts.mjs PAGE WORK` writes WORK/parts.mjs.

import { createRequire } from "node:module";
import { join, resolve } from "node:path";

const [page, work] = process.argv.slice(2).map((path) => resolve(path));
const esbuild = createRequire(join(work, "package.json"))("esbuild");
const names = [
  "address",
  "geometry/display_mesh",
  "geometry/plane",
  "geometry/ranking",
  "geometry/section",
  "geometry/tool_arrows",
  "geometry/tool_way",
  "link/event_stream",
  "link/state",
  "pages/check/names",
  "pages/check/strokes",
  "parts/keys",
  "parts/words",
];
await esbuild.build({
  stdin: { contents: names.map((name) => `export * from "./src/${name}";`).join("\n"), resolveDir: page, loader: "ts" },
  bundle: true,
  format: "esm",
  platform: "node",
  jsx: "automatic",
  jsxImportSource: "preact",
  nodePaths: [join(work, "node_modules")],
  outfile: join(work, "parts.mjs"),
  logLevel: "warning",
});
