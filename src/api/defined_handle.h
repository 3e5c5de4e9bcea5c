// SPDX-License-Identifier: Apache-2.0
// Handles of objects that keep their definitions.
#pragma once

#include "api/definitions.h"
#include "api/guard.h"

namespace msq::api {

/// A handle to a new object, which keeps its definition.
template <class Handle, class Def>
Handle* defined_handle(const Ref<typename ObjectOf<Handle>::type>& object, const Def& def) {
  keep(*object, def);
  return new_handle<Handle>(object);
}

}  // namespace msq::api
