-- SPDX-License-Identifier: Apache-2.0
-- Runs the vectors through the FFI: see tests/vectors/protocol.py. usage: vectors.lua MODEL POINTS ...
local ffi = require("ffi")
local bit = require("bit")
local msq = require("msq")
local C = msq.C

local function read_file(path)
  local file = assert(io.open(path, "rb"))
  local bytes = file:read("*a")
  file:close()
  return bytes
end

local function hex(data, count)
  local digits = {}
  for i = 0, count - 1 do
    digits[#digits + 1] = ("%02x"):format(data[i])
  end
  return table.concat(digits)
end

-- The 64 bits of a double, the highest first.
local function bits(value)
  local words = ffi.cast("uint32_t*", ffi.new("double[1]", value))
  local low_first = ffi.abi("le")
  return bit.tohex(words[low_first and 1 or 0]) .. bit.tohex(words[low_first and 0 or 1])
end

local function print_hash(model)
  local hash = ffi.new("uint8_t[16]")
  local status = C.msq_model_hash(model, hash)
  if status == C.MSQ_E_UNSUPPORTED then
    return print("hash -")
  end
  msq.check(status)
  print("hash " .. hex(hash, 16))
end

local function print_points(model, bytes)
  local count = #bytes / 24
  local def = msq.definition("points_def")
  def.kind = C.MSQ_POINTS_ARRAY
  def.coordinates = bytes
  def.count = count
  local inside, distances = ffi.new("uint8_t[?]", count), ffi.new("double[?]", count)
  msq.check(C.msq_set_membership(model, def, nil, inside, count, nil))
  msq.check(C.msq_set_distance(model, def, nil, distances, count, nil))
  local digits, words = {}, {}
  for i = 0, count - 1 do
    digits[i + 1] = tostring(inside[i])
    words[i + 1] = bits(distances[i])
  end
  print("inside " .. table.concat(digits))
  print("distance " .. table.concat(words, " "))
end

local function print_layers(model, document)
  local def = msq.definition("slicer_def")
  msq.check(C.msq_document_slicing(document, def))
  local slicer = msq.make("slicer", C.msq_slicer_create, model, def)
  local plan = msq.report("slicer_report", C.msq_slicer_info, slicer)
  print(("plan %d %d %d"):format(plan.width, plan.height, tonumber(plan.layer_count)))
  local size = tonumber(plan.layer_bytes)
  local layer, z = ffi.new("uint8_t[?]", size), ffi.new("double[1]")
  for index = 0, tonumber(plan.layer_count) - 1 do
    msq.check(C.msq_slicer_layer_z(slicer, index, z))
    msq.check(C.msq_slice_layer(slicer, index, layer, size, nil))
    print(("layer %d %s %s"):format(index, bits(z[0]), hex(layer, size)))
  end
end

local context = msq.make("context", C.msq_context_create, nil)
for i = 1, #arg - 1, 2 do
  print("case")
  local text = read_file(arg[i])
  local function read(handle)
    return C.msq_document_from_json(context, text, #text, nil, handle, nil)
  end
  local is_read, document = pcall(msq.make, "document", read)
  if is_read then
    local about = msq.report("document_report", C.msq_document_info, document)
    print("title " .. ffi.string(about.title))
    local model = msq.make("model", C.msq_document_model, document)
    print_hash(model)
    print_points(model, read_file(arg[i + 1]))
    print_layers(model, document)
  else
    print("refused " .. document:match("MSQ_E_.*"))  -- without the place, which Lua puts before it
  end
end
