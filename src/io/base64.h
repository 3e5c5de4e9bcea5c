// SPDX-License-Identifier: Apache-2.0
// Source: IETF, RFC 4648, "The Base16, Base32, and Base64 Data Encodings", 2006, section 4.
#pragma once

#include <string>
#include <string_view>

#include "base/job.h"

namespace msq {

/// Appends the bytes that the text stands for. Returns false on text that is not base64. The job
/// may be null.
bool decode_base64(std::string_view text, std::string& bytes, const Job* job);

}  // namespace msq
