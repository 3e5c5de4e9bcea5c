// SPDX-License-Identifier: Apache-2.0
#include "model/scale.h"

#include "base/ray_normal.h"

namespace msq {

// Inside both, the ball that fits in either lies in their union, as far as it lies in the shape.
// Outside both, the smaller of the two distances is a lower bound.
double Scale::distance(Vec3 p, double depth) const {
  const double of_structure = structure->distance(p);
  if (skin.is_none()) return of_structure;
  const double of_skin = signed_distance(skin.holds(p, depth), skin.distance_bound(p, depth));
  return std::min(of_structure, of_skin);
}

void Scale::keep_points(const Vec3* points, uint8_t* alive, size_t count) const {
  if (skin.is_none()) return structure->keep_points(points, alive, count);
  const std::vector<uint8_t> before(alive, alive + count);
  structure->keep_points(points, alive, count);
  uint32_t part = 0;  // points of a group lie close together
  for (size_t i = 0; i < count; ++i)
    if (before[i] && !alive[i]) alive[i] = skin.find(points[i], part);
}

void Scale::keep_rows(const RowBlock& block, const Job* job) const {
  if (skin.is_none()) return structure->keep_rows(block, job);
  const size_t words = block.row_words();
  std::vector<uint64_t> solid(words * block.rows() * block.layers());
  RowBlock skin_rows = block;
  skin_rows.words = solid.data();
  skin_rows.row_stride = words;
  skin_rows.layer_stride = words * block.rows();
  skin.mark_rows(block, skin_rows, job);
  // The structure need not be evaluated within the skin.
  const auto for_words = [&](auto&& change) {
    for (uint64_t k = block.z0; k < block.z1; ++k)
      for (uint64_t j = block.y0; j < block.y1; ++j) {
        uint64_t* row = block.row(j, k);
        const uint64_t* in_skin = skin_rows.row(j, k);
        for (size_t w = 0; w < words; ++w) row[w] = change(row[w], in_skin[w]);
      }
  };
  for_words([](uint64_t alive, uint64_t in_skin) { return alive & ~in_skin; });
  structure->keep_rows(block, job);
  for_words([](uint64_t kept, uint64_t in_skin) { return kept | in_skin; });
}

void Scale::draw_rows(const RowBlock& block, const Job* job) const {
  if (skin.is_none()) return structure->draw_rows(block, job);
  set_all_bits(block);
  keep_rows(block, job);
}

void Scale::enter(RaySearch* searches, size_t count, const Job* job) const {
  if (skin.is_none()) return structure->enter(searches, count, job);
  // The skin comes first: it shortens the search of the structure.
  std::vector<RaySearch> within(searches, searches + count);
  for (size_t i = 0; i < count; ++i) {
    RaySearch& s = searches[i];
    s.found = skin.enter(s.ray, s.from, s.to, structure->ray_tolerance(s.ray, s.to), s.t, job);
    if (s.found) within[i].to = s.t;
  }
  structure->enter(within.data(), count, job);
  for (size_t i = 0; i < count; ++i)
    if (within[i].found) {
      searches[i].found = true;
      searches[i].t = within[i].t;
      searches[i].normal = within[i].normal;
    }
}

double Scale::leave(const Ray& ray, double from, double to, const Job* job) const {
  if (skin.is_none() || structure->inside(ray.at(from)))
    return structure->leave(ray, from, to, job);
  return skin.leave(ray, from, to, structure->ray_tolerance(ray, to), job);
}

Vec3 Scale::normal(const Ray& ray, double t) const {
  if (skin.is_none() || structure->inside(ray.at(t))) return structure->normal(ray, t);
  return normal_by_membership([this](Vec3 p) { return inside(p); }, ray, t,
                              1e-4 * structure->cell_length());
}

}  // namespace msq
