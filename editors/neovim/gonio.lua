-- Starts `gonio lsp` for shaders. Load it from init.lua with `dofile("/path/to/gonio.lua")`. It needs Neovim 0.7 or later.
--
-- Other arguments: vim.g.gonio_command = { "gonio", "lsp", "--exercise", "ex04" }

local client

local function start(buffer)
  if vim.bo[buffer].filetype == "" then
    vim.bo[buffer].filetype = "glsl"
  end
  local config = {
    name = "gonio",
    cmd = vim.g.gonio_command or { "gonio", "lsp" },
    root_dir = vim.fn.getcwd(),
  }
  if vim.lsp.start then
    vim.lsp.start(config, { bufnr = buffer })
    return
  end
  -- Neovim 0.7
  client = client or vim.lsp.start_client(config)
  if client then
    vim.lsp.buf_attach_client(buffer, client)
  end
end

vim.api.nvim_create_autocmd({ "BufReadPost", "BufNewFile" }, {
  pattern = { "*.vert", "*.frag", "*.glsl" },
  callback = function(event)
    start(event.buf)
  end,
})
