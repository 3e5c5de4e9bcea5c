// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Version and licence of the msq inside, as one line; static.
const char* engine_backend();
