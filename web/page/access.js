// The mirror for screen readers: hidden elements over the canvas, one for each widget, in step with the application's
// accessibility tree. What is done with an element becomes an action on its widget. Loaded when support is turned on.

/** Creates the element of each kind: `gonio_app::mirror::MirrorKind`. */
const KINDS = {
  "group": () => element("div", { role: "none" }),
  "dialog": () => element("div", { role: "dialog" }),
  "tab-list": () => element("div", { role: "tablist" }),
  "tab": () => element("button", { role: "tab" }),
  "button": () => element("button"),
  "combo-box": () => element("button", { "aria-haspopup": "listbox" }),
  "check-box": () => element("input", { type: "checkbox" }),
  "switch": () => element("input", { type: "checkbox", role: "switch" }),
  "radio": () => element("input", { type: "radio" }),
  "slider": () => element("input", { type: "range" }),
  "number": () => element("input", { type: "text", role: "spinbutton", inputmode: "decimal" }),
  "line": () => element("input", { type: "text" }),
  "lines": () => element("textarea"),
  "image": () => element("div", { role: "img" }),
  "progress": () => element("div", { role: "progressbar" }),
  "heading": () => element("h2"),
  "text": () => element("p"),
};

function element(name, attributes = {}) {
  const made = document.createElement(name);
  if (name === "button") made.type = "button";
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  return made;
}

const SAID = new Set(["text", "heading"]);
const CONTAINERS = new Set(["group", "dialog", "tab-list"]);
const TYPED = new Set(["line", "lines"]);

/** Keys that a kind needs itself. */
const OWN_KEYS = {
  "slider": ["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown", "Home", "End", "PageUp", "PageDown"],
};
/** Keys that mean nothing to the application, or that move the focus. */
const LEFT_TO_THE_BROWSER = ["Tab", "Control", "Shift", "Alt", "Meta"];
/** Combinations with Control that edit text. */
const EDITING = ["a", "c", "v", "x", "y", "z"];

/** Sets an attribute, or removes it where the value is undefined. Nothing is written that is there already. */
function attribute(target, name, value) {
  if (value === undefined || value === null || value === false) {
    if (target.hasAttribute(name)) target.removeAttribute(name);
  } else if (target.getAttribute(name) !== String(value)) {
    target.setAttribute(name, value);
  }
}

/** The mirror, while support is on. */
export class Mirror {
  /** For each id: its element, and the node it shows. */
  #shown = new Map();
  #top = element("div", { id: "mirror" });
  /** Changes that came during a frame. */
  #waiting = [];
  /** The element that takes the focus because the application has moved it. */
  #led = null;

  /** `application`: the module's functions. `canvas`: what the mirror lies over. */
  constructor(application, canvas) {
    this.application = application;
    this.canvas = canvas;
    canvas.before(this.#top);
    for (const [kind, handle] of [
      ["click", this.#clicked], ["input", this.#typed], ["change", this.#changed], ["focusin", this.#entered],
      ["focusout", this.#left], ["keydown", this.#pressed],
    ]) this.#top.addEventListener(kind, handle);
    this.resumed();
    application.turn_access_on((text) => {
      // After the frame: the page's own events must not come in the middle of it.
      if (this.#waiting.push(text) === 1) queueMicrotask(() => this.#apply());
    });
  }

  /** To be called after each start of the application, which puts the canvas into the order of the Tab key. */
  resumed() {
    this.#leaveTabOrder(true);
  }

  /** Ends the mirror. */
  end() {
    this.application.access_focus(false);
    this.application.turn_access_off();
    this.#top.remove();
    this.#leaveTabOrder(false);
  }

  /** With the mirror, the Tab key goes through its elements and not to the canvas and egui's field for text. */
  #leaveTabOrder(leave) {
    this.canvas.tabIndex = leave ? -1 : 0;
    const field = this.#field();
    if (field !== null) field.tabIndex = leave ? -1 : 0;
  }

  /** egui's hidden field, which has the page's focus while text is edited in the canvas. */
  #field = () => document.querySelector("#lab + input");

  #apply() {
    for (const text of this.#waiting.splice(0)) this.#change(JSON.parse(text));
  }

  #change({ root, nodes, removed, focus }) {
    const before = document.activeElement?.dataset?.node;
    for (const node of nodes) this.#update(node);
    for (const id of removed) {
      this.#shown.get(id)?.target.remove();
      this.#shown.delete(id);
    }
    // Children may have come after their parents.
    for (const { id } of nodes) this.#arrange(this.#shown.get(id));
    const top = this.#shown.get(root)?.target;
    if (top && top.parentNode !== this.#top) this.#top.replaceChildren(top);
    if (focus !== null) this.#follow(focus, root);
    // Moving an element takes its focus away.
    else if (before !== undefined && document.activeElement?.dataset?.node !== before) this.#lead(before);
    // Whoever had the focus may be gone, and keys would go nowhere.
    if (document.activeElement === document.body && before !== undefined) this.canvas.focus({ preventScroll: true });
  }

  /** The page's focus goes where the application's is. */
  #follow(focus, root) {
    const active = document.activeElement;
    // Text is being typed into the canvas.
    if (active !== null && active === this.#field() && this.#hasText(focus)) return;
    if (focus !== root && active?.dataset?.node !== focus) this.#lead(focus);
  }

  #hasText = (id) => TYPED.has(this.#shown.get(id)?.node.kind) || this.#shown.get(id)?.node.kind === "number";

  #lead(id) {
    const shown = this.#shown.get(id);
    if (!shown) return;
    this.#led = shown.target;
    shown.target.focus({ preventScroll: true });
    this.#led = null;
  }

  #update(node) {
    const { id, kind, name, value, number, range, on, expanded, disabled, read_only, focusable, rect } = node;
    let shown = this.#shown.get(id);
    if (shown?.node.kind !== kind) {
      const target = KINDS[kind]();
      target.dataset.node = id;
      shown?.target.replaceWith(target);
      shown = { target, node };
      this.#shown.set(id, shown);
    }
    shown.node = node;
    const { target } = shown;
    if (SAID.has(kind)) {
      if (target.textContent !== name) target.textContent = name;
    } else {
      attribute(target, "aria-label", name === "" ? undefined : name);
    }
    if (!CONTAINERS.has(kind)) {
      const sides = ["left", "top", "width", "height"];
      for (const [index, side] of sides.entries()) target.style[side] = `${rect[index]}px`;
    }
    attribute(target, "aria-disabled", disabled || undefined);
    attribute(target, "aria-expanded", expanded);
    if (!SAID.has(kind) && !CONTAINERS.has(kind)) attribute(target, "tabindex", focusable && !disabled ? "0" : "-1");
    if (kind === "tab") attribute(target, "aria-selected", String(on ?? false));
    if (kind === "button" && on !== undefined) attribute(target, "aria-pressed", String(on));
    if (kind === "combo-box") attribute(target, "aria-description", value);
    if (["check-box", "switch", "radio"].includes(kind)) {
      target.checked = on ?? false;
      target.indeterminate = on === undefined;
    }
    if (kind === "slider") {
      [target.min, target.max] = range;
      target.step = "any";
      target.value = number ?? range[0];
      attribute(target, "aria-valuetext", number === undefined ? undefined : String(Number(number.toPrecision(4))));
    }
    if (kind === "number" || kind === "progress") {
      attribute(target, "aria-valuenow", number);
      attribute(target, "aria-valuemin", range?.[0]);
      attribute(target, "aria-valuemax", range?.[1]);
    }
    if (kind === "number" && document.activeElement !== target) {
      target.value = value ?? (number === undefined ? "" : String(Number(number.toPrecision(6))));
    }
    if (TYPED.has(kind)) {
      target.readOnly = read_only;
      if (target.value !== (value ?? "")) target.value = value ?? "";
    }
  }

  /** Puts a node's children into it, in their order. What stands right is not touched. */
  #arrange(shown) {
    if (!shown || !CONTAINERS.has(shown.node.kind)) return;
    let next = shown.target.firstChild;
    for (const id of shown.node.children) {
      const child = this.#shown.get(id)?.target;
      if (!child) continue;
      if (child === next) next = next.nextSibling;
      else shown.target.insertBefore(child, next);
    }
    // What follows belongs elsewhere now, or is placed there later.
    while (next !== null) {
      const after = next.nextSibling;
      if (!this.#shown.has(next.dataset.node)) next.remove();
      next = after;
    }
  }

  #of = (event) => this.#shown.get(event.target.dataset?.node);

  #act(shown, action, value) {
    this.application.access_act(shown.node.id, action, value);
  }

