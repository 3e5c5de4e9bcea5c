// SPDX-License-Identifier: Apache-2.0
#include "cell/sampled_map.h"

#include <algorithm>
#include <cmath>

#include "base/infinity.h"
#include "base/job.h"
#include "base/status.h"

namespace msq {

namespace {

/// A determinant below this part of the product of the slopes is that of a flat map.
constexpr double least_determinant = 0x1p-40;
constexpr int max_depth = 6;  // of parts of a voxel
constexpr int newton_steps = 16;
/// Of a voxel, beyond its faces.
constexpr double beyond = 0x1p-32;

/// Rows: coordinates; columns: axes of the samples, per voxel.
struct Jacobian {
  double m[3][3];

  double determinant() const {
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) +
           m[0][1] * (m[1][2] * m[2][0] - m[1][0] * m[2][2]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  }
};

/// Of the edges of a cell where the coordinates have these derivatives by voxels: the columns of
/// the inverse.
double longest_edge_of(const Jacobian& j, Vec3 spacing) {
  const auto row = [&](int c) { return Vec3{j.m[c][0], j.m[c][1], j.m[c][2]}; };
  double most = 0;
  for (int c = 0; c < 3; ++c)
    most = std::max(most, length(cross(row((c + 1) % 3), row((c + 2) % 3)) * spacing));
  return most / std::abs(j.determinant());
}

double blend(double a, double b, double f) {
  return a + f * (b - a);
}

double value_of(const double (&s)[8], Vec3 f) {
  const auto edge = [&](int i) { return blend(s[i], s[i + 1], f.x); };
  return blend(blend(edge(0), edge(2), f.y), blend(edge(4), edge(6), f.y), f.z);
}

/// The samples at the lower ends of the four edges along an axis.
constexpr int edges[3][4] = {{0, 2, 4, 6}, {0, 1, 4, 5}, {0, 1, 2, 3}};

Jacobian jacobian_of(const double (&samples)[3][8], Vec3 f) {
  Jacobian j;
  for (int c = 0; c < 3; ++c) {
    const double(&s)[8] = samples[c];
    for (int axis = 0; axis < 3; ++axis) {
      const int step = 1 << axis;
      const auto rise = [&](int e) { return s[edges[axis][e] + step] - s[edges[axis][e]]; };
      const double first = axis == 0 ? f.y : f.x, second = axis == 2 ? f.y : f.z;
      j.m[c][axis] = blend(blend(rise(0), rise(1), first), blend(rise(2), rise(3), first), second);
    }
  }
  return j;
}

Interval product(Interval a, Interval b) {
  const auto [low, high] =
      std::minmax({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high});
  return {low, high};
}
Interval sum(Interval a, Interval b) {
  return {a.low + b.low, a.high + b.high};
}
Interval difference(Interval a, Interval b) {
  return {a.low - b.high, a.high - b.low};
}
double magnitude(Interval a) {
  return std::max(std::abs(a.low), std::abs(a.high));
}

/// Encloses the derivatives in a voxel: they are means of those of the edges.
struct Slants {
  Interval m[3][3];

  explicit Slants(const double (&samples)[3][8]) {
    for (int c = 0; c < 3; ++c)
      for (int axis = 0; axis < 3; ++axis) {
        Interval& range = m[c][axis] = {infinity, -infinity};
        for (const int e : edges[axis]) {
          const double rise = samples[c][e + (1 << axis)] - samples[c][e];
          range.low = std::min(range.low, rise);
          range.high = std::max(range.high, rise);
        }
      }
  }
  Interval determinant() const {
    const auto minor = [this](int a, int b) {
      return difference(product(m[1][a], m[2][b]), product(m[1][b], m[2][a]));
    };
    return sum(sum(product(m[0][0], minor(1, 2)), product(m[0][1], minor(2, 0))),
               product(m[0][2], minor(0, 1)));
  }
  /// The product of bounds of the rows.
  double most() const {
    double most = 1;
    for (const auto& row : m) most *= magnitude(row[0]) + magnitude(row[1]) + magnitude(row[2]);
    return most;
  }
};

/// The determinant in a part of a voxel by its Bernstein coefficients, x fastest.
struct Determinants {
  double b[27];
  Vec3 from, to;

