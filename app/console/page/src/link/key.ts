// The key of the server: from the address into this window's sessionStorage, and out of the address at once. It is sent only
// to the server that it was first used with.

const KEY = "qchopper.key";
const SERVER = "qchopper.server";
const OPTIONS = "qchopper.options";

// "#key=K&antialias=off" is taken and removed; any other fragment is an address of a page and is left alone.
export function takeKeyFromAddress(): void {
  const fragment = location.hash.slice(1);
  if (!fragment.startsWith("key=")) return;
  const values = new URLSearchParams(fragment);
  sessionStorage.setItem(KEY, values.get("key") ?? "");
  sessionStorage.removeItem(SERVER);
  if (values.has("antialias")) sessionStorage.setItem(OPTIONS, values.get("antialias") ?? "");
  history.replaceState(null, "", `${location.pathname}#/${values.get("page") ?? ""}`);
}

export function hasKey(): boolean {
  return (sessionStorage.getItem(KEY) ?? "") !== "";
}

// The key, if it is for this server; else nothing, and nothing may be sent.
export function keyFor(server: string): string | null {
  const known = sessionStorage.getItem(SERVER);
  if (known !== null && known !== server) return null;
  const key = sessionStorage.getItem(KEY);
  if (key) sessionStorage.setItem(SERVER, server);
  return key || null;
}

export function wantsAntialias(): boolean {
  return sessionStorage.getItem(OPTIONS) !== "off";
}
