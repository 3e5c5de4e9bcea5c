// SPDX-License-Identifier: Apache-2.0
#include "structure/functional/ray_search.h"

#include <algorithm>
#include <cmath>

#include "base/infinity.h"
#include "base/ray_normal.h"
#include "base/simd.h"
#include "base/unit.h"
#include "structure/functional/row_kernels.h"

namespace msq {

namespace {

/// In smallest cell sizes. Longer pieces prove little.
constexpr double first_span = 0.125, max_span = 0.5, small_span = 0x1p-7;
/// Number of steps of the tolerance before they double: where nothing is known, and within rounding
/// of a surface; and the number of steps between doublings.
constexpr uint32_t short_blind_steps = 16, short_near_steps = 1 << 14;
constexpr uint32_t near_steps_at_once = 1 << 10;

/// Rounds after which progress is checked.
constexpr uint32_t rounds_at_once = 4096;
/// In smallest cell sizes: a ray that advances less in these rounds creeps.
constexpr double slow = 0x1p-12;

}  // namespace

FunctionalRays::FunctionalRays(const Functional& solid, const Job* job)
    : solid_(solid),
      job_(job),
      grid_(solid.neighbourhood()),
      level_(solid.level()),
      tolerance_(solid.ray_tolerance()),
      cell_(min_component(grid_.cell_size)),
      cells_{cell_ / grid_.cell_size.x, cell_ / grid_.cell_size.y, cell_ / grid_.cell_size.z},
      is_plain_(solid.angles().is_uniform() &&
                solid.repeats() == std::array<bool, 3>{true, true, true}),
      batch_(solid.ray_program()) {
  std::fill(std::begin(pieces_.span), std::end(pieces_.span), 1);
  if (level_.is_constant()) std::fill_n(levels_.value, lanes, level_.at({}));
  set_no_borders();
}

// Points of the ray, their positions in the grid and their angles are rounded, and so is two_pi.
double FunctionalRays::position_error(const RaySearch& search) const {
  const Vec3 p = search.ray.at(search.from), q = search.ray.at(search.to);
  return 0x1p-49 * (max_magnitude(p) + max_magnitude(q) + max_magnitude(grid_.origin));
}

double FunctionalRays::angle_error(const RaySearch& search, double position_error) const {
  if (solid_.angles().is_mapped()) return 0x1p-47;  // others depend on the piece (bend())
  const double error = two_pi * position_error / cell_ + 0x1p-47;
  const CellAngles& angles = solid_.angles();
  if (!angles.period()) return error;
  const Vec3 p = search.ray.at(search.from), q = search.ray.at(search.to);
  return error + 2 * two_pi * angles.error(p, length(q - p));
}

void FunctionalRays::start(uint32_t number, const RaySearch& search, Live& live) const {
  live.search = number;
  live.blind_steps = live.near_steps = live.rounds = 0;
  live.border = -1;
  live.t = live.before = live.looked_at = search.from;
  live.tolerance = solid_.ray_tolerance(search.ray, search.to);
  live.least = tolerance_;
  live.span = first_span * cell_;
  const Vec3 along = live.along = grid_.rotation.apply_inverse(search.ray.direction);
  live.rates = {two_pi * (along.x * cells_.x), two_pi * (along.y * cells_.y),
                two_pi * (along.z * cells_.z)};
  live.off = position_error(search);
  live.error = angle_error(search, live.off);
}

void FunctionalRays::locate(const RaySearch* searches, size_t count) {
  for (size_t i = 0; i < count; ++i) {
    const Vec3 p = searches[live_[i].search].ray.at(live_[i].t);
    points_[i] = p;
    places_[0][i] = p.x;
    places_[1][i] = p.y;
    places_[2][i] = p.z;
  }
  const Values x{places_[0], false}, y{places_[1], false}, z{places_[2], false};
  auto& to = pieces_.coordinates;
  if (solid_.angles().is_uniform()) {
    static_assert(lanes % max_simd_doubles == 0);  // whole vectors are written
    solid_.angles().find(x, y, z, count, {to[0], to[1], to[2]});
  } else {
    double angles[3][lanes + batch_padding];
    solid_.angles().find(x, y, z, count, {angles[0], angles[1], angles[2]});
    for (size_t axis = 0; axis < 3; ++axis) std::copy_n(angles[axis], count, to[axis]);
  }
  if (!level_.is_constant()) level_.values(points_, count, levels_.value);
}

void FunctionalRays::set_level(const Ray& ray, double t, double span, size_t lane) {
  const double value = levels_.value[lane];
  const auto set = [&](double low, double high, double above, double below, bool is_vague) {
    levels_.low[lane] = low;
    levels_.high[lane] = high;
    levels_.above[lane] = above;
    levels_.below[lane] = below;
    is_level_vague_[lane] = is_vague;
  };
  const Vec3 p = ray.at(t), q = ray.at(t + span);
  const Box3 piece = Box3{min(p, q), max(p, q)}.grown(0x1p-49 * (max_magnitude(p) + span));
  Vec3 gradient;
  if (level_.is_linear(piece, gradient)) {
    const Interval all = level_.range();
    const double slope = dot(gradient, ray.direction);
    const double off =
        0x1p-38 * (all.high - all.low) + 0x1p-49 * length(gradient) * (max_magnitude(p) + span);
    return set(slope, slope, off, off, false);
  }
  const double steepest = level_.lipschitz();
  if (steepest < infinity) {
    const Interval range = level_.range(Box3{p, p});
    const double off =
        2 * (range.high - range.low) + 0x1p-49 * steepest * (max_magnitude(p) + span);
    const bool is_vague = range.high - range.low > 0x1p-36 * (std::abs(value) + 1);
    return set(-steepest, steepest, off, off, is_vague);
  }
  const Interval range = level_.range(piece);
  set(0, 0, range.high - value, value - range.low, true);
}

/// If bounds do not advance the ray, as along a surface that it touches up to rounding, the minimum
/// step doubles each time. So there are at most rounds_at_once rounds for each `slow` of the way
/// and for each doubling up to that.
void FunctionalRays::count_round(Live& live) const {
  if (++live.rounds % rounds_at_once != 0) return;
  const bool creeps = live.t - live.looked_at < slow * cell_;
  live.least = creeps ? 2 * live.least : std::max(tolerance_, 0.5 * live.least);
  live.looked_at = live.t;
}

/// A step without proof.
double FunctionalRays::step_unproven(Live& live, bool is_known, bool is_apart, bool is_vague,
                                     double tolerance) const {
  uint32_t doublings = 0;
  if (is_known && is_apart) {
    live.blind_steps = live.near_steps = 0;
  } else if (is_known && !is_vague) {
    live.blind_steps = 0;
    if (++live.near_steps > short_near_steps)
      doublings = (live.near_steps - short_near_steps) / near_steps_at_once;
  } else if (++live.blind_steps > short_blind_steps) {
    doublings = live.blind_steps - short_blind_steps;
  }
  if (doublings == 0) return tolerance;
  return std::min(std::ldexp(tolerance, static_cast<int>(std::min<uint32_t>(doublings, 64))),
                  std::max(tolerance, max_blind_step * cell_));
}

/// Whether no step is needed.
bool FunctionalRays::is_settled(bool wanted, const RaySearch& search, size_t lane,
                                const RayBatch::Bounds& bounds) const {
  return (bounds.value[lane] <= levels_.value[lane]) == wanted || live_[lane].t >= search.to;
}

bool FunctionalRays::advance(bool wanted, RaySearch& search, Live& live, size_t lane,
                             const RayBatch::Bounds& bounds) {
  const double tolerance = live.tolerance;
  count_round(live);
  const double least = std::max(tolerance, live.least);
  if ((bounds.value[lane] <= levels_.value[lane]) == wanted) {
    search.found = true;
    search.t = live.t;
    if (live.t - live.before > tolerance)
      search.t = bisect(live.before, live.t, tolerance,
                        [&](double t) { return solid_.inside(search.ray.at(t)) == wanted; });
    if (live.border >= 0) {
      Vec3 back;
      back[live.border] = live.rates[live.border] > 0 ? -1 : 1;
      search.normal = solid_.angles().is_mapped()
                          ? unit_along(solid_.angles().gradient(search.ray.at(search.t), back))
                          : grid_.rotation.apply(back);
    }
    return false;
  }
  if (live.t >= search.to) return false;
  const double span = pieces_.span[lane] * cell_;
  const bool is_clear = is_clear_[lane];
  const double proven = is_clear ? steps_.step[lane] : 0;
  live.border = -1;
  if (proven > least) {
    live.before = live.t += proven;
    // Bounds are tighter on shorter pieces.
    const double growth = proven < span || proven > small_span * cell_ ? 2 : 8;
    live.span = std::min(growth * proven, max_span * cell_);
    live.blind_steps = live.near_steps = 0;
    return live.t < search.to;
  }
  const double gap = steps_.gap[lane];
  const bool is_bounded =
      std::abs(steps_.slope[lane]) < infinity && bounds.bend[lane] < infinity && !std::isnan(gap);
  const bool is_level_vague = is_level_vague_[lane];
  if (is_clear && span > 2 * least &&
      (!is_bounded || (gap <= 0 && (is_level_vague || is_vague_[lane])))) {
    live.span = 0.25 * span;
    return true;
  }
  const double step = std::max(
      least, step_unproven(live, is_bounded && is_clear, gap > 0, is_level_vague, tolerance));
  live.span = 8 * step;
  if (border_[lane] <= step) {
    live.border = border_axis_[lane];
    live.span = first_span * cell_;
  }
  live.before = live.t;
  live.t = std::min(live.t + step, search.to);
  return live.t > live.before;  // otherwise steps vanish in rounding
}

void FunctionalRays::set_ray(size_t lane) {
  const Live& live = live_[lane];
  pieces_.error[lane] = live.error;
  for (size_t axis = 0; axis < 3; ++axis)
    pieces_.rates[axis][lane] = live.rates[static_cast<int>(axis)];
}

// A lane whose ray ends takes the next one. So as long as there are more rays, all lanes are busy,
// and the state of the rays stays in the fastest cache.
void FunctionalRays::find(bool wanted, RaySearch* searches, size_t count) {
  size_t next = 0, size = 0;
  const auto take_next = [&](size_t lane) {
    for (; next < count; ++next) {
      RaySearch& search = searches[next];
      search.found = false;
      search.normal = {};
      if (!(search.from <= search.to)) continue;
      start(static_cast<uint32_t>(next++), search, live_[lane]);
      set_ray(lane);
      return true;
    }
    return false;
  };
  if (is_plain_) set_no_borders();
  while (size < lanes && take_next(size)) ++size;
  while (size > 0) {
    check_cancelled(job_);
    locate(searches, size);
    set_pieces(searches, size);
    const RayBatch::Bounds bounds = batch_.run(pieces_, size);
    for (size_t i = 0; i < size; ++i) {
      const double span = pieces_.span[i] * cell_;
      steps_.most[i] = std::min(span, border_[i]);
      const RaySearch& search = searches[live_[i].search];
      if (!level_.is_constant() && !is_settled(wanted, search, i, bounds))
        set_level(search.ray, live_[i].t, span, i);
    }
    steps_.find(wanted, bounds, levels_, cell_, size);
    bool continues[lanes];
    for (size_t i = 0; i < size; ++i)
      continues[i] = advance(wanted, searches[live_[i].search], live_[i], i, bounds);
    for (size_t i = size; i-- > 0;) {
      if (continues[i] || take_next(i)) continue;
      if (i == --size) continue;
      live_[i] = live_[size];
      set_ray(i);
    }
  }
}

void FunctionalRays::set_no_borders() {
  std::fill_n(border_, lanes, infinity);
  std::fill_n(border_axis_, lanes, -1);
  std::fill_n(is_clear_, lanes, true);
  std::fill_n(is_vague_, lanes, false);
}

void FunctionalRays::set_pieces(const RaySearch* searches, size_t count) {
  if (!is_plain_) {
    for (size_t i = 0; i < count; ++i) set_piece(searches[live_[i].search], live_[i], i);
    return;
  }
  for (size_t i = 0; i < count; ++i) {
    const Live& live = live_[i];
    pieces_.span[i] = std::max(std::min(live.span, searches[live.search].to - live.t), tolerance_);
  }
  for (size_t i = 0; i < count; ++i) pieces_.span[i] /= cell_;
}

/// Where cells vary in size, the angle along the period's axis bends within a piece, and its rate
/// differs from piece to piece.
void FunctionalRays::grade(const RaySearch& search, Live& live, size_t lane) {
  const GradedPeriod& period = *solid_.angles().period();
  const int axis = period.axis();
  const double s = solid_.angles().position(search.ray.at(live.t));
  const double span = pieces_.span[lane] * cell_, change = live.along[axis] * span;
  const GradedPeriod::Bounds bounds =
      period.over({s + std::min(0.0, change) - live.off, s + std::max(0.0, change) + live.off});
  const double along = live.along[axis] * cell_;  // per smallest cell size
  live.rates[axis] = two_pi * (period.frequency(s) * along);
  pieces_.bends[static_cast<size_t>(axis)][lane] = two_pi * bounds.bend * along * along;
  // The rate is that of a position that is off.
  pieces_.error[lane] += 2 * two_pi * bounds.bend * live.off * span;
  max_rates_[axis][lane] = two_pi * bounds.most * std::abs(along);
}

/// In warped cells all rates differ from piece to piece, and the angles bend. The bounds hold at
/// the distances from the axis that the piece has; it ends before it is half as far.
void FunctionalRays::bend(const RaySearch& search, Live& live, size_t lane) {
  const Warp& warp = *solid_.angles().warp();
  const Vec3 p = points_[lane], along = search.ray.direction;
  const double rho = warp.axis_distance(p);
  pieces_.span[lane] =
      std::max(std::min(pieces_.span[lane], 0.25 * rho / cell_), tolerance_ / cell_);
  const double span = pieces_.span[lane] * cell_, off = warp.slack(p, span);
  const double reach = (1 + 0x1p-40) * span + 2 * off;
  const double near = rho - reach, radius = warp.radius(p) - reach;
  if (!(near > 0)) {
    // Nothing is known.
    for (size_t axis = 0; axis < 3; ++axis) {
      pieces_.bends[axis][lane] = infinity;
      live.rates[static_cast<int>(axis)] = 0;
      max_rates_[axis][lane] = infinity;
    }
    return;
  }
  const Vec3 slopes = warp.slopes(near, radius), bends = warp.bends(near, radius);
  const std::array<Vec3, 3> gradients = warp.gradients(p);
  double error = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const size_t a = static_cast<size_t>(axis);
    live.rates[axis] = two_pi * (dot(gradients[a], along) * cell_);
    max_rates_[a][lane] = two_pi * (1 + 0x1p-40) * slopes[axis] * cell_;
    pieces_.bends[a][lane] = two_pi * (0.5 + 0x1p-40) * bends[axis] * cell_ * cell_;
    // Places are off, and rates are those of places that are off, and rounded.
    error =
        std::max(error, slopes[axis] * (2 * off + 0x1p-45 * span) + 2 * bends[axis] * off * span);
  }
  pieces_.error[lane] += two_pi * (1 + 0x1p-40) * error;
}

