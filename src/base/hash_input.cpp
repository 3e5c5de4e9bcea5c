// SPDX-License-Identifier: Apache-2.0
#include "base/hash_input.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>
#include <type_traits>

namespace msq {

namespace {

/// One of all numbers that compare equal.
template <class T>
T canonical(T value) {
  if constexpr (std::is_floating_point_v<T>)
    return value + T{0};  // -0 + 0 is 0
  else
    return value;
}

template <size_t size>
using Bits = std::conditional_t<
    size == 8, uint64_t,
    std::conditional_t<size == 4, uint32_t, std::conditional_t<size == 2, uint16_t, uint8_t>>>;

template <class T>
void put(T value, unsigned char* bytes) {
  const auto bits = std::bit_cast<Bits<sizeof(T)>>(value);
  for (size_t i = 0; i < sizeof(T); ++i) bytes[i] = static_cast<unsigned char>(bits >> (8 * i));
}

constexpr size_t block_bytes = 1024;
constexpr uint64_t quiet_nan = 0x7ff8000000000000;

}  // namespace

void HashInput::integer(uint64_t value) {
  unsigned char bytes[sizeof value];
  put(value, bytes);
  digest_.add(bytes, sizeof bytes);
}

void HashInput::exact_number(double value) {
  integer(std::isnan(value) ? quiet_nan : std::bit_cast<uint64_t>(value));
}

void HashInput::number(double value) {
  exact_number(canonical(value));
}

void HashInput::point(Vec3 p) {
  for (int axis = 0; axis < 3; ++axis) number(p[axis]);
}

void HashInput::rotation(const Rotation& rotation) {
  for (double m : rotation.m) number(m);
}

void HashInput::text(std::string_view text) {
  integer(text.size());
  digest_.add(text.data(), text.size());
}

void HashInput::object(const Described& object) {
  hash(object.hash());
}

void HashInput::optional(const Described* object) {
  integer(object ? 1 : 0);
  if (object) this->object(*object);
}

template <class T>
void HashInput::list(const T* values, size_t count) {
  integer(count);
  if constexpr (sizeof(T) == 1) {
    digest_.add(values, count);
    return;
  }
  constexpr size_t at_once = block_bytes / sizeof(T);
  unsigned char bytes[block_bytes];
  for (size_t first = 0; first < count; first += at_once) {
    const size_t size = std::min(at_once, count - first);
    for (size_t i = 0; i < size; ++i) put(canonical(values[first + i]), bytes + i * sizeof(T));
    digest_.add(bytes, size * sizeof(T));
  }
}

template void HashInput::list(const uint8_t*, size_t);
template void HashInput::list(const int16_t*, size_t);
template void HashInput::list(const uint16_t*, size_t);
template void HashInput::list(const uint32_t*, size_t);
template void HashInput::list(const float*, size_t);
template void HashInput::list(const double*, size_t);

void HashInput::points(const std::vector<Vec3>& points) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  list(points.empty() ? nullptr : &points[0].x, 3 * points.size());
}

const Hash& Described::hash() const {
  return hash_.get([this] {
    HashInput input;
    describe(input);
    return std::make_unique<const Hash>(input.finish());
  });
}

}  // namespace msq
