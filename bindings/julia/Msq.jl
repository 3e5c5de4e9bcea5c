# SPDX-License-Identifier: Apache-2.0
# msq for Julia: the C ABI through ccall, with handles that release themselves and statuses as errors.
#
#   include("Msq.jl")
#   context = Msq.make(Msq.msq_context, Msq.msq_context_create, C_NULL)
#
# MSQ_LIBRARY names the library if the loader does not find libmsq.so.0.
module Msq

const library = get(ENV, "MSQ_LIBRARY", "libmsq.so.0")
include("abi.jl")

# Throws what a status says.
function check(status)
    status == MSQ_OK && return
    error(unsafe_string(msq_status_name(status)), ": ", unsafe_string(msq_error_message()))
end

# A copy of a struct with other values of some fields. Tuples are the arrays of C. Throws an ArgumentError if the struct
# has no field of a name.
function with(value::T; fields...) where {T}
    for name in keys(fields)
        hasfield(T, name) || throw(ArgumentError(string(nameof(T), " has no field ", name)))
    end
    T((convert(fieldtype(T, name), get(fields, name, getfield(value, name))) for name in fieldnames(T))...)
end

# A definition with its defaults and the given fields: Msq.definition(Msq.msq_slicer_def, layer_height = 0.5).
# Functions take it as a Ref.
function definition(::Type{T}; fields...) where {T}
    def = Ref{T}()
    check(getfield(Msq, Symbol(nameof(T), :_init))(def, sizeof(T)))
    with(def[]; fields...)
end

# A report, filled in: Msq.report(Msq.msq_slicer_report, Msq.msq_slicer_info, slicer).
function report(::Type{T}, call, arguments...) where {T}
    empty = reinterpret(T, zeros(UInt8, sizeof(T)))[1]
    filled = Ref(with(empty, struct_size = sizeof(T)))
    check(call(arguments..., filled))
    filled[]
end

# A reference to an object of msq, which is released when this is collected. T is msq_shape, msq_model, ...
mutable struct Object{T}
    pointer::Ptr{T}
end
Base.unsafe_convert(::Type{Ptr{T}}, object::Object{T}) where {T} = object.pointer

# An object of a kind: create(arguments..., handle) makes it.
function make(::Type{T}, create, arguments...) where {T}
    handle = Ref{Ptr{T}}(C_NULL)
    check(create(arguments..., handle))
    release = getfield(Msq, Symbol(nameof(T), :_release))
    finalizer(object -> release(object.pointer), Object{T}(handle[]))
end

# A model of a shape that structures fill.
function model(context, shape, structures...)
    objects = [shape, structures...]
    first = with(reinterpret(msq_scale_def, zeros(UInt8, sizeof(msq_scale_def)))[1], shape = shape.pointer)
    scales = [first; [with(first, shape = C_NULL, structure = each.pointer) for each in structures]]
    GC.@preserve objects scales begin
        def = definition(msq_model_def, scales = pointer(scales), scale_count = length(scales),
                         scale_size = sizeof(msq_scale_def))
        make(msq_model, msq_model_create, context, Ref(def))
    end
end

end
