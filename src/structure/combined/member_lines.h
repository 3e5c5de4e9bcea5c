// SPDX-License-Identifier: Apache-2.0
// Lines of structures that are made of others by a Boolean operation. Of a union the lines of all;
// of an intersection those of the first structure within all others, of a difference those outside
// of all others.
#pragma once

#include "structure/combined/boolean_structure.h"

namespace msq {

ThinWalls walls_of_members(BooleanStructure::Operation operation, const StructureList& members);
/// Throws Error(unsupported), with the number of a structure that has no lines.
LineGraph lines_of_members(BooleanStructure::Operation operation, const StructureList& members,
                           const WallSection& section);

}  // namespace msq
