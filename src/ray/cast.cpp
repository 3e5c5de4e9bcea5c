// SPDX-License-Identifier: Apache-2.0
#include "ray/cast.h"

#include <algorithm>
#include <atomic>

namespace msq {

namespace {

/// A batch of rays on their way. Within a scale, `end` is where a ray may leave it.
class Caster {
 public:
  Caster(const Model& model, const Scales& resolved, const Job* job)
      : model_(model),
        resolved_(resolved),
        job_(job),
        levels_(1 + resolved.size()),
        waiting_(levels_) {}

  /// hits[i] becomes what searches[i], which are used up, meet.
  void run(std::vector<RaySearch>& searches, std::vector<RayHit>& hits) {
    searches_ = searches.data();
    hits_ = hits.data();
    ends_.resize(levels_ * searches.size());
    begins_.resize(searches.size());
    for (uint32_t i = 0; i < searches.size(); ++i) start(i);
    while (true) {
      // The coarsest level first: rays then reach finer ones in large batches.
      size_t level = 0;
      while (level < levels_ && waiting_[level].empty()) ++level;
      if (level == levels_) return;
      check_cancelled(job_);
      advance(level);
    }
  }

 private:
  struct Begin {
    double from;    // of the search
    double offset;  // of the origin along the ray
  };

  /// Rays begin where they come near the shape, so that none of their numbers is larger than the
  /// shape's.
  void start(uint32_t i) {
    RaySearch& s = searches_[i];
    hits_[i] = {};
    double low = s.from, high = s.to;
    if (!clip_to_box(s.ray, model_.bounds().grown(model_.shape().ray_tolerance()), low, high))
      return;
    begins_[i] = {s.from, low};
    s.ray.origin = s.ray.at(low);
    s.from = 0;
    end(i, 0) = high - low;
    hits_[i].scale = 0;
    waiting_[0].push_back(i);
  }

  double& end(size_t ray, size_t level) { return ends_[ray * levels_ + level]; }

  void advance(size_t level) {
    std::vector<uint32_t> rays;
    rays.swap(waiting_[level]);
    batch_.clear();
    for (const uint32_t i : rays) {
      RaySearch search = searches_[i];
      search.to = end(i, level);
      batch_.push_back(search);
    }
    enter(level);
    for (size_t n = 0; n < rays.size(); ++n) {
      const uint32_t i = rays[n];
      const RaySearch& found = batch_[n];
      if (!found.found) {
        leave(i, level);
        continue;
      }
      if (found.t > searches_[i].from) {
        searches_[i].from = found.t;
        hits_[i].scale = static_cast<int32_t>(level);
        hits_[i].normal = found.normal;
      }
      if (level + 1 == levels_) {
        hit(i);
        continue;
      }
      end(i, level + 1) = leave_of(level, searches_[i].ray, found.t, end(i, level));
      waiting_[level + 1].push_back(i);
    }
  }

  void enter(size_t level) {
    if (level > 0) {
      resolved_[level - 1]->enter(batch_.data(), batch_.size());
      return;
    }
    for (RaySearch& s : batch_) s.found = model_.shape().enter(s.ray, s.from, s.to, s.t);
  }

  double leave_of(size_t level, const Ray& ray, double from, double to) const {
    return level == 0 ? model_.shape().leave(ray, from, to)
                      : resolved_[level - 1]->leave(ray, from, to);
  }

  double tolerance_of(size_t level) const {
    return level == 0 ? model_.shape().ray_tolerance()
                      : resolved_[level - 1]->structure->ray_tolerance();
  }

  /// Nothing at this level up to where the level above ends: on behind that.
  void leave(uint32_t i, size_t level) {
    if (level == 0) {
      hits_[i].scale = -1;
      return;
    }
    // Past the end by the tolerance, so that the level above is left even where rounding has not.
    searches_[i].from = std::max(end(i, level), searches_[i].from) + tolerance_of(level - 1);
    hits_[i].scale = static_cast<int32_t>(level);  // that comes in next, if none above it does
    hits_[i].normal = {};
    if (searches_[i].from > end(i, level - 1)) {
      leave(i, level - 1);
      return;
    }
    waiting_[level - 1].push_back(i);
  }

  void hit(uint32_t i) {
    RayHit& hit = hits_[i];
    const Ray& ray = searches_[i].ray;
    const double t = searches_[i].from;
    hit.t = begins_[i].offset + t;
    hit.point = ray.at(t);
    hit.starts_inside = hit.t == begins_[i].from;
    if (hit.starts_inside)
      hit.normal = ray.direction * -1.0;
    else if (dot(hit.normal, hit.normal) == 0)
      hit.normal = hit.scale == 0 ? model_.shape().normal(ray, t)
                                  : resolved_[static_cast<size_t>(hit.scale) - 1]->normal(ray, t);
    if (hit.starts_inside) hit.scale = static_cast<int32_t>(levels_) - 1;
    if (levels_ > 1) hit.cell = resolved_.back()->structure->neighbourhood().locate(hit.point).cell;
  }

  const Model& model_;
  const Scales& resolved_;
  const Job* const job_;
  const size_t levels_;
  RaySearch* searches_ = nullptr;
  RayHit* hits_ = nullptr;
  std::vector<double> ends_;  // ray by ray
  std::vector<Begin> begins_;
  std::vector<std::vector<uint32_t>> waiting_;
  std::vector<RaySearch> batch_;
};

}  // namespace

uint32_t material_id(const Model& model, const Scales& resolved, const RayHit& hit,
                     uint32_t& part) {
  if (hit.scale < 0) return 0;
  const Material* material = model.material(hit.point, resolved, part);
  return material ? material->id() : 0;
}

void prepare_rays(const Model& model, const Scales& resolved) {
  model.shape().prepare_distance();
  model.prepare_skins(resolved);
}

void cast_batch(const Model& model, const Scales& resolved, std::vector<RaySearch>& searches,
                std::vector<RayHit>& hits, const Job* job) {
  hits.resize(searches.size());
  Caster(model, resolved, job).run(searches, hits);
}

void cast_rays(const Model& model, const Scales& resolved, uint64_t count, const FillRays& fill,
               const TakeHits& take, Job* job) {
  if (count == 0) return;
  prepare_rays(model, resolved);
  const uint64_t batches = count / ray_batch + (count % ray_batch != 0);
  std::atomic<uint64_t> done{0};
  model.executor().for_each(batches, [&](uint64_t b) {
    check_cancelled(job);
    const uint64_t first = b * ray_batch;
    const size_t size = static_cast<size_t>(std::min(count - first, ray_batch));
    std::vector<RaySearch> searches(size);
    std::vector<RayHit> hits(size);
    fill(first, size, searches.data());
    Caster(model, resolved, job).run(searches, hits);
    take(first, size, hits.data());
    const uint64_t now = done.fetch_add(1, std::memory_order_relaxed) + 1;
    if (job) job->raise_progress(static_cast<double>(now) / static_cast<double>(batches));
  });
}

}  // namespace msq
