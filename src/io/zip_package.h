// SPDX-License-Identifier: Apache-2.0
// A zip archive in memory.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace msq {

class ZipPackage {
 public:
  /// Whether the bytes begin as a zip archive does.
  static bool is_zip(std::string_view file) { return file.starts_with("PK\x03\x04"); }

  /// The file must outlive this. Throws Error(io) if it is not an archive. All entries read
  /// together may not unpack to more than max_bytes.
  ZipPackage(std::string_view file, uint64_t max_bytes);
  ~ZipPackage();

  /// Content of an entry, found without regard to case; none if there is no such entry. Throws
  /// Error(limit) before it unpacks too much, Error(io) on damage.
  std::optional<std::string> read(const std::string& name);
  /// Name of the first entry that ends so, without regard to case; of the first entry of all if
  /// none does.
  std::string find_by_ending(std::string_view ending);

 private:
  struct Archive;
  std::unique_ptr<Archive> archive_;
  uint64_t bytes_left_, max_bytes_;
};

}  // namespace msq
