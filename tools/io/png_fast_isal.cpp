// SPDX-License-Identifier: Apache-2.0
// PNG streams compressed by ISA-L. https://github.com/intel/isa-l
#include <isa-l/igzip_lib.h>
#include <zlib.h>

#include <memory>

#include "png_stream.h"

namespace msq_io {

namespace {

void append_be32(std::vector<uint8_t>& to, uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) to.push_back(static_cast<uint8_t>(value >> shift));
}

/// Ends the chunk that began with its length at `start`.
void end_chunk(std::vector<uint8_t>& stream, size_t start) {
  const auto size = static_cast<uint32_t>(stream.size() - start - 8);
  for (size_t i = 0; i < 4; ++i) stream[start + i] = static_cast<uint8_t>(size >> (24 - 8 * i));
  append_be32(stream, static_cast<uint32_t>(crc32(0, stream.data() + start + 4, size + 4)));
}

/// Returns where the chunk starts.
size_t begin_chunk(std::vector<uint8_t>& stream, const char* name) {
  const size_t start = stream.size();
  append_be32(stream, 0);
  stream.insert(stream.end(), name, name + 4);
  return start;
}

}  // namespace

bool encode_fast(const PngRows& image, const std::vector<uint8_t>& rows,
                 std::vector<uint8_t>& stream) {
  // Level 1 is as fast as level 0 here, with fewer bytes.
  auto level = std::make_unique_for_overwrite<uint8_t[]>(ISAL_DEF_LVL1_DEFAULT);
  // Stored blocks, which ISA-L takes where nothing is saved, have 5 bytes for each 65535.
  const size_t room = rows.size() + rows.size() / 8192 + 4096;

  stream.clear();
  static constexpr uint8_t signature[8] = {137, 80, 78, 71, 13, 10, 26, 10};
  stream.insert(stream.end(), signature, signature + 8);
  size_t chunk = begin_chunk(stream, "IHDR");
  append_be32(stream, image.width);
  append_be32(stream, image.height);
  const uint8_t kind[5] = {static_cast<uint8_t>(image.depth),
                           static_cast<uint8_t>(image.channels == 1   ? 0
                                                : image.channels == 3 ? 2
                                                                      : 6),
                           0, 0, 0};
  stream.insert(stream.end(), kind, kind + 5);
  end_chunk(stream, chunk);

  chunk = begin_chunk(stream, "IDAT");
  auto output = std::make_unique_for_overwrite<uint8_t[]>(room);
  isal_zstream state;
  isal_deflate_stateless_init(&state);
  state.level = 1;
  state.level_buf = level.get();
  state.level_buf_size = ISAL_DEF_LVL1_DEFAULT;
  state.gzip_flag = IGZIP_ZLIB;
  state.end_of_stream = 1;
  state.next_in = const_cast<uint8_t*>(rows.data());
  state.avail_in = static_cast<uint32_t>(rows.size());
  state.next_out = output.get();
  state.avail_out = static_cast<uint32_t>(room);
  const int code = isal_deflate_stateless(&state);
  if (code != COMP_OK || state.avail_in != 0)
    fail(MSQ_E_INTERNAL, "ISA-L does not compress %zu bytes: %d", rows.size(), code);
  stream.insert(stream.end(), output.get(), output.get() + state.total_out);
  end_chunk(stream, chunk);

  end_chunk(stream, begin_chunk(stream, "IEND"));
  return true;
}

}  // namespace msq_io
