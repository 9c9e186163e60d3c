// Loads three when the first view needs it, from the file of its own.

export type Three = typeof import("./three");

let loading: Promise<Three> | null = null;

export function loadThree(): Promise<Three> {
  // Written so that the bundler leaves the address to the browser (build.mjs, external).
  const address = "/three.js";
  loading ??= (import(address) as Promise<Three>).catch((reason: unknown) => {
    loading = null;
    throw reason;
  });
  return loading;
}
