// SPDX-License-Identifier: Apache-2.0
// A file that gets its name when it is complete.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>

namespace msq_io {

class AtomicFile {
 public:
  /// Creates the temporary file. Fails where the name exists and `replace` is false, and where it
  /// is not that of a plain file.
  AtomicFile(const std::filesystem::path& path, bool replace);
  /// Removes the temporary file if the file was not committed.
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(const void* bytes, uint64_t size);
  void seek(uint64_t offset);
  /// Where the next bytes go.
  uint64_t offset() const { return offset_; }
  /// Size of the file so far.
  uint64_t size() const { return size_; }
  const std::filesystem::path& path() const { return path_; }
  /// Waits until the bytes are on the disk and gives the file its name.
  void commit();

 private:
  [[noreturn]] void fail_write(int code) const;
  void remove() noexcept;

  std::filesystem::path path_, temporary_;
  bool replace_;
  std::FILE* file_ = nullptr;
  uint64_t offset_ = 0, size_ = 0;
};

/// Opens a new file for writing; it must not exist. Returns null and sets errno where it cannot.
std::FILE* create_file(const std::filesystem::path& path);

}  // namespace msq_io
