// SPDX-License-Identifier: Apache-2.0
#include "ray/cast.h"

#include <algorithm>
#include <numeric>

#include "base/borrowed.h"
#include "base/run_parts.h"

namespace msq {

namespace {

struct Begin {
  double from;    // of the search
  double offset;  // of the origin along the ray
};

/// Of a batch; kept for the next one of the thread.
struct CastMemory {
  std::vector<RaySearch> batch;
  std::vector<double> ends;  // ray by ray
  std::vector<Begin> begins;
  std::vector<std::vector<uint32_t>> waiting;  // by level
  std::vector<uint32_t> rays, without_normal;

  void make_room(size_t count, size_t levels) {
    if (batch.size() < count) {
      batch.resize(count);
      begins.resize(count);
    }
    if (ends.size() < count * levels) ends.resize(count * levels);
    if (waiting.size() < levels) waiting.resize(levels);
    for (std::vector<uint32_t>& level : waiting) level.clear();
    without_normal.clear();
  }
};

/// A batch of rays on their way. Within a scale, `end` is where a ray may leave it.
class Caster {
 public:
  /// hits[i] will be what searches[i], which are used up, meet.
  Caster(const Model& model, const Scales& resolved, HitDetail detail, const Job* job,
         CastMemory& memory, RaySearch* searches, RayHit* hits)
      : model_(model),
        resolved_(resolved),
        detail_(detail),
        job_(job),
        levels_(1 + resolved.size()),
        bounds_(model.bounds().grown(model.shape().ray_tolerance())),
        searches_(searches),
        hits_(hits),
        ends_(memory.ends.data()),
        begins_(memory.begins.data()),
        batch_(memory.batch.data()),
        waiting_(memory.waiting),
        rays_(memory.rays),
        without_normal_(memory.without_normal) {}

  void run(size_t count) {
    for (uint32_t i = 0; i < count; ++i) start(i);
    while (true) {
      // The coarsest level first: rays then reach finer ones in large batches.
      size_t level = 0;
      while (level < levels_ && waiting_[level].empty()) ++level;
      if (level == levels_) break;
      check_cancelled(job_);
      rays_.clear();
      rays_.swap(waiting_[level]);
      if (level == 0)
        enter_shape();
      else
        enter_scale(level);
    }
    if (!without_normal_.empty()) find_normals();
  }

 private:
  /// Rays begin where they come near the shape, so that none of their numbers is larger than the
  /// shape's.
  void start(uint32_t i) {
    RaySearch& s = searches_[i];
    static constexpr RayHit nothing{};  // in memory: what is put together would be waited for
    hits_[i] = nothing;
    double low = s.from, high = s.to;
    if (!clip_to_box(s.ray, bounds_, low, high)) return;
    begins_[i] = {s.from, low};
    s.ray.origin = s.ray.at(low);
    s.from = 0;
    end(i, 0) = high - low;
    hits_[i].scale = 0;
    waiting_[0].push_back(i);
  }

  double& end(size_t ray, size_t level) { return ends_[ray * levels_ + level]; }

  void enter_shape() {
    const Shape& shape = model_.shape();
    if (shape.gains_by_rays()) return enter_shape_together();
    for (const uint32_t i : rays_) {
      const RaySearch& s = searches_[i];
      double t;
      if (shape.enter(s.ray, s.from, end(i, 0), t))
        entered(i, 0, t, {});
      else
        leave(i, 0);
    }
  }

  void enter_shape_together() {
    const Shape& shape = model_.shape();
    fill_batch(0);
    shape.enter_all(batch_, rays_.size());
    size_t kept = 0;
    for (size_t n = 0; n < rays_.size(); ++n) {
      const uint32_t i = rays_[n];
      if (!batch_[n].found)
        leave(i, 0);
      else if (come_in(i, 0, batch_[n].t, {}))
        rays_[kept++] = i;
    }
    if (levels_ == 1) return;
    rays_.resize(kept);
    fill_batch(0);
    shape.leave_all(batch_, kept);
    for (size_t n = 0; n < kept; ++n) go_deeper(rays_[n], 0, batch_[n].t);
  }

  void fill_batch(size_t level) {
    for (size_t n = 0; n < rays_.size(); ++n) {
      const RaySearch& s = searches_[rays_[n]];
      batch_[n].ray = s.ray;
      batch_[n].from = s.from;
      batch_[n].to = end(rays_[n], level);
      batch_[n].normal = {};
    }
  }

  void enter_scale(size_t level) {
    fill_batch(level);
    resolved_[level - 1]->enter(batch_, rays_.size());
    for (size_t n = 0; n < rays_.size(); ++n) {
      if (batch_[n].found)
        entered(rays_[n], level, batch_[n].t, batch_[n].normal);
      else
        leave(rays_[n], level);
    }
  }

  void entered(uint32_t i, size_t level, double t, Vec3 normal) {
    if (come_in(i, level, t, normal) && level + 1 < levels_)
      go_deeper(i, level, leave_of(level, searches_[i].ray, t, end(i, level)));
  }

  /// Whether it did; a hit where this is the finest level.
  bool come_in(uint32_t i, size_t level, double t, Vec3 normal) {
    // What is settled within a tolerance past an entry may lie past the end.
    if (t > end(i, level)) {
      leave(i, level);
      return false;
    }
    if (t > searches_[i].from) {
      searches_[i].from = t;
      hits_[i].scale = static_cast<int32_t>(level);
      hits_[i].normal = normal;
    }
    if (level + 1 == levels_) hit(i);
    return true;
  }

