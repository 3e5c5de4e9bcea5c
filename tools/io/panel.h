// SPDX-License-Identifier: Apache-2.0
// Panels of resin printers.
#pragma once

#include "defs.h"

namespace msq_io {

msq_io_panel_def panel_defaults();

/// Checks the definition of the host. NULL: the defaults.
msq_io_panel_def read_panel(const msq_io_panel_def* def);

}  // namespace msq_io
