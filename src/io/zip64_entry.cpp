// SPDX-License-Identifier: Apache-2.0
#include "io/zip64_entry.h"

#include <zlib.h>

#include <algorithm>
#include <memory>
#include <new>

namespace msq {
namespace {

/// A number, lowest byte first; the caller knows that it is within the file.
uint64_t number_at(std::string_view file, uint64_t at, int bytes) {
  uint64_t value = 0;
  for (int i = 0; i < bytes; ++i)
    value |= uint64_t{static_cast<uint8_t>(file[at + static_cast<uint64_t>(i)])} << (8 * i);
  return value;
}

/// Part of the file, empty if it is not all there.
std::string_view part_of(std::string_view file, uint64_t at, uint64_t bytes) {
  if (at > file.size() || bytes > file.size() - at) return {};
  return file.substr(at, bytes);
}

}  // namespace

std::optional<Zip64Entry> read_zip64_entry(std::string_view file, uint64_t record) {
  constexpr uint64_t fixed = 46, full = UINT32_MAX;
  const std::string_view head = part_of(file, record, fixed);
  if (!head.starts_with("PK\x01\x02")) return std::nullopt;
  Zip64Entry entry{};
  entry.method = static_cast<uint16_t>(number_at(head, 10, 2));
  entry.crc = static_cast<uint32_t>(number_at(head, 16, 4));
  entry.packed = number_at(head, 20, 4);
  entry.unpacked = number_at(head, 24, 4);
  entry.offset = number_at(head, 42, 4);
  if (entry.packed != full && entry.unpacked != full && entry.offset != full) return std::nullopt;
  const std::string_view extra =
      part_of(file, record + fixed + number_at(head, 28, 2), number_at(head, 30, 2));
  for (uint64_t at = 0; extra.size() - at >= 4;) {
    const uint64_t kind = number_at(extra, at, 2), size = number_at(extra, at + 2, 2);
    at += 4;
    if (size > extra.size() - at) return std::nullopt;
    if (kind == 1) {
      uint64_t next = at;
      for (uint64_t* number : {&entry.unpacked, &entry.packed, &entry.offset}) {
        if (*number != full) continue;
        if (at + size - next < 8) return std::nullopt;
        *number = number_at(extra, next, 8);
        next += 8;
      }
      return entry;
    }
    at += size;
  }
  return std::nullopt;
}

std::optional<std::string> unpack(std::string_view file, const Zip64Entry& entry, const Job* job) {
  constexpr uint64_t fixed = 30;
  const std::string_view head = part_of(file, entry.offset, fixed);
  if (!head.starts_with("PK\x03\x04")) return std::nullopt;
  const uint64_t begin = entry.offset + fixed + number_at(head, 26, 2) + number_at(head, 28, 2);
  const std::string_view packed = part_of(file, begin, entry.packed);
  if (packed.size() != entry.packed || (entry.method != 0 && entry.method != Z_DEFLATED))
    return std::nullopt;
  std::string content;
  if (entry.method == 0) {
    if (entry.packed != entry.unpacked) return std::nullopt;
    content = packed;
  } else {
    z_stream stream{};
    const int begun = inflateInit2(&stream, -MAX_WBITS);
    if (begun == Z_MEM_ERROR) throw std::bad_alloc();
    if (begun != Z_OK) return std::nullopt;
    const auto end = [](z_stream* s) { inflateEnd(s); };
    const std::unique_ptr<z_stream, decltype(end)> ending(&stream, end);
    constexpr uint64_t piece = 1 << 18;
    uint64_t taken = 0;
    for (int result = Z_OK; result != Z_STREAM_END;) {
      check_cancelled(job);
      const uint64_t in = std::min(piece, packed.size() - taken);
      stream.next_in =
          reinterpret_cast<Bytef*>(const_cast<char*>(packed.data() + taken));  // it only reads
      stream.avail_in = static_cast<uInt>(in);
      const uint64_t size = content.size(), out = std::min(piece, entry.unpacked - size) + 1;
      content.resize(size + out);  // a byte more, so that content that is too long shows
      stream.next_out = reinterpret_cast<Bytef*>(content.data() + size);
      stream.avail_out = static_cast<uInt>(out);
      result = inflate(&stream, Z_NO_FLUSH);
      if (result == Z_MEM_ERROR) throw std::bad_alloc();
      taken += in - stream.avail_in;
      const uint64_t got = out - stream.avail_out;
      content.resize(size + got);
      const bool is_stuck = result == Z_OK && got == 0 && in == stream.avail_in;
      if ((result != Z_OK && result != Z_STREAM_END) || is_stuck || content.size() > entry.unpacked)
        return std::nullopt;
    }
  }
  uLong crc = crc32(0, nullptr, 0);
  for (uint64_t at = 0; at < content.size();) {
    const auto bytes = static_cast<uInt>(std::min<uint64_t>(content.size() - at, 1 << 30));
    crc = crc32(crc, reinterpret_cast<const Bytef*>(content.data() + at), bytes);
    at += bytes;
  }
  if (content.size() != entry.unpacked || crc != entry.crc) return std::nullopt;
  return content;
}

}  // namespace msq
