// SPDX-License-Identifier: Apache-2.0
#include "shape/placed.h"

#include <limits>
#include <vector>

#include "base/hash_input.h"

namespace msq {

PlacedShape::PlacedShape(Ref<const Shape> original, const Placement& placement)
    : original_(std::move(original)), placement_(placement) {
  facts_ = original_->facts();
  facts_.bounds = placement_.to_placed(original_->bounds());
  const double scale = placement_.scale();
  facts_.volume *= std::abs(placement_.determinant());
  facts_.area = placement_.is_similarity() ? facts_.area * scale * scale
                                           : std::numeric_limits<double>::quiet_NaN();
  // Rays know the original's tolerance, in any direction, and where its points are placed.
  min_tolerance_ = std::max(original_->ray_tolerance() * placement_.max_growth(),
                            4 * placement_.rounding(bounds()));
}

void PlacedShape::find_inside(const Vec3* points, size_t count, uint8_t* inside) const {
  std::vector<Vec3> mapped;
  std::vector<size_t> index;
  for (size_t i = 0; i < count; ++i) {
    inside[i] = 0;
    if (!bounds().contains(points[i])) continue;
    mapped.push_back(placement_.to_original(points[i]));
    index.push_back(i);
  }
  if (mapped.empty()) return;
  std::vector<uint8_t> answers(mapped.size());
  original_->find_inside(mapped.data(), mapped.size(), answers.data());
  for (size_t n = 0; n < index.size(); ++n) inside[index[n]] = answers[n];
}

// A ball about p is mapped into one about to_original(p) whose radius is at most its own over the
// least growth, except for the rounding of the points of both.
double PlacedShape::distance_bound(Vec3 p) const {
  const double of_original = std::abs(original_->distance(placement_.to_original(p)));
  const double reach = std::min(of_original * placement_.min_growth() * (1 - 0x1p-50),
                                std::numeric_limits<double>::max());
  const double bound = std::max(0.0, reach - placement_.rounding(p, reach));
  const Vec3 gap = max(max(bounds().min - p, p - bounds().max), Vec3{});
  return std::max(bound, std::hypot(gap.x, gap.y, gap.z) * (1 - 0x1p-50));
}

double PlacedShape::depth(Vec3 p) const {
  return original_->depth(placement_.to_original(p)) * placement_.scale();
}

// The bounds of the original, turned, have corners up to twice as far from it as its own.
double PlacedShape::depth_error() const {
  return 4 * placement_.scale() * original_->depth_error() + 4 * placement_.rounding(bounds()) +
         placement_.deviation() * length(bounds().extent());
}

const BoundarySearch* PlacedShape::boundary_search() const {
  return knows_depth() && original_->boundary_search() ? this : nullptr;
}

BoundarySearch::Foot PlacedShape::nearest(Vec3 p, uint32_t start) const {
  const Foot foot = original_->boundary_search()->nearest(placement_.to_original(p), start);
  return {foot.distance * placement_.scale(), placement_.to_placed(foot.point), foot.part};
}

BoundarySearch::Range PlacedShape::compare(Vec3 p, double low, double high, uint32_t& part) const {
  const double back = 1 / placement_.scale();
  return original_->boundary_search()->compare(placement_.to_original(p), low * back, high * back,
                                               part);
}

// Entries of the original, in its own coordinates, are settled by membership here. One that is none
// here is a graze: what the original holds behind it is tried in its middle, and left.
bool PlacedShape::follow(const Ray& ray, double from, double to, double first, double& t,
                         const Job* job) const {
  double factor;
  const Ray mapped = placement_.to_original(ray, factor);
  const double tolerance = ray_tolerance();
  const auto is_in = [this](Vec3 p) { return inside(p); };
  LeastStep least(tolerance, tolerance, from);
  for (double at = from;;) {
    t = std::clamp(first / factor, at, to);
    if (settle_entry(ray, at, to, tolerance, is_in, t)) return true;
    const double out = std::min(to, original_->leave(mapped, first, to * factor, job) / factor);
    const double middle = 0.5 * (t + out);
    if (middle > t && is_in(ray.at(middle))) {
      t = bisect(t, middle, tolerance, [&](double s) { return is_in(ray.at(s)); });
      return true;
    }
    at = std::max(out, t) + least.of_step(t);
    if (!(at <= to) || !original_->enter(mapped, at * factor, to * factor, first, job))
      return false;
  }
}

bool PlacedShape::enter(const Ray& ray, double from, double to, double& t, const Job* job) const {
  if (!clip_to_box(ray, bounds(), from, to)) return false;
  double factor, first;
  const Ray mapped = placement_.to_original(ray, factor);
  return original_->enter(mapped, from * factor, to * factor, first, job) &&
         follow(ray, from, to, first, t, job);
}

double PlacedShape::leave(const Ray& ray, double from, double to, const Job* job) const {
  if (!clip_to_box(ray, bounds(), from, to)) return from;
  double factor;
  const Ray mapped = placement_.to_original(ray, factor);
  return std::clamp(original_->leave(mapped, from * factor, to * factor, job) / factor, from, to);
}

void PlacedShape::enter_all(RaySearch* searches, size_t count, const Job* job) const {
  if (!gains_by_rays()) return Shape::enter_all(searches, count, job);
  std::vector<RaySearch> mapped(count);
  for (size_t i = 0; i < count; ++i) {
    RaySearch& s = searches[i];
    mapped[i].from = 1;  // and `to` 0: none
    if (!clip_to_box(s.ray, bounds(), s.from, s.to)) continue;
    double factor;
    mapped[i].ray = placement_.to_original(s.ray, factor);
    mapped[i].from = s.from * factor;
    mapped[i].to = s.to * factor;
  }
  original_->enter_all(mapped.data(), count, job);
  for (size_t i = 0; i < count; ++i) {
    RaySearch& s = searches[i];
    s.found = mapped[i].found && follow(s.ray, s.from, s.to, mapped[i].t, s.t, job);
  }
}

Vec3 PlacedShape::normal(const Ray& ray, double t) const {
  double factor;
  const Ray mapped = placement_.to_original(ray, factor);
  const Vec3 normal = placement_.normal_to_placed(original_->normal(mapped, t * factor));
  return is_finite(normal) ? normal : ray.direction * -1.0;
}

// The roundings of a sample's place and of a vertex'. What the sums of a vertex' place lose: as in
// Placement::to_placed().
MeshMap PlacedShape::mesh_map() const {
  MeshMap map = original_->mesh_map();
  if (!map.mesh) return map;
  map.place = [this, place = std::move(map.place)](Vec3 v) {
    return placement_.to_placed(place ? place(v) : v);
  };
  map.is_mirrored ^= placement_.determinant() < 0;
  map.bounds = bounds();
  const double magnitude = max_magnitude(bounds().min) + max_magnitude(bounds().max);
  map.error =
      placement_.max_growth() * map.error + 3 * placement_.rounding(bounds()) + 0x1p-49 * magnitude;
  return map;
}

void PlacedShape::describe(HashInput& input) const {
  input.kind("shape: placed");
  input.object(*original_);
  placement_.describe(input);
}

}  // namespace msq
