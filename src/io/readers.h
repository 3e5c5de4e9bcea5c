// SPDX-License-Identifier: Apache-2.0
// The readers of the formats. Each adds the triangles of a whole file, in the file's unit, and
// throws Error on files that are truncated or malformed, before it allocates what their headers
// claim.
#pragma once

#include <cstdint>
#include <string_view>

#include "io/soup_builder.h"

namespace msq {

void read_stl(std::string_view file, SoupBuilder& soup);
void read_obj(std::string_view file, SoupBuilder& soup);
void read_ply(std::string_view file, SoupBuilder& soup);
void read_off(std::string_view file, SoupBuilder& soup);
/// These two return the millimetres of the file's unit, and unpack no more than max_bytes.
double read_threemf(std::string_view file, uint64_t max_bytes, SoupBuilder& soup);
double read_amf(std::string_view file, uint64_t max_bytes, SoupBuilder& soup);

}  // namespace msq