/// Of a sampled map the slopes in the box of a piece are known. The angles follow the mean of these
/// slopes, up to half of their spread.
void FunctionalRays::follow(const RaySearch& search, Live& live, size_t lane) {
  const SampledMap& map = *solid_.angles().sampled();
  const Vec3 p = points_[lane], along = search.ray.direction;
  const double span = pieces_.span[lane] * cell_, off = map.slack(p, span);
  const Vec3 q = search.ray.at(live.t + span);
  const Box3 box = Box3{min(p, q), max(p, q)}.grown(2 * off);
  double error = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const size_t a = static_cast<size_t>(axis);
    const std::optional<Slopes> slopes = map.slopes_in(axis, box);
    pieces_.bends[a][lane] = 0;
    if (!slopes) {
      pieces_.bends[a][lane] = infinity;
      live.rates[axis] = 0;
      max_rates_[a][lane] = infinity;
      continue;
    }
    Interval rate{0, 0};
    for (int i = 0; i < 3; ++i) {
      const double one = slopes->between.min[i] * along[i],
                   other = slopes->between.max[i] * along[i];
      rate.low += std::min(one, other);
      rate.high += std::max(one, other);
    }
    const double most = std::max(std::abs(rate.low), std::abs(rate.high));
    live.rates[axis] = two_pi * (0.5 * (rate.low + rate.high) * cell_);
    max_rates_[a][lane] = two_pi * (1 + 0x1p-40) * most * cell_;
    error = std::max(error, 0.5 * (rate.high - rate.low) * span + 2 * slopes->rounding +
                                most * (2 * off + 0x1p-45 * span));
  }
  is_vague_[lane] = true;
  pieces_.error[lane] += two_pi * (1 + 0x1p-40) * error;
}

