// SPDX-License-Identifier: Apache-2.0
#include "structure/structure.h"

#include <bit>
#include <vector>

namespace msq {

void Structure::keep_points(const Vec3* points, uint8_t* alive, size_t count) const {
  for (size_t i = 0; i < count; ++i)
    if (alive[i] && !inside(points[i])) alive[i] = 0;
}

void Structure::keep_rows(const RowBlock& block, const Job* job) const {
  // Tiles of one word's width, so that the points of a batch lie close together.
  constexpr uint64_t tile_rows = 16, tile_layers = 8;
  struct Sample {
    uint64_t* word;
    unsigned bit;
  };
  std::vector<Vec3> points;
  std::vector<Sample> samples;
  std::vector<uint8_t> alive;
  for (uint64_t k0 = block.z0; k0 < block.z1; k0 += tile_layers)
    for (uint64_t j0 = block.y0; j0 < block.y1; j0 += tile_rows)
      for (size_t w = 0; w < block.row_words(); ++w) {
        points.clear();
        samples.clear();
        for (uint64_t k = k0; k < std::min(k0 + tile_layers, block.z1); ++k)
          for (uint64_t j = j0; j < std::min(j0 + tile_rows, block.y1); ++j) {
            uint64_t* word = block.row(j, k) + w;
            for (uint64_t rest = *word; rest; rest &= rest - 1) {
              const unsigned bit = static_cast<unsigned>(std::countr_zero(rest));
              points.push_back(block.grid->at(w * bits_per_word + bit, j, k));
              samples.push_back({word, bit});
            }
          }
        if (points.empty()) continue;
        check_cancelled(job);
        alive.assign(points.size(), 1);
        keep_points(points.data(), alive.data(), points.size());
        for (size_t i = 0; i < samples.size(); ++i)
          if (!alive[i]) *samples[i].word &= ~(uint64_t{1} << samples[i].bit);
      }
}

}  // namespace msq
