// SPDX-License-Identifier: Apache-2.0
// What all objects that the host defines share. Their callbacks are functions made in src/api,
// which throw Error(host) if the host's return code stops the work.
#pragma once

#include "base/call.h"
#include "base/hash_input.h"
#include "base/status.h"
#include "base/vec.h"

namespace msq {

// Points are passed to the host without conversion.
static_assert(sizeof(Vec3) == 3 * sizeof(double));

/// The host's own pointer. It lives as long as the callbacks may be called with it.
class HostUser {
 public:
  HostUser() = default;
  HostUser(const HostUser&) = delete;
  HostUser& operator=(const HostUser&) = delete;
  ~HostUser() {
    if (release_) call_host(release_, user_);
  }

  /// Takes ownership: at the end, calls `release`, which may be null, with the pointer.
  void own(void* user, void (*release)(void* user)) {
    user_ = user;
    release_ = release;
  }
  /// Two words that stand for what the callbacks compute; both 0: none.
  void set_key(const uint64_t (&key)[2]) {
    key_[0] = key[0];
    key_[1] = key[1];
  }
  /// Throws Error(unsupported) if there is no key. `what` the host computes is for the message.
  void describe(HashInput& input, const char* what) const {
    if (!key_[0] && !key_[1])
      fail(Status::unsupported,
           "a %s that the host computes has no hash_key; only the host knows when it changes",
           what);
    input.integer(key_[0]);
    input.integer(key_[1]);
  }

 private:
  void* user_ = nullptr;
  void (*release_)(void* user) = nullptr;
  uint64_t key_[2] = {0, 0};
};

/// Maximum number of points per callback.
constexpr size_t host_batch = 4096;

}  // namespace msq
