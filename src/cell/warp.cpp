// SPDX-License-Identifier: Apache-2.0
#include "cell/warp.h"

#include <algorithm>
#include <cmath>

#include "base/infinity.h"
#include "base/pi.h"
#include "base/status.h"
#include "cell/warp-inl.h"

// What inlines a function of a target must be compiled for that target (expression/evaluate.cpp).
HWY_BEFORE_NAMESPACE();
namespace msq {

namespace {

Warp::Place place_of(const Warp::Numbers& n, Vec3 p) {
  const HWY_NAMESPACE::Single a;
  HWY_NAMESPACE::to_warp_frame(a, n, p.x, p.y, p.z);
  const auto place = HWY_NAMESPACE::warped_place(a, n, p.x, p.y, p.z);
  return {{place.u, place.v, place.w}, place.radius};
}

double radius_of(const Warp::Numbers& n, Vec3 p) {
  const HWY_NAMESPACE::Single a;
  HWY_NAMESPACE::to_warp_frame(a, n, p.x, p.y, p.z);
  return HWY_NAMESPACE::warped_radius(a, n, p.x, p.y, p.z);
}

double fraction_of(const Warp::Numbers& n, double w) {
  return HWY_NAMESPACE::fraction_along(HWY_NAMESPACE::Single(), n, w);
}

double angle_of(double y, double x) {
  return HWY_NAMESPACE::arctangent(HWY_NAMESPACE::Single(), y, x);
}

Vec3 direction(double angle) {
  const HWY_NAMESPACE::Single a;
  return {HWY_NAMESPACE::sine(a, angle, 1), HWY_NAMESPACE::sine(a, angle, 0), 0};
}

}  // namespace

}  // namespace msq
HWY_AFTER_NAMESPACE();

