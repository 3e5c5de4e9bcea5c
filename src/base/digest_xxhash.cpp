// SPDX-License-Identifier: Apache-2.0
// The only file that includes xxHash, as a header alone: nothing is linked.
#include <cstring>
#include <new>

#include "base/digest.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

static_assert(XXH_VERSION_NUMBER >= 800, "XXH3 is fixed from version 0.8.0 on");

namespace msq {

namespace {

XXH3_state_t* state_of(void* state) {
  return static_cast<XXH3_state_t*>(state);
}

}  // namespace

bool can_hash() {
  return true;
}

Digest::Digest() : state_(XXH3_createState()) {
  if (!state_) throw std::bad_alloc();
  XXH3_128bits_reset(state_of(state_));
}

Digest::~Digest() {
  XXH3_freeState(state_of(state_));
}

void Digest::add(const void* bytes, size_t count) {
  XXH3_128bits_update(state_of(state_), bytes, count);
}

Hash Digest::finish() const {
  XXH128_canonical_t canonical;
  XXH128_canonicalFromHash(&canonical, XXH3_128bits_digest(state_of(state_)));
  Hash hash;
  static_assert(sizeof canonical.digest == sizeof hash);
  std::memcpy(hash.data(), canonical.digest, sizeof hash);
  return hash;
}

}  // namespace msq
