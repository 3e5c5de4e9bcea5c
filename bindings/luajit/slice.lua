-- SPDX-License-Identifier: Apache-2.0
-- Slices a box filled with a foam, and prints the share of solid pixels of each fifth layer.
local ffi = require("ffi")
local bit = require("bit")
local msq = require("msq")
local C = msq.C

local function vector(x, y, z)
  return ffi.new("double[3]", x, y, z)
end

local context = msq.make("context", C.msq_context_create, nil)
local box = msq.make("shape", C.msq_shape_from_box, context, vector(0, 0, 0), vector(20, 20, 10))

local foam_def = msq.definition("foam_def")
for axis = 0, 2 do
  foam_def.grid.cell_size[axis] = 2
end
foam_def.radius.value = 0.2
local foam = msq.make("structure", C.msq_structure_foam, context, foam_def)

local scales = ffi.new("msq_scale_def[2]")
scales[0].shape = box
scales[1].structure = foam
local model_def = msq.definition("model_def")
model_def.scales = scales
model_def.scale_count = 2
model_def.scale_size = ffi.sizeof("msq_scale_def")
local model = msq.make("model", C.msq_model_create, context, model_def)

local slicer_def = msq.definition("slicer_def")
slicer_def.output = C.MSQ_LAYER_BYTES
slicer_def.pitch[0], slicer_def.pitch[1] = 0.1, 0.1
slicer_def.layer_height = 0.5
local slicer = msq.make("slicer", C.msq_slicer_create, model, slicer_def)
local info = msq.report("slicer_report", C.msq_slicer_info, slicer)

-- One layer a call: LuaJIT compiles no code that C calls back, so there is no msq_slicer_run here.
local bytes = tonumber(info.layer_bytes)
local layer = ffi.new("uint8_t[?]", bytes)
for index = 0, tonumber(info.layer_count) - 1, 5 do
  msq.check(C.msq_slice_layer(slicer, index, layer, bytes, nil))
  local solid = 0
  for i = 0, bytes - 1 do
    solid = solid + bit.band(layer[i], 1)
  end
  print(("layer %d: %.1f %% solid"):format(index, 100 * solid / (info.width * info.height)))
end
print(("%d layers"):format(tonumber(info.layer_count)))

local ok, message = pcall(msq.make, "shape", C.msq_shape_from_sphere, context, vector(0, 0, 0), -1)
assert(not ok)
print("refused: " .. message)
