-- SPDX-License-Identifier: Apache-2.0
-- msq for LuaJIT: the C ABI with handles that release themselves and statuses as errors.
--
--   local msq = require("msq")
--   local context = msq.make("context", msq.C.msq_context_create, nil)
--
-- MSQ_LIBRARY names the library if the loader does not find libmsq.so.0.
local ffi = require("ffi")
require("msq_cdef")

local C = ffi.load(os.getenv("MSQ_LIBRARY") or "libmsq.so.0")
local msq = { C = C }

-- Raises what a status says.
function msq.check(status)
  if status ~= 0 then
    error(ffi.string(C.msq_status_name(status)) .. ": " .. ffi.string(C.msq_error_message()), 2)
  end
end

-- A definition with its defaults: msq.definition("foam_def").
function msq.definition(name)
  local def = ffi.new("msq_" .. name)
  msq.check(C["msq_" .. name .. "_init"](def, ffi.sizeof(def)))
  return def
end

-- A report, filled in: msq.report("slicer_report", C.msq_slicer_info, slicer).
function msq.report(name, call, ...)
  local report = ffi.new("msq_" .. name)
  report.struct_size = ffi.sizeof(report)
  local arguments = { ... }
  arguments[#arguments + 1] = report
  msq.check(call(unpack(arguments)))
  return report
end

-- An object of a kind, such as "shape", released when it is collected: create(..., handle) makes it.
function msq.make(kind, create, ...)
  local handle = ffi.new("msq_" .. kind .. "*[1]")
  local count = select("#", ...)
  local arguments = { ... }
  arguments[count + 1] = handle
  msq.check(create(unpack(arguments, 1, count + 1)))
  return ffi.gc(handle[0], C["msq_" .. kind .. "_release"])
end

return msq
