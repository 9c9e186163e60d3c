// Addresses of the page: "#/cut/PROJECT?piece=B&k=2" names the page, the project or check, and what is selected.

import { useEffect, useState } from "preact/hooks";

export const PAGES = ["start", "check", "cut", "pieces", "jobs", "guide"] as const;
export type PageName = (typeof PAGES)[number];

export interface Address {
  page: PageName;
  id: string; // of the project, or of the check; "": none
  selection: Record<string, string>;
}

export function parseAddress(fragment: string): Address {
  const [path = "", query = ""] = fragment.replace(/^#?\/?/, "").split("?", 2);
  const [name = "", id = ""] = path.split("/");
  const page = PAGES.find((one) => one === name);
  if (page === undefined) return { page: "start", id: "", selection: {} };
  return { page, id: decode(id), selection: Object.fromEntries(new URLSearchParams(query)) };
}

function decode(text: string): string {
  try {
    return decodeURIComponent(text);
  } catch {
    return "";
  }
}

export function formatAddress({ page, id, selection }: Address): string {
  const query = new URLSearchParams(Object.entries(selection).filter(([, value]) => value !== "")).toString();
  return `#/${page}${id === "" ? "" : `/${encodeURIComponent(id)}`}${query === "" ? "" : `?${query}`}`;
}

export const here = (): Address => parseAddress(location.hash);

export function go(page: PageName, id = "", selection: Record<string, string> = {}): void {
  location.hash = formatAddress({ page, id, selection });
}

// Changes the selection in place: it is no step back in the browser's history.
export function select(selection: Record<string, string>): void {
  const now = here();
  const next = formatAddress({ ...now, selection: { ...now.selection, ...selection } });
  if (next === formatAddress(now)) return;
  history.replaceState(null, "", next);
  dispatchEvent(new Event("hashchange"));
}

export function useAddress(): Address {
  const [address, setAddress] = useState(here);
  useEffect(() => {
    const read = () => setAddress(here());
    addEventListener("hashchange", read);
    return () => removeEventListener("hashchange", read);
  }, []);
  return address;
}
