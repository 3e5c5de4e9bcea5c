# SPDX-License-Identifier: Apache-2.0
# Runs the vectors through ccall: see tests/vectors/protocol.py. usage: vectors.jl MODEL POINTS ...
include("../Msq.jl")

bits(value) = string(reinterpret(UInt64, value), base = 16, pad = 16)

function print_hash(model)
    hash = zeros(UInt8, 16)
    status = Msq.msq_model_hash(model, hash)
    status == Msq.MSQ_E_UNSUPPORTED && return println("hash -")
    Msq.check(status)
    println("hash ", bytes2hex(hash))
end

function print_points(model, coordinates)
    count = length(coordinates) ÷ 3
    inside, distances = zeros(UInt8, count), zeros(count)
    GC.@preserve coordinates begin
        def = Ref(Msq.definition(Msq.msq_points_def, kind = Msq.MSQ_POINTS_ARRAY, coordinates = pointer(coordinates),
                                 count = count))
        Msq.check(Msq.msq_set_membership(model, def, C_NULL, inside, count, C_NULL))
        Msq.check(Msq.msq_set_distance(model, def, C_NULL, distances, count, C_NULL))
    end
    println("inside ", join(Int.(inside)))
    println("distance ", join(bits.(distances), " "))
end

function print_layers(model, document)
    def = Ref(Msq.definition(Msq.msq_slicer_def))
    Msq.check(Msq.msq_document_slicing(document, def))
    slicer = Msq.make(Msq.msq_slicer, Msq.msq_slicer_create, model, def)
    plan = Msq.report(Msq.msq_slicer_report, Msq.msq_slicer_info, slicer)
    println("plan $(plan.width) $(plan.height) $(plan.layer_count)")
    layer, z = zeros(UInt8, plan.layer_bytes), Ref(0.0)
    for index in 0:Int(plan.layer_count) - 1
        Msq.check(Msq.msq_slicer_layer_z(slicer, index, z))
        Msq.check(Msq.msq_slice_layer(slicer, index, layer, length(layer), C_NULL))
        println("layer $index ", bits(z[]), " ", bytes2hex(layer))
    end
end

function read_document(context, text)
    read(handle) = Msq.msq_document_from_json(context, text, sizeof(text), C_NULL, handle, C_NULL)
    Msq.make(Msq.msq_document, read)
end

context = Msq.make(Msq.msq_context, Msq.msq_context_create, C_NULL)
for (path, points) in zip(ARGS[1:2:end], ARGS[2:2:end])
    println("case")
    document = try
        read_document(context, read(path, String))
    catch problem
        println("refused ", problem.msg)
        continue
    end
    println("title ", unsafe_string(Msq.report(Msq.msq_document_report, Msq.msq_document_info, document).title))
    model = Msq.make(Msq.msq_model, Msq.msq_document_model, document)
    print_hash(model)
    print_points(model, collect(reinterpret(Float64, read(points))))
    print_layers(model, document)
end
