# SPDX-License-Identifier: Apache-2.0
# Definitions have the given values, and refuse fields that their struct does not have.
using Test
include("../Msq.jl")

def = Msq.definition(Msq.msq_slicer_def, pitch = (0.1, 0.2), layer_height = 0.5)
@test def.pitch == (0.1, 0.2)
@test def.layer_height == 0.5
@test Msq.with(def, layer_height = 1).layer_height == 1.0
@test Msq.with(def).pitch == def.pitch

function message(call)
    try
        call()
    catch problem
        return problem isa ArgumentError ? problem.msg : string(problem)
    end
    return "no error"
end
@test message(() -> Msq.definition(Msq.msq_slicer_def, heigth = 0.5)) == "msq_slicer_def has no field heigth"
@test message(() -> Msq.with(def, pitch = (1, 1), height = 2)) == "msq_slicer_def has no field height"
