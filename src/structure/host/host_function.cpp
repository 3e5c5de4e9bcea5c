// SPDX-License-Identifier: Apache-2.0
// Clusters of the unit cell as in the paper, section "Preprocessing for Repeating Structures". Each
// has an interval of the onset, which the host proves by its own interval or by a Lipschitz
// constant.
#include "structure/host/host_function.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/march_together.h"
#include "base/pi.h"
#include "structure/host/host_function_lines.h"

namespace msq {

namespace {

constexpr int automatic_clusters = 32;
/// For boxes with more clusters, the clusters are not examined one by one.
constexpr int max_in_box = 4096;

Vec3 angles_of(Vec3 fraction) {
  return fraction * two_pi;
}

}  // namespace

HostFunction::HostFunction(const Neighbourhood& neighbourhood, HostFunctionCalls calls,
                           bool is_sheet, Parameter level, int clusters, double lipschitz,
                           bool is_concurrent)
    : Structure(neighbourhood),
      calls_(std::move(calls)),
      is_sheet_(is_sheet),
      is_concurrent_(is_concurrent && level.is_concurrent()),
      level_(std::move(level)),
      lipschitz_(lipschitz),
      side_(clusters ? clusters : automatic_clusters) {
  if (side_ > 1 && (calls_.range || std::isfinite(lipschitz))) build_clusters(lipschitz);
}

void HostFunction::call(const Vec3* angles, size_t count, double* values) const {
  for (size_t first = 0; first < count; first += host_batch)
    calls_.evaluate(angles + first, std::min(host_batch, count - first), values + first);
  for (size_t i = 0; i < count; ++i)
    if (std::isnan(values[i]))
      fail(Status::host, "the host's function is no number at the angles (%g, %g, %g)", angles[i].x,
           angles[i].y, angles[i].z);
}

void HostFunction::evaluate(const Vec3* angles, size_t count, double* onsets) const {
  call(angles, count, onsets);
  for (size_t i = 0; is_sheet_ && i < count; ++i) onsets[i] = std::abs(onsets[i]);
}

void HostFunction::differences(const Vec3* points, size_t count, double* values) const {
  std::vector<Vec3> angles(count);
  for (size_t i = 0; i < count; ++i)
    angles[i] = angles_of(neighbourhood().locate(points[i]).fraction);
  call(angles.data(), count, values);
  for (size_t i = 0; !is_sheet_ && i < count; ++i) values[i] -= level_.at(points[i]);
}

LineGraph HostFunction::wall_lines(const WallSection& section) const {
  return find_host_function_lines(*this, section);
}

Interval HostFunction::onset_of(Interval function) const {
  if (!is_sheet_ || function.low >= 0) return function;
  if (function.high <= 0) return {-function.high, -function.low};
  return {0, std::max(-function.low, function.high)};
}

int HostFunction::number(double angle) const {
  return std::clamp(static_cast<int>(angle * (side_ / two_pi)), 0, side_ - 1);
}

void HostFunction::build_clusters(double lipschitz) {
  // Slightly wider than the rounding of angles and of number().
  constexpr double margin = 1e-10;
  const double size = two_pi / side_;
  std::vector<Vec3> middles;
  std::vector<Interval> functions;
  for (int z = 0; z < side_; ++z)
    for (int y = 0; y < side_; ++y)
      for (int x = 0; x < side_; ++x) {
        const Vec3 low = Vec3{double(x), double(y), double(z)} * size;
        const Box3 box = Box3{low, low + Vec3{size, size, size}}.grown(margin);
        middles.push_back((box.min + box.max) * 0.5);
        constexpr double infinity = std::numeric_limits<double>::infinity();
        Interval function{-infinity, infinity};
        if (calls_.range) function = calls_.range(box);
        if (!(function.low <= function.high))
          fail(Status::host,
               "the host's function runs from %g to %g over the angles (%g, %g, %g) to "
               "(%g, %g, %g)",
               function.low, function.high, box.min.x, box.min.y, box.min.z, box.max.x, box.max.y,
               box.max.z);
        functions.push_back(function);
      }
  if (std::isfinite(lipschitz)) {
    std::vector<double> values(middles.size());
    for (size_t first = 0; first < middles.size(); first += host_batch)
      calls_.evaluate(middles.data() + first, std::min(host_batch, middles.size() - first),
                      values.data() + first);
    const double reach = lipschitz * std::sqrt(3.0) * (0.5 * size + 2 * margin);
    for (size_t i = 0; i < values.size(); ++i) {
      if (std::isnan(values[i]))
        fail(Status::host, "the host's function is no number at the angles (%g, %g, %g)",
             middles[i].x, middles[i].y, middles[i].z);
      const double slack = reach + 0x1p-40 * std::abs(values[i]);
      if (!std::isfinite(slack)) continue;
      functions[i] = {std::max(functions[i].low, values[i] - slack),
                      std::min(functions[i].high, values[i] + slack)};
    }
  }
  clusters_.reserve(functions.size());
  for (const Interval& function : functions) clusters_.push_back(onset_of(function));
}

bool HostFunction::inside(Vec3 p) const {
  const Vec3 angles = angles_of(neighbourhood().locate(p).fraction);
  double onset;
  evaluate(&angles, 1, &onset);
  return onset <= level_.at(p);
}

void HostFunction::keep_points(const Vec3* points, uint8_t* alive, size_t count) const {
  const Interval levels = level_.range();
  const size_t most = std::min(count, host_batch);
  std::vector<Vec3> queried, angles;
  std::vector<size_t> index;
  std::vector<double> onsets(most), level(most);
  queried.reserve(most);
  angles.reserve(most);
  index.reserve(most);
  for (size_t next = 0; next < count;) {
    queried.clear();
    angles.clear();
    index.clear();
    for (; next < count && queried.size() < most; ++next) {
      if (!alive[next]) continue;
      const Vec3 a = angles_of(neighbourhood().locate(points[next]).fraction);
      if (!clusters_.empty()) {
        const Interval& onset = cluster(number(a.x), number(a.y), number(a.z));
        if (onset.high <= levels.low) continue;
        if (onset.low > levels.high) {
          alive[next] = 0;
          continue;
        }
      }
      queried.push_back(points[next]);
      angles.push_back(a);
      index.push_back(next);
    }
    if (queried.empty()) continue;
    evaluate(angles.data(), angles.size(), onsets.data());
    level_.values(queried.data(), queried.size(), level.data());
    for (size_t i = 0; i < queried.size(); ++i)
      if (!(onsets[i] <= level[i])) alive[index[i]] = 0;
  }
}

BoxClass HostFunction::classify(const Box3& box) const {
  if (clusters_.empty()) return BoxClass::mixed;
  const Neighbourhood& grid = neighbourhood();
  const Box3 in_grid = grid.to_grid(box);
  // Many times the error of locating a point, of to_grid() and of angles.
  const double off =
      0x1p-46 * (max_magnitude(box.min) + max_magnitude(box.max) + max_magnitude(grid.origin));
  int first[3], count[3];
  for (int axis = 0; axis < 3; ++axis) {
    const double cell = grid.cell_size[axis];
    const double slack = off / cell + 1e-9;
    const double low = in_grid.min[axis] / cell - slack, high = in_grid.max[axis] / cell + slack;
    if (!(high - low < 1)) {
      first[axis] = 0;
      count[axis] = side_;
      continue;
    }
    const double start = std::floor(low);
    first[axis] = static_cast<int>((low - start) * side_);
    const int last = static_cast<int>((high - start) * side_);
    count[axis] = std::min(last - first[axis] + 1, side_);
  }
  if (count[0] * count[1] * count[2] > max_in_box) return BoxClass::mixed;
  const Interval levels = level_.range(box);
  bool may_be_inside = false, may_be_outside = false;
  for (int z = 0; z < count[2]; ++z)
    for (int y = 0; y < count[1]; ++y)
      for (int x = 0; x < count[0]; ++x) {
        const Interval& onset =
            cluster((first[0] + x) % side_, (first[1] + y) % side_, (first[2] + z) % side_);
        may_be_inside |= onset.low <= levels.high;
        may_be_outside |= onset.high > levels.low;
        if (may_be_inside && may_be_outside) return BoxClass::mixed;
      }
  return may_be_inside ? BoxClass::inside : BoxClass::outside;
}

double HostFunction::min_ray_step() const {
  return std::isfinite(lipschitz_ + level_.lipschitz()) ? ray_tolerance()
                                                        : Structure::min_ray_step();
}

double HostFunction::outside_along(const Ray& ray, double t, double gap) const {
  if (std::isfinite(lipschitz_ + level_.lipschitz())) return steady_along(ray, t, gap);
  if (clusters_.empty()) return 0;
  // As far as the clusters show.
  const Vec3 p = ray.at(t);
  for (const double steps : {8, 2}) {
    const double step = steps * Structure::min_ray_step();
    const Vec3 q = ray.at(t + step);
    if (classify({min(p, q), max(p, q)}) == BoxClass::outside) return step;
  }
  return 0;
}

double HostFunction::steady_along(const Ray& ray, double t, double gap) const {
  const Neighbourhood& grid = neighbourhood();
  const double slope = lipschitz_ * two_pi / min_component(grid.cell_size) + level_.lipschitz();
  if (!std::isfinite(slope)) return 0;
  const Vec3 along = grid.rotation.apply_inverse(ray.direction);
  const Vec3 fraction = grid.locate(ray.at(t)).fraction;
  // Reduced by the host's possible rounding.
  double step = slope > 0 ? (gap - 0x1p-46 * (1 + gap)) / slope : max_component(grid.cell_size);
  for (int axis = 0; axis < 3; ++axis) {
    if (along[axis] == 0) continue;
    const double ahead = along[axis] > 0 ? 1 - fraction[axis] : fraction[axis];
    step = std::min(step, ahead * grid.cell_size[axis] / std::abs(along[axis]));
  }
  return std::max(0.0, step * (1 - 0x1p-40));
}

double HostFunction::leave(const Ray& ray, double from, double to, const Job* job) const {
  const double tolerance = ray_tolerance(ray, to);
  const auto onset = [&](Vec3 p) {
    const Vec3 angles = angles_of(neighbourhood().locate(p).fraction);
    double value;
    evaluate(&angles, 1, &value);
    return value;
  };
  double at = from;
  LeastStep least(std::max(min_ray_step(), tolerance), tolerance, from);
  while (at < to) {
    check_cancelled(job);
    const Vec3 p = ray.at(at);
    const double gap = level_.at(p) - onset(p);
    if (!(gap >= 0)) return at;
    const double next = std::min(to, at + std::max(steady_along(ray, at, gap), least.of_step(at)));
    if (!(next > at)) break;  // steps vanish in rounding
    if (!inside(ray.at(next)))
      return bisect(at, next, tolerance, [&](double t) { return !inside(ray.at(t)); });
    at = next;
  }
  return at;
}

void HostFunction::enter(RaySearch* searches, size_t count, const Job* job) const {
  std::vector<Vec3> points, angles;
  std::vector<double> onsets, levels;
  const auto ask = [&](const std::vector<MarchPoint>& queried, uint8_t* inside, double* steps) {
    points.clear();
    angles.clear();
    for (const MarchPoint& p : queried) {
      points.push_back(searches[p.search].ray.at(p.t));
      angles.push_back(angles_of(neighbourhood().locate(points.back()).fraction));
    }
    onsets.resize(queried.size());
    levels.resize(queried.size());
    evaluate(angles.data(), angles.size(), onsets.data());
    level_.values(points.data(), points.size(), levels.data());
    for (size_t i = 0; i < queried.size(); ++i) {
      inside[i] = onsets[i] <= levels[i];
      if (!inside[i] && !queried[i].is_settling)
        steps[i] =
            outside_along(searches[queried[i].search].ray, queried[i].t, onsets[i] - levels[i]);
    }
  };
  const auto tolerance_of = [this](const RaySearch& s) { return ray_tolerance(s.ray, s.to); };
  march_together(searches, count, min_ray_step(), tolerance_of, job, ask);
  find_normals(searches, count);
}

void HostFunction::find_normals(RaySearch* searches, size_t count) const {
  constexpr double step = 0x1p-16;  // of angles
  const Vec3 size = neighbourhood().cell_size;
  std::vector<Vec3> angles;
  std::vector<size_t> found;
  for (size_t i = 0; i < count; ++i) {
    if (!searches[i].found) continue;
    found.push_back(i);
    const Vec3 at = angles_of(neighbourhood().locate(searches[i].ray.at(searches[i].t)).fraction);
    for (int axis = 0; axis < 3; ++axis)
      for (const double away : {-step, step}) {
        Vec3 a = at;
        a[axis] = std::clamp(a[axis] + away, 0.0, two_pi);  // hosts define nothing beyond
        angles.push_back(a);
      }
  }
  std::vector<double> onsets(angles.size());
  evaluate(angles.data(), angles.size(), onsets.data());
  for (size_t n = 0; n < found.size(); ++n) {
    RaySearch& search = searches[found[n]];
    Vec3 gradient;
    for (int axis = 0; axis < 3; ++axis) {
      const size_t low = 6 * n + 2 * static_cast<size_t>(axis), high = low + 1;
      gradient[axis] = (onsets[high] - onsets[low]) * two_pi /
                       ((angles[high][axis] - angles[low][axis]) * size[axis]);
    }
    const Vec3 away = neighbourhood().rotation.apply(gradient) -
                      level_.gradient(search.ray.at(search.t), 0x1p-16 * min_component(size));
    const double steepness = length(away);
    search.normal = steepness > 0 && std::isfinite(steepness) ? away * (1 / steepness)
                                                              : search.ray.direction * -1.0;
  }
}

Vec3 HostFunction::normal(const Ray& ray, double t) const {
  RaySearch search{ray, t, t, true, t};
  find_normals(&search, 1);
  return search.normal;
}

void HostFunction::describe(HashInput& input) const {
  input.kind("structure: host function");
  user_.describe(input, "function");
  neighbourhood().describe(input);
  input.integer(is_sheet_ ? 1 : 0);
  level_.describe(input);
  input.number(lipschitz_);
}

}  // namespace msq
