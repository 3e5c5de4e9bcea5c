// SPDX-License-Identifier: Apache-2.0
// Objects that hash what their results depend on (hash_input.h) and know how they were defined.
#pragma once

#include <memory>

#include "base/digest.h"
#include "base/lazy.h"
#include "base/ref.h"

namespace msq {

class HashInput;

/// How the host defined an object. It is kept to write the object down again, and for nothing else:
/// results depend on describe() alone.
class Definition {
 public:
  virtual ~Definition() = default;
};

class Described : public RefCounted {
 public:
  /// Null: the object cannot be written, for example because the host computes it.
  const Definition* definition() const { return definition_.get(); }
  /// Before anybody else sees the object.
  void define(std::unique_ptr<const Definition> definition) { definition_ = std::move(definition); }
  /// The hash of the description, computed once. Throws Error(unsupported) if an object of the host
  /// has no key, or the build no hash.
  const Hash& hash() const;

 protected:
  /// Adds all that results depend on: the kind, the definition and the inputs. Nothing else: not
  /// what is derived from them, and not options that do not change results.
  virtual void describe(HashInput& input) const = 0;

 private:
  Lazy<Hash> hash_;
  std::unique_ptr<const Definition> definition_;
};

}  // namespace msq
