-- SPDX-License-Identifier: GPL-3.0-or-later
--
-- In neovim: open a wrong model with fbd-lsp, wait for its diagnostics, apply each quick fix, and wait until none is left. Prints
-- what happens; ends with 1 when something does not.

local function fail(text)
  io.stderr:write("not ok - " .. text .. "\n")
  vim.cmd("cquit 1")
end

local function check(text, condition)
  if not condition then fail(text) end
  io.stdout:write("ok - " .. text .. "\n")
end

local buffer = vim.api.nvim_get_current_buf()
local client = vim.lsp.start_client({name = "fbd", cmd = {"fbd-lsp", "--stdio"}, root_dir = vim.fn.getcwd()})
check("the server starts", client ~= nil)
vim.lsp.buf_attach_client(buffer, client)
check("diagnostics arrive", vim.wait(20000, function() return #vim.diagnostic.get(buffer) == 2 end, 50))

for _, diagnostic in ipairs(vim.diagnostic.get(buffer)) do
  io.stdout:write(string.format("   %d:%d %s\n", diagnostic.lnum + 1, diagnostic.col + 1, diagnostic.message:gsub("\n", " ")))
end

local function quick_fixes()
  local params = {
    textDocument = vim.lsp.util.make_text_document_params(buffer),
    range = {start = {line = 0, character = 0}, ["end"] = {line = vim.api.nvim_buf_line_count(buffer), character = 0}},
    context = {diagnostics = {}},
  }
  local answers = vim.lsp.buf_request_sync(buffer, "textDocument/codeAction", params, 20000)
  return answers and answers[client] and answers[client].result or {}
end

local actions = quick_fixes()
check("there is a quick fix for each", #actions == 2)
for _, action in ipairs(actions) do
  vim.lsp.util.apply_workspace_edit(action.edit, "utf-16")
end
check("after them no diagnostics are left", vim.wait(20000, function() return #vim.diagnostic.get(buffer) == 0 end, 50))

local text = table.concat(vim.api.nvim_buf_get_lines(buffer, 0, -1, false), "\n")
check("the text is mended", text:find("motion: slide", 1, true) and text:find("forces:", 1, true) and not text:find("focres", 1, true))
vim.cmd("qall!")