  #clicked = (event) => {
    const shown = this.#of(event);
    if (!shown || shown.node.disabled) return;
    const { kind } = shown.node;
    // The state comes from the application.
    if (["check-box", "switch", "radio"].includes(kind)) event.preventDefault();
    if (["button", "combo-box", "tab", "check-box", "switch", "radio", "image"].includes(kind)) this.#act(shown, "click");
  };

  #typed = (event) => {
    const shown = this.#of(event);
    if (!shown) return;
    if (shown.node.kind === "slider") this.#act(shown, "set-value", Number(event.target.value));
    if (TYPED.has(shown.node.kind)) this.#act(shown, "set-value", event.target.value);
  };

  #changed = (event) => {
    const shown = this.#of(event);
    if (shown?.node.kind !== "number") return;
    const number = Number.parseFloat(event.target.value.replace(",", "."));
    if (Number.isFinite(number)) this.#act(shown, "set-value", number);
  };

  #entered = (event) => {
    const shown = this.#of(event);
    this.application.access_focus(true);
    if (!shown || event.target === this.#led) return;
    this.#act(shown, "focus");
    this.#act(shown, "scroll-into-view");
  };

  #left = (event) => {
    if (!this.#top.contains(event.relatedTarget)) this.application.access_focus(false);
  };

  #pressed = (event) => {
    const shown = this.#of(event);
    if (!shown || event.isComposing || LEFT_TO_THE_BROWSER.includes(event.key)) return;
    const { kind } = shown.node;
    const command = event.ctrlKey || event.metaKey;
    if (kind === "number" && ["ArrowUp", "ArrowDown"].includes(event.key)) {
      this.#act(shown, event.key === "ArrowUp" ? "increment" : "decrement");
      event.preventDefault();
      return;
    }
    if (TYPED.has(kind) || kind === "number") {
      // Text is edited here.
      const elsewhere = event.key === "Escape" || /^F\d+$/.test(event.key) || (command && !EDITING.includes(event.key.toLowerCase()));
      if (!elsewhere) return;
    } else if (!command && (["Enter", " "].includes(event.key) || OWN_KEYS[kind]?.includes(event.key))) {
      // A radio button and a check box are pressed by Enter too, as in the application.
      if (event.key === "Enter" && event.target instanceof HTMLInputElement) event.target.click();
      return;
    }
    const { key, ctrlKey, shiftKey, altKey, metaKey } = event;
    const known = this.application.access_key(key.length === 1 ? key.toUpperCase() : key, ctrlKey, shiftKey, altKey, metaKey);
    // Those of the browser that the application takes: open, save.
    if (known && command && ["o", "s"].includes(key.toLowerCase())) event.preventDefault();
  };
}