  /// On to the next level, up to where this one ends.
  void go_deeper(uint32_t i, size_t level, double to) {
    end(i, level + 1) = to;
    waiting_[level + 1].push_back(i);
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
    hit.t = std::min(begins_[i].offset + t, searches_[i].to);
    hit.point = ray.at(t);
    hit.starts_inside = hit.t == begins_[i].from;
    if (detail_ == HitDetail::place) return;
    if (hit.starts_inside)
      hit.normal = ray.direction * -1.0;
    else if (hit.scale == 0 && model_.shape().gains_by_rays())
      without_normal_.push_back(i);
    else if (dot(hit.normal, hit.normal) == 0)
      hit.normal = hit.scale == 0 ? model_.shape().normal(ray, t)
                                  : resolved_[static_cast<size_t>(hit.scale) - 1]->normal(ray, t);
    if (hit.starts_inside) hit.scale = static_cast<int32_t>(levels_) - 1;
  }

  /// Of the shape, at all hits on it.
  void find_normals() {
    for (size_t n = 0; n < without_normal_.size(); ++n) {
      const RaySearch& s = searches_[without_normal_[n]];
      batch_[n].ray = s.ray;
      batch_[n].t = s.from;
    }
    model_.shape().find_normals(batch_, without_normal_.size());
    for (size_t n = 0; n < without_normal_.size(); ++n)
      hits_[without_normal_[n]].normal = batch_[n].normal;
  }

  const Model& model_;
  const Scales& resolved_;
  const HitDetail detail_;
  const Job* const job_;
  const size_t levels_;
  const Box3 bounds_;
  RaySearch* const searches_;
  RayHit* const hits_;
  double* const ends_;
  Begin* const begins_;
  RaySearch* const batch_;
  std::vector<std::vector<uint32_t>>& waiting_;
  std::vector<uint32_t>& rays_;
  std::vector<uint32_t>& without_normal_;
};

}  // namespace

CellIndex cell_of(const Scales& resolved, const RayHit& hit) {
  if (hit.scale < 0 || resolved.empty()) return {};
  return resolved.back()->structure->neighbourhood().locate(hit.point).cell;
}

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
                std::vector<RayHit>& hits, HitDetail detail, const Job* job) {
  const size_t count = searches.size();
  hits.resize(count);
  // The model may be of the host's, whose callbacks may cast rays.
  const Borrowed<CastMemory> memory;
  (*memory).make_room(count, 1 + resolved.size());
  Caster(model, resolved, detail, job, *memory, searches.data(), hits.data()).run(count);
}

namespace {

/// Casts rays [first, first + count), in that order where `order` is null.
void cast_part(const Model& model, const Scales& resolved, uint64_t first, uint64_t count,
               const RayOrder* order, const FillRays& fill, const TakeHits& take, Job* job,
               Interval progress) {
  struct Batch {
    std::vector<uint64_t> numbers;
    std::vector<RaySearch> searches;
    std::vector<RayHit> hits;
  };
  const uint64_t batches = count / ray_batch + (count % ray_batch != 0);
  run_parts(model.executor(), batches, job, progress, [&](uint64_t b) {
    const uint64_t begin = b * ray_batch;
    const size_t size = static_cast<size_t>(std::min(count - begin, ray_batch));
    const Borrowed<Batch> borrowed;
    Batch& batch = *borrowed;
    batch.numbers.resize(size);
    if (order)
      order->take(begin, batch.numbers);
    else
      std::iota(batch.numbers.begin(), batch.numbers.end(), first + begin);
    batch.searches.assign(size, {});
    fill(batch.numbers, batch.searches.data());
    cast_batch(model, resolved, batch.searches, batch.hits, HitDetail::all, job);
    take(batch.numbers, batch.hits.data());
  });
}

/// How many rays may be sorted at once, so that it takes no more than a part of the memory.
uint64_t sorted_at_once(const MemoryBudget& budget) {
  constexpr uint64_t part = 16;
  if (budget.limit() == 0) return RayOrder::most;
  return std::clamp(budget.limit() / part / RayOrder::bytes_of_ray, ray_batch, RayOrder::most);
}

}  // namespace

void cast_rays(const Model& model, const Scales& resolved, uint64_t count, const FillRays& fill,
               const TakeHits& take, Job* job) {
  if (count == 0) return;
  prepare_rays(model, resolved);
  if (resolved.empty()) {
    cast_part(model, resolved, 0, count, nullptr, fill, take, job, {0, 1});
    return;
  }
  const std::shared_ptr<MemoryBudget>& budget = model.context().budget;
  const uint64_t at_once = std::min(count, sorted_at_once(*budget));
  Reservation room;
  try {
    room = Reservation(budget, at_once * RayOrder::bytes_of_ray, "an order of rays");
  } catch (const Error& error) {
    if (error.status != Status::limit) throw;
    cast_part(model, resolved, 0, count, nullptr, fill, take, job, {0, 1});
    return;
  }
  RayOrder order(model.bounds(), resolved.front()->structure->characteristic_length());
  const auto part_of = [&](uint64_t n) {
    return static_cast<double>(n) / static_cast<double>(count);
  };
  for (uint64_t first = 0; first < count; first += at_once) {
    const uint64_t size = std::min(count - first, at_once);
    check_cancelled(job);
    const bool is_sorted = order.sort(model.executor(), first, size, fill);
    cast_part(model, resolved, first, size, is_sorted ? &order : nullptr, fill, take, job,
              {part_of(first), part_of(first + size)});
  }
}

}  // namespace msq
