# SPDX-License-Identifier: Apache-2.0
# Slices a box filled with a foam, and prints the share of solid pixels of each fifth layer.
include("Msq.jl")
using .Msq: msq_context, msq_layer, msq_shape, msq_slicer, msq_structure

context = Msq.make(msq_context, Msq.msq_context_create, C_NULL)
box = Msq.make(msq_shape, Msq.msq_shape_from_box, context, [0.0, 0.0, 0.0], [20.0, 20.0, 10.0])

foam_def = Msq.definition(Msq.msq_foam_def)
foam_def = Msq.with(foam_def, grid = Msq.with(foam_def.grid, cell_size = (2, 2, 2)),
                    radius = Msq.with(foam_def.radius, value = 0.2))
foam = Msq.make(msq_structure, Msq.msq_structure_foam, context, Ref(foam_def))
model = Msq.model(context, box, foam)

slicer_def = Msq.definition(Msq.msq_slicer_def, pitch = (0.1, 0.1), layer_height = 0.5)
slicer = Msq.make(msq_slicer, Msq.msq_slicer_create, model, Ref(slicer_def))
plan = Msq.report(Msq.msq_slicer_report, Msq.msq_slicer_info, slicer)

# msq calls this on the thread that called msq_slicer_run. Exceptions must not leave it.
function take_layer(user::Ptr{Cvoid}, pointer::Ptr{msq_layer})::Int32
    layer = unsafe_load(pointer)
    solid = round(100 * layer.inside_count / (plan.width * plan.height), digits = 1)
    if layer.index % 5 == 0
        println("layer $(layer.index): $solid % solid")
    end
    return 0
end
callback = @cfunction(take_layer, Int32, (Ptr{Cvoid}, Ptr{msq_layer}))
Msq.check(Msq.msq_slicer_run(slicer, 0, typemax(UInt64), callback, C_NULL, C_NULL))
println("$(plan.layer_count) layers")

try
    Msq.make(msq_shape, Msq.msq_shape_from_sphere, context, [0.0, 0.0, 0.0], -1)
    exit(1)
catch problem
    println("refused: ", problem.msg)
end
