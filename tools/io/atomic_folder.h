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
  /// failure removes those that have appeared, and puts back those that they had replaced.
  void commit(const std::vector<std::string>& names);

 private:
  void remove() noexcept;
  /// Keeps the file that has a name, if there is one, in another folder.
  void keep_old(const std::string& name, const std::filesystem::path& to) const;
  /// Undoes a step of commit(). is_new: whether the new file has the name already.
  void put_back(const std::string& name, const std::filesystem::path& from, bool is_new) const;

  std::filesystem::path path_, temporary_;
  bool replace_, is_new_;
};

}  // namespace msq_io
