// Caches the page's files: the next visit loads at once, and works offline.
//
// Names with a hash never change their content: they always come from the cache. The page itself (`./`) is
// requested again, so that a new version appears at once; if the network is slow, the cached one is used.

/** Filled in when the page is built: a hash of all files, and every file that the page may request. */
const VERSION = "%VERSION%";
const FILES = ["%FILES%"];

const CACHE = `gonio-${VERSION}`;
/** Milliseconds that the network may take before the cached page is shown. */
const PATIENCE = 400;

self.addEventListener("install", (event) => {
  event.waitUntil(
    caches.open(CACHE).then((cache) => cache.addAll(FILES)).then(() => self.skipWaiting()),
  );
});

self.addEventListener("activate", (event) => {
  event.waitUntil(
    caches.keys().then((names) => {
      const ours = names.filter((name) => name.startsWith("gonio-"));
      // A page of the previous version may still be open and request files, so that version is kept.
      const old = ours.filter((name) => name !== CACHE).slice(0, -1);
      return Promise.all(old.map((name) => caches.delete(name)));
    }).then(() => self.clients.claim()),
  );
});

self.addEventListener("fetch", (event) => {
  const { request } = event;
  if (request.method !== "GET" || new URL(request.url).origin !== self.location.origin) return;
  event.respondWith(request.mode === "navigate" ? page(request) : file(request));
});

/** A file: from the cache, or else from the network. */
async function file(request) {
  return (await caches.match(request, { ignoreSearch: true, ignoreVary: true })) ?? fetch(request);
}

/** The page: from the network if it answers soon, or else from the cache. */
async function page(request) {
  const kept = () => caches.match("./", { ignoreSearch: true, ignoreVary: true, cacheName: CACHE });
  const fresh = fetch(request);
  try {
    const late = new Promise((resolve) => setTimeout(resolve, PATIENCE));
    const answer = await Promise.race([fresh, late]);
    if (answer?.ok) return answer;
  } catch {
    // No connection.
  }
  return (await kept()) ?? fresh;
}
