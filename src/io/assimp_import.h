// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "io/soup_builder.h"

namespace msq {

/// Has Assimp's importer of that one extension read a file that is known to be well-formed, and
/// adds every instance in it. Throws Error(io) with Assimp's message if it refuses.
void import_with_assimp(std::string_view file, const char* extension, SoupBuilder& soup);

}  // namespace msq
