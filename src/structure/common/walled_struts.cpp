// SPDX-License-Identifier: Apache-2.0
#include "structure/common/walled_struts.h"

#include <algorithm>
#include <vector>

#include "structure/common/row_copy.h"
#include "structure/common/struts.h"

namespace msq {

// Outside both, the boundary is that of the nearer one. A ball about p in either is in the union.
double WalledStruts::distance_bound(Vec3 p) const {
  const bool in_walls = walls_->inside(p), in_struts = struts_->inside(p);
  const double to_walls = walls_->distance_bound(p), to_struts = struts_->distance_bound(p);
  if (in_walls == in_struts)
    return in_walls ? std::max(to_walls, to_struts) : std::min(to_walls, to_struts);
  return in_walls ? to_walls : to_struts;
}

void WalledStruts::keep_points(const Vec3* points, uint8_t* alive, size_t count) const {
  std::vector<uint8_t> rest(alive, alive + count);
  walls_->keep_points(points, alive, count);
  for (size_t i = 0; i < count; ++i) rest[i] &= static_cast<uint8_t>(!alive[i]);
  struts_->keep_points(points, rest.data(), count);
  for (size_t i = 0; i < count; ++i) alive[i] |= rest[i];
}

void WalledStruts::keep_rows(const RowBlock& block, const Job* job) const {
  const RowCopy rest(block);
  walls_->keep_rows(block, job);
  for_each_word(block, rest.block(), [](uint64_t in_walls, uint64_t& left) { left &= ~in_walls; });
  struts_->keep_rows(rest.block(), job);
  for_each_word(block, rest.block(), [](uint64_t& whole, uint64_t held) { whole |= held; });
}

std::unique_ptr<StrutParts> WalledStruts::struts(const StrutSelection& selection) const {
  return struts_->struts(selection);
}

void WalledStruts::enter(RaySearch* searches, size_t count, const Job* job) const {
  std::vector<RaySearch> of_walls(searches, searches + count);
  walls_->enter(of_walls.data(), count, job);
  for (size_t i = 0; i < count; ++i)
    if (of_walls[i].found) searches[i].to = of_walls[i].t;
  struts_->enter(searches, count, job);
  for (size_t i = 0; i < count; ++i) {
    const RaySearch& wall = of_walls[i];
    if (wall.found && !(searches[i].found && searches[i].t < wall.t))
      searches[i] = wall;
    else
      searches[i].to = wall.to;
  }
}

double WalledStruts::leave(const Ray& ray, double from, double to, const Job* job) const {
  return walls_->inside(ray.at(from)) ? walls_->leave(ray, from, to, job)
                                      : struts_->leave(ray, from, to, job);
}

Vec3 WalledStruts::normal(const Ray& ray, double t) const {
  const Vec3 p = ray.at(t);
  const bool in_walls = walls_->inside(p), in_struts = struts_->inside(p);
  // In both, that which the ray has just come into. In neither, the nearer one.
  const bool by_walls =
      in_walls == in_struts ? walls_->distance_bound(p) <= struts_->distance_bound(p) : in_walls;
  return by_walls ? walls_->normal(ray, t) : struts_->normal(ray, t);
}

}  // namespace msq
