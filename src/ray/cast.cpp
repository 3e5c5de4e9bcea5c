// SPDX-License-Identifier: Apache-2.0
#include "ray/cast.h"

#include <algorithm>
#include <memory>
#include <numeric>

#include "base/borrowed.h"
#include "base/run_parts.h"
#include "ray/cast_regions.h"
#include "ray/ray_starts.h"

namespace msq {

namespace {

/// Where a ray is, from an origin near the shape on.
struct Progress {
  Vec3 origin;
  double offset;  // of that, along the ray
  double from;    // nothing is before, or the last entry
};

/// Memory of a batch, kept for the thread's next one.
struct CastMemory {
  std::vector<RaySearch> batch;
  std::vector<double> ends;      // ray by ray
  std::vector<PartSteps> steps;  // likewise; new where has_steps is 0
  std::vector<uint8_t> has_steps;
  std::vector<Progress> progress;
  std::vector<std::vector<uint32_t>> waiting;  // by level
  std::vector<uint32_t> rays, without_normal;

  void make_room(size_t count, size_t levels) {
    if (batch.size() < count) {
      batch.resize(count);
      progress.resize(count);
    }
    if (ends.size() < count * levels) {
      ends.resize(count * levels);
      steps.resize(count * levels);
    }
    has_steps.assign(count * levels, 0);
    if (waiting.size() < levels) waiting.resize(levels);
    for (std::vector<uint32_t>& level : waiting) level.clear();
    without_normal.clear();
  }
};

/// A batch of rays in progress. Within a scale, `end` is where a ray may leave it.
class Caster {
 public:
  /// Will set hits[i] to the hit of searches[i].
  Caster(const Model& model, const Scales& resolved, HitDetail detail, const Job* job,
         CastMemory& memory, const RaySearch* searches, RayHit* hits)
      : model_(model),
        resolved_(resolved),
        detail_(detail),
        job_(job),
        levels_(1 + resolved.size()),
        is_bounded_(model.shape().is_bounded()),
        boxes_(boxes_of(model, resolved, detail)),
        searches_(searches),
        hits_(hits),
        ends_(memory.ends.data()),
        steps_(memory.steps.data()),
        has_steps_(memory.has_steps.data()),
        progress_(memory.progress.data()),
        batch_(memory.batch.data()),
        waiting_(memory.waiting),
        rays_(memory.rays),
        without_normal_(memory.without_normal) {}

