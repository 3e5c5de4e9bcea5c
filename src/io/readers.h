// SPDX-License-Identifier: Apache-2.0
// The readers of the formats. Each adds the triangles of a whole file, in the file's unit. It
// throws Error if the file is truncated or malformed, before it allocates the sizes that the header
// gives.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "io/beam_lattice.h"
#include "io/soup_builder.h"
#include "io/zip_package.h"

namespace msq {

void read_stl(std::string_view file, SoupBuilder& soup);
void read_obj(std::string_view file, SoupBuilder& soup);
void read_ply(std::string_view file, SoupBuilder& soup);
void read_off(std::string_view file, SoupBuilder& soup);
/// These return the file's unit in millimetres; those of archives unpack within the limit.
double read_threemf(std::string_view file, UnpackLimit limit, SoupBuilder& soup);
/// Reads beam lattices, too, in the file's unit. Those that nothing clips are one.
double read_threemf_beams(std::string_view file, UnpackLimit limit, SoupBuilder& soup,
                          std::vector<BeamLattice>& lattices);
double read_gltf(std::string_view file, SoupBuilder& soup);
double read_amf(std::string_view file, UnpackLimit limit, SoupBuilder& soup);

}  // namespace msq
