// SPDX-License-Identifier: Apache-2.0
// What an object is hashed from, in a form that does not depend on the machine.
//
// Numbers are little-endian, of fixed size. A real number is 8 bytes (numbers of arrays as many as
// their type has): 0 and -0 are equal, and all that are not a number are one. Lists begin with
// their length, and a description with the name of its kind, so no two descriptions have the same
// bytes. Objects within an object count by their hash.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "base/described.h"
#include "base/digest.h"
#include "base/vec.h"

namespace msq {

/// Changes where a kind describes itself otherwise, or an equal description has other results: all
/// hashes change with it.
constexpr uint64_t hash_version = 1;

class HashInput {
 public:
  /// Begins with hash_version.
  HashInput() { integer(hash_version); }

  /// The name of the kind; no two kinds of objects have the same.
  void kind(std::string_view name) { text(name); }
  void text(std::string_view text);
  void integer(uint64_t value);
  void number(double value);
  /// The number's own bits: -0 is not 0. Only for what tells them apart.
  void exact_number(double value);
  void point(Vec3 p);
  void rotation(const Rotation& rotation);
  void object(const Described& object);
  /// An object that may be missing.
  void optional(const Described* object);
  /// Lists. uint8_t, int16_t, uint16_t, uint32_t, float and double.
  template <class T>
  void list(const T* values, size_t count);
  void points(const std::vector<Vec3>& points);
  void hash(const Hash& hash) { digest_.add(hash.data(), hash.size()); }

  Hash finish() const { return digest_.finish(); }

 private:
  Digest digest_;
};

}  // namespace msq
