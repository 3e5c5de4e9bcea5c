// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/seeds/sampled_seeds.h"

#include <algorithm>
#include <cmath>

#include "base/job.h"
#include "base/status.h"

namespace msq {

namespace {

/// Boxes of which bounds are looked up one by one.
constexpr int64_t max_looked_up = 512;
/// Along each axis, of a box, for its bound.
constexpr int parts = 4;
constexpr char memory_name[] = "the seeds of a sampled map";

template <class Visit>
void for_each_box(CellIndex low, CellIndex high, Visit&& visit) {
  for (int32_t z = low.z; z <= high.z; ++z)
    for (int32_t y = low.y; y <= high.y; ++y)
      for (int32_t x = low.x; x <= high.x; ++x) visit(CellIndex{x, y, z});
}

Vec3 corner_of(CellIndex box) {
  return {double(box.x), double(box.y), double(box.z)};
}

}  // namespace

SampledSeeds::SampledSeeds(const Context& context, std::shared_ptr<const SampledMap> map,
                           double jitter, uint64_t seed)
    : map_(std::move(map)),
      grid_(map_->smallest()),
      smallest_(grid_),
      cells_(seed, jitter, {1, 1, 1}),
      own_(seed ^ border_stream, 1, {1, 1, 1}) {
  const double least = smallest_.cell_size.x, longest = map_->longest_edge();
  if (longest > max_ratio * least * (1 + 1e-12))
    fail(Status::limit,
         "by warp.u, v and w, cells are at least %g wide and up to %g long; in a foam, the longest "
         "may be %g times the smallest",
         least, longest, max_ratio);
  const SampledMap::Cells cells = map_->cells();
  if (cells.all > max_cells)
    fail(Status::limit,
         "warp.u, v and w run over %llu x %llu x %llu cells; the limit of a foam is %.0f in all",
         static_cast<unsigned long long>(cells.count[0]),
         static_cast<unsigned long long>(cells.count[1]),
         static_cast<unsigned long long>(cells.count[2]), max_cells);
  set_side(2 * longest);
  // While places are found, with what is kept of them.
  const Reservation room_for_all(context.budget,
                                 static_cast<uint64_t>(cells.all) * (sizeof(Found) + sizeof(Kept)),
                                 memory_name);
  const std::vector<Found> found = find_all(cells, context.executor);
  choose_side(found);
  keep(found, context);
}

std::vector<SampledSeeds::Found> SampledSeeds::find_all(const SampledMap::Cells& cells,
                                                        const Executor& executor) const {
  std::vector<std::vector<Found>> layers(cells.count[2]);
  SampledMap::SearchCost cost(static_cast<uint64_t>(cells.all));
  executor.for_each(cells.count[2], [&](uint64_t k) {
    for (uint64_t j = 0; j < cells.count[1]; ++j) {
      check_cancelled();
      for (uint64_t i = 0; i < cells.count[0]; ++i) {
        const CellIndex cell{cells.first.x + static_cast<int32_t>(i),
                             cells.first.y + static_cast<int32_t>(j),
                             cells.first.z + static_cast<int32_t>(k)};
        Vec3 g;
        if (map_->find(corner_of(cell) + cells_.fractions(cells_.bits(cell)), g, cost))
          layers[k].push_back({g, cell});
      }
    }
  });
  std::vector<Found> found;
  for (std::vector<Found>& layer : layers) {
    found.insert(found.end(), layer.begin(), layer.end());
    layer = {};
  }
  return found;
}

CellIndex SampledSeeds::box_at(Vec3 g) const {
  const Vec3 boxes = g * (1 / side());
  return {static_cast<int32_t>(std::floor(boxes.x)), static_cast<int32_t>(std::floor(boxes.y)),
          static_cast<int32_t>(std::floor(boxes.z))};
}

bool SampledSeeds::is_known(CellIndex box) const {
  return box.x >= 0 && box.y >= 0 && box.z >= 0 && box.x < count_[0] && box.y < count_[1] &&
         box.z < count_[2];
}

size_t SampledSeeds::index(CellIndex box) const {
  const auto nx = static_cast<size_t>(count_[0]), ny = static_cast<size_t>(count_[1]);
  return (static_cast<size_t>(box.z) * ny + static_cast<size_t>(box.y)) * nx +
         static_cast<size_t>(box.x);
}

void SampledSeeds::set_side(double side) {
  const Vec3 size = map_->box().max;
  double count[3];
  for (int axis = 0; axis < 3; ++axis) count[axis] = std::floor(size[axis] * (1 / side)) + 1;
  const double all = count[0] * count[1] * count[2];
  if (all > max_boxes)
    fail(Status::limit,
         "by warp.u, v and w, cells are up to %g long, and the box of the samples is %g x %g x %g: "
         "it has %.0f cubes twice as long as a cell; the limit of a foam is %.0f",
         map_->longest_edge(), size.x, size.y, size.z, all, max_boxes);
  grid_.cell_size = {side, side, side};
  for (int axis = 0; axis < 3; ++axis) count_[axis] = static_cast<int32_t>(count[axis]);
}

void SampledSeeds::choose_side(const std::vector<Found>& found) {
  std::vector<bool> has_seed;
  for (;; set_side(1.125 * side())) {
    check_cancelled();
    has_seed.assign(index({0, 0, count_[2]}), false);
    for (const Found& one : found) has_seed[index(box_at(one.g))] = true;
    // The last box along an axis reaches beyond the samples; those before it touch them or may.
    bool is_any_empty = false;
    for_each_box({1, 1, 1}, {count_[0] - 3, count_[1] - 3, count_[2] - 3},
                 [&](CellIndex box) { is_any_empty = is_any_empty || !has_seed[index(box)]; });
    if (!is_any_empty) return;
  }
}

int SampledSeeds::level_at(Vec3 g) const {
  const auto [u, v, w] = map_->gradients(grid_.from_grid(g));
  return seed_level(side() * side() * side() * std::abs(dot(u, cross(v, w))), 2.828);
}

void SampledSeeds::keep(const std::vector<Found>& found, const Context& context) {
  const size_t boxes = index({0, 0, count_[2]});
  // The firsts are there twice for a while.
  reservation_ =
      Reservation(context.budget,
                  found.size() * sizeof(Kept) + boxes * (2 * sizeof first_[0] + sizeof bounds_[0]),
                  memory_name);
  first_.assign(boxes + 1, 0);
  for (const Found& one : found) ++first_[index(box_at(one.g)) + 1];
  const uint32_t most = *std::max_element(first_.begin(), first_.end());
  if (most > max_in_box)
    fail(Status::limit,
         "by warp.u, v and w, %u seeds are in one box of the search, %g long; the limit is %u",
         most, side(), max_in_box);
  most_in_box_ = std::max(1.0, double(most));
  for (size_t i = 0; i < boxes; ++i) first_[i + 1] += first_[i];
  kept_.resize(found.size());
  std::vector<uint32_t> next(first_.begin(), first_.end() - 1);
  for (const Found& one : found) {
    const CellIndex box = box_at(one.g);
    Kept& kept = kept_[next[index(box)]++];
    for (int axis = 0; axis < 3; ++axis)
      kept.in_box[axis] = place_in_box(one.g[axis] * (1 / side()));
    kept.cell = one.cell;
    kept.level = level_at(one.g);
  }
  bounds_.resize(boxes);
  context.executor.for_each(static_cast<uint64_t>(count_[2]), [&](uint64_t k) {
    const auto z = static_cast<int32_t>(k);
    std::vector<PlacedSeed> seeds;
    check_cancelled();
    for_each_box({0, 0, z}, {count_[0] - 1, count_[1] - 1, z},
                 [&](CellIndex box) { bounds_[index(box)] = bound_of(box, seeds); });
  });
}

/// In sides of boxes.
float SampledSeeds::bound_of(CellIndex box, std::vector<PlacedSeed>& seeds) const {
  seeds.clear();
  for_each_box({box.x - 1, box.y - 1, box.z - 1}, {box.x + 1, box.y + 1, box.z + 1},
               [&](CellIndex near) { find(near, seeds); });
  float least[parts][parts][parts];  // squared, from the middles of the parts
  std::fill_n(&least[0][0][0], parts * parts * parts, 9.0f);
  for (const PlacedSeed& seed : seeds) {
    const Vec3 at = corner_of(seed.box) - corner_of(box) + seed.in_box;
    float squares[3][parts];
    for (int axis = 0; axis < 3; ++axis)
      for (int i = 0; i < parts; ++i) {
        const auto d = static_cast<float>(at[axis] - (i + 0.5) / parts);
        squares[axis][i] = d * d;
      }
    for (int k = 0; k < parts; ++k)
      for (int j = 0; j < parts; ++j) {
        const float beside = squares[2][k] + squares[1][j];
        for (int i = 0; i < parts; ++i)
          least[k][j][i] = std::min(least[k][j][i], beside + squares[0][i]);
      }
  }
  const float most = *std::max_element(&least[0][0][0], &least[0][0][0] + parts * parts * parts);
  constexpr float half_of_part = 0.8660255f / parts, up = 1 + 0x1p-18f;
  return (std::sqrt(most) + half_of_part) * up;
}

PlacedSeed SampledSeeds::own_seed(CellIndex box) const {
  return {box, own_.fractions(own_.bits(box)), 0, 0};
}

std::span<const SampledSeeds::Kept> SampledSeeds::kept_in(CellIndex box) const {
  if (!is_known(box)) return {};
  const size_t at = index(box);
  return {kept_.data() + first_[at], kept_.data() + first_[at + 1]};
}

void SampledSeeds::find(CellIndex box, std::vector<PlacedSeed>& seeds) const {
  const std::span<const Kept> kept = kept_in(box);
  if (kept.empty()) seeds.push_back(own_seed(box));
  for (uint32_t n = 0; n < kept.size(); ++n)
    seeds.push_back({box, kept[n].in_box, n, kept[n].level});
}

PlacedSeed SampledSeeds::seed(CellIndex box, uint32_t number) const {
  const std::span<const Kept> kept = kept_in(box);
  if (kept.empty()) return own_seed(box);
  return {box, kept[number].in_box, number, kept[number].level};
}

CellIndex SampledSeeds::cell_of(CellIndex box, uint32_t number) const {
  const std::span<const Kept> kept = kept_in(box);
  if (!kept.empty()) return kept[number].cell;
  return cell_of((corner_of(box) + own_seed(box).in_box) * side());
}

CellIndex SampledSeeds::cell_of(Vec3 g) const {
  const Vec3 cells = map_->cells_of(g);
  return {static_cast<int32_t>(std::floor(cells.x)), static_cast<int32_t>(std::floor(cells.y)),
          static_cast<int32_t>(std::floor(cells.z))};
}

PlacedSeed SampledSeeds::near(Vec3 g) const {
  const CellIndex box = box_at(g);
  const Vec3 in_box = g * (1 / side()) - corner_of(box);
  const std::span<const Kept> kept = kept_in(box);
  uint32_t nearest = 0;
  double least = 4;
  for (uint32_t n = 0; n < kept.size(); ++n) {
    const Vec3 d = kept[n].in_box - in_box;
    if (dot(d, d) >= least) continue;
    least = dot(d, d);
    nearest = n;
  }
  return seed(box, nearest);
}

bool SampledSeeds::known_boxes(const Box3& box, Boxes& boxes) const {
  const double most = 0x1p30 * side();
  if (!(max_magnitude(box.min) < most && max_magnitude(box.max) < most)) return false;
  boxes = {box_at(box.min), box_at(box.max)};
  if (!is_known(boxes.low) || !is_known(boxes.high)) return false;
  const int64_t x = boxes.high.x - boxes.low.x + 1, y = boxes.high.y - boxes.low.y + 1,
                z = boxes.high.z - boxes.low.z + 1;
  return x > 0 && y > 0 && z > 0 && x <= max_looked_up && y <= max_looked_up &&
         z <= max_looked_up && x * y * z <= max_looked_up;
}

double SampledSeeds::max_distance(const Box3& box) const {
  Boxes boxes;
  const double diagonal = length(grid_.cell_size) * (1 + 1e-9);
  // Rounding does not leave out a box.
  if (!known_boxes(box.grown(1e-9 * side()), boxes)) return diagonal;
  float most = 0;
  for_each_box(boxes.low, boxes.high,
               [&](CellIndex at) { most = std::max(most, bounds_[index(at)]); });
  return std::min(diagonal, most * side());
}

Interval SampledSeeds::density(const Box3& box) const {
  Boxes boxes;
  if (!known_boxes(box, boxes)) return {1, most_in_box_};
  Interval range{most_in_box_, 1};
  for_each_box(boxes.low, boxes.high, [&](CellIndex at) {
    const double count = std::max(1.0, static_cast<double>(kept_in(at).size()));
    range = {std::min(range.low, count), std::max(range.high, count)};
  });
  return range;
}

// Points where the foam is needed are within the radius of struts of the box of the samples, and
// within the diagonal of a box of their nearest seeds.
bool SampledSeeds::is_needed(const Box3& box) const {
  const double most = smallest_.cell_size.x + length(grid_.cell_size) * (1 + 1e-9);
  return box.grown(most).overlaps(map_->box());
}

void SampledSeeds::describe(HashInput& input) const {
  input.text("sampled map");
  map_->describe(input);
}

}  // namespace msq
