// SPDX-License-Identifier: Apache-2.0
// Rows, distances and rays of open meshes with the rule `automatic`: a point is inside if the
// generalised winding number, rounded half up, is not 0 (open_mesh.h).
#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "shape/mesh.h"
#include "shape/triangle_rows.h"

namespace msq {

namespace {

/// Samples [first, end) of rows of a layer.
struct Part {
  uint64_t first, end, first_row, end_row;
};

/// A number for each square of `side` samples of a part.
template <uint64_t side>
class Squares {
 public:
  void reset(const Part& part) {
    part_ = part;
    across_ = squares(part.first, part.end);
    numbers_.assign(across_ * squares(part.first_row, part.end_row), 0);
  }
  /// Of all squares that begin in `p`, which begins at a square.
  void fill(const Part& p, int64_t number) {
    const uint64_t x0 = (p.first - part_.first) / side, x1 = x0 + squares(p.first, p.end);
    const uint64_t y0 = (p.first_row - part_.first_row) / side;
    const uint64_t y1 = y0 + squares(p.first_row, p.end_row);
    for (uint64_t y = y0; y < y1; ++y)
      std::fill(&numbers_[y * across_ + x0], &numbers_[y * across_] + x1, number);
  }
  /// That of a sample, and of those after it in the row up to `end`.
  int64_t run(uint64_t i, uint64_t j, uint64_t& end) const {
    const int64_t* row = &numbers_[(j - part_.first_row) / side * across_];
    const uint64_t square = (i - part_.first) / side;
    uint64_t next = square + 1;
    while (next < across_ && row[next] == row[square]) ++next;
    end = std::min(part_.end, part_.first + next * side);
    return row[square];
  }
  /// Where a sample lies in its square, which is filled row by row.
  uint64_t place(uint64_t i, uint64_t j) const {
    return (j - part_.first_row) % side * side + (i - part_.first) % side;
  }

 private:
  static uint64_t squares(uint64_t from, uint64_t to) { return (to - from + side - 1) / side; }

  Part part_{};
  uint64_t across_ = 0;
  std::vector<int64_t> numbers_;
};

/// What the winding numbers of the row rule, through mesh and caps, exceed those of the samples of
/// a layer by: one number over a rectangle where that is proven, else sample by sample.
class WholeParts {
 public:
  static constexpr int64_t not_proven = INT64_MIN;
  /// Rows that are known at once, which bounds what is kept of the parts.
  static constexpr uint64_t band = 64;

  /// `all`: not empty. Far from caps large squares are proven at once.
  WholeParts(const OpenMesh& mesh, const SampleGrid& grid, double z, const Part& all)
      : mesh_(mesh), grid_(grid), z_(z), all_(all) {
    coarse_.reset(all);
    divide<band>(
        all, [&](const Part& p, int64_t whole) { coarse_.fill(p, whole); },
        [&](const Part& p, Vec3, double) { coarse_.fill(p, not_proven); });
  }

  /// Goes to the band that begins at a row.
  void set(uint64_t first_row) {
    const Part part{all_.first, all_.end, first_row, std::min(all_.end_row, first_row + band)};
    fine_.reset(part);
    single_.clear();
    for (uint64_t i = part.first, next; i < part.end; i = next) {
      const int64_t whole = coarse_.run(i, first_row, next);
      const Part run{i, next, part.first_row, part.end_row};
      if (whole != not_proven)
        fine_.fill(run, whole);
      else
        divide<side>(
            run, [&](const Part& p, int64_t found) { fine_.fill(p, found); },
            [&](const Part& p, Vec3 centre, double radius) { look_into(p, centre, radius); });
    }
  }

  /// That of a sample, and of those after it up to `end`.
  int64_t run(uint64_t i, uint64_t j, uint64_t& end) const {
    const int64_t whole = fine_.run(i, j, end);
    if (whole >= first_single) return whole;
    end = i + 1;
    return single_[static_cast<size_t>(whole - not_proven)][fine_.place(i, j)];
  }

 private:
  static constexpr uint64_t side = 4;  // samples of a square
  using Square = std::array<int64_t, side * side>;
  static constexpr int64_t first_single = INT64_MIN / 2;

