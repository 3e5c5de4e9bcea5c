// SPDX-License-Identifier: Apache-2.0
// Images of all sorts through the compressor of layers, read back by programs of others.
#include "png_stream.h"

#include <cstdlib>
#include <random>

#include "decoders.h"
#include "msq_test.h"

namespace {

using namespace msq_io;

/// The same numbers on every machine.
using Random = std::mt19937_64;

void check(const PngRows& image, const std::vector<uint8_t>& rows) {
  std::vector<uint8_t> stream;
  encode_png(image, rows, 0, stream);
  assert_in_range(stream.size(), 40, image.bytes() + image.bytes() / 8 + 1000);
  for (size_t k = 0; k < decoder_count; ++k) {
    decoded got = {};
    if (decoders[k].decode(stream.data(), stream.size(), &got) != 0)
      fail_msg("%s does not read %u x %u pixels", decoders[k].name, image.width, image.height);
    assert_int_equal(got.width, image.width);
    assert_int_equal(got.height, image.height);
    assert_int_equal(got.depth, image.depth);
    for (uint32_t y = 0; y < image.height; ++y)
      for (uint32_t x = 0; x < image.width; ++x) {
        const uint8_t* row = rows.data() + y * image.row_bytes() + 1;
        const int wanted = image.depth == 1 ? (row[x / 8] >> (7 - x % 8) & 1) * 255 : row[x];
        const int found = got.pixels[size_t{y} * image.width + x];
        if (found != wanted)
          fail_msg("%s: pixel %u, %u of %u x %u is %d, not %d", decoders[k].name, x, y, image.width,
                   image.height, found, wanted);
      }
    std::free(got.pixels);
  }
}

/// Bytes of an image one after the other, without the bits that pad rows.
template <class Bytes>
void check_of(uint32_t width, uint32_t height, uint32_t depth, Bytes&& bytes) {
  const PngRows image{width, height, depth, 1};
  std::vector<uint8_t> rows(image.bytes());
  for (uint32_t y = 0; y < height; ++y) {
    uint8_t* row = rows.data() + y * image.row_bytes();
    for (uint64_t i = 1; i < image.row_bytes(); ++i) row[i] = bytes();
    if (depth == 1 && width % 8 != 0)
      row[image.row_bytes() - 1] &= static_cast<uint8_t>(0xff00 >> width % 8);
  }
  check(image, rows);
}

void sizes(void**) {
  Random random(1);
  for (const uint32_t width : {1u, 7u, 8u, 9u, 55u, 56u, 57u, 64u, 2047u})
    for (const uint32_t height : {1u, 2u, 5u})
      for (const uint32_t depth : {1u, 8u})
        for (const uint64_t rare : {1, 9, 100000})
          check_of(width, height, depth, [&] {
            return random() % rare == 0 ? static_cast<uint8_t>(random()) : uint8_t{0};
          });
}

/// A first row that is zero except for one byte, at every place: the runs that follow it reach
/// through rows that repeat the first, for every length of matches.
void lengths_of_runs(void**) {
  for (uint32_t run = 0; run < 800; ++run) {
    uint32_t at = 0;
    check_of(820, 2, 8, [&] { return at++ % 820 == run ? uint8_t{200} : uint8_t{0}; });
  }
}

/// More bytes than a block has, of noise, of nothing, and of both in turn.
void blocks(void**) {
  Random random(2);
  check_of(1500, 1500, 8, [&] { return static_cast<uint8_t>(random()); });
  check_of(4000, 3000, 8, [] { return uint8_t{0}; });
  uint64_t at = 0;
  check_of(1500, 1500, 8,
           [&] { return ++at / 500000 % 2 == 0 ? static_cast<uint8_t>(random()) : uint8_t{255}; });
  check_of(9000, 2000, 1, [&] { return random() % 30 == 0 ? uint8_t{1} : uint8_t{255}; });
  // A block for each row. libpng reads rows of up to a million pixels.
  check_of(900000, 3, 8, [&] { return random() % 999 == 0 ? uint8_t{7} : uint8_t{0}; });
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(sizes), cmocka_unit_test(lengths_of_runs),
                              cmocka_unit_test(blocks)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
