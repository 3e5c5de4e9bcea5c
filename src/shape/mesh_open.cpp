// SPDX-License-Identifier: Apache-2.0
// Rows, distances and rays of open meshes with the rule `automatic`: a point is inside if the
// generalised winding number, rounded half up, is not 0 (open_mesh.h).
#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "base/job.h"
#include "shape/mesh.h"
#include "shape/triangle_rows.h"

namespace msq {

namespace {

/// Layers that share what is proven about boxes of samples.
constexpr uint64_t open_layers = 16;

/// Samples [low, high) along each axis.
struct Part {
  std::array<uint64_t, 3> low, high;

  uint64_t count(size_t axis) const { return high[axis] - low[axis]; }
};

/// A number for each cube of `side` samples of a part.
template <uint64_t side>
class Cubes {
 public:
  void reset(const Part& part) {
    part_ = part;
    for (size_t axis = 0; axis < 3; ++axis) counts_[axis] = (part.count(axis) + side - 1) / side;
    numbers_.assign(counts_[0] * counts_[1] * counts_[2], 0);
  }
  /// Of all cubes that begin in `p`, which begins at a cube.
  void fill(const Part& p, int64_t number) {
    uint64_t begin[3], end[3];
    for (size_t axis = 0; axis < 3; ++axis) {
      begin[axis] = (p.low[axis] - part_.low[axis]) / side;
      end[axis] = begin[axis] + (p.count(axis) + side - 1) / side;
    }
    for (uint64_t z = begin[2]; z < end[2]; ++z)
      for (uint64_t y = begin[1]; y < end[1]; ++y) {
        int64_t* const row = &numbers_[(z * counts_[1] + y) * counts_[0]];
        std::fill(row + begin[0], row + end[0], number);
      }
  }
  /// Once all cubes are filled: where runs of equal numbers end.
  void find_runs() {
    ends_.resize(numbers_.size());
    for (size_t row_end = numbers_.size(); row_end > 0; row_end -= counts_[0])
      for (uint64_t n = 1; n <= counts_[0]; ++n) {
        const size_t at = row_end - n;
        const bool goes_on = n > 1 && numbers_[at] == numbers_[at + 1];
        ends_[at] = goes_on ? ends_[at + 1] : static_cast<uint32_t>(counts_[0] - n + 1);
      }
  }
  /// That of a sample, and of those after it in the row up to `end`.
  int64_t run(uint64_t i, uint64_t j, uint64_t k, uint64_t& end) const {
    const uint64_t row = (k - part_.low[2]) / side * counts_[1] + (j - part_.low[1]) / side;
    const size_t cube = row * counts_[0] + (i - part_.low[0]) / side;
    end = std::min(part_.high[0], part_.low[0] + ends_[cube] * side);
    return numbers_[cube];
  }
  /// Where a sample lies in its cube.
  uint64_t place(uint64_t i, uint64_t j, uint64_t k) const {
    return ((k - part_.low[2]) % side * side + (j - part_.low[1]) % side) * side +
           (i - part_.low[0]) % side;
  }

 private:
  Part part_{};
  std::array<uint64_t, 3> counts_{};
  std::vector<int64_t> numbers_;
  std::vector<uint32_t> ends_;  // in its row, the cube after the run that begins at a cube
};

/// What the winding numbers of the row rule, through mesh and caps, exceed those of the samples of
/// some layers by: one number over a box where that is proven, else sample by sample.
class WholeParts {
 public:
  static constexpr int64_t not_proven = INT64_MIN;
  /// Rows that are known at once, which bounds what is kept of the parts.
  static constexpr uint64_t band = 64;
  static_assert(open_layers <= band);

  /// `all`: not empty. Far from caps large boxes are proven at once.
  WholeParts(const OpenMesh& mesh, const SampleGrid& grid, const Part& all)
      : mesh_(mesh), grid_(grid), all_(all) {
    coarse_.reset(all);
    divide<band>(
        all, [&](const Part& p, int64_t whole) { coarse_.fill(p, whole); },
        [&](const Part& p, Vec3, double) { coarse_.fill(p, not_proven); });
    coarse_.find_runs();
  }

