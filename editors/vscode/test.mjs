// Tests the package, and the bundled extension with a server: GONIO_PROGRAM=PATH node test.mjs
//
// VS Code itself is not here: `vscode` is a stand-in with the few functions that the extension and its client library call. What the
// extension starts is the real program.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import Module from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { vsix } from "./build.mjs";

const program = process.env.GONIO_PROGRAM;
if (program === undefined) {
  console.error("GONIO_PROGRAM must name the program gonio");
  process.exit(2);
}

/** The package is the same each time, and holds what its manifest names. */
async function testPackage() {
  const [first, second] = [await vsix(), await vsix()];
  assert.ok(first.equals(second), "two builds differ");
  const manifest = createRequire(import.meta.url)("./package.json");
  const text = first.toString("latin1");
  for (const path of [manifest.main, ...manifest.contributes.languages.map((language) => language.configuration)]) {
    assert.ok(text.includes(path.replace("./", "extension/")), `${path} is not in the package`);
  }
}

const shown = [];
const nothing = { dispose() {} };
const event = () => nothing;

/** A class with any members, for those that the library only derives from. */
const anyClass = (name) =>
  class {
    static [Symbol.toPrimitive]() {
      return name;
    }
  };

/** An object whose missing members are classes, events, or functions that return nothing. */
const standIn = (known) => {
  const made = new Map();
  return new Proxy(known, {
    get(target, name) {
      if (name in target || typeof name === "symbol" || name === "then") {
        return target[name];
      }
      if (!made.has(name)) {
        const is = (pattern) => pattern.test(name);
        made.set(name, is(/^on[A-Z]/) ? event : is(/^[A-Z]/) ? anyClass(name) : () => nothing);
      }
      return made.get(name);
    },
  });
};

class EventEmitter {
  event = event;
  fire() {}
  dispose() {}
}
class Disposable {
  static from() {
    return nothing;
  }
  dispose() {}
}
class CancellationTokenSource {
  token = { isCancellationRequested: false, onCancellationRequested: event };
  cancel() {}
  dispose() {}
}

class CodeActionKind {
  constructor(value) {
    this.value = value;
  }
  append(part) {
    return new CodeActionKind(this.value === "" ? part : `${this.value}.${part}`);
  }
}
for (const name of ["Empty", "QuickFix", "Refactor", "Source"]) {
  CodeActionKind[name] = new CodeActionKind(name === "Empty" ? "" : name.toLowerCase());
}

const settings = { path: program, arguments: [] };
const channel = standIn({ appendLine: (line) => shown.push(line), append: (text) => shown.push(text), show() {} });
const vscode = standIn({
  CodeActionKind,
  EventEmitter,
  Disposable,
  CancellationTokenSource,
  version: "1.91.0",
  env: standIn({ language: "fr", appName: "stand-in" }),
  commands: standIn({ registerCommand: () => nothing, executeCommand: async () => undefined }),
  languages: standIn({ createDiagnosticCollection: () => standIn({ set() {}, clear() {}, dispose() {} }), match: () => 0 }),
  workspace: standIn({
    textDocuments: [],
    notebookDocuments: [],
    workspaceFolders: undefined,
    getConfiguration: () => ({ get: (name) => settings[name] }),
    createFileSystemWatcher: () => standIn({ onDidCreate: event, onDidChange: event, onDidDelete: event, dispose() {} }),
  }),
  window: standIn({
    tabGroups: standIn({ all: [] }),
    visibleTextEditors: [],
    createOutputChannel: () => channel,
    showErrorMessage: async (text) => void shown.push(text),
  }),
});

const resolve = Module._resolveFilename;
Module._resolveFilename = (request, ...rest) => (request === "vscode" ? "vscode" : resolve(request, ...rest));
Module._cache.vscode = { id: "vscode", exports: vscode, loaded: true };

/** The process that the extension has started. */
const children = () => execFileSync("ps", ["-o", "args=", "--ppid", String(process.pid)], { encoding: "utf8" });

async function testExtension() {
  const extension = createRequire(import.meta.url)("./dist/extension.js");
  const subscriptions = [];
  await extension.activate({ subscriptions });
  assert.equal(subscriptions.length, 2);
  assert.deepEqual(shown, []);
  assert.ok(children().includes(`${program} lsp`), children());
  await extension.deactivate();
  assert.ok(!children().includes(`${program} lsp`), "the server outlives the extension");
  settings.path = join(tmpdir(), "no such gonio");
  await extension.activate({ subscriptions });
  assert.ok(shown.some((text) => text.includes("set gonio.path")), shown.join("\n"));
  await extension.deactivate();
}

const folder = mkdtempSync(join(tmpdir(), "gonio-vscode-"));
process.chdir(folder);
try {
  await testPackage();
  await testExtension();
} finally {
  process.chdir(tmpdir());
  rmSync(folder, { recursive: true });
}
console.log("2 tests passed");
