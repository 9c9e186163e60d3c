// The page: takes the key, follows the server, shows the page that the address names.

import { render } from "preact";
import { useEffect, useState } from "preact/hooks";
import { useAddress, type Address } from "./address";
import { takeKeyFromAddress } from "./link/key";
import { isStale, start, useStore, type Link } from "./link/store";
import { CellBar } from "./parts/cell_bar";
import { Header } from "./parts/header";
import { KeyList, listenToKeys, useKey } from "./parts/keys";
import { CheckPage } from "./pages/check/page";
import { CutPage } from "./pages/cut/page";
import { GuidePage } from "./pages/guide";
import { JobsPage } from "./pages/jobs/page";
import { PiecesPage } from "./pages/pieces/page";
import { StartPage } from "./pages/start";

const PAGES = { start: StartPage, check: CheckPage, cut: CutPage, pieces: PiecesPage, jobs: JobsPage, guide: GuidePage };

const NO_LINK: Partial<Record<Link, string>> = {
  starting: "The page asks the server.",
  lost: "The server does not answer. The page tries again by itself; look whether qchopper serve still runs.",
  "no key": "This window has no key. Open the link that qchopper serve printed.",
  "other server": "The server was started again and has a new key. Open the link that it printed.",
  refused: "The server refuses the key of this window. Open the link that qchopper serve printed.",
};

function App() {
  const { link, state } = useStore();
  const address = useAddress();
  const now = useClock();
  const [showsKeys, setShowsKeys] = useState(false);
  useKey("help", () => setShowsKeys(true));
  const stale = isStale(now);
  useEffect(() => {
    document.title = `${titleOf(address)} - QChopper`;
  }, [address.page]);
  const Page = PAGES[address.page];
  const hasEnded = link === "other server" || link === "refused" || link === "no key";
  return (
    <>
      <Header address={address} stale={stale} onKeys={() => setShowsKeys(true)} />
      {(state === null || hasEnded) && (
        <p class="wait" role={hasEnded ? "alert" : "status"}>
          {NO_LINK[link]}
        </p>
      )}
      {state !== null && (
        <div class={stale ? "page-body grey" : "page-body"}>
          <Page key={`${address.page} ${address.id}`} address={address} stale={stale} />
        </div>
      )}
      {state !== null && <CellBar stale={stale} now={now} />}
      {showsKeys && <KeyList onClose={() => setShowsKeys(false)} />}
    </>
  );
}

const titleOf = (address: Address): string => address.page.replace(/^./, (letter) => letter.toUpperCase());

// Ages are counted on once a second.
function useClock(): number {
  const [now, setNow] = useState(performance.now());
  useEffect(() => {
    const timer = setInterval(() => setNow(performance.now()), 1000);
    return () => clearInterval(timer);
  }, []);
  return now;
}

takeKeyFromAddress();
addEventListener("hashchange", () => {
  if (!location.hash.startsWith("#key=")) return;
  takeKeyFromAddress();
  location.reload();
});
// A window that comes back from the browser's cache of pages has lost its events.
addEventListener("pageshow", (event) => event.persisted && location.reload());
listenToKeys();
const root = document.getElementById("page")!;
root.textContent = "";
render(<App />, root);
void start();
