// Starts `gonio lsp`, which does all of the work, and restarts it when its settings change.

const { commands, window, workspace } = require("vscode");
const { LanguageClient } = require("vscode-languageclient/node");

let client;

async function start() {
  const settings = workspace.getConfiguration("gonio");
  const program = settings.get("path");
  const server = { command: program, args: ["lsp", ...settings.get("arguments")] };
  client = new LanguageClient("gonio", "gonio", server, {
    documentSelector: [{ scheme: "file", language: "glsl" }, { scheme: "untitled", language: "glsl" }],
    // Files that other programs change, and those that tell the exercise.
    synchronize: { fileEvents: workspace.createFileSystemWatcher("**/*.{vert,frag,glsl,toml,md}") },
  });
  try {
    await client.start();
  } catch (error) {
    window.showErrorMessage(`\`${program} lsp\` cannot be started (${error.message}). Install gonio, or set gonio.path.`);
  }
}

async function stop() {
  const ended = client;
  client = undefined;
  // A server that never started cannot be stopped.
  await ended?.stop().catch(() => undefined);
}

async function restart() {
  await stop();
  await start();
}

exports.activate = async (context) => {
  context.subscriptions.push(
    commands.registerCommand("gonio.restart", restart),
    workspace.onDidChangeConfiguration((event) => event.affectsConfiguration("gonio") && restart()),
  );
  await start();
};

exports.deactivate = stop;
