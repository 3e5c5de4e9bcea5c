// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/paper/halo.h"

#include <algorithm>
#include <cstdint>

namespace msq {

void halo_seeds(const FoamSeeds& seeds, CellIndex cell, double radius, std::vector<Vec3>& found) {
  const Vec3 scale = seeds.scale();
  const double reach = seeds.empty_radius() + radius + halo_slack;
  int half[3];
  for (int axis = 0; axis < 3; ++axis)
    half[axis] = static_cast<int>(std::ceil(reach / scale[axis]));
  found.clear();
  for (int dz = -half[2]; dz <= half[2]; ++dz)
    for (int dy = -half[1]; dy <= half[1]; ++dy) {
      const uint64_t key = seeds.row_key(cell, dy, dz);
      for (int dx = -half[0]; dx <= half[0]; ++dx)
        found.push_back(seeds.in_row(key, cell, dx, dy, dz));
    }
}

// A seed s is left out if some seed t is nearer, by a margin, to every point v of the box of the
// cell grown by `radius`. |s - v|^2 - |t - v|^2 is linear in v. Its minimum over a box is its value
// at the centre, minus 2 |s - t| times the half extents, axis by axis. The relation is transitive
// and t is nearer to the centre than s. So it is enough to try each seed, by distance from the
// centre, against those kept so far.
//
// EdgeLine gives the same result without s. If s is one of the three seeds of a line, or would clip
// it at v, t clips it there with the margin to spare: half of the difference of squared distances
// is at least 1e-9, so the clip is deeper by a length of at least 1e-9 / |s - t| > 1e-11. Rounding
// and the slack of EdgeLine::holds are at most a tenth of that.
std::vector<Vec3> seeds_that_matter(const std::vector<Vec3>& halo, Vec3 scale, double radius) {
  constexpr double margin = 2e-9;
  const Vec3 centre = scale * 0.5;
  const Vec3 half = centre + Vec3{1, 1, 1} * (radius + halo_slack);
  struct Candidate {
    double distance_squared;
    uint32_t index;
  };
  std::vector<Candidate> candidates;
  for (uint32_t i = 0; i < halo.size(); ++i)
    candidates.push_back({dot(halo[i] - centre, halo[i] - centre), i});
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return a.distance_squared < b.distance_squared;
  });
  std::vector<Candidate> kept;
  for (const Candidate& s : candidates) {
    const auto hides = [&](const Candidate& t) {
      const Vec3 d = halo[s.index] - halo[t.index];
      const double swing = std::abs(d.x) * half.x + std::abs(d.y) * half.y + std::abs(d.z) * half.z;
      return s.distance_squared - t.distance_squared - 2 * swing > margin;
    };
    if (std::none_of(kept.begin(), kept.end(), hides)) kept.push_back(s);
  }
  std::sort(kept.begin(), kept.end(),
            [](const Candidate& a, const Candidate& b) { return a.index < b.index; });
  std::vector<Vec3> found;
  found.reserve(kept.size());
  for (const Candidate& s : kept) found.push_back(halo[s.index]);
  return found;
}

}  // namespace msq
