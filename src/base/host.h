// SPDX-License-Identifier: Apache-2.0
// What objects that the host defines have in common. Their callbacks come as functions made in
// src/api, which throw Error(host) where the host's code asks to stop.
#pragma once

#include "base/status.h"
#include "base/vec.h"

namespace msq {

// Points go to the host as they are.
static_assert(sizeof(Vec3) == 3 * sizeof(double));

/// The host's own pointer, for as long as the callbacks may be called with it.
class HostUser {
 public:
  HostUser() = default;
  HostUser(const HostUser&) = delete;
  HostUser& operator=(const HostUser&) = delete;
  ~HostUser() {
    if (release_) release_(user_);
  }

  /// From now on the host's function, which may be null, is called with the pointer at the end.
  void own(void* user, void (*release)(void* user)) {
    user_ = user;
    release_ = release;
  }

 private:
  void* user_ = nullptr;
  void (*release_)(void* user) = nullptr;
};

/// Most points that a callback is given at once.
constexpr size_t host_batch = 4096;

}  // namespace msq
