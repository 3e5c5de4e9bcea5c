// SPDX-License-Identifier: Apache-2.0
#include "model/scale.h"

namespace msq {

// Inside both, the ball that fits in either lies in their union, as far as it lies in the shape.
// Outside both, neither is nearer than the nearer one.
double Scale::distance(Vec3 p, double depth) const {
  const double of_structure = structure->distance(p);
  if (skin.is_none()) return of_structure;
  const double of_skin = signed_distance(skin.holds(p, depth), skin.clearance(p, depth));
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
  // The structure need not be asked within the skin.
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

}  // namespace msq
