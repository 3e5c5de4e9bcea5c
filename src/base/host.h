// SPDX-License-Identifier: Apache-2.0
// What all objects that the host defines share. Their callbacks are functions made in src/api,
// which throw Error(host) if the host's return code stops the work.
#pragma once

#include "base/call.h"
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

 private:
  void* user_ = nullptr;
  void (*release_)(void* user) = nullptr;
};

/// Maximum number of points per callback.
constexpr size_t host_batch = 4096;

}  // namespace msq