  static constexpr int steps[3] = {1, 3, 9};
  template <class Visit>
  static void for_each_line(int axis, Visit&& visit) {
    const int step = steps[axis], j = steps[(axis + 1) % 3], k = steps[(axis + 2) % 3];
    for (int a = 0; a < 3; ++a)
      for (int c = 0; c < 3; ++c) visit(a * j + c * k, step);
  }
  Determinants(const double (&samples)[3][8], double sign) : from{0, 0, 0}, to{1, 1, 1} {
    for (int i = 0; i < 27; ++i) {
      const int x = i % 3, y = i / 3 % 3, z = i / 9;
      b[i] = sign * jacobian_of(samples, {0.5 * x, 0.5 * y, 0.5 * z}).determinant();
    }
    for (int axis = 0; axis < 3; ++axis)
      for_each_line(axis, [&](int first, int step) {
        double* const at = b + first;
        at[step] = 2 * at[step] - 0.5 * (at[0] + at[2 * step]);
      });
  }
  void halve(int axis, Determinants& high) {
    high = *this;
    for_each_line(axis, [&](int first, int step) {
      double *const low = b + first, *const up = high.b + first;
      const double a = low[0], m = low[step], c = low[2 * step];
      const double am = 0.5 * (a + m), mc = 0.5 * (m + c);
      low[step] = am;
      low[2 * step] = up[0] = 0.5 * (am + mc);
      up[step] = mc;
    });
    to[axis] = high.from[axis] = 0.5 * (from[axis] + to[axis]);
  }
  /// Whether all are above `least`; if not, a point where one is not, or that is undecided.
  bool are_above(double least, int depth, Vec3& where) const {
    if (*std::min_element(b, b + 27) > least) return true;
    for (int corner = 0; corner < 8; ++corner) {
      const int x = corner & 1, y = corner >> 1 & 1, z = corner >> 2;
      where = {x ? to.x : from.x, y ? to.y : from.y, z ? to.z : from.z};
      if (!(b[2 * x + 6 * y + 18 * z] > least)) return false;
    }
    where = (from + to) * 0.5;
    if (depth == max_depth) return false;
    Determinants parts[8]{*this, *this, *this, *this, *this, *this, *this, *this};
    parts[0].halve(0, parts[1]);
    for (int i = 0; i < 2; ++i) parts[i].halve(1, parts[i + 2]);
    for (int i = 0; i < 4; ++i) parts[i].halve(2, parts[i + 4]);
    return std::all_of(std::begin(parts), std::end(parts), [&](const Determinants& part) {
      return part.are_above(least, depth + 1, where);
    });
  }
};

/// The same bits everywhere, unlike the C library's.
double cube_root(double value) {
  double root = std::ldexp(1.0, std::ilogb(value) / 3);
  for (int n = 0; n < 16; ++n) root = (2 * root + value / (root * root)) / 3;
  return root;
}

/// The position in a voxel that has these coordinates, by Newton's method from a position.
/// 1: found, 0: elsewhere, -1: no convergence.
int solve(const double (&samples)[3][8], Vec3 cells, Vec3& f) {
  double moved = infinity;
  for (int n = 0; n < newton_steps; ++n) {
    const Jacobian j = jacobian_of(samples, f);
    const double d = j.determinant();
    const Vec3 r{value_of(samples[0], f) - cells.x, value_of(samples[1], f) - cells.y,
                 value_of(samples[2], f) - cells.z};
    const auto& m = j.m;
    const Vec3 step{(r.x * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) +
                     r.y * (m[0][2] * m[2][1] - m[0][1] * m[2][2]) +
                     r.z * (m[0][1] * m[1][2] - m[0][2] * m[1][1])) /
                        d,
                    (r.x * (m[1][2] * m[2][0] - m[1][0] * m[2][2]) +
                     r.y * (m[0][0] * m[2][2] - m[0][2] * m[2][0]) +
                     r.z * (m[0][2] * m[1][0] - m[0][0] * m[1][2])) /
                        d,
                    (r.x * (m[1][0] * m[2][1] - m[1][1] * m[2][0]) +
                     r.y * (m[0][1] * m[2][0] - m[0][0] * m[2][1]) +
                     r.z * (m[0][0] * m[1][1] - m[0][1] * m[1][0])) /
                        d};
    if (!is_finite(step)) return -1;
    const Vec3 next = max(Vec3{-1, -1, -1}, min(Vec3{2, 2, 2}, f - step));
    moved = max_magnitude(next - f);
    if (moved == 0) break;  // all further steps are the same
    f = next;
  }
  if (!(moved <= 0x1p-30)) return -1;
  const bool is_here = min_component(f) >= -beyond && max_component(f) <= 1 + beyond;
  f = max(Vec3{}, min(Vec3{1, 1, 1}, f));
  return is_here ? 1 : 0;
}

}  // namespace

