// SPDX-License-Identifier: Apache-2.0
// A folder of files that appear together when all are complete.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace msq_io {

class AtomicFolder {
 public:
  /// Creates a temporary folder: beside the folder if that does not exist, or within it.
  AtomicFolder(const std::filesystem::path& path, bool replace);
  /// Removes the temporary folder and what is in it, unless it was committed.
  ~AtomicFolder();
  AtomicFolder(const AtomicFolder&) = delete;
  AtomicFolder& operator=(const AtomicFolder&) = delete;

  /// Fails where a file of that name exists already and must not be replaced.
  void check_free(const std::string& name) const;
  /// Writes a file. Any threads may call it, with names that differ.
  void write(const std::string& name, const void* bytes, size_t size) const;
  /// Makes the files appear: the folder itself in one step, or each file in a folder that exists. A
  /// failure removes those that have appeared.
  void commit(const std::vector<std::string>& names);

 private:
  void remove() noexcept;

  std::filesystem::path path_, temporary_;
  bool replace_, is_new_;
};

}  // namespace msq_io