void FunctionalRays::set_piece(const RaySearch& search, Live& live, size_t lane) {
  pieces_.span[lane] = std::max(std::min(live.span, search.to - live.t), tolerance_) / cell_;
  pieces_.error[lane] = live.error;
  border_[lane] = infinity;
  border_axis_[lane] = -1;
  is_clear_[lane] = true;
  is_vague_[lane] = false;
  const std::optional<GradedPeriod>& period = solid_.angles().period();
  const bool is_warped = solid_.angles().is_mapped();
  if (period) grade(search, live, lane);
  if (solid_.angles().warp()) bend(search, live, lane);
  if (solid_.angles().sampled()) follow(search, live, lane);
  const double error = pieces_.error[lane];
  for (int axis = 0; axis < 3; ++axis) {
    const double rate = live.rates[axis];
    pieces_.rates[static_cast<size_t>(axis)][lane] = rate;
    if (solid_.repeats()[static_cast<size_t>(axis)]) continue;
    if (rate == 0 && !is_warped && grid_.sample_axes()[0] >= 0)
      continue;  // then rounding is the same all along
    const double angle = pieces_.coordinates[static_cast<size_t>(axis)][lane];
    const double behind = rate > 0 ? angle : two_pi - angle;
    const double ahead = two_pi - behind - error;
    if (behind < error) is_clear_[lane] = false;  // points may still be before the border
    const bool is_graded = period && period->axis() == axis;
    const double most =
        is_graded || is_warped ? max_rates_[static_cast<size_t>(axis)][lane] : std::abs(rate);
    const double until = cell_ * std::max(0.0, ahead / most);
    if (ahead <= 0) is_clear_[lane] = false;
    if (until < border_[lane]) {
      border_[lane] = until;
      border_axis_[lane] = axis;
    }
    // In warped cells a ray may turn back.
    const double back = is_warped ? cell_ * std::max(0.0, (behind - error) / most) : infinity;
    if (back < border_[lane]) {
      border_[lane] = back;
      border_axis_[lane] = -1;
    }
  }
}

