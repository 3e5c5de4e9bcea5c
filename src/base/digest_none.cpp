// SPDX-License-Identifier: Apache-2.0
// Stands in for digest_xxhash.cpp.
#include "base/digest.h"
#include "base/status.h"

namespace msq {

bool can_hash() {
  return false;
}

Digest::Digest() : state_(nullptr) {
  fail(Status::unsupported, "this build of msq has no hashes (MSQ_WITH_XXHASH is off)");
}

Digest::~Digest() {
  static_cast<void>(state_);
}

void Digest::add(const void*, size_t) {}

Hash Digest::finish() const {
  return {};
}

}  // namespace msq
