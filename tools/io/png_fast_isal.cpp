// SPDX-License-Identifier: Apache-2.0
// PNG streams compressed by ISA-L. https://github.com/intel/isa-l
#include <isa-l/igzip_lib.h>

#include <memory>

#include "png_stream.h"

namespace msq_io {

bool encode_fast(const PngRows& image, const std::vector<uint8_t>& rows,
                 std::vector<uint8_t>& stream) {
  // Level 1 is as fast as level 0 here, with fewer bytes.
  auto level = std::make_unique_for_overwrite<uint8_t[]>(ISAL_DEF_LVL1_DEFAULT);
  // Stored blocks, which ISA-L takes where nothing is saved, have 5 bytes for each 65535.
  const size_t room = rows.size() + rows.size() / 8192 + 4096;

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
  wrap_png(image, output.get(), state.total_out, stream);
  return true;
}

}  // namespace msq_io
