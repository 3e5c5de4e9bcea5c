// SPDX-License-Identifier: Apache-2.0
// The struts of a union: those of its members, one member after the other.
#pragma once

#include <memory>

#include "structure/combined/members.h"

namespace msq {

/// Null if a member has no struts. Ids are hashes of the members' ids and the members' numbers, so
/// that those of two members differ, also if they are the same structure. Refers to the members.
std::unique_ptr<StrutParts> union_struts(const StructureList& members,
                                         const StrutSelection& selection);

}  // namespace msq