SampledMap::SampledMap(Fields fields) : fields_(std::move(fields)) {
  check_grids();
  for (int axis = 0; axis < 3; ++axis) {
    top_[axis] = static_cast<double>(image(0).size(axis) - 1);
    rounding_ = std::max(rounding_, image(axis).value_slack());
  }
  examine();
}

void SampledMap::check_grids() const {
  constexpr const char* names[] = {"u", "v", "w"};
  const Image& first = image(0);
  for (int axis = 0; axis < 3; ++axis)
    if (first.size(axis) < 2)
      fail(Status::argument, "warp.u has %llu sample along axis %d; a map needs 2",
           static_cast<unsigned long long>(first.size(axis)), axis);
  for (int c = 1; c < 3; ++c) {
    const Image& other = image(c);
    const ImageFrame &a = first.frame(), &b = other.frame();
    for (int axis = 0; axis < 3; ++axis) {
      if (other.size(axis) != first.size(axis))
        fail(Status::argument,
             "warp.%s has %llu samples along axis %d and warp.u %llu; the fields "
             "of a map have one grid",
             names[c], static_cast<unsigned long long>(other.size(axis)), axis,
             static_cast<unsigned long long>(first.size(axis)));
      if (a.origin[axis] != b.origin[axis] || a.spacing[axis] != b.spacing[axis])
        fail(Status::argument,
             "the samples of warp.%s are from %.17g on, %.17g apart, along axis %d, and those of "
             "warp.u from %.17g on, %.17g apart; the fields of a map have one grid",
             names[c], b.origin[axis], b.spacing[axis], axis, a.origin[axis], a.spacing[axis]);
    }
    if (a.rotation.m != b.rotation.m)
      fail(Status::argument,
           "the grids of warp.%s and warp.u are turned differently; the fields of a map have one "
           "grid",
           names[c]);
  }
  for (int c = 0; c < 3; ++c) {
    const Interval range = image(c).range();
    if (!(magnitude(range) <= max_coordinate))
      fail(Status::argument, "warp.%s runs from %g to %g; coordinates are at most %g in magnitude",
           names[c], range.low, range.high, max_coordinate);
  }
}

SampledMap::Voxel SampledMap::voxel(uint64_t x, uint64_t y, uint64_t z) const {
  Voxel voxel{{x, y, z}, {}};
  for (int c = 0; c < 3; ++c) image(c).corners(voxel.at, voxel.samples[c]);
  return voxel;
}

void SampledMap::refuse(const Voxel& voxel, Vec3 fraction, double determinant) const {
  Vec3 g;
  for (int axis = 0; axis < 3; ++axis)
    g[axis] = (static_cast<double>(voxel.at[axis]) + fraction[axis]) * frame().spacing[axis];
  const Vec3 p = smallest().from_grid(g);
  fail(Status::argument,
       "the map of warp.u, v and w folds, or is flat, in voxel (%llu, %llu, %llu), near the point "
       "(%g, %g, %g): the determinant of its derivatives by voxels is %g there; it must not be 0, "
       "nor change its sign",
       static_cast<unsigned long long>(voxel.at[0]), static_cast<unsigned long long>(voxel.at[1]),
       static_cast<unsigned long long>(voxel.at[2]), p.x, p.y, p.z, determinant);
}

