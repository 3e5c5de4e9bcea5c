// SPDX-License-Identifier: Apache-2.0
// The struts of a foam that have a point in the shell of warped cells.
#pragma once

#include <memory>

#include "structure/common/cell_shell.h"
#include "structure/common/struts.h"

namespace msq {

/// Refers to the shell. Null without struts.
std::unique_ptr<StrutParts> shelled_struts(std::unique_ptr<StrutParts> struts,
                                           const CellShell& shell);

}  // namespace msq
