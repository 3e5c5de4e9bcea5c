// SPDX-License-Identifier: Apache-2.0
// A zip archive in memory.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "base/job.h"

namespace msq {

class ZipPackage {
 public:
  /// Whether the bytes begin like a zip archive.
  static bool is_zip(std::string_view file) { return file.starts_with("PK\x03\x04"); }

  /// The file, and the job, which may be null, must outlive this. Throws Error(io) if the file is
  /// not an archive. All entries together may unpack to at most max_bytes.
  ZipPackage(std::string_view file, uint64_t max_bytes, const Job* job);
  ~ZipPackage();

  /// Content of an entry, found without regard to case; empty if there is no such entry. Throws
  /// Error(limit) before it unpacks too much, Error(io) on damage, Error(cancelled).
  std::optional<std::string> read(const std::string& name);
  /// Name of the first entry with this ending, without regard to case; of the first entry of all if
  /// there is none.
  std::string find_by_ending(std::string_view ending);

 private:
  struct Archive;
  std::unique_ptr<Archive> archive_;
  uint64_t bytes_left_, max_bytes_;
  const Job* job_;
};

}  // namespace msq
