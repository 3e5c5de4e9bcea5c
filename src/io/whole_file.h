// SPDX-License-Identifier: Apache-2.0
// Files that are read at once.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "base/job.h"

namespace msq {

/// A path for messages: only the end of a long one, so that there is room for the reason.
std::string shown(const std::string& path);

struct FileContent {
  std::unique_ptr<char[]> bytes;
  uint64_t size = 0;

  std::string_view view() const { return {bytes.get(), size}; }
};

/// Reads a regular file. path: UTF-8 on Windows, bytes elsewhere. admit(size) is called before the
/// memory is allocated, to refuse files that are too large. job may be null. Throws Error(io) and
/// Error(cancelled).
FileContent read_whole_file(const std::string& path, const Job* job,
                            const std::function<void(uint64_t)>& admit);

}  // namespace msq
