// SPDX-License-Identifier: Apache-2.0
// Callbacks of objects that the host defines, as functions that the engine calls.
#pragma once

#include "api/guard.h"
#include "base/host.h"

namespace msq::api {

/// Throws Error(host) where a callback's code is not 0.
inline void check_code(int32_t code, const char* callback) {
  if (code != 0)
    throw Error(Status::host,
                std::string("the callback ") + callback + " returned " + std::to_string(code),
                code);
}

inline const double* coordinates(const Vec3* points) {
  return &points->x;
}

/// `callback` names it in messages and must be a literal.
inline std::function<void(const Vec3*, size_t, double*)> values_call(msq_values_fn fn, void* user,
                                                                     const char* callback) {
  return [=](const Vec3* points, size_t count, double* values) {
    // What the host does not write is no number, and found out.
    std::fill_n(values, count, std::numeric_limits<double>::quiet_NaN());
    check_code(call_host(fn, user, coordinates(points), count, values), callback);
  };
}

inline std::function<void(const Vec3*, size_t, uint8_t*)> inside_call(msq_inside_fn fn, void* user,
                                                                      const char* callback) {
  return [=](const Vec3* points, size_t count, uint8_t* inside) {
    std::fill_n(inside, count, uint8_t{0});
    check_code(call_host(fn, user, coordinates(points), count, inside), callback);
  };
}

/// Null where `fn` is.
inline std::function<Interval(const Box3&)> range_call(msq_range_fn fn, void* user,
                                                       const char* callback) {
  if (!fn) return nullptr;
  return [=](const Box3& box) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    Interval range{none, none};
    check_code(call_host(fn, user, &box.min.x, &box.max.x, &range.low, &range.high), callback);
    return range;
  };
}

}  // namespace msq::api