  /// Goes to the band that begins at a row.
  void set(uint64_t first_row) {
    Part part = all_;
    part.low[1] = first_row;
    part.high[1] = std::min(all_.high[1], first_row + band);
    fine_.reset(part);
    single_.clear();
    // All layers are in one coarse cube.
    for (uint64_t i = part.low[0], next; i < part.high[0]; i = next) {
      const int64_t whole = coarse_.run(i, first_row, part.low[2], next);
      Part run = part;
      run.low[0] = i;
      run.high[0] = next;
      if (whole != not_proven)
        fine_.fill(run, whole);
      else
        divide<side>(
            run, [&](const Part& p, int64_t found) { fine_.fill(p, found); },
            [&](const Part& p, Vec3 centre, double radius) { look_into(p, centre, radius); });
    }
    fine_.find_runs();
  }

  /// That of a sample, and of those after it up to `end`.
  int64_t run(uint64_t i, uint64_t j, uint64_t k, uint64_t& end) const {
    const int64_t whole = fine_.run(i, j, k, end);
    if (whole >= first_single) return whole;
    const int16_t* const found =
        &single_[static_cast<size_t>(whole - not_proven)][fine_.place(i, j, k)];
    uint64_t n = 1;
    while (i + n < end && found[n] == *found) ++n;
    end = i + n;
    return *found == single_not_proven ? not_proven : *found;
  }

 private:
  static constexpr uint64_t side = 4;  // samples of a cube
  /// Small, as a band may have many. Larger numbers are as good as not proven.
  using Cube = std::array<int16_t, side * side * side>;
  static constexpr int16_t single_not_proven = INT16_MIN;
  static constexpr int64_t first_single = INT64_MIN / 2;

  /// Calls whole(part, number) for parts over which there is one number, and rest(part, centre,
  /// radius) with a ball about the others, cubes of `least` samples.
  template <uint64_t least, class Whole, class Rest>
  void divide(const Part& p, const Whole& whole, const Rest& rest) {
    check_cancelled();
    const Vec3 low = grid_.at(p.low[0], p.low[1], p.low[2]);
    const Vec3 high = grid_.at(p.high[0] - 1, p.high[1] - 1, p.high[2] - 1);
    const Vec3 extent = high - low, centre = (low + high) * 0.5;
    const double radius =
        (0.5 + 0x1p-20) * length(extent) + 0x1p-48 * (max_magnitude(low) + max_magnitude(high));
    int64_t number;
    if (mesh_.is_whole_about(centre, radius, number)) return whole(p, number);
    size_t longest = 3;
    for (size_t axis = 0; axis < 3; ++axis)
      if (p.count(axis) > least &&
          (longest == 3 || extent[static_cast<int>(axis)] > extent[static_cast<int>(longest)]))
        longest = axis;
    if (longest == 3) return rest(p, centre, radius);
    Part lower = p, upper = p;
    lower.high[longest] = upper.low[longest] =
        p.low[longest] + (p.count(longest) + 2 * least - 1) / (2 * least) * least;
    divide<least>(lower, whole, rest);
    divide<least>(upper, whole, rest);
  }

  void look_into(const Part& p, Vec3 centre, double radius) {
    mesh_.caps().gather(centre, radius, near_);
    fine_.fill(p, not_proven + static_cast<int64_t>(single_.size()));
    Cube& cube = single_.emplace_back();
    cube.fill(single_not_proven);
    std::array<Vec3, side * side * side> points;
    std::array<uint64_t, side * side * side> places;
    std::array<Caps::View, side * side * side> views;
    size_t count = 0;
    for (uint64_t k = p.low[2]; k < p.high[2]; ++k)
      for (uint64_t j = p.low[1]; j < p.high[1]; ++j)
        for (uint64_t i = p.low[0]; i < p.high[0]; ++i, ++count) {
          points[count] = grid_.at(i, j, k);
          places[count] = fine_.place(i, j, k);
        }
    mesh_.caps().find_views(points.data(), count, near_, views.data());
    for (size_t n = 0; n < count; ++n)
      if (views[n].margin() > 0 && std::abs(views[n].turns) < -single_not_proven - 1)
        cube[places[n]] = static_cast<int16_t>(views[n].whole());
  }