void SampledMap::examine() {
  const Vec3 scale = image(0).scale();
  const double voxel_volume = frame().spacing.x * frame().spacing.y * frame().spacing.z;
  const Vec3 middle{0.5, 0.5, 0.5};
  double sign = 0, cells = 0, least = infinity, steepest = 0;
  Vec3 steep;
  const uint64_t nx = image(0).cells(0), ny = image(0).cells(1), nz = image(0).cells(2);
  for (uint64_t z = 0; z < nz; ++z)
    for (uint64_t y = 0; y < ny; ++y) {
      check_cancelled();
      for (uint64_t x = 0; x < nx; ++x) {
        const Voxel at = voxel(x, y, z);
        const Slants slants(at.samples);
        const Jacobian of_middle = jacobian_of(at.samples, middle);
        const double in_middle = of_middle.determinant();
        if (sign == 0) sign = in_middle < 0 ? -1 : 1;
        const double most = slants.most(), limit = least_determinant * most;
        // Products may vanish or overflow.
        if (!(limit > 1e-280 && most < 1e280)) refuse(at, middle, in_middle);
        const Interval d = slants.determinant();
        if (!((sign > 0 ? d.low : -d.high) > limit)) {
          Vec3 where;
          if (!Determinants(at.samples, sign).are_above(limit, 0, where))
            refuse(at, where, jacobian_of(at.samples, where).determinant());
        }
        longest_edge_ = std::max(longest_edge_, longest_edge_of(of_middle, frame().spacing));
        cells += std::abs(in_middle);
        least = std::min(least, std::abs(in_middle));
        // With J the derivatives, the largest eigenvalue of J J^T is at most a sum of a row.
        double sums[3] = {};
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j) {
            Interval dots{0, 0};
            for (int axis = 0; axis < 3; ++axis) {
              const double squared = scale[axis] * scale[axis];
              const Interval term = product(slants.m[i][axis], slants.m[j][axis]);
              dots.low += term.low * squared;
              dots.high += term.high * squared;
            }
            sums[i] += magnitude(dots);
            if (i == j) steep[i] = std::max(steep[i], dots.high);
          }
        steepest = std::max({steepest, sums[0], sums[1], sums[2]});
      }
    }
  constexpr double up = 1 + 0x1p-40;
  steepness_ = std::sqrt(steepest) * up;
  for (int c = 0; c < 3; ++c) slopes_[c] = std::sqrt(steep[c]) * up;
  const double count = static_cast<double>(nx) * static_cast<double>(ny) * static_cast<double>(nz);
  mean_size_ = cube_root(voxel_volume * (count / cells));
  largest_size_ = cube_root(voxel_volume / least);
}

Neighbourhood SampledMap::smallest() const {
  const double side = steepness_ > 0 ? 1 / steepness_ : 1;
  return {frame().origin, {side, side, side}, frame().rotation};
}

SampledMap::Cells SampledMap::cells() const {
  int32_t first[3];
  Cells cells{};
  cells.all = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const Interval within = range(axis);
    first[axis] = static_cast<int32_t>(std::floor(within.low));
    cells.count[axis] = static_cast<uint64_t>(std::floor(within.high) - std::floor(within.low)) + 1;
    cells.all *= static_cast<double>(cells.count[axis]);
  }
  cells.first = {first[0], first[1], first[2]};
  return cells;
}

Box3 SampledMap::box() const {
  return {{}, top_ * frame().spacing};
}

Box3 SampledMap::image_of(const Box3& box) const {
  Box3 cells;
  for (int c = 0; c < 3; ++c) {
    const Interval range = image(c).range(box);
    cells.min[c] = range.low;
    cells.max[c] = range.high;
  }
  return cells;
}

SampledMap::Side SampledMap::side_of(const Box3& box) const {
  const Box3 voxels = image(0).to_voxels(box);
  bool is_inside = true;
  for (int axis = 0; axis < 3; ++axis) {
    if (voxels.max[axis] < 0 || voxels.min[axis] > top_[axis]) return Side::outside;
    is_inside = is_inside && voxels.min[axis] >= 0 && voxels.max[axis] <= top_[axis];
  }
  return is_inside ? Side::inside : Side::both;
}

double SampledMap::distance_within(Vec3 p) const {
  const Vec3 u = to_voxels(p), spacing = frame().spacing;
  Vec3 out;
  double within = infinity;
  for (int axis = 0; axis < 3; ++axis) {
    const double gap = std::min(u[axis], top_[axis] - u[axis]) * spacing[axis];
    within = std::min(within, gap);
    out[axis] = std::max(0.0, -gap);
  }
  return within < 0 ? -length(out) : within;
}

