// SPDX-License-Identifier: Apache-2.0
// Writes the members of a definition into an object of a document.
#pragma once

#include "api/definition_walk.h"
#include "document/output.h"
#include "io/json_text.h"

namespace msq::document {

class ModelWriter;

/// What a walk writes, without the members that the other walk writes alike. Throws
/// Error(argument) for numbers that are not finite.
Output written(ModelWriter& writer, const api::DefinitionWalk::Part& part,
               const api::DefinitionWalk::Part& defaults);

}  // namespace msq::document
