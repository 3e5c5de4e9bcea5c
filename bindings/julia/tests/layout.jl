# SPDX-License-Identifier: Apache-2.0
# Prints what check_layout.py compares with abi.json: structs with their sizes, fields with their offsets, constants.
include("../Msq.jl")

for name in names(Msq, all = true)
    startswith(string(name), r"msq_|MSQ_") || continue
    value = getfield(Msq, name)
    if value isa Integer
        println("constant $name $value")
    elseif value isa DataType && fieldcount(value) > 0
        println("struct $name $(sizeof(value))")
        for i in 1:fieldcount(value)
            println("field $name $(fieldname(value, i)) $(fieldoffset(value, i)) $(sizeof(fieldtype(value, i)))")
        end
    elseif value isa Function
        println("function $name $(first(methods(value)).nargs - 1)")
    end
end
