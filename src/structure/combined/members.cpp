// SPDX-License-Identifier: Apache-2.0
#include "structure/combined/members.h"

#include <algorithm>

#include "base/infinity.h"
#include "base/job.h"

namespace msq {

namespace {

/// The grid by which points are grouped: that of the first member that gains by groups.
const Neighbourhood& grid_of(const StructureList& members) {
  for (const Ref<const Structure>& member : members)
    if (member->gains_by_groups()) return member->neighbourhood();
  return members[0]->neighbourhood();
}

template <class Value>
double largest(const StructureList& members, Value&& value) {
  double most = 0;
  for (const Ref<const Structure>& member : members) most = std::max(most, value(*member));
  return most;
}

}  // namespace

CombinedStructure::CombinedStructure(StructureList members)
    : Structure(grid_of(members),
                largest(members, [](const Structure& m) { return m.cell_length(); }),
                largest(members, [](const Structure& m) { return m.characteristic_length(); })),
      members_(std::move(members)),
      smallest_cell_(infinity) {
  for (const Ref<const Structure>& member : members_) {
    const auto* combined = dynamic_cast<const CombinedStructure*>(member.get());
    terms_ += combined ? combined->terms() : 1;
    if (combined) steady_pairs_ = std::max(steady_pairs_, combined->steady_pairs());
    row_copies_ = std::max(row_copies_, member->row_copies());
    combined_.push_back(combined);
    nesting_ = std::max(nesting_, 1 + member->nesting());
    is_concurrent_ = is_concurrent_ && member->is_concurrent();
    if (member->gains_by_groups() && !gains_by_groups_) group_parts_ = member->group_parts();
    gains_by_groups_ = gains_by_groups_ || member->gains_by_groups();
    gains_by_layers_ = gains_by_layers_ || member->gains_by_layers();
    knows_boxes_ = knows_boxes_ || member->knows_boxes();
    has_steady_distance_ = has_steady_distance_ && member->has_steady_distance();
    min_ray_step_ = std::max(min_ray_step_, member->min_ray_step());
  }
  for_each_grid([this](const Neighbourhood& grid) {
    smallest_cell_ = std::min(smallest_cell_, min_component(grid.cell_size));
  });
  if (!(smallest_cell_ < infinity)) smallest_cell_ = cell_length();
}

bool CombinedStructure::is_alike_from_origin() const {
  return std::all_of(members_.begin(), members_.end(), [](const Ref<const Structure>& member) {
    return member->is_alike_from_origin();
  });
}

void CombinedStructure::for_each_grid(const TakeGrid& take) const {
  for (const Ref<const Structure>& member : members_) member->for_each_grid(take);
}

double CombinedStructure::ray_tolerance(const Ray& ray, double to) const {
  return largest(members_, [&](const Structure& m) { return m.ray_tolerance(ray, to); });
}

void keep_points_of(const Structure& structure, const Vec3* points, uint8_t* alive, size_t count) {
  const auto living = static_cast<uint64_t>(std::count(alive, alive + count, 1));
  if (living == 0) return;
  if (living >= structure.critical_count()) return structure.keep_points(points, alive, count);
  for (size_t i = 0; i < count; ++i)
    if (alive[i]) alive[i] = structure.inside(points[i]);
}

// Each search ends where the structures before are entered.
void enter_any(const StructureList& structures, RaySearch* searches, size_t count, const Job* job) {
  structures[0]->enter(searches, count, job);
  std::vector<RaySearch> others(searches, searches + count);
  for (size_t m = 1; m < structures.size(); ++m) {
    for (size_t i = 0; i < count; ++i) {
      others[i].to = searches[i].found ? searches[i].t : searches[i].to;
      others[i].found = false;
      others[i].normal = {};
    }
    structures[m]->enter(others.data(), count, job);
    for (size_t i = 0; i < count; ++i) {
      RaySearch& s = searches[i];
      if (!others[i].found || (s.found && !(others[i].t < s.t))) continue;
      s.found = true;
      s.t = others[i].t;
      s.normal = others[i].normal;
    }
  }
}

}  // namespace msq
