// SPDX-License-Identifier: Apache-2.0
#include "structure/lattice/warped/round_places.h"

#include <algorithm>
#include <cmath>

#include "base/pi.h"
#include "base/status.h"

namespace msq {

namespace {

Neighbourhood in_grid(const Neighbourhood& grid) {
  return {{}, grid.cell_size, {}};
}

/// Encloses the cosine over an interval. Bounds need no exact bits.
Interval cosine(Interval angle) {
  constexpr double slack = 1e-12;
  if (!(angle.high - angle.low < two_pi)) return {-1, 1};
  const double a = std::cos(angle.low), b = std::cos(angle.high);
  Interval range{std::min(a, b) - slack, std::max(a, b) + slack};
  const auto holds = [&](double from) {  // from plus whole turns
    const double turns = std::ceil((angle.low - from) / two_pi - slack);
    return from + turns * two_pi <= angle.high + slack;
  };
  if (holds(0)) range.high = 1;
  if (holds(pi)) range.low = -1;
  return range;
}

Interval product(Interval a, Interval b) {
  const auto [low, high] =
      std::minmax({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high});
  return {low, high};
}

}  // namespace

RoundPlaces::RoundPlaces(const Warp& warp)
    : warp_(warp.kind(), in_grid(warp.grid()), warp.shell()),
      straight_(warp_.straight()),
      smallest_(warp.grid()) {
  const Warp::Shell& shell = warp.shell();
  const double size = smallest_.cell_size.x, middle = shell.inner + 0.5 * size;
  const double wide_as = 1 + std::abs(shell.shear_outwards) + std::abs(shell.shear_along);
  double angle = wide_as * (two_pi / shell.count);
  if (is_spherical()) angle += pi / shell.count_polar;
  if (!(angle <= max_angle * pi / 180))
    fail(Status::argument,
         "warp.count is %u, count_polar %u and the shear %g and %g: struts would reach over %g "
         "degrees; the limit for lattices is %g",
         shell.count, shell.count_polar, shell.shear_outwards, shell.shear_along, angle * 180 / pi,
         max_angle);
  dip_ = std::cos(0.5 * angle) * (1 - 1e-9);
  layers_ = std::floor((warp.outer() - shell.inner) / size * (1 + 1e-12));
  if (!(layers_ >= 1))
    fail(Status::argument,
         "warp.outer_radius is %.17g and inner_radius %.17g: no whole cell of grid.cell_size[0], "
         "%g, "
         "fits between them",
         shell.outer, shell.inner, size);
  smallest_.cell_size.y = middle * (two_pi / shell.count);
  if (is_spherical()) smallest_.cell_size.z = middle * (pi / shell.count_polar);
  const double wide = std::isfinite(layers_) ? shell.outer / middle : 1;
  largest_ = std::max(
      {size, smallest_.cell_size.y * wide, smallest_.cell_size.z * (is_spherical() ? wide : 1)});
}

Interval RoundPlaces::shear(const CellBlock& cells) const {
  const Warp::Shell& shell = warp_.shell();
  if (!shell.is_sheared()) return {0, 0};
  const auto span = [&](int axis, double times) {
    return product({cells.first[axis], cells.last[axis] + 1}, {times, times});
  };
  const Interval outwards = span(0, shell.shear_outwards), along = span(2, shell.shear_along);
  return {outwards.low + along.low, outwards.high + along.high};
}

CellIndex RoundPlaces::cell_of(Vec3 g) const {
  return warp_.locate(warp_.to_cells(g)).cell;
}

CellIndex RoundPlaces::canonical(CellIndex cell) const {
  const auto count = static_cast<int32_t>(warp_.shell().count);
  cell.y %= count;
  if (cell.y < 0) cell.y += count;
  return cell;
}

CellIndex RoundPlaces::nearest_with_struts(CellIndex cell) const {
  cell.x = std::max(cell.x, 0);
  if (cell.x >= layers_) cell.x = static_cast<int32_t>(layers_) - 1;
  return canonical(cell);
}

CellPlaces::Ends RoundPlaces::ends(CellIndex cell) const {
  Ends ends;
  const auto end_of = [](int32_t at, double last) {
    return at <= 0 ? End::first : at >= last ? End::last : End::none;
  };
  ends.along[0] = end_of(cell.x, layers_);
  if (is_spherical()) ends.along[2] = end_of(cell.z, warp_.shell().count_polar);
  return ends;
}

Vec3 RoundPlaces::place(CellIndex cell, Vec3 fraction) const {
  return warp_.from_cells(Vec3{double(cell.x), double(cell.y), double(cell.z)} + fraction);
}

unsigned RoundPlaces::folded_axes(CellIndex cell, Vec3 fraction) const {
  constexpr unsigned y = 2, z = 4;
  const bool is_in_middle = cell.x == 0 && fraction.x == 0 && warp_.shell().inner == 0;
  if (!is_spherical()) return is_in_middle ? y : 0;
  if (is_in_middle) return y | z;
  const bool is_pole =
      fraction.z == 0 && (cell.z == 0 || cell.z == static_cast<int32_t>(warp_.shell().count_polar));
  return is_pole ? y : 0;
}

Box3 RoundPlaces::bounds(const CellBlock& cells) const {
  const Warp::Shell& shell = warp_.shell();
  const Vec3 size = warp_.grid().cell_size;
  const auto radius_at = [&](double u) { return std::max(0.0, shell.inner + u * size.x); };
  Interval across{radius_at(cells.first[0]), radius_at(cells.last[0] + 1)}, along;
  const double most = across.high;
  if (is_spherical()) {
    const auto polar = [&](double w) {  // from the north pole
      return pi * (1 - std::min<double>(w, shell.count_polar) / shell.count_polar);
    };
    const Interval angle{polar(cells.last[2] + 1), polar(cells.first[2])};
    along = product(across, cosine(angle));
    const Interval sine = cosine({angle.low - pi / 2, angle.high - pi / 2});
    across = product(across, {std::max(0.0, sine.low), sine.high});
  } else {
    along = {cells.first[2] * size.z, (cells.last[2] + 1) * size.z};
  }
  const double turn = two_pi / shell.count;
  const Interval shear_of = shear(cells);
  // Whole turns do not matter, but the cosine's slack is for few of them.
  const double turns = std::floor((cells.first[1] - shear_of.high) / shell.count) * shell.count;
  const Interval around{(cells.first[1] - shear_of.high - turns) * turn,
                        (cells.last[1] + 1 - shear_of.low - turns) * turn};
  const Interval x = product(across, cosine(around)),
                 y = product(across, cosine({around.low - pi / 2, around.high - pi / 2}));
  // Nodes and the cells of points are rounded by far less.
  const double sheared = std::max(std::abs(shear_of.low), std::abs(shear_of.high)) * turn;
  const double slack =
      0x1p-38 * (most + shell.inner + std::max(std::abs(along.low), std::abs(along.high))) +
      0x1p-44 * sheared * most;
  return Box3{{x.low, y.low, along.low}, {x.high, y.high, along.high}}.grown(slack);
}

// A strut stays between the half planes of constant v of its cell, as less than half a turn lies
// between them: the wedge is convex. Around an axis it stays between planes of constant w. Its
// distance from the middle is at most that of its ends, and at least that times the cosine of half
// the angle between them. In sheared cells the same holds of half planes of constant angle: those
// between which v, less the shear of all of the cell's points, lies.
void RoundPlaces::for_each_block(const Box3& box, const TakeBlock& take) const {
  const Warp::Image image = straight_.image(box);
  constexpr double slack = 1e-6;
  const double size = warp_.grid().cell_size.x, count = warp_.shell().count;
  CellBlock cells;
  cells.first[0] = std::max(0.0, std::floor(image.cells.min.x - slack));
  cells.last[0] = std::min(
      layers_, cell_within_reach((image.radius.high / dip_ - warp_.shell().inner) / size + slack));
  if (is_spherical()) {
    cells.first[2] = 0;
    cells.last[2] = warp_.shell().count_polar;
  } else {
    cells.first[2] = cell_within_reach(image.cells.min.z - slack);
    cells.last[2] = cell_within_reach(image.cells.max.z + slack);
  }
  if (!(cells.first[0] <= cells.last[0])) return;
  const Interval shear_of = shear(cells);
  const double first = std::floor(image.cells.min.y + shear_of.low - slack),
               last = std::floor(image.cells.max.y + shear_of.high + slack);
  if (last - first + 1 >= count) {
    cells.first[1] = 0;
    cells.last[1] = count - 1;
    return take(cells);
  }
  cells.first[1] = first - count * std::floor(first / count);
  const double end = cells.first[1] + last - first;
  cells.last[1] = std::min(end, count - 1);
  take(cells);
  if (end < count) return;
  cells.first[1] = 0;
  cells.last[1] = end - count;
  take(cells);
}

void RoundPlaces::describe(HashInput& input) const {
  warp_.describe(input);
  input.number(warp_.grid().cell_size.x);
  input.number(warp_.grid().cell_size.z);
}

}  // namespace msq