  const OpenMesh& mesh_;
  const SampleGrid& grid_;
  const Part all_;
  Cubes<band> coarse_;
  Cubes<side> fine_;  // of the current band; below first_single, its samples are in single_
  std::vector<Cube> single_;
  Caps::Nearby near_;
};

}  // namespace

uint64_t Mesh::layers_together() const {
  return open_ ? open_layers : 1;
}

void Mesh::fill_open_rows(const RowBlock& block) const {
  const SampleGrid& grid = *block.grid;
  const Box3& box = facts_.bounds;
  const uint64_t first = grid.first_x_from(box.min.x);
  const uint64_t end = grid.first_x_from<true>(box.max.x);
  const auto row_from = [&](uint64_t j) { return std::clamp(j, block.y0, block.y1); };
  const uint64_t first_row = row_from(grid.first_y_from(box.min.y));
  const uint64_t end_row = row_from(grid.first_y_from<true>(box.max.y));
  if (first >= end || first_row >= end_row) return;

  uint64_t first_layer = block.z0, end_layer = block.z1;
  while (first_layer < end_layer && grid.z(first_layer) < box.min.z) ++first_layer;
  while (first_layer < end_layer && grid.z(end_layer - 1) > box.max.z) --end_layer;
  // Of mesh and caps, by rows of the block.
  struct LayerCrossings {
    std::vector<uint32_t> row_ends;
    std::vector<RowCrossing> sorted;
  };
  const auto fill_row = [&](const WholeParts& parts, LayerCrossings& layer, uint64_t j,
                            uint64_t k) {
    check_cancelled();
    const uint64_t r = j - block.y0;
    RowCrossing* const row_begin = layer.sorted.data() + (r ? layer.row_ends[r - 1] : 0);
    RowCrossing* const row_end = layer.sorted.data() + layer.row_ends[r];
    std::sort(row_begin, row_end,
              [](const RowCrossing& a, const RowCrossing& b) { return a.x < b.x; });
    uint64_t* const row = block.row(j, k);
    for (uint64_t i = first, next; i < end; i = next) {
      const int64_t whole = parts.run(i, j, k, next);
      if (whole == WholeParts::not_proven) {
        for (; i < next; ++i)
          if (inside(grid.at(i, j, k))) set_bits(row, i, i);
      } else if (whole != 0 || row_begin != row_end) {
        fill_between(row_begin, row_end, grid, i, next, row,
                     [whole](int64_t winding) { return winding != whole; });
      }
    }
  };
  std::vector<RowCrossing> crossings;
  std::vector<LayerCrossings> layers(std::min(end_layer - first_layer, open_layers));
  for (uint64_t k0 = first_layer; k0 < end_layer; k0 += open_layers) {
    const uint64_t k1 = std::min(end_layer, k0 + open_layers);
    for (uint64_t k = k0; k < k1; ++k) {
      LayerCrossings& layer = layers[k - k0];
      crossings.clear();
      add_crossings(soup_, sheets_.at(box.min.y, grid.z(k)), block, k, crossings);
      add_crossings(open_->caps().soup(), open_->caps().at_height(grid.z(k)), block, k, crossings);
      sort_by_row(crossings, block.rows(), layer.row_ends, layer.sorted);
    }
    WholeParts parts(*open_, grid, {{first, first_row, k0}, {end, end_row, k1}});
    for (uint64_t j0 = first_row; j0 < end_row; j0 += WholeParts::band) {
      parts.set(j0);
      for (uint64_t k = k0; k < k1; ++k)
        for (uint64_t j = j0; j < std::min(end_row, j0 + WholeParts::band); ++j)
          fill_row(parts, layers[k - k0], j, k);
    }
  }
}

// Where the point lies in the box of the mesh, and in the solid, the box's faces bound that too.
// Outside the box, the solid is no nearer than the box; where the winding number is 0, no nearer
// than where that changes.
double Mesh::open_distance_bound(Vec3 p) const {
  const double of_triangles = boundary().distance_bound(p);
  const Vec3 low = facts_.bounds.min - p, high = p - facts_.bounds.max;
  const Vec3 gap = max(low, high);
  const bool is_in_box = max_component(gap) <= 0;
  const double of_box =
      (is_in_box ? -max_component(gap) : length(max(gap, Vec3{}))) * (1 - 0x1p-50);
  if (is_in_box && of_triangles == 0) return 0;
  const int64_t winding =
      count_crossings(soup_, columns_.at(p.y, p.z), p).beyond + open_->correction(p);
  if (winding != 0 && !is_in_box) return of_box;
  double bound = std::min(of_triangles, open_->distance_bound(p, winding, of_triangles));
  if (winding != 0) bound = std::min(bound, of_box);
  return is_in_box ? bound : std::max(bound, of_box);
}

// Between two crossings of triangles membership changes only where the winding number passes a
// half. A step is as long as that is proven not to, by a ball about it, else by the course of the
// winding number, and no less than LeastStep has it, which bounds their number. Next to a half no
// ball is small enough for the bounds of caps: there the course decides.
bool Mesh::find_between(const Ray& ray, double from, double to, bool wanted, double& t,
                        LeastStep& least, JobPoll& poll) const {
  const double tolerance = ray_tolerance();
  const auto is_wanted = [&](double at) { return inside(ray.at(at)) == wanted; };
  const auto is_steady = [&](double at, double step) {
    return open_->is_steady_in(ray.at(at + 0.5 * step), (0.5 + 0x1p-20) * step + tolerance);
  };
  if (is_wanted(from)) {
    t = from;
    return true;
  }
  double growth = 2;  // of a step that is proven at once
  for (double at = from, step = to - from; at < to; step *= growth) {
    poll();
    const double min_now = least.of_step(at);
    step = std::min(step, to - at);
    const double first = step;
    size_t tries = open_->tries_before_way();
    for (; step > min_now && !is_steady(at, step); step *= 0.5) {
      const bool is_last = open_->knows_way() && 0.5 * step <= min_now;
      if (tries > 0 && !is_last) {
        --tries;
        continue;
      }
      const Vec3 p = ray.at(at);
      const int64_t beyond = count_crossings(soup_, columns_.at(p.y, p.z), p).beyond;
      step = std::min(to - at, open_->steady_way(p, ray.direction, beyond));
      break;
    }
    growth = step < first ? 1 : 2;
    step = std::max(step, min_now);
    const double next = std::min(to, at + step);
    if (!(next > at)) return false;  // steps vanish in rounding
    if (is_wanted(next)) {
      t = bisect(at, next, tolerance, is_wanted);
      return true;
    }
    at = next;
  }
  return false;
}

// A triangle is crossed at one t, and each search begins behind the last crossing: there are no
// more rounds than triangles.
bool Mesh::find_along_open(const Ray& ray, double from, double to, bool wanted, double& t,
                           const Job* job) const {
  const double tolerance = ray_tolerance();
  LeastStep least(tolerance, tolerance, from);
  JobPoll poll(job);
  double at = from, crossing = from;
  bool crosses = true;
  for (double search_from = from - tolerance; crosses; search_from = at) {
    poll();
    const double before = crossing;
    Vec3 normal;
    crosses = boundary().first_crossing(ray, search_from, to, tolerance, crossing, normal);
    if (find_between(ray, at, crosses ? std::max(at, crossing - tolerance) : to, wanted, t, least,
                     poll)) {
      if (t == at && inside(ray.at(before)) == wanted) t = before;
      return true;
    }
    // Crossings closer than the tolerance are one.
    at = std::max(crossing + tolerance,
                  std::nextafter(crossing, std::numeric_limits<double>::infinity()));
    crosses = crosses && at <= to;
  }
  return false;
}

}  // namespace msq
