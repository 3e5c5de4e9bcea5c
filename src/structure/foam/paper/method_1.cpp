// SPDX-License-Identifier: Apache-2.0
// Source: paper, section "Preprocessing for Voronoi Foams", Method 1. Per cell: a line from every
// triplet of seeds, made as in the point query (naive_point.cpp), except the lines that miss the
// cell. Per sample: the projection onto the lines of the nearest seed and the test of validity.
//
// A line is discarded if it misses the cell grown by r, since a capsule may reach in from outside.
// It is also discarded if it meets that box only where its seeds are farther than the empty radius
// and cannot be nearest. Before that, as the same section of the paper suggests, seeds that cannot
// contribute to the cell are discarded (halo.h): of the 125 around a cell, with 317,750 triplets, a
// few tens remain. Nothing else about validity is determined before there is a sample.
#include "structure/foam/paper/method_1.h"

#include <algorithm>
#include <array>
#include <vector>

#include "base/borrowed.h"
#include "structure/foam/paper/cell_data_method.h"
#include "structure/foam/paper/halo.h"
#include "structure/foam/paper/reaching_seeds.h"
#include "structure/foam/point/edge_line.h"

namespace msq {

namespace {

class CellLines final : public CellData {
 public:
  CellLines(const FoamSeeds& seeds, CellIndex cell, double max_radius);

  bool inside(Vec3 q, double radius) const;
  uint64_t bytes() const override {
    return sizeof *this + seeds_.capacity() * sizeof(Vec3) + lines_.capacity() * sizeof(Line) +
           first_.capacity() * sizeof(uint32_t);
  }

 private:
  struct Line {
    EdgeLine line;
    std::array<uint32_t, 3> seeds;
  };

  std::vector<Vec3> seeds_;
  std::vector<Line> lines_;
  std::vector<uint32_t> first_;  // lines whose first seed is s are first_[s] to first_[s + 1]
};

/// Whether a line meets a box within some distance of its seeds.
bool meets(const EdgeLine& line, const Box3& box, double distance) {
  const double under = distance * distance - dot(line.offset, line.offset);
  if (under < 0) return false;
  double high = std::sqrt(under * line.inverse_squared), low = -high;
  const Vec3 centre = line.at(0);
  for (int axis = 0; axis < 3; ++axis) {
    const double along = line.direction[axis];
    double from = box.min[axis] - centre[axis], to = box.max[axis] - centre[axis];
    if (along == 0) {
      if (from > 0 || to < 0) return false;
      continue;
    }
    from /= along;
    to /= along;
    low = std::max(low, std::min(from, to));
    high = std::min(high, std::max(from, to));
  }
  return low <= high;
}

CellLines::CellLines(const FoamSeeds& seeds, CellIndex cell, double max_radius) {
  std::vector<Vec3> halo;
  halo_seeds(seeds, cell, max_radius, halo);
  seeds_ = seeds_that_matter(halo, seeds.scale(), max_radius);
  const Box3 grown = Box3{{0, 0, 0}, seeds.scale()}.grown(max_radius + halo_slack);
  const double farthest = seeds.empty_radius() + halo_slack;
  const uint32_t count = static_cast<uint32_t>(seeds_.size());
  for (uint32_t a = 0; a < count; ++a) {
    first_.push_back(static_cast<uint32_t>(lines_.size()));
    for (uint32_t b = a + 1; b < count; ++b) {
      check_cancelled();
      for (uint32_t c = b + 1; c < count; ++c) {
        const EdgeLine line(seeds_[a], seeds_[b], seeds_[c]);
        if (line.exists() && meets(line, grown, farthest)) lines_.push_back({line, {a, b, c}});
      }
    }
  }
  first_.push_back(static_cast<uint32_t>(lines_.size()));
  lines_.shrink_to_fit();
  first_.shrink_to_fit();
}

bool CellLines::inside(Vec3 q, double radius) const {
  const Borrowed<ReachingSeeds> borrowed;
  ReachingSeeds& near = *borrowed;
  near.find(seeds_, q, radius);
  const double r2 = radius * radius;
  for (uint32_t s = 0; s < seeds_.size(); ++s) {
    if (!near.has(s)) continue;
    for (uint32_t l = first_[s]; l < first_[s + 1]; ++l) {
      const auto& [line, ids] = lines_[l];
      if (!near.has(ids)) continue;
      LineInterval part = line.chord(q, r2);
      for (uint32_t i = 0; i < seeds_.size() && line.holds(part); ++i)
        if (i != ids[0] && i != ids[1] && i != ids[2]) line.cut(seeds_[i], part);
      if (line.holds(part)) return true;
    }
  }
  return false;
}

}  // namespace

void method_1_keep_points(const FoamData& foam, const Vec3* points, uint8_t* alive, size_t count) {
  keep_points_by_cell<CellLines>(foam, points, alive, count);
}

}  // namespace msq
