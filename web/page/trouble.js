// What is said when the application cannot run. It stays until the page is loaded again.

const element = (id) => document.getElementById(id);

/** Shows a message in place of the application. The first one stays: those that follow come of it.
 * `title`, `text`: one sentence each. `advice`: what to do, one item each. `details`: what the program said. */
export function trouble({ title, text, advice = [], details = "" }) {
  if (!element("trouble").hidden) return;
  element("trouble-title").textContent = title;
  element("trouble-text").textContent = text;
  element("trouble-advice").replaceChildren(
    ...advice.map((words) => Object.assign(document.createElement("li"), { textContent: words })),
  );
  element("trouble-more").hidden = details === "";
  element("trouble-details").textContent = details;
  element("trouble-reload").addEventListener("click", () => location.reload());
  element("trouble").hidden = false;
  element("lab").inert = true;
  element("progress").hidden = true;
  document.title = `${title} – gonio`;
}

export const noWebGl2 = () => trouble({
  title: "This browser offers no WebGL 2",
  text: "The light lab draws with it, on the graphics card or without one.",
  advice: [
    "Use a current Firefox, Chrome, Edge or Safari (15 or later).",
    "Switch on hardware acceleration in the browser's settings, under System or Performance.",
    "Close other pages that draw in 3D: a browser allows only so many at once.",
    "On a machine without graphics, the program on the desktop does the same: gonio view.",
  ],
});

export const noModule = (error) => trouble({
  title: "The light lab could not be loaded",
  text: "A part of the page did not arrive, or is not what it should be.",
  advice: ["Check the connection, and load the page again.", "If it stays so, tell whoever put this page here."],
  details: describe(error),
});

export const stopped = (error, said) => trouble({
  title: "The light lab has stopped",
  text: "It met with a fault of its own and cannot go on. What you had open is still in your files.",
  advice: ["Load the page again.", "If it happens again, please report what the program said, and what you did before."],
  details: said ?? describe(error),
});

/** An error as text, with where it came from. */
function describe(error) {
  if (error instanceof Error) return error.stack?.includes(error.message) ? error.stack : `${error}\n${error.stack ?? ""}`;
  return String(error);
}
