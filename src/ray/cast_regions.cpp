// SPDX-License-Identifier: Apache-2.0
#include "ray/cast_regions.h"

#include <algorithm>

#include "base/infinity.h"

namespace msq {

namespace {

class RegionCaster {
 public:
  RegionCaster(const Model& model, const Scales& resolved, std::vector<RaySearch>& searches,
               std::vector<RayHit>& hits, HitDetail detail, const Job* job)
      : model_(model),
        regions_(model.regions()),
        resolved_(resolved),
        searches_(searches),
        hits_(hits),
        detail_(detail),
        job_(job),
        tolerance_(model.shape().ray_tolerance()),
        past_(way_past_end(model, resolved)),
        box_(model.bounds().grown(tolerance_)),
        near_(box_.grown(tolerance_)),
        parts_(regions_.size()) {}

  void run() {
    ways_.resize(searches_.size());
    for (size_t i = 0; i < searches_.size(); ++i) start(i);
    std::vector<size_t> going;
    while (!going_.empty()) {
      check_cancelled(job_);
      going.clear();
      going.swap(going_);
      for (const size_t i : going) find_part(i);
      for (size_t r = 0; r < regions_.size(); ++r)
        if (!parts_[r].rays.empty()) cast_parts(r);
    }
  }

 private:
  /// The next place at which a ray comes into a region's shape, if it is not in it.
  struct Entry {
    uint32_t region;
    double t;  // no less than where the ray is, or not known
  };
  struct Way {
    Ray ray;               // from where it comes near the model
    double offset, begin;  // of that; of the search, both along the given ray
    double at, end;        // along `ray`
    double known_void;     // no point of the solid from there up to `at`
    Vec3 last;             // the point at the search's end
    double to;             // of the search, along `ray`
    LeastStep least;
    std::vector<Entry> entries;  // of the regions whose boxes it meets
  };
  /// Parts of rays in a region.
  struct Parts {
    std::vector<size_t> rays;
    std::vector<RaySearch> searches;
    std::vector<RayHit> hits;
  };

  void start(size_t i) {
    hits_[i] = {};
    RaySearch& s = searches_[i];
    if (!(s.from <= s.to)) return;
    double low = s.from, high = s.to + past_;
    if (!clip_to_box(s.ray, box_, low, high)) return;
    Way& way = ways_[i];
    way.begin = s.from;
    way.last = s.ray.at(s.to);
    if (!move_to_box(box_, near_, low, high, past_, s, way.offset, way.end)) return;
    way.ray = s.ray;
    way.to = s.to - way.offset;
    way.at = way.known_void = 0;
    way.least = LeastStep(tolerance_, tolerance_, 0);
    way.entries.clear();
    for (uint32_t r = 0; r < regions_.size(); ++r) {
      double from = 0, to = way.end;
      if (clip_to_box(way.ray, regions_[r]->bounds(), from, to))
        way.entries.push_back({r, -infinity});
    }
    going_.push_back(i);
  }

  /// Up to where the ray stays in its region, which it is to be cast through, or in none, where it
  /// goes on at the next one.
  void find_part(size_t i) {
    Way& way = ways_[i];
    if (way.at > way.end) return;
    const Vec3 place = way.ray.at(way.at);
    double next = infinity;
    for (Entry& entry : way.entries) {
      const Shape& shape = regions_[entry.region]->shape();
      if (shape.inside(place)) {
        double out = shape.leave(way.ray, way.at, way.end, job_);
        out = std::min(std::max(out, way.at), next);
        Parts& parts = parts_[entry.region];
        parts.rays.push_back(i);
        RaySearch& part = parts.searches.emplace_back();
        part.ray = way.ray;
        part.from = way.at;
        part.to = std::min(out, way.end);
        return;
      }
      if (entry.t < way.at || entry.t == -infinity)
        if (!shape.enter(way.ray, way.at, way.end, entry.t, job_)) entry.t = infinity;
      next = std::min(next, entry.t);
    }
    go_on(i, next);
  }

