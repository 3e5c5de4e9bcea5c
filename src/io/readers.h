// SPDX-License-Identifier: Apache-2.0
// The readers of the formats. Each adds the triangles of a whole file, in the file's unit. It
// throws Error if the file is truncated or malformed, before it allocates the sizes that the header
// gives.
#pragma once

#include <cstdint>
#include <string_view>

#include "io/soup_builder.h"

namespace msq {

void read_stl(std::string_view file, SoupBuilder& soup);
void read_obj(std::string_view file, SoupBuilder& soup);
void read_ply(std::string_view file, SoupBuilder& soup);
void read_off(std::string_view file, SoupBuilder& soup);
/// These two return the file's unit in millimetres, and unpack at most max_bytes.
double read_threemf(std::string_view file, uint64_t max_bytes, SoupBuilder& soup);
double read_amf(std::string_view file, uint64_t max_bytes, SoupBuilder& soup);

}  // namespace msq