Vec3 FunctionalRays::border_normal(const Ray& ray, double t) const {
  if (solid_.repeats() == std::array<bool, 3>{true, true, true}) return {};
  const double room = 2 * solid_.ray_tolerance(ray, t);
  const Vec3 before = ray.at(t - room), behind = ray.at(t + room);
  const Vec3 change = solid_.angles().fraction(behind) - solid_.angles().fraction(before);
  for (int axis = 0; axis < 3; ++axis) {
    if (solid_.repeats()[static_cast<size_t>(axis)] || std::abs(change[axis]) < 0.5) continue;
    if (solid_.inside(before) || !solid_.inside(behind)) return {};
    Vec3 along;
    along[axis] = 1;
    const Vec3 normal = unit_along(solid_.angles().gradient(ray.at(t), along));
    return dot(normal, ray.direction) > 0 ? normal * -1.0 : normal;
  }
  return {};
}

/// By a slope, the surface of a function without jumps is near the hit, within `way`, and the
/// normal leads out. The mean of the points outside is less accurate, and gives nothing at walls
/// that are thinner than the distance of these points.
Vec3 FunctionalRays::checked_normal(const RaySearch& search, Vec3 by_slope,
                                    double steepness) const {
  const auto inside = [this](Vec3 p) { return solid_.inside(p); };
  const double way = solid_.normal_distance();
  const Vec3 p = search.ray.at(search.t);
  const auto leads_out = [&](Vec3 normal) {
    return !inside(p + normal * way) && inside(p - normal * way);
  };
  // Where a ray starts inside, the hit has another normal: back along the ray, or that of the shape
  // or scale through which it comes.
  if (search.t == search.from && search.from < search.to) return by_slope;
  const bool is_into = dot(by_slope, search.ray.direction) > 0x1p-20;
  bool is_far = false;
  if (!is_into) {
    if (dot(by_slope, by_slope) > 0 && (solid_.is_continuous() || solid_.has_steady_distance()))
      return by_slope;
    is_far = !(std::abs(solid_.onset(p) - level_.at(p)) <= 0x1p-4 * way * steepness);
    if (!is_far && leads_out(by_slope)) return by_slope;
  }
  const Vec3 around = normal_by_membership(inside, search.ray, search.t, way);
  return is_into || is_far || leads_out(around) ? around : by_slope;
}

