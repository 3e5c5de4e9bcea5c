// SPDX-License-Identifier: Apache-2.0
// Source: PKWARE, "APPNOTE.TXT - .ZIP File Format Specification", sections 4.3.14 to 4.3.16.
#pragma once

#include <string_view>

namespace msq {

/// Whether the bytes end with a valid directory of a zip archive that is in one file and within
/// these bytes. Uses the same rules as minizip, which opens such archives unless memory fails.
bool has_zip_directory(std::string_view file);

}  // namespace msq