  /// There is nothing up to `to`; on from there.
  void go_on(size_t i, double to) {
    Way& way = ways_[i];
    const double least = way.at + way.least.of_step(way.at);
    if (!(to <= way.end) || !(least > way.at)) return;
    way.known_void = std::max(way.known_void, way.at);
    way.at = std::max(to, least);
    if (way.at <= way.end) going_.push_back(i);
  }

  void cast_parts(size_t r) {
    Parts& parts = parts_[r];
    std::vector<size_t> rays;
    rays.swap(parts.rays);
    std::vector<RaySearch> given = parts.searches;
    cast_batch(*regions_[r], resolved_.regions[r], parts.searches, parts.hits, detail_, job_);
    parts.searches.clear();
    for (size_t n = 0; n < rays.size(); ++n) {
      Way& way = ways_[rays[n]];
      RayHit& hit = parts.hits[n];
      if (hit.scale < 0)
        go_on(rays[n], given[n].to + tolerance_);
      else if (const double t = hit.t; settle(way, r, hit))
        hits_[rays[n]] = hit;
      else
        go_on(rays[n], t + tolerance_);
    }
  }

  bool is_solid(const Way& way, double t) const { return model_.inside(way.ray.at(t), resolved_); }

  /// What a region's part of a ray met, as a hit of the whole; false where a region that goes
  /// before it begins there, or the ray ends.
  bool settle(const Way& way, size_t r, RayHit& hit) {
    double t = hit.t;
    hit.region = static_cast<uint32_t>(r);
    if (!is_solid(way, t)) {  // rounding, or another region
      t += tolerance_;
      if (!is_solid(way, t)) return false;
    }
    const bool is_first = way.at == 0 && way.offset <= way.begin && hit.starts_inside;
    if (hit.starts_inside && !is_first) {
      // It comes from another region, or from none: where exactly, membership tells.
      settle_entry(
          way.ray, way.known_void, infinity, tolerance_,
          [this](Vec3 p) { return model_.inside(p, resolved_); }, t);
      hit.starts_inside = false;
      hit.scale = 0;
      if (detail_ == HitDetail::all) find_normal(way.ray, t, r, hit);
    }
    if (t > way.to) {
      // Found past the end, at which the ray may be inside already.
      if (!model_.inside(way.last, resolved_)) return false;
      t = way.to;
    }
    hit.t = is_first ? way.begin : way.offset + t;
    hit.point = way.ray.at(t);
    return true;
  }

  /// Where the ray comes into the region r, or leaves one that goes before it, or meets a scale of
  /// it right behind where its last part ended.
  void find_normal(const Ray& ray, double t, size_t r, RayHit& hit) const {
    const double room = 2 * tolerance_;
    const Vec3 before = ray.at(t - room), behind = ray.at(t + room);
    const Shape& shape = regions_[r]->shape();
    hit.normal = ray.direction * -1.0;
    if (!shape.inside(before)) {
      hit.normal = shape.normal(ray, t);
      return;
    }
    for (size_t other = 0; other < r; ++other) {
      const Shape& left = regions_[other]->shape();
      if (!left.inside(before) || left.inside(behind)) continue;
      hit.normal = left.normal({ray.at(t), ray.direction * -1.0}, 0) * -1.0;
      return;
    }
    const Scales& scales = resolved_.regions[r];
    for (size_t s = 0; s < scales.size(); ++s)
      if (!scales[s]->inside(before)) {
        hit.scale = static_cast<int32_t>(s) + 1;
        hit.normal = scales[s]->normal(ray, t);
        return;
      }
  }

  const Model& model_;
  const std::vector<Ref<const Model>>& regions_;
  const Scales& resolved_;
  std::vector<RaySearch>& searches_;
  std::vector<RayHit>& hits_;
  const HitDetail detail_;
  const Job* const job_;
  const double tolerance_, past_;
  const Box3 box_, near_;
  std::vector<Way> ways_;
  std::vector<size_t> going_;
  std::vector<Parts> parts_;
};

}  // namespace

void cast_through_regions(const Model& model, const Scales& resolved,
                          std::vector<RaySearch>& searches, std::vector<RayHit>& hits,
                          HitDetail detail, const Job* job) {
  hits.resize(searches.size());
  RegionCaster(model, resolved, searches, hits, detail, job).run();
}

}  // namespace msq
