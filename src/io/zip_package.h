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

/// How much the entries of an archive may unpack to together.
struct UnpackLimit {
  uint64_t bytes;
  /// The context's memory_limit that it follows from; 0: it is max_bytes.
  uint64_t memory_limit = 0;
};

class ZipPackage {
 public:
  /// Whether the bytes begin like a zip archive.
  static bool is_zip(std::string_view file) { return file.starts_with("PK\x03\x04"); }

  /// The file, and the job, which may be null, must outlive this. Throws Error(io) if the file is
  /// not an archive.
  ZipPackage(std::string_view file, UnpackLimit limit, const Job* job);
  ~ZipPackage();

  /// Content of an entry, found without regard to case; empty if there is no such entry. Throws
  /// Error(limit) before it unpacks too much, Error(io) on damage, Error(cancelled).
  std::optional<std::string> read(const std::string& name);
  /// Name of the first entry with this ending, without regard to case; of the first entry of all if
  /// there is none.
  std::string find_by_ending(std::string_view ending);

 private:
  /// Throws Error(limit) for an entry that would pass the limit.
  [[noreturn]] void fail_large(const std::string& name, uint64_t bytes) const;

  struct Archive;
  std::unique_ptr<Archive> archive_;
  UnpackLimit limit_;
  uint64_t bytes_left_;
  const Job* job_;
};

}  // namespace msq
