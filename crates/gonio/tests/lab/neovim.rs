//! Neovim as a client of `gonio lsp`, with the file that the book tells its users to load.

use crate::common::Lab;
use crate::hand_in;
use serde_json::Value;
use std::path::Path;
use std::process::Command;

const SCRIPT: &str = r#"
local out = {}
local function finish()
  local file = assert(io.open(vim.g.result, "w"))
  file:write(vim.fn.json_encode(out))
  file:close()
  vim.cmd("qall!")
end
local ok, why = pcall(function()
  vim.cmd("luafile " .. vim.fn.fnameescape(vim.g.loaded))
  vim.cmd("edit " .. vim.fn.fnameescape(vim.g.shader))
  local function has_mistake()
    for _, found in ipairs(vim.diagnostic.get(0)) do
      if found.code == "normal-by-model-matrix" then return found end
    end
  end
  assert(vim.wait(100000, has_mistake, 50), "there is no diagnostic")
  local found = has_mistake()
  out.line, out.source = found.lnum, found.source
  vim.api.nvim_win_set_cursor(0, { found.lnum + 1, found.col })
  local position = vim.lsp.util.make_position_params(0, "utf-16")
  vim.fn.search("itM", "bw")
  position = vim.lsp.util.make_position_params(0, "utf-16")
  local hover = vim.lsp.buf_request_sync(0, "textDocument/hover", position, 60000)
  for _, answer in pairs(hover) do out.hover = answer.result.contents.value end
  vim.api.nvim_win_set_cursor(0, { found.lnum + 1, found.col })
  local range = vim.lsp.util.make_range_params(0, "utf-16")
  range.context = { diagnostics = {} }
  local actions = vim.lsp.buf_request_sync(0, "textDocument/codeAction", range, 60000)
  for _, answer in pairs(actions) do
    for _, action in ipairs(answer.result) do
      out.title = action.title
      vim.lsp.util.apply_workspace_edit(action.edit, "utf-16")
    end
  end
  local function is_right() return #vim.diagnostic.get(0) == 0 end
  assert(vim.wait(100000, is_right, 50), "the diagnostics stay")
  vim.cmd("silent write")
end)
if not ok then out.why = tostring(why) end
finish()
"#;

#[test]
fn neovim_shows_a_mistake_and_a_value_and_applies_the_fix() {
    let lab = Lab::new();
    hand_in(&lab, "ex04", "ex04 mine", "mat3(itM)", "mat3(M)");
    let line =
        String::from_utf8(lab.read("ex04 mine/reference.vert")).unwrap().lines().position(|l| l.contains("mat3(M)"));
    let loaded = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../editors/neovim/gonio.lua");
    let book = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/editors.md");
    let [lua, book] = [&loaded, &book].map(|path| std::fs::read_to_string(path).unwrap());
    assert!(book.contains(&format!("```lua,file=gonio.lua\n{lua}```\n")), "docs/editors.md has another gonio.lua");
    let quoted = |path: &Path| path.to_string_lossy().replace('\'', "''");
    let program = quoted(Path::new(env!("CARGO_BIN_EXE_gonio")));
    lab.write("test.lua", SCRIPT);
    let mut command = Command::new("nvim");
    command.args(["--clean", "--headless", "-n"]).current_dir(lab.path("")).env("HOME", lab.path(""));
    command.args(["--cmd", &format!("let g:gonio_command = ['{program}', 'lsp', '--feedback', 'fix']")]);
    for (name, path) in
        [("result", lab.path("result.json")), ("loaded", loaded), ("shader", lab.path("ex04 mine/reference.vert"))]
    {
        command.args(["--cmd", &format!("let g:{name} = '{}'", quoted(&path))]);
    }
    let output = match command.args(["-c", "luafile test.lua"]).output() {
        Ok(output) => output,
        Err(error) => panic!("nvim cannot be started ({error}): install the Debian package `neovim`"),
    };
    let words = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(lab.path("result.json").is_file(), "{words}");
    let result: Value = serde_json::from_slice(&lab.read("result.json")).unwrap();
    assert_eq!(result["why"], Value::Null, "{words}");
    assert_eq!((result["line"].as_u64(), &result["source"]), (line.map(|line| line as u64), &"gonio".into()));
    let hover = result["hover"].as_str().unwrap();
    assert!(hover.contains("mat4 itM") && hover.contains("Role: "), "{hover}");
    assert_eq!(result["title"], "Apply the change with which every test scene is right");
    lab.run(&["lab", "check", "ex04", "ex04 mine"]).good();
}
