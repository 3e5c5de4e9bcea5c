// SPDX-License-Identifier: Apache-2.0
// The bytes that hashes are made of, and the hash of them.
#include "base/hash_input.h"

#include <algorithm>
#include <bit>
#include <cstdio>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "msq_test.h"

using namespace msq;

namespace {

std::string digits(const Hash& hash) {
  std::string text;
  char two[3];
  for (uint8_t byte : hash) {
    snprintf(two, sizeof two, "%02x", static_cast<unsigned>(byte));
    text += two;
  }
  return text;
}

Hash digest_of(const std::string& bytes) {
  Digest digest;
  digest.add(bytes.data(), bytes.size());
  return digest.finish();
}

// Vectors of xxHash's own documentation and of xxhsum.
void digests_are_those_of_xxh3(void**) {
  assert_string_equal(digits(digest_of("")).c_str(), "99aa06d3014798d86001c324468d497f");
  assert_string_equal(digits(digest_of("msq")).c_str(), "5a803ffec4257046084d3ad941630052");
  // In any parts.
  std::string text;
  for (int i = 0; i < 5000; ++i) text += static_cast<char>(i * 7);
  Digest parts;
  for (size_t first = 0, size = 1; first < text.size(); first += size++)
    parts.add(text.data() + first, std::min(size, text.size() - first));
  assert_true(parts.finish() == digest_of(text));
}

std::string little_endian(uint64_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i));
  return text;
}

std::string with_version(const std::string& bytes) {
  return little_endian(hash_version, 8) + bytes;
}

/// What write() adds is hashed as these bytes.
template <class Write>
void assert_written(const std::string& bytes, Write&& write) {
  HashInput input;
  write(input);
  assert_string_equal(digits(input.finish()).c_str(),
                      digits(digest_of(with_version(bytes))).c_str());
}

void numbers_are_little_endian(void**) {
  assert_written(little_endian(0x0102030405060708, 8),
                 [](HashInput& input) { input.integer(0x0102030405060708); });
  assert_written(little_endian(std::bit_cast<uint64_t>(-1.5), 8),
                 [](HashInput& input) { input.number(-1.5); });
  assert_written(little_endian(3, 8) + "abc", [](HashInput& input) { input.text("abc"); });
  const int16_t shorts[2] = {-2, 300};
  assert_written(little_endian(2, 8) + little_endian(0xfffe, 2) + little_endian(300, 2),
                 [&](HashInput& input) { input.list(shorts, 2); });
  std::string bytes = little_endian(700, 8);
  std::vector<float> floats(700);
  for (size_t i = 0; i < floats.size(); ++i) {
    floats[i] = static_cast<float>(i) * 0.37f;
    bytes += little_endian(std::bit_cast<uint32_t>(floats[i]), 4);
  }
  assert_written(bytes, [&](HashInput& input) { input.list(floats.data(), floats.size()); });
  assert_written(little_endian(0, 8), [](HashInput& input) { input.points({}); });
}

void equal_numbers_have_equal_bytes(void**) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const std::string zero = little_endian(0, 8), none = little_endian(0x7ff8000000000000, 8);
  assert_written(zero, [](HashInput& input) { input.number(-0.0); });
  assert_written(little_endian(uint64_t{1} << 63, 8),
                 [](HashInput& input) { input.exact_number(-0.0); });
  for (const double value : {nan, -nan, std::bit_cast<double>(0x7ff8000000000001)}) {
    assert_written(none, [&](HashInput& input) { input.number(value); });
    assert_written(none, [&](HashInput& input) { input.exact_number(value); });
  }
  const float zeros[2] = {0.0f, -0.0f};
  assert_written(little_endian(2, 8) + zero, [&](HashInput& input) { input.list(zeros, 2); });
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(digests_are_those_of_xxh3),
      cmocka_unit_test(numbers_are_little_endian),
      cmocka_unit_test(equal_numbers_have_equal_bytes),
  };
  if (!can_hash()) return 0;
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
