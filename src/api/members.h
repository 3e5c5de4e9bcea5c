// SPDX-License-Identifier: Apache-2.0
// Objects that are made of a list of others of their kind.
#pragma once

#include <cstdint>
#include <vector>

#include "api/guard.h"

namespace msq::api {

/// How deep shapes, or structures, may be within each other, and how many one may be made of.
inline constexpr unsigned max_nesting = 64;
inline constexpr uint64_t max_members = 4096;

template <class Handle>
void require_members(const Handle* const* members, uint64_t count, const char* name) {
  if (count < 1 || count > max_members)
    fail(Status::argument, "count is %llu; it must be from 1 to %llu",
         static_cast<unsigned long long>(count), static_cast<unsigned long long>(max_members));
  require(members, name);
}

/// An object made of others of its kind, which are not too many or too deep within each other.
template <class Made>
void require_small(const Made& made, const char* kind) {
  if (made.nesting() > max_nesting)
    fail(Status::limit, "%u %s made of %s would be within each other; the limit is %u",
         made.nesting(), kind, kind, max_nesting);
  if (made.terms() > max_members)
    fail(Status::limit,
         "it would be made of %llu %s, the same counted as often as it occurs; the limit is %llu",
         static_cast<unsigned long long>(made.terms()), kind,
         static_cast<unsigned long long>(max_members));
}

/// What `read` makes of each member and its index. None may be NULL.
template <class Member, class Handle, class Read>
std::vector<Ref<const Member>> read_members(const Handle* const* members, uint64_t count,
                                            const char* name, const Read& read) {
  std::vector<Ref<const Member>> known;
  for (uint64_t i = 0; i < count; ++i) {
    if (!members[i])
      fail(Status::argument, "%s[%llu] is NULL", name, static_cast<unsigned long long>(i));
    known.emplace_back(&read(object(members[i], name), i));
  }
  return known;
}

}  // namespace msq::api
