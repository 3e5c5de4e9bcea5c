// SPDX-License-Identifier: Apache-2.0
// A hash of a stream of bytes: XXH3 with 128 bits, without a seed, in the canonical order of its
// bytes. It is not cryptographic: who wants to can make two inputs with the same hash.
// Source: Collet, "xxHash fast digest algorithm", specification of XXH3, version 0.8.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace msq {

/// Whether this build has xxHash.
bool can_hash();

using Hash = std::array<uint8_t, 16>;

class Digest {
 public:
  /// Throws Error(unsupported) in a build without xxHash, std::bad_alloc.
  Digest();
  ~Digest();
  Digest(const Digest&) = delete;
  Digest& operator=(const Digest&) = delete;

  void add(const void* bytes, size_t count);
  /// Of the bytes so far.
  Hash finish() const;

 private:
  void* state_;  // on the heap: objects are hashed within each other
};

}  // namespace msq