namespace msq {

namespace {

void check(const Warp::Shell& shell, Warp::Kind kind) {
  const auto check_count = [](uint32_t count, const char* name) {
    if (count < 1 || count > Warp::max_count)
      fail(Status::argument, "warp.%s is %u; it must be from 1 to %u", name, count,
           Warp::max_count);
  };
  check_count(shell.count, "count");
  if (kind == Warp::Kind::spherical)
    check_count(shell.count_polar, "count_polar");
  else if (shell.count_polar)
    fail(Status::argument, "warp.count_polar is %u; around an axis it must be 0",
         shell.count_polar);
  constexpr double most = 1e75;
  if (!(shell.inner >= 0 && shell.inner <= most))
    fail(Status::argument, "warp.inner_radius is %g; it must be from 0 to %g", shell.inner, most);
  if (!(shell.outer == 0 || (shell.outer > shell.inner && shell.outer <= most)))
    fail(Status::argument,
         "warp.outer_radius is %g; it must be 0, for no limit, or above inner_radius, %g, and at "
         "most %g",
         shell.outer, shell.inner, most);
  const auto check_shear = [&](double shear, const char* name) {
    if (!(std::abs(shear) <= Warp::max_shear))
      fail(Status::argument, "warp.%s is %g; it must be at most %g in magnitude", name, shear,
           Warp::max_shear);
    if (shear != 0 && kind == Warp::Kind::spherical)
      fail(Status::argument, "warp.%s is %g; around a point it must be 0", name, shear);
  };
  check_shear(shell.shear_outwards, "shear_outwards");
  check_shear(shell.shear_along, "shear_along");
}

/// Rounding of the definition after the position in the grid's frame, whose relative error is a few
/// units of 2^-53: squares, sums and roots are good to 2^-51, angles to 2^-48 absolute
/// (elementary-inl.h), and products with their factors to 2^-52. This is more than twice their sum.
constexpr double relative_margin = 0x1p-45;
/// Squares below the smallest normal number lose their accuracy.
constexpr double tiny = 1e-150;

}  // namespace

Warp::Warp(Kind kind, const Neighbourhood& grid, const Shell& shell)
    : kind_(kind), grid_(grid), shell_(shell) {
  check(shell, kind);
  const double inner_cells = shell.inner / grid.cell_size.x;
  if (!(inner_cells < max_cell_index))
    fail(Status::limit,
         "warp.inner_radius is %g, %g cells of %g from the middle; the limit is %g cells",
         shell.inner, inner_cells, grid.cell_size.x, max_cell_index);
  for (int axis = 0; axis < 3; ++axis) numbers_.origin[axis] = grid.origin[axis];
  std::copy_n(grid.rotation.m.begin(), 9, numbers_.matrix);
  numbers_.inner = shell.inner;
  numbers_.outer = shell.outer > 0 ? shell.outer : infinity;
  numbers_.radial = grid.cell_size.x;
  numbers_.count = shell.count;
  numbers_.around = shell.count / two_pi;
  numbers_.is_spherical = kind == Kind::spherical;
  numbers_.along = numbers_.is_spherical ? shell.count_polar / pi : grid.cell_size.z;
  numbers_.quarter_turn = pi / 2;
  numbers_.last = shell.count_polar;
  numbers_.shear_outwards = shell.shear_outwards;
  numbers_.shear_along = shell.shear_along;
  numbers_.is_sheared = shell.is_sheared();
}

Warp Warp::straight() const {
  Shell shell = shell_;
  shell.shear_outwards = shell.shear_along = 0;
  return {kind_, grid_, shell};
}

Warp::Place Warp::place(Vec3 p) const {
  return place_of(numbers_, p);
}

double Warp::radius(Vec3 p) const {
  return radius_of(numbers_, p);
}

Neighbourhood::Located Warp::locate(Vec3 cells) const {
  const Vec3 floor{std::floor(cells.x), std::floor(cells.y), std::floor(cells.z)};
  Neighbourhood::Located located;
  located.fraction = {cells.x - floor.x, cells.y - floor.y, fraction_of(numbers_, cells.z)};
  located.cell = {static_cast<int32_t>(floor.x), static_cast<int32_t>(floor.y),
                  static_cast<int32_t>(floor.z)};
  if (numbers_.is_spherical)
    located.cell.z = std::min(located.cell.z, static_cast<int32_t>(shell_.count_polar) - 1);
  return located;
}

Vec3 Warp::from_cells(Vec3 cells) const {
  const double r = numbers_.inner + cells.x * numbers_.radial;
  const auto closed = [&](double v) { return v - numbers_.count * std::floor(v / numbers_.count); };
  double v = closed(cells.y);
  if (numbers_.is_sheared)
    v = closed(v - (cells.x * numbers_.shear_outwards + cells.z * numbers_.shear_along));
  const Vec3 around = direction(v * (two_pi / numbers_.count));
  double across = r, along = cells.z * numbers_.along;
  if (numbers_.is_spherical) {
    const Vec3 up = direction(cells.z * (pi / shell_.count_polar) - numbers_.quarter_turn);
    across = r * up.x;
    along = r * up.y;
  }
  return grid_.from_grid(Vec3{across * around.x, across * around.y, along});
}

double Warp::axis_distance(Vec3 p) const {
  const Vec3 g = grid_.to_grid(p);
  return std::sqrt(g.x * g.x + g.y * g.y);
}

double Warp::slack(Vec3 p, double distance) const {
  // Positions in the grid's frame are sums of three products of rounded differences: within 12
  // units of 2^-53 of the reach in each coordinate, so within 2^-48. Angles, with their factors,
  // are within 2^-48 of the true ones, as arcs at a distance of at most twice the reach; radii
  // within 2^-51.
  const double reach = max_magnitude(p) + max_magnitude(grid_.origin) + distance;
  const double slack = 0x1p-45 * (reach + numbers_.inner) + tiny;
  if (!numbers_.is_sheared) return slack;
  // The shear is of the u and w that are computed. It has four roundings; as v goes around, they
  // are arcs at a distance of at most twice the reach. Whole turns are removed without rounding.
  const double in_cells =
      2 * (std::abs(numbers_.shear_outwards) * ((reach + numbers_.inner) / numbers_.radial) +
           std::abs(numbers_.shear_along) * (reach / numbers_.along));
  return slack + 0x1p-48 * reach * (in_cells / numbers_.around);
}

// With S the lengths without a shear and s, t its two numbers, the squared length of a grad u + b
// grad v + c grad w is (S_u (a + s b))^2 + (S_v b)^2 + (S_w (c + t b))^2, and (a + s b)^2 is at
// most 2 a^2 + 2 s^2 b^2.
Vec3 Warp::slopes(double axis_distance, double radius) const {
  constexpr double up = 1 + relative_margin;
  const auto around = [](double cells, double at) { return at > 0 ? cells / at * up : infinity; };
  const Vec3 straight{up / numbers_.radial, around(numbers_.around, axis_distance),
                      numbers_.is_spherical
                          ? around(numbers_.along, std::max(radius, axis_distance))
                          : up / numbers_.along};
  if (!numbers_.is_sheared) return straight;
  const double s = straight.x * numbers_.shear_outwards, t = straight.z * numbers_.shear_along;
  const double root = std::sqrt(2.0) * up;
  return {straight.x * root, std::sqrt(straight.y * straight.y + 2 * (s * s + t * t)) * up,
          straight.z * root};
}

Vec3 Warp::bends(double axis_distance, double radius) const {
  // Along a line of unit speed rho'' = (rho theta')^2 / rho, and so is r''. theta' = h / rho^2 with
  // a constant h <= rho, so |theta''| = 2 |theta' rho'| / rho, and 2 |rho theta' rho'| <= 1. The
  // latitude's derivative is k / r^2 with k = z' rho - z rho' <= r and |k'| = |z| rho'', so that of
  // it is at most rho'' / r + 2 |k / r| |r'| / r^2 <= 1 / (rho r) + 1 / r^2.
  constexpr double up = 1 + relative_margin;
  const double r = std::max(radius, axis_distance);
  Vec3 bends{up / (r * numbers_.radial), up * numbers_.around / (axis_distance * axis_distance),
             numbers_.is_spherical ? up * 2 * numbers_.along / (axis_distance * r) : 0};
  // w is linear where cells are sheared.
  if (numbers_.is_sheared) bends.y += up * std::abs(numbers_.shear_outwards) * bends.x;
  return bends;
}

std::array<Vec3, 3> Warp::gradients(Vec3 p) const {
  const Vec3 g = grid_.to_grid(p);
  const double across = g.x * g.x + g.y * g.y, rho = std::sqrt(across);
  Vec3 around = Vec3{-g.y, g.x, 0} * (numbers_.around / across);
  Vec3 outwards{g.x / rho, g.y / rho, 0}, along{0, 0, 1 / numbers_.along};
  if (numbers_.is_spherical) {
    const double square = across + g.z * g.z;
    along = Vec3{-g.z * outwards.x, -g.z * outwards.y, rho} * (numbers_.along / square);
    outwards = g * (1 / std::sqrt(square));
  }
  outwards = outwards * (1 / numbers_.radial);
  if (numbers_.is_sheared)
    around = around + outwards * numbers_.shear_outwards + along * numbers_.shear_along;
  return {grid_.rotation.apply(outwards), grid_.rotation.apply(around),
          grid_.rotation.apply(along)};
}

Warp::Image Warp::image(const Box3& box) const {
  const Vec3 middle = (box.min + box.max) * 0.5;
  Box3 g = grid_.to_grid(box);
  g = g.grown(slack(middle, 2 * max_component(box.extent())));
  const auto nearest = [](double low, double high) { return std::max({0.0, low, -high}); };
  const auto farthest = [](double low, double high) { return std::max(-low, high); };
  // Square roots of sums of squares are monotone.
  const double x0 = nearest(g.min.x, g.max.x), y0 = nearest(g.min.y, g.max.y),
               x1 = farthest(g.min.x, g.max.x), y1 = farthest(g.min.y, g.max.y);
  const double near = std::sqrt(x0 * x0 + y0 * y0), far = std::sqrt(x1 * x1 + y1 * y1);
  constexpr double down = 1 - relative_margin, up = 1 + relative_margin;
  Image image;
  image.axis_distance = std::max(0.0, near * down - tiny);
  double low = near, high = far;
  if (numbers_.is_spherical) {
    const double z0 = nearest(g.min.z, g.max.z), z1 = farthest(g.min.z, g.max.z);
    low = std::sqrt(near * near + z0 * z0);
    high = std::sqrt(far * far + z1 * z1);
    // The latitude rises with z. It falls with rho where z is positive, otherwise it rises.
    const double south = angle_of(g.min.z, g.min.z > 0 ? far : near),
                 north = angle_of(g.max.z, g.max.z > 0 ? near : far);
    const double margin = 8 * relative_margin;
    const auto cells = [&](double latitude) {
      return std::clamp((latitude + numbers_.quarter_turn) * numbers_.along, 0.0, numbers_.last);
    };
    image.cells.min.z = cells(south - margin);
    image.cells.max.z = cells(north + margin);
  } else {
    const double a = g.min.z / numbers_.along, b = g.max.z / numbers_.along;
    image.cells.min.z = a - relative_margin * std::abs(a);
    image.cells.max.z = b + relative_margin * std::abs(b);
  }
  image.radius = {std::max(0.0, low * down - tiny), high * up + tiny};
  const double u0 = (image.radius.low - numbers_.inner) / numbers_.radial,
               u1 = (image.radius.high - numbers_.inner) / numbers_.radial;
  image.cells.min.x = u0 - relative_margin * std::abs(u0);
  image.cells.max.x = u1 + relative_margin * std::abs(u1);
  // All angles, unless the box leaves the axis on one side.
  image.cells.min.y = 0;
  image.cells.max.y = numbers_.count;
  if (!(near > 2 * tiny)) return image;
  // A convex set that the axis does not meet lies within half a turn. Angles from its middle to its
  // corners have errors of some 2^-50, as the products' errors are relative to the lengths.
  const Vec3 m = (g.min + g.max) * 0.5;
  double back = 0, ahead = 0;
  for (int corner = 0; corner < 4; ++corner) {
    const double x = corner & 1 ? g.max.x : g.min.x, y = corner & 2 ? g.max.y : g.min.y;
    const double angle = angle_of(m.x * y - m.y * x, m.x * x + m.y * y);
    back = std::min(back, angle);
    ahead = std::max(ahead, angle);
  }
  const double at = angle_of(m.y, m.x), margin = 8 * relative_margin;
  double v0 = (at + back - margin) * numbers_.around, v1 = (at + ahead + margin) * numbers_.around;
  if (numbers_.is_sheared) {
    const auto span = [](double a, double b, double times) {
      return Interval{std::min(a * times, b * times), std::max(a * times, b * times)};
    };
    const Interval s = span(image.cells.min.x, image.cells.max.x, numbers_.shear_outwards),
                   t = span(image.cells.min.z, image.cells.max.z, numbers_.shear_along);
    const double most = std::max({-s.low, s.high, 0.0}) + std::max({-t.low, t.high, 0.0}),
                 rounding = relative_margin * (most + numbers_.count);
    v0 += s.low + t.low - rounding;
    v1 += s.high + t.high + rounding;
    const double turns = numbers_.count * std::floor(v0 / numbers_.count);
    v0 -= turns;
    v1 -= turns;
  }
  if (!(v1 - v0 < numbers_.count)) return image;
  image.cells.min.y = v0;
  image.cells.max.y = v1;
  return image;
}

void Warp::describe(HashInput& input) const {
  input.integer(static_cast<uint64_t>(kind_));
  input.integer(shell_.count);
  input.integer(shell_.count_polar);
  input.number(shell_.inner);
  input.number(shell_.outer);
  if (!shell_.is_sheared()) return;
  input.number(shell_.shear_outwards);
  input.number(shell_.shear_along);
}

}  // namespace msq