  /// Calls whole(part, number) for parts over which there is one number, and rest(part, centre,
  /// radius) with a ball about the others, squares of `least` samples.
  template <uint64_t least, class Whole, class Rest>
  void divide(const Part& p, const Whole& whole, const Rest& rest) {
    const Vec3 low{grid_.x(p.first), grid_.y(p.first_row), z_};
    const Vec3 high{grid_.x(p.end - 1), grid_.y(p.end_row - 1), z_};
    const Vec3 extent = high - low, centre = (low + high) * 0.5;
    const double radius =
        (0.5 + 0x1p-20) * length(extent) + 0x1p-48 * (max_magnitude(low) + max_magnitude(high));
    int64_t number;
    if (mesh_.is_whole_about(centre, radius, number)) return whole(p, number);
    const bool splits_x = p.end - p.first > least, splits_y = p.end_row - p.first_row > least;
    const auto middle = [](uint64_t from, uint64_t to) {
      return from + (to - from + 2 * least - 1) / (2 * least) * least;
    };
    if (splits_x && (!splits_y || extent.x >= extent.y)) {
      const uint64_t at = middle(p.first, p.end);
      divide<least>({p.first, at, p.first_row, p.end_row}, whole, rest);
      divide<least>({at, p.end, p.first_row, p.end_row}, whole, rest);
    } else if (splits_y) {
      const uint64_t at = middle(p.first_row, p.end_row);
      divide<least>({p.first, p.end, p.first_row, at}, whole, rest);
      divide<least>({p.first, p.end, at, p.end_row}, whole, rest);
    } else {
      rest(p, centre, radius);
    }
  }

  void look_into(const Part& p, Vec3 centre, double radius) {
    mesh_.caps().gather(centre, radius, near_);
    Square square;
    square.fill(not_proven);
    for (uint64_t j = p.first_row; j < p.end_row; ++j)
      for (uint64_t i = p.first; i < p.end; ++i) {
        const Caps::View view = mesh_.caps().view({grid_.x(i), grid_.y(j), z_}, near_);
        if (view.margin() > 0) square[(j - p.first_row) * side + i - p.first] = view.whole();
      }
    fine_.fill(p, not_proven + static_cast<int64_t>(single_.size()));
    single_.push_back(square);
  }

  const OpenMesh& mesh_;
  const SampleGrid& grid_;
  const double z_;
  const Part all_;
  Squares<band> coarse_;
  Squares<side> fine_;  // of the current band; below first_single, its samples are in single_
  std::vector<Square> single_;
  Caps::Nearby near_;
};

}  // namespace

void Mesh::fill_open_rows(const RowBlock& block) const {
  const SampleGrid& grid = *block.grid;
  const Box3& box = facts_.bounds;
  const uint64_t first = grid.first_x_from(box.min.x);
  const uint64_t end = grid.first_x_from<true>(box.max.x);
  const auto row_from = [&](uint64_t j) { return std::clamp(j, block.y0, block.y1); };
  const uint64_t first_row = row_from(grid.first_y_from(box.min.y));
  const uint64_t end_row = row_from(grid.first_y_from<true>(box.max.y));
  if (first >= end || first_row >= end_row) return;

  std::vector<RowCrossing> crossings, sorted;
  std::vector<uint32_t> row_ends;
  for (uint64_t k = block.z0; k < block.z1; ++k) {
    const double z = grid.z(k);
    if (z < box.min.z || z > box.max.z) continue;
    crossings.clear();
    add_crossings(soup_, sheets_.at(box.min.y, z), block, k, crossings);
    add_crossings(open_->caps().soup(), open_->caps().at_height(z), block, k, crossings);
    sort_by_row(crossings, block.rows(), row_ends, sorted);
    WholeParts parts(*open_, grid, z, {first, end, first_row, end_row});
    for (uint64_t j = first_row; j < end_row; ++j) {
      if ((j - first_row) % WholeParts::band == 0) parts.set(j);
      const uint64_t r = j - block.y0;
      RowCrossing* const row_begin = sorted.data() + (r ? row_ends[r - 1] : 0);
      RowCrossing* const row_end = sorted.data() + row_ends[r];
      std::sort(row_begin, row_end,
                [](const RowCrossing& a, const RowCrossing& b) { return a.x < b.x; });
      uint64_t* const row = block.row(j, k);
      for (uint64_t i = first, next; i < end; i = next) {
        const int64_t whole = parts.run(i, j, next);
        if (whole == WholeParts::not_proven) {
          for (; i < next; ++i)
            if (inside({grid.x(i), grid.y(j), z})) set_bits(row, i, i);
        } else if (whole != 0 || row_begin != row_end) {
          fill_between(row_begin, row_end, grid, i, next, row,
                       [whole](int64_t winding) { return winding != whole; });
        }
      }
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
