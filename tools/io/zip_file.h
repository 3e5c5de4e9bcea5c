// SPDX-License-Identifier: Apache-2.0
// A ZIP archive, written by minizip into a file that appears when it is complete.
#pragma once

#include <cstdint>
#include <ctime>
#include <optional>
#include <string>

#include "atomic_file.h"
#include "error.h"

namespace msq_io {

class ZipFile {
 public:
  /// created: time of all entries, in seconds since 1970, UTC.
  ZipFile(const std::filesystem::path& path, bool replace, int64_t created);
  ~ZipFile();
  ZipFile(const ZipFile&) = delete;
  ZipFile& operator=(const ZipFile&) = delete;

  /// Adds an entry, stored or deflated.
  void add(const std::string& name, const void* bytes, uint64_t size, bool is_deflated);
  /// The same in pieces. is_large: it may have more than 4 GB. (Readers that check archives warn of
  /// small ones that are marked so.)
  void begin(const std::string& name, bool is_deflated, bool is_large);
  void append(const void* bytes, uint64_t size);
  void end();
  void commit();
  uint64_t size() const { return file_.size(); }

 private:
  friend struct ZipCalls;
  /// Throws what a callback kept, or `what` of minizip.
  [[noreturn]] void fail_zip(const char* what) const;

  AtomicFile file_;
  int64_t created_;
  void* zip_ = nullptr;
  /// Of a callback: no exception passes through minizip.
  std::optional<Failure> error_;
};

/// Days, hours and so on of a time in seconds since 1970, UTC (Howard Hinnant, "chrono-compatible
/// low-level date algorithms").
std::tm utc_of(int64_t seconds);

}  // namespace msq_io
