// SPDX-License-Identifier: Apache-2.0
#include "io/zip_directory.h"

#include <cstddef>
#include <cstdint>

namespace msq {
namespace {

constexpr size_t none = std::string_view::npos;

/// Reads numbers, lowest byte first; returns false past the end of the file.
class Record {
 public:
  Record(std::string_view file, uint64_t at) : file_(file), at_(at) {}

  template <int bytes>
  bool number(uint64_t& value) {
    if (at_ > file_.size() || file_.size() - at_ < bytes) return false;
    value = 0;
    for (int i = 0; i < bytes; ++i)
      value |= uint64_t{static_cast<uint8_t>(file_[at_++])} << (8 * i);
    return true;
  }

 private:
  std::string_view file_;
  uint64_t at_;
};

/// Position of the last such signature, no farther from the end than the maximum length of a
/// comment.
size_t find_signature(std::string_view file, std::string_view signature) {
  constexpr size_t far = 0xffff;
  const size_t at = file.rfind(signature);
  return at != none && file.size() - at <= far ? at : none;
}

/// Reads the fields that both end records share: whether the directory is in this file, and ends
/// before the record.
template <int count_bytes, int disk_bytes, int size_bytes>
bool is_valid(Record record, uint64_t at) {
  uint64_t disk, directory_disk, here, all, size, offset;
  return record.number<disk_bytes>(disk) && record.number<disk_bytes>(directory_disk) &&
         record.number<count_bytes>(here) && record.number<count_bytes>(all) &&
         record.number<size_bytes>(size) && record.number<size_bytes>(offset) && disk == 0 &&
         directory_disk == 0 && here == all && size <= at && offset <= at - size;
}

/// Position of the end record of a Zip64 archive.
size_t find_zip64_end(std::string_view file) {
  const size_t locator = find_signature(file, "PK\x06\x07");
  if (locator == none) return none;
  Record record(file, locator + 4);
  uint64_t disk, at, disks;
  if (!record.number<4>(disk) || !record.number<8>(at) || !record.number<4>(disks)) return none;
  if (disk != 0 || disks != 1 || at > file.size()) return none;
  return file.substr(at).starts_with("PK\x06\x06") ? at : none;
}

}  // namespace

bool has_zip_directory(std::string_view file) {
  if (const size_t at = find_zip64_end(file); at != none)
    return is_valid<8, 4, 8>(Record(file, at + 4 + 8 + 2 + 2), at);
  const size_t at = find_signature(file, "PK\x05\x06");
  return at != none && is_valid<2, 2, 4>(Record(file, at + 4), at);
}

}  // namespace msq