double SampledMap::slack(Vec3 p, double distance) const {
  const double reach = max_magnitude(p) + max_magnitude(frame().origin) + distance;
  return 0x1p-45 * reach;
}

std::array<Vec3, 3> SampledMap::gradients(Vec3 p) const {
  const Vec3 u = to_voxels(p);
  uint64_t at[3];
  Vec3 fraction;
  for (int axis = 0; axis < 3; ++axis) {
    const Image::Located located = image(0).locate(u[axis], axis);
    at[axis] = located.cell;
    fraction[axis] = located.fraction;
  }
  const Voxel there = voxel(at[0], at[1], at[2]);
  const Jacobian j = jacobian_of(there.samples, fraction);
  std::array<Vec3, 3> gradients;
  for (size_t c = 0; c < 3; ++c)
    gradients[c] = frame().rotation.apply(Vec3{j.m[c][0], j.m[c][1], j.m[c][2]} * image(0).scale());
  return gradients;
}

void SampledMap::SearchCost::add(uint64_t cost) {
  check_cancelled();
  if (sum_.fetch_add(cost, std::memory_order_relaxed) + cost > most_)
    fail(Status::limit,
         "by warp.u, v and w, so many points have nearly the same coordinates that finding the "
         "places of cells takes more than %llu looks at voxels, the limit",
         static_cast<unsigned long long>(most_));
}

bool SampledMap::find(Vec3 cells, Vec3& g, SearchCost& cost) const {
  const uint64_t root[3] = {0, 0, 0};
  return find_below(image(0).bounds().levels().size() - 1, root, cells, g, cost);
}

bool SampledMap::find_below(size_t level, const uint64_t (&block)[3], Vec3 cells, Vec3& g,
                            SearchCost& cost) const {
  const auto holds = [](Interval range, double value) {
    const double slack = 0x1p-30 * (1 + std::abs(value));
    return range.low - slack <= value && value <= range.high + slack;
  };
  for (int c = 0; c < 3; ++c)
    if (!holds(image(c).bounds().levels()[level].at(block[0], block[1], block[2]), cells[c]))
      return false;
  const uint64_t side = level > 0 ? 2 : uint64_t{1} << ImageBounds::leaf_bits;
  uint64_t end[3];
  for (int axis = 0; axis < 3; ++axis)
    end[axis] = std::min(
        side * (block[axis] + 1),
        level > 0 ? image(0).bounds().levels()[level - 1].size[axis] : image(0).cells(axis));
  cost.add((end[0] - side * block[0]) * (end[1] - side * block[1]) * (end[2] - side * block[2]));
  constexpr uint64_t trial = 64;
  for (uint64_t z = side * block[2]; z < end[2]; ++z)
    for (uint64_t y = side * block[1]; y < end[1]; ++y)
      for (uint64_t x = side * block[0]; x < end[0]; ++x) {
        if (level > 0) {
          const uint64_t child[3] = {x, y, z};
          if (find_below(level - 1, child, cells, g, cost)) return true;
          continue;
        }
        const Voxel at = voxel(x, y, z);
        bool may_hold = true;
        for (int c = 0; c < 3 && may_hold; ++c) {
          const auto [low, high] = std::minmax_element(at.samples[c], at.samples[c] + 8);
          may_hold = holds({*low, *high}, cells[c]);
        }
        if (!may_hold) continue;
        Vec3 f{0.5, 0.5, 0.5};
        cost.add(trial);
        int found = solve(at.samples, cells, f);
        for (int part = 0; part < 8 && found < 0; ++part) {
          f = {part & 1 ? 0.75 : 0.25, part & 2 ? 0.75 : 0.25, part & 4 ? 0.75 : 0.25};
          cost.add(trial);
          found = solve(at.samples, cells, f);
        }
        if (found != 1) continue;
        const Vec3 u =
            Vec3{static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)} + f;
        g = u * frame().spacing;
        return true;
      }
  return false;
}

void SampledMap::describe(HashInput& input) const {
  input.integer(3);
  for (int c = 0; c < 3; ++c) image(c).describe(input);
}

}  // namespace msq