void FunctionalRays::find_normals(RaySearch* searches, size_t count) {
  const bool has_slopes = solid_.ray_program().has_slopes();
  for (size_t next = 0; next < count;) {
    size_t size = 0;
    for (; next < count && size < lanes; ++next) {
      RaySearch& search = searches[next];
      if (!search.found || dot(search.normal, search.normal) > 0) continue;
      search.normal = border_normal(search.ray, search.t);
      if (dot(search.normal, search.normal) > 0) continue;
      live_[size].search = static_cast<uint32_t>(next);
      live_[size].t = search.t;
      ++size;
    }
    if (size == 0) return;
    locate(searches, size);
    Vec3 gradients[lanes];
    if (has_slopes) {
      const RayBatch::Slopes slopes = batch_.slopes(pieces_.coordinates, size);
      for (size_t i = 0; i < size; ++i)
        gradients[i] = {slopes.along[0][i], slopes.along[1][i], slopes.along[2][i]};
    } else {
      bound_gradients(searches, size, gradients);
    }
    for (size_t i = 0; i < size; ++i) {
      const Vec3 away = solid_.angles().gradient(points_[i], gradients[i]) -
                        level_.gradient(points_[i], 0x1p-16 * cell_);
      const double steepness = length(away);
      RaySearch& search = searches[live_[i].search];
      const Vec3 by_slope = steepness > 0 && steepness < infinity ? away * (1 / steepness) : Vec3{};
      search.normal = checked_normal(search, by_slope, steepness);
    }
  }
}

void FunctionalRays::bound_gradients(const RaySearch* searches, size_t count, Vec3* gradients) {
  for (size_t i = 0; i < count; ++i) {
    const RaySearch& search = searches[live_[i].search];
    pieces_.span[i] = tolerance_ / cell_;
    pieces_.error[i] = angle_error(search, position_error(search));
  }
  for (auto& bends : pieces_.bends) std::fill_n(bends, count, 0);
  for (int along = 0; along < 3; ++along) {
    for (int axis = 0; axis < 3; ++axis)
      std::fill_n(pieces_.rates[axis], count, axis == along ? 1 : 0);
    const RayBatch::Bounds bounds = batch_.run(pieces_, count);
    for (size_t i = 0; i < count; ++i) gradients[i][along] = 0.5 * (bounds.low[i] + bounds.high[i]);
  }
}

}  // namespace msq
