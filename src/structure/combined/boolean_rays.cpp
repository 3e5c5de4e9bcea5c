// SPDX-License-Identifier: Apache-2.0
// Rays: each member is followed from change to change.
#include <algorithm>

#include "base/follow_changes.h"
#include "base/infinity.h"
#include "base/ray_normal.h"
#include "structure/combined/boolean_structure.h"

namespace msq {

void BooleanStructure::enter(RaySearch* searches, size_t count, const Job* job) const {
  if (is_union()) return enter_any(members(), searches, count, job);
  // Nothing is inside before the first member is.
  members()[0]->enter(searches, count, job);
  for (size_t i = 0; i < count; ++i) {
    RaySearch& s = searches[i];
    if (!s.found) continue;
    const double first = s.t;
    s.found = find_entry(s.ray, first, s.to, s.t, job);
    if (!s.found || s.t != first) s.normal = {};
  }
}

bool BooleanStructure::find_entry(const Ray& ray, double from, double to, double& t,
                                  const Job* job) const {
  const auto is_inside = [&](double at) { return inside(ray.at(at)); };
  if (is_inside(from)) {
    t = from;
    return true;
  }
  const double tolerance = ray_tolerance(ray, to);
  std::vector<double> next(members().size(), -infinity);
  const auto next_change = [&](double at) -> std::optional<double> {
    double nearest = infinity;
    for (size_t i = 0; i < members().size(); ++i) {
      const Structure& member = *members()[i];
      if (next[i] <= at) {
        if (member.inside(ray.at(at))) {
          next[i] = member.leave(ray, at, to, job);
        } else {
          RaySearch search{ray, at, to};
          member.enter(&search, 1, job);
          next[i] = search.found ? search.t : infinity;
        }
      }
      // Only where all are as they must be the ray can be inside: none needs a look before.
      if (!(next[i] < infinity) && member.inside(ray.at(at)) != is_wanted(i)) return std::nullopt;
      nearest = std::min(nearest, next[i]);
    }
    return nearest;
  };
  return follow_changes(from, to, tolerance, job, next_change, is_inside, t);
}

double BooleanStructure::leave(const Ray& ray, double from, double to, const Job* job) const {
  if (is_union()) return leave_union(ray, from, to, job);
  if (!inside(ray.at(from))) return from;
  double end = to;
  for (size_t i = 0; i < members().size() && end > from; ++i) {
    if (is_wanted(i)) {
      end = std::min(end, members()[i]->leave(ray, from, end, job));
      continue;
    }
    RaySearch search{ray, from, end};
    members()[i]->enter(&search, 1, job);
    if (search.found) end = std::min(end, search.t);
  }
  return std::max(from, end);
}

// From member to member, as far as they overlap. A ray that runs on through many is left for the
// caller to continue.
double BooleanStructure::leave_union(const Ray& ray, double from, double to, const Job* job) const {
  constexpr int max_parts = 16;
  double end = from;
  for (int part = 0; part < max_parts && end < to; ++part) {
    const double at = end;
    for (const Ref<const Structure>& member : members())
      if (end < to && member->inside(ray.at(end)))
        end = std::max(end, member->leave(ray, end, to, job));
    if (!(end > at)) break;
  }
  return end;
}

// That of the member whose membership changes there. Where the ray leaves a subtracted one, that is
// what it meets on its way back, turned round.
Vec3 BooleanStructure::normal(const Ray& ray, double t) const {
  const double room = 2 * ray_tolerance(ray, t);
  const Vec3 before = ray.at(t - room), behind = ray.at(t + room);
  for (size_t i = 0; i < members().size(); ++i) {
    const Structure& member = *members()[i];
    const bool is_in = member.inside(behind);
    if (is_in != is_wanted(i) || member.inside(before) == is_in) continue;
    if (is_in) return member.normal(ray, t);
    return member.normal({ray.at(t), ray.direction * -1.0}, 0) * -1.0;
  }
  return normal_by_membership([this](Vec3 p) { return inside(p); }, ray, t,
                              normal_distance_of_members());
}

}  // namespace msq
