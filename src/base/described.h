// SPDX-License-Identifier: Apache-2.0
// Objects that hash what their results depend on (hash_input.h).
#pragma once

#include "base/digest.h"
#include "base/lazy.h"
#include "base/ref.h"

namespace msq {

class HashInput;

class Described : public RefCounted {
 public:
  /// The hash of the description, computed once. Throws Error(unsupported) if an object of the host
  /// has no key, or the build no hash.
  const Hash& hash() const;

 protected:
  /// Adds all that results depend on: the kind, the definition and the inputs. Nothing else: not
  /// what is derived from them, and not options that do not change results.
  virtual void describe(HashInput& input) const = 0;

 private:
  Lazy<Hash> hash_;
};

}  // namespace msq
