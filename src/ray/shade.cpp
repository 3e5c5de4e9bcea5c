// SPDX-License-Identifier: Apache-2.0
#include "ray/shade.h"

#include <numbers>

#include "base/basis.h"
#include "base/random.h"

namespace msq {

namespace {

/// Distance of the start of rays above a surface, in tolerances.
constexpr double lift = 4096;
constexpr size_t rays_at_once = 1024;

double wrapped(double x) {
  return x - std::floor(x);
}

/// Directions of a pixel around a normal, with a density proportional to their cosine with it. They
/// are the points of one lattice of rank 1 (its second number by the golden ratio) for all samples
/// of the pixel, shifted as a whole by the pixel's random numbers (Cranley and Patterson 1976) and
/// projected from the disc upwards (Malley's method). Each sample takes every samples-th point, so
/// that its own directions are spread as evenly, and those of the pixel are never the same twice.
class Directions {
 public:
  Directions(const Seen& seen, uint32_t samples, uint32_t count)
      : first_(random_fraction(splitmix_output(splitmix_finalise(seen.pixel), 1))),
        second_(random_fraction(splitmix_output(splitmix_finalise(seen.pixel), 2))),
        sample_(seen.sample),
        samples_(samples),
        part_(1.0 / (double{1} * samples * count)) {}

  /// normal: of unit length; a and b: a basis with it.
  Vec3 direction(uint32_t index, Vec3 normal, Vec3 a, Vec3 b) const {
    constexpr double golden = 0.6180339887498949;
    const double point = double{1} * index * samples_ + sample_;
    const double u = wrapped(first_ + point * part_), v = wrapped(second_ + point * golden);
    const double angle = 2 * std::numbers::pi * v, across = std::sqrt(u);
    return a * (across * std::cos(angle)) + b * (across * std::sin(angle)) +
           normal * std::sqrt(1 - u);
  }

 private:
  double first_, second_;
  uint32_t sample_, samples_;
  double part_;
};

}  // namespace

Shader::Shader(const Model& model, const Scales& resolved, const View& view, const Shading& shading)
    : model_(model), resolved_(resolved), view_(view), shading_(shading) {
  const Vec3 light = view.right() * shading.light.x + view.up() * shading.light.y -
                     view.forward() * shading.light.z;
  light_ = light * (1 / length(light));
  reach_ = shading.occlusion_distance > 0 ? shading.occlusion_distance
                                          : 0.1 * length(model.bounds().extent());
  offsets_.push_back(lift * model.shape().ray_tolerance());
  const Box3& bounds = model.bounds();
  const Ray across{bounds.min, bounds.extent()};
  // By level; of regions the most of any.
  const auto add = [&](const Scales& scales) {
    for (size_t i = 0; i < scales.size(); ++i) {
      if (offsets_.size() < i + 2) offsets_.push_back(0);
      offsets_[i + 1] =
          std::max(offsets_[i + 1], lift * scales[i]->structure->ray_tolerance(across, 1));
    }
  };
  if (resolved.regions.empty()) add(resolved);
  for (const Scales& scales : resolved.regions) add(scales);
}

double Shader::offset_of(const RayHit& hit) const {
  const auto scale = static_cast<size_t>(hit.scale);
  if (model_.shape().is_bounded() || scale == 0) return offsets_[scale];
  return lift * resolved_[scale - 1]->structure->ray_tolerance({hit.point, {}}, 0);
}

Vec3 Shader::base_colour(const RayHit& hit, uint32_t material) const {
  const std::vector<Vec3>& colours = shading_.colours;
  switch (shading_.colour_by) {
    case ColourBy::normal:
      return (hit.normal + Vec3{1, 1, 1}) * 0.5;
    case ColourBy::scale:
      return colours[static_cast<size_t>(hit.scale) % colours.size()];
    case ColourBy::material:
      return colours[material % colours.size()];
    default:
      return colours[0];
  }
}

// Parts cut off by the camera's planes do not block light either.
RaySearch Shader::search_from(const Seen& seen, const RayHit& hit, Vec3 direction,
                              double reach) const {
  const Camera& camera = view_.camera();
  const double offset = offset_of(hit);
  RaySearch search;
  search.ray = {hit.point + hit.normal * offset, direction};
  search.to = reach;
  const double along = dot(direction, view_.forward());
  const double depth = seen.depth + offset * dot(hit.normal, view_.forward());
  if (along < 0) {
    search.to = hit.starts_inside ? -1 : std::min(reach, (camera.clip_near - depth) / along);
  } else if (along > 0) {
    search.from = std::max(0.0, (camera.clip_near - depth) / along);
    search.to = std::min(reach, (camera.clip_far - depth) / along);
  }
  return search;
}

void Shader::find_lit(const std::vector<Seen>& seen, const std::vector<RayHit>& hits,
                      std::vector<uint8_t>& lit, const Job* job) const {
  std::vector<size_t> queried;
  std::vector<RaySearch> searches;
  for (size_t i = 0; i < hits.size(); ++i) {
    if (hits[i].scale < 0 || !(dot(hits[i].normal, light_) > 0)) continue;
    queried.push_back(i);
    searches.push_back(
        search_from(seen[i], hits[i], light_, std::numeric_limits<double>::infinity()));
  }
  std::vector<RayHit> found;
  cast_batch(model_, resolved_, searches, found, HitDetail::place, job);
  for (size_t n = 0; n < queried.size(); ++n) lit[queried[n]] = found[n].scale < 0;
}

void Shader::find_open(const std::vector<Seen>& seen, uint32_t samples,
                       const std::vector<RayHit>& hits, std::vector<float>& open,
                       const Job* job) const {
  const uint32_t count = shading_.occlusion_rays;
  const float part = 1.0f / static_cast<float>(count);
  std::vector<size_t> queried;
  std::vector<RaySearch> searches;
  std::vector<RayHit> found;
  const auto cast = [&] {
    cast_batch(model_, resolved_, searches, found, HitDetail::place, job);
    for (size_t n = 0; n < queried.size(); ++n)
      if (found[n].scale >= 0) open[queried[n]] -= part;
    queried.clear();
    searches.clear();
  };
  for (size_t i = 0; i < hits.size(); ++i) {
    if (hits[i].scale < 0) continue;
    const Vec3 normal = hits[i].normal;
    Vec3 a, b;
    complete_basis(normal, a, b);
    const Directions directions(seen[i], samples, count);
    for (uint32_t k = 0; k < count; ++k) {
      queried.push_back(i);
      searches.push_back(
          search_from(seen[i], hits[i], directions.direction(k, normal, a, b), reach_));
    }
    if (searches.size() >= rays_at_once) cast();
  }
  cast();
}

void Shader::shade(const std::vector<Seen>& seen, uint32_t samples, const std::vector<RayHit>& hits,
                   std::vector<Colour>& colours, const Job* job) const {
  std::vector<uint8_t> lit(hits.size(), 1);
  std::vector<float> open(hits.size(), 1);
  if (shading_.has_shadows) find_lit(seen, hits, lit, job);
  if (shading_.occlusion_rays > 0) find_open(seen, samples, hits, open, job);
  colours.resize(hits.size());
  for (size_t i = 0; i < hits.size(); ++i) {
    if (hits[i].scale < 0) {
      colours[i] = shading_.background;
      continue;
    }
    const double facing = lit[i] ? std::max(0.0, dot(hits[i].normal, light_)) : 0;
    const double light =
        shading_.ambient * std::max(0.0f, open[i]) + (1 - shading_.ambient) * facing;
    colours[i] = colour_of(base_colour(hits[i], seen[i].material) * light);
  }
}

}  // namespace msq
