// Messages for when the application cannot run. They stay until the page is reloaded.

const element = (id) => document.getElementById(id);

/** Shows a message in place of the application. The first one stays, because later ones are its consequences.
 * `title`, `text`: one sentence each. `advice`: what to do, one item each. `details`: the error. */
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
  for (const id of ["lab", "mirror"]) element(id)?.setAttribute("inert", "");
  element("progress").hidden = true;
  document.title = `${title} – gonio`;
}

export const noWebGl2 = () => trouble({
  title: "This browser has no WebGL 2",
  text: "gonio draws with WebGL 2, with or without a graphics card.",
  advice: [
    "Use a current Firefox, Chrome, Edge or Safari (15 or later).",
    "Switch on hardware acceleration in the browser's settings, under System or Performance.",
    "Close other pages with 3D graphics: browsers limit their number.",
    "On a machine without graphics, use the desktop program: gonio view.",
  ],
});

export const noModule = (error) => trouble({
  title: "The light lab could not be loaded",
  text: "A part of the page did not arrive or is damaged.",
  advice: ["Check the connection and reload the page.", "If this does not help, contact the owner of this page."],
  details: describe(error),
});

export const stopped = (error, panic) => trouble({
  title: "The light lab has stopped",
  text: "It crashed because of an internal error. Your files on disk are unchanged.",
  advice: ["Reload the page.", "If it happens again, please report the error details and what you did before."],
  details: panic ?? describe(error),
});

/** An error as text, with its stack. */
function describe(error) {
  if (error instanceof Error) return error.stack?.includes(error.message) ? error.stack : `${error}\n${error.stack ?? ""}`;
  return String(error);
}