  void run(size_t count) {
    for (size_t i = 0; i < count; i += RayStarts::most)
      start(static_cast<uint32_t>(i), std::min(RayStarts::most, count - i));
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
  static StartBoxes boxes_of(const Model& model, const Scales& resolved, HitDetail detail) {
    const Shape& shape = model.shape();
    StartBoxes boxes{};
    boxes.tolerance = shape.ray_tolerance();
    boxes.bounds = model.bounds().grown(boxes.tolerance);
    boxes.near = boxes.bounds.grown(boxes.tolerance);
    if (detail == HitDetail::all && shape.is_bounded())
      boxes.beyond = way_past_end(model, resolved);
    // Without scales, hits are on the surface of the box itself.
    boxes.has_box = shape.is_box() && !resolved.empty();
    boxes.box = shape.bounds();
    return boxes;
  }

  bool is_beyond_common() const { return detail_ != HitDetail::all || is_bounded_; }
  double beyond_end(const RaySearch& s) const {
    return is_beyond_common() ? boxes_.beyond : way_past_end(model_, resolved_, s.ray, s.to);
  }

  /// Rays begin where they come near the shape, so that none of their numbers is larger than the
  /// shape's.
  void start(uint32_t first, size_t count) {
    if (is_beyond_common())
      start_rays(searches_ + first, count, boxes_, starts_);
    else
      starts_.miss = starts_.begin = starts_.crosses = 0;
    static constexpr RayHit nothing{};  // static: a new one would stall on its stores
    for (uint32_t lane = 0; lane < count; ++lane) {
      const uint32_t i = first + lane;
      RayHit& hit = hits_[i];
      hit = nothing;
      if (starts_.miss >> lane & 1) continue;
      Progress& progress = progress_[i];
      if (starts_.begin >> lane & 1) {
        for (int axis = 0; axis < 3; ++axis) progress.origin[axis] = starts_.origin[axis][lane];
        progress.offset = starts_.offset[lane];
        end(i, 0) = starts_.end[lane];
      } else if (!start_alone(i)) {
        continue;
      }
      hit.scale = 0;
      progress.from = 0;
      if (starts_.crosses >> lane & 1) {
        progress.from = starts_.enter[lane];
        go_deeper(i, 0, starts_.leave[lane]);
      } else if (model_.shape().gains_by_rays()) {
        waiting_[0].push_back(i);
      } else {
        enter_shape(i);
      }
    }
  }

  /// Starts a ray by itself, also one whose origin is so far away that its numbers do not tell the
  /// place. Returns whether it comes near the shape.
  bool start_alone(uint32_t i) {
    RaySearch moved = searches_[i];
    const double beyond = beyond_end(moved);
    double low = moved.from, high = moved.to + beyond;
    if (!(moved.from <= moved.to) || !clip_to_box(moved.ray, boxes_.bounds, low, high) ||
        !move_to_box(boxes_.bounds, boxes_.near, low, high, beyond, moved, progress_[i].offset,
                     end(i, 0)))
      return false;
    progress_[i].origin = moved.ray.origin;
    return true;
  }

  double& end(size_t ray, size_t level) { return ends_[ray * levels_ + level]; }

  Ray ray(uint32_t i) const { return {progress_[i].origin, searches_[i].ray.direction}; }

  void enter_shape() {
    if (model_.shape().gains_by_rays()) return enter_shape_together();
    for (const uint32_t i : rays_) enter_shape(i);
  }

  void enter_shape(uint32_t i) {
    const Shape& shape = model_.shape();
    const Ray along = ray(i);
    const double from = progress_[i].from, to = end(i, 0);
    double t, out = 0;
    const bool is_met = levels_ == 1 ? shape.enter(along, from, to, t, job_)
                                     : shape.cross(along, from, to, t, out, job_);
    if (!is_met)
      leave(i, 0);
    else if (come_in(i, 0, t, {}) && levels_ > 1)
      go_deeper(i, 0, out);
  }

  void enter_shape_together() {
    const Shape& shape = model_.shape();
    fill_batch(0);
    shape.enter_all(batch_, rays_.size(), job_);
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
    shape.leave_all(batch_, kept, job_);
    for (size_t n = 0; n < kept; ++n) go_deeper(rays_[n], 0, batch_[n].t);
  }

  void fill_batch(size_t level) {
    for (size_t n = 0; n < rays_.size(); ++n) {
      batch_[n].ray = ray(rays_[n]);
      batch_[n].from = progress_[rays_[n]].from;
      batch_[n].to = end(rays_[n], level);
      batch_[n].normal = {};
    }
  }

  void enter_scale(size_t level) {
    fill_batch(level);
    resolved_[level - 1]->enter(batch_, rays_.size(), job_);
    for (size_t n = 0; n < rays_.size(); ++n) {
      const uint32_t i = rays_[n];
      if (!batch_[n].found)
        leave(i, level);
      else if (const double t = batch_[n].t;
               come_in(i, level, t, batch_[n].normal) && level + 1 < levels_)
        go_deeper(i, level, resolved_[level - 1]->leave(ray(i), t, end(i, level), job_));
    }
  }

  /// Returns whether the ray enters; that is a hit if this is the finest level.
  bool come_in(uint32_t i, size_t level, double t, Vec3 normal) {
    // An entry is settled within a tolerance past it, which may lie past the end.
    if (t > end(i, level)) {
      leave(i, level);
      return false;
    }
    const double last = progress_[i].from;
    if (level > 0 && level + 1 == levels_ && !is_within(i, std::max(t, last))) {
      leave(i, level);
      return false;
    }
    if (t > last) {
      progress_[i].from = t;
      hits_[i].scale = static_cast<int32_t>(level);
      hits_[i].normal = normal;
    }
    if (level + 1 == levels_) hit(i, t > last ? t : last);
    return true;
  }

  /// Whether an entry into the finest level is in those above it, too. Where they end, the ray is
  /// outside, at most a tolerance past their boundary. If the finest level begins at this boundary,
  /// as the complement of a coarser one does, its entry lies there and nothing is inside.
  bool is_within(uint32_t i, double t) {
    const double way = end(i, levels_ - 1) - t;
    double tolerance = 0;
    for (size_t level = 0; level + 1 < levels_; ++level)
      tolerance = std::max(tolerance, tolerance_of(i, level));
    return way > 2 * tolerance || model_.inside(ray(i).at(t), resolved_);
  }

  /// Continues on the next level, up to the end of this one.
  void go_deeper(uint32_t i, size_t level, double to) {
    end(i, level + 1) = to;
    waiting_[level + 1].push_back(i);
  }

  double tolerance_of(uint32_t i, size_t level) {
    return level == 0 ? boxes_.tolerance
                      : resolved_[level - 1]->structure->ray_tolerance(ray(i), end(i, 0));
  }

  /// 64 parts within so much of a ray are noise: 2^-18 of the shape, and no more than a quarter of
  /// a cell.
  double slow_of(size_t level, double tolerance) const {
    const double slow = 0x1p18 * tolerance;
    return level == 0 ? slow
                      : std::min(slow, 0.25 * resolved_[level - 1]->structure->cell_length());
  }

  PartSteps& steps_of(uint32_t i, size_t level) {
    const size_t n = i * levels_ + level;
    if (!has_steps_[n]) {
      has_steps_[n] = 1;
      steps_[n] = {};
    }
    return steps_[n];
  }

  /// Nothing at this level up to where the level above ends: on behind that.
  void leave(uint32_t i, size_t level) {
    // Nothing begins behind the end of all space.
    if (level == 0 || (level == 1 && !is_bounded_)) {
      hits_[i].scale = -1;
      return;
    }
    // Past the end by the tolerance, so that the level above is left even where rounding has not.
    double& from = progress_[i].from;
    const double end_above = std::max(end(i, level), from);
    const double tolerance = tolerance_of(i, level - 1);
    // The point of an entry may lie outside by rounding, and its stay then ends where it begins.
    // The entry may be that of a level further above, if those between have left, too.
    const bool stays_at_entry =
        hits_[i].scale < static_cast<int32_t>(level) && end_above <= from + tolerance;
    from =
        end_above + steps_of(i, level).behind(end_above, tolerance, slow_of(level - 1, tolerance));
    if (!stays_at_entry) {
      hits_[i].scale = static_cast<int32_t>(level);  // that comes in next, if none above it does
      hits_[i].normal = {};
    }
    if (from > end(i, level - 1)) {
      leave(i, level - 1);
      return;
    }
    waiting_[level - 1].push_back(i);
  }

  /// The ray, at t, is in the finest level.
  void hit(uint32_t i, double t) {
    RayHit& hit = hits_[i];
    const RaySearch& search = searches_[i];
    hit.t = progress_[i].offset + t;
    if (hit.t > search.to) {
      // Found past the end, at which the ray may be inside already.
      if (detail_ == HitDetail::all && !model_.inside(search.ray.at(search.to), resolved_)) {
        hit = {};
        return;
      }
      hit.t = search.to;
    }
    hit.point = progress_[i].origin + search.ray.direction * t;
    if (hit.t > search.from && hit.t - search.from <= beyond_end(search) &&
        model_.inside(search.ray.at(search.from), resolved_)) {
      hit.t = search.from;  // found late, by rounding
      hit.point = search.ray.at(search.from);
    }
    hit.starts_inside = hit.t == search.from;
    if (detail_ == HitDetail::place) return;
    if (hit.starts_inside)
      hit.normal = search.ray.direction * -1.0;
    else if (hit.scale == 0 && model_.shape().gains_by_rays())
      without_normal_.push_back(i);
    else if (dot(hit.normal, hit.normal) == 0)
      hit.normal = hit.scale == 0
                       ? model_.shape().normal(ray(i), t)
                       : resolved_[static_cast<size_t>(hit.scale) - 1]->normal(ray(i), t);
    if (hit.starts_inside) hit.scale = static_cast<int32_t>(levels_) - 1;
  }

  /// Computes the shape's normals at all hits on it.
  void find_normals() {
    for (size_t n = 0; n < without_normal_.size(); ++n) {
      batch_[n].ray = ray(without_normal_[n]);
      batch_[n].t = progress_[without_normal_[n]].from;
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
  const bool is_bounded_;
  const StartBoxes boxes_;
  RayStarts starts_;
  const RaySearch* const searches_;
  RayHit* const hits_;
  double* const ends_;
  PartSteps* const steps_;
  uint8_t* const has_steps_;
  Progress* const progress_;
  RaySearch* const batch_;
  std::vector<std::vector<uint32_t>>& waiting_;
  std::vector<uint32_t>& rays_;
  std::vector<uint32_t>& without_normal_;
};

}  // namespace

double way_past_end(const Model& model, const Scales& resolved, const Ray& ray, double to) {
  double sum = model.shape().ray_tolerance();
  for (const Scale* scale : resolved) sum += scale->structure->ray_tolerance(ray, to);
  // A grid with an origin far away makes it large. All cells stay within reach of their grids.
  double past = 2 * sum;
  for (const Scale* scale : resolved)
    scale->structure->for_each_grid(
        [&](const Neighbourhood& grid) { past = std::min(past, min_component(grid.cell_size)); });
  return past;
}

double way_past_end(const Model& model, const Scales& resolved) {
  return way_past_end(model, resolved, {model.bounds().min, model.bounds().extent()}, 1);
}

// From so far away that rounding moves points out of the box: points that far are known to 2^-53 of
// their coordinates, so the ray is clipped again from the point that it came to, which is as much
// nearer.
bool move_to_box(const Box3& box, const Box3& near, double low, double high, double past,
                 RaySearch& s, double& offset, double& end) {
  offset = low;
  if (const Vec3 place = s.ray.at(low); near.contains(place)) {
    s.ray.origin = place;
    end = high - low;
    return true;
  }
  constexpr int max_rounds = 48;  // 2^52 each, from the largest numbers to the smallest
  for (int round = 0; round < max_rounds; ++round) {
    s.ray.origin = s.ray.exactly_at(low);
    if (round > 0) offset += low;
    if (near.contains(s.ray.origin)) {
      double first = 0;
      end = s.to + past - offset;
      return clip_to_box(s.ray, box, first, end);
    }
    low = s.from - offset;
    high = s.to + past - offset;
    if (!clip_to_box(s.ray, box, low, high)) return false;
  }
  return false;
}

CellIndex cell_of(const Scales& all, const RayHit& hit) {
  if (hit.scale < 0) return {};
  const Scales& resolved = all.regions.empty() ? all : all.regions[hit.region];
  if (resolved.empty()) return {};
  const Structure& finest = *resolved.back()->structure;
  return finest.is_on_grid() ? finest.cell_of(hit.point) : CellIndex{};
}

uint32_t material_id(const Model& model, const Scales& resolved, const RayHit& hit,
                     uint32_t& part) {
  if (hit.scale < 0) return 0;
  uint32_t own_part = 0;  // parts are of one region
  const Material* material = model.regions().empty()
                                 ? model.material(hit.point, resolved, part)
                                 : model.regions()[hit.region]->material(
                                       hit.point, resolved.regions[hit.region], own_part);
  return material ? material->id() : 0;
}

void prepare_rays(const Model& model, const Scales& resolved, const Job* job) {
  model.shape().prepare_distance(job);
  model.prepare_skins(resolved, job);
}

void cast_batch(const Model& model, const Scales& resolved, std::vector<RaySearch>& searches,
                std::vector<RayHit>& hits, HitDetail detail, const Job* job) {
  if (!model.regions().empty())
    return cast_through_regions(model, resolved, searches, hits, detail, job);
  const size_t count = searches.size();
  hits.resize(count);
  // The model may be of the host's, whose callbacks may cast rays.
  const Borrowed<CastMemory> memory;
  (*memory).make_room(count, 1 + resolved.size());
  Caster(model, resolved, detail, job, *memory, searches.data(), hits.data()).run(count);
}

namespace {

/// Casts rays [first, first + count), in this order if `order` is null.
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

/// Maximum number of rays sorted at once, so that they take only a part of the memory.
uint64_t sorted_at_once(const MemoryBudget& budget) {
  constexpr uint64_t part = 16;
  if (budget.limit() == 0) return RayOrder::most;
  return std::clamp(budget.limit() / part / RayOrder::bytes_of_ray, ray_batch, RayOrder::most);
}

}  // namespace

void cast_rays(const Model& model, const Scales& resolved, uint64_t count, const FillRays& fill,
               const TakeHits& take, Job* job) {
  if (count == 0) return;
  prepare_rays(model, resolved, job);
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
  const auto order =
      std::make_unique<RayOrder>(model.bounds(), resolved.front()->structure->cell_length());
  const auto part_of = [&](uint64_t n) {
    return static_cast<double>(n) / static_cast<double>(count);
  };
  for (uint64_t first = 0; first < count; first += at_once) {
    const uint64_t size = std::min(count - first, at_once);
    check_cancelled(job);
    const bool is_sorted = order->sort(model.executor(), first, size, fill, job);
    cast_part(model, resolved, first, size, is_sorted ? order.get() : nullptr, fill, take, job,
              {part_of(first), part_of(first + size)});
  }
}

}  // namespace msq
