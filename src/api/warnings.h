// SPDX-License-Identifier: Apache-2.0
// Warnings to the host about what is legal but doubtful. All are given on the calling thread, by
// the functions of src/api, once their work is done: no lock is held there.
#pragma once

#include <vector>

#include "cell/context.h"
#include "shape/shape.h"
#include "slice/slicer.h"
#include "structure/lattice/cell/unit_cell.h"

namespace msq::api {

/// Of a new mesh that is read by MSQ_WINDING_AUTO.
void warn_of_open_mesh(const Context& context, const Shape& mesh);
/// Of a new lattice, with one unit cell or a library.
void warn_of_faces(const Context& context, const std::vector<UnitCell>& library);
/// Of a new slicer.
void warn_of_pitch(const Slicer& slicer);
/// After a call that evaluated a model. Takes a few nanoseconds without a host's callback, else
/// about a microsecond.
void warn_of_cache(Context& context);

}  // namespace msq::api
