// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "io/soup_builder.h"

namespace msq {

/// Reads a file, known to be well-formed, with Assimp's importer for one extension, and adds every
/// instance in it. Throws Error(io) with Assimp's message if the importer fails.
void import_with_assimp(std::string_view file, const char* extension, SoupBuilder& soup);

}  // namespace msq
