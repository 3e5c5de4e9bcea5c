// SPDX-License-Identifier: Apache-2.0
// Entries of zip archives whose sizes or place are in a Zip64 field, as lib3mf writes them at any
// size. minizip 1.1, which Debian ships, does not read that field on 64-bit systems: it compares
// with 2^64 - 1 in place of 2^32 - 1.
// Source: PKWARE, "APPNOTE.TXT - .ZIP File Format Specification", sections 4.3.7, 4.3.12, 4.5.3.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/job.h"

namespace msq {

struct Zip64Entry {
  uint16_t method;
  uint32_t crc;
  uint64_t packed, unpacked;  ///< bytes
  uint64_t offset;            ///< of its local header
};

/// The entry of a record of the directory; nothing if the record has no such field, or is damaged.
std::optional<Zip64Entry> read_zip64_entry(std::string_view file, uint64_t record);

/// The content of an entry; nothing if it is damaged or packed in another way than by deflate.
/// Takes no more memory than the content that is there, and at most entry.unpacked.
std::optional<std::string> unpack(std::string_view file, const Zip64Entry& entry, const Job* job);

}  // namespace msq
