// SPDX-License-Identifier: Apache-2.0
#include "shape/boolean.h"

#include <limits>

#include "base/follow_changes.h"
#include "base/hash_input.h"
#include "base/infinity.h"
#include "base/ray_normal.h"
#include "base/status.h"

namespace msq {

namespace {}

BooleanShape::BooleanShape(Operation operation, std::vector<Ref<const Shape>> members)
    : operation_(operation), members_(std::move(members)) {
  for (const Ref<const Shape>& member : members_) {
    is_concurrent_ = is_concurrent_ && member->is_concurrent();
    is_steady_ = is_steady_ && member->has_steady_distance();
    nesting_ = std::max(nesting_, 1 + member->nesting());
    terms_ += member->terms();
    min_tolerance_ = std::max(min_tolerance_, member->ray_tolerance());
  }
  find_bounds();
  find_exactness();
  facts_.volume = facts_.area = std::numeric_limits<double>::quiet_NaN();
}

void BooleanShape::find_bounds() {
  Box3& box = facts_.bounds;
  box = members_[0]->bounds();
  if (operation_ == Operation::subtracted) return;
  for (const Ref<const Shape>& member : members_) {
    const Box3& other = member->bounds();
    if (operation_ == Operation::united) {
      box = {min(box.min, other.min), max(box.max, other.max)};
      continue;
    }
    box = {max(box.min, other.min), min(box.max, other.max)};
    for (int axis = 0; axis < 3; ++axis)
      if (!(box.min[axis] <= box.max[axis]))
        fail(Status::argument,
             "the shapes do not meet: along axis %d some begin at %g where others end at %g", axis,
             box.min[axis], box.max[axis]);
  }
}

// The nearest point of a union is that of a member; a point inside may lie deeper in all of them
// than in each. With complements: the other way round for intersections, and for differences,
// which are intersections with complements.
void BooleanShape::find_exactness() {
  bool are_apart = operation_ == Operation::united;
  for (size_t i = 0; are_apart && i < members_.size(); ++i)
    for (size_t j = 0; are_apart && j < i; ++j)
      are_apart = !members_[i]->bounds().overlaps(members_[j]->bounds());
  const bool is_union = operation_ == Operation::united;
  is_exact_outside_ = is_union || members_.size() == 1;
  is_exact_inside_ = !is_union || are_apart;
  knows_depth_ = !is_union || are_apart;
  for (size_t i = 0; i < members_.size(); ++i) {
    const Shape& m = *members_[i];
    const bool outside = is_wanted(i) ? m.is_exact_outside() : m.is_exact_inside();
    const bool inside = is_wanted(i) ? m.is_exact_inside() : m.is_exact_outside();
    is_exact_outside_ = is_exact_outside_ && outside;
    is_exact_inside_ = is_exact_inside_ && inside;
    knows_depth_ = knows_depth_ && m.knows_depth() && (is_wanted(i) || m.is_exact_outside());
  }
}

bool BooleanShape::inside(Vec3 p) const {
  if (!bounds().contains(p)) return false;
  const bool is_union = operation_ == Operation::united;
  for (size_t i = 0; i < members_.size(); ++i)
    if ((members_[i]->inside(p) == is_wanted(i)) == is_union) return is_union;
  return !is_union;
}

void BooleanShape::find_inside(const Vec3* points, size_t count, uint8_t* inside) const {
  const bool is_union = operation_ == Operation::united;
  // Points that no member has decided yet.
  std::vector<Vec3> open;
  std::vector<size_t> index;
  for (size_t i = 0; i < count; ++i) {
    inside[i] = 0;
    if (!bounds().contains(points[i])) continue;
    inside[i] = !is_union;
    open.push_back(points[i]);
    index.push_back(i);
  }
  std::vector<uint8_t> answers;
  for (size_t m = 0; m < members_.size() && !open.empty(); ++m) {
    answers.resize(open.size());
    members_[m]->find_inside(open.data(), open.size(), answers.data());
    size_t kept = 0;
    for (size_t n = 0; n < open.size(); ++n) {
      if (((answers[n] != 0) == is_wanted(m)) == is_union) {
        inside[index[n]] = is_union;
        continue;
      }
      open[kept] = open[n];
      index[kept++] = index[n];
    }
    open.resize(kept);
    index.resize(kept);
  }
}

void BooleanShape::prepare_distance(const Job* job) const {
  for (const Ref<const Shape>& member : members_) member->prepare_distance(job);
}

void BooleanShape::prepare_rows(const Job* job) const {
  for (const Ref<const Shape>& member : members_) member->prepare_rows(job);
}

// A ball in which no member changes its answer, as far as that decides: the union's signed distance
// is at most the least of its members', the intersection's at most the greatest.
double BooleanShape::distance_bound(Vec3 p) const {
  const bool is_union = operation_ == Operation::united;
  double bound = is_union ? infinity : -infinity;
  for (size_t i = 0; i < members_.size(); ++i) {
    const double distance = distance_of(i, p);
    bound = is_union ? std::min(bound, distance) : std::max(bound, distance);
  }
  return std::min(std::abs(bound), std::numeric_limits<double>::max());
}

double BooleanShape::depth(Vec3 p) const {
  if (!knows_depth_) return distance_bound(p);
  double least = infinity;
  if (operation_ == Operation::united)  // of which at most one has it in its bounds
    for (const Ref<const Shape>& member : members_)
      if (member->bounds().contains(p)) return member->depth(p);
  for (const Ref<const Shape>& member : members_) least = std::min(least, member->depth(p));
  return least;
}

// Members' depths are queried in all of the bounds, which may be many times larger than theirs.
double BooleanShape::depth_error() const {
  double error = 0;
  for (const Ref<const Shape>& member : members_) {
    const Box3& box = member->bounds();
    const Vec3 gap = max(max(box.min - bounds().min, bounds().max - box.max), Vec3{});
    const double size = max_component(box.extent());
    error = std::max(error, member->depth_error() * (1 + length(gap) / size));
  }
  return error;
}

bool BooleanShape::find(bool wanted, const Ray& ray, double from, double to, double& t,
                        const Job* job) const {
  const double tolerance = ray_tolerance();
  const auto is_there = [&](double at) { return inside(ray.at(at)) == wanted; };
  if (is_there(from)) {
    t = from;
    return true;
  }
  std::vector<double> next(members_.size(), -infinity);
  const auto next_change = [&](double at) -> std::optional<double> {
    double nearest = infinity;
    for (size_t i = 0; i < members_.size(); ++i) {
      const Shape& member = *members_[i];
      if (next[i] <= at) {
        if (member.inside(ray.at(at)))
          next[i] = member.leave(ray, at, to, job);
        else if (!member.enter(ray, at, to, next[i], job))
          next[i] = infinity;
      }
      nearest = std::min(nearest, next[i]);
    }
    return nearest;
  };
  return follow_changes(from, to, tolerance, job, next_change, is_there, t);
}

bool BooleanShape::enter(const Ray& ray, double from, double to, double& t, const Job* job) const {
  return clip_to_box(ray, bounds(), from, to) && find(true, ray, from, to, t, job);
}

double BooleanShape::leave(const Ray& ray, double from, double to, const Job* job) const {
  if (!clip_to_box(ray, bounds(), from, to)) return from;
  double t;
  return find(false, ray, from, to, t, job) ? t : to;
}

// That of the member whose answer changes there. Where the ray leaves a subtracted one, that is
// what it meets on its way back, turned round.
Vec3 BooleanShape::normal(const Ray& ray, double t) const {
  const double room = 2 * ray_tolerance();
  const Vec3 before = ray.at(t - room), behind = ray.at(t + room);
  for (size_t i = 0; i < members_.size(); ++i) {
    const Shape& member = *members_[i];
    const bool is_in = member.inside(behind);
    if (is_in != is_wanted(i) || member.inside(before) == is_in) continue;
    if (is_in) return member.normal(ray, t);
    return member.normal({ray.at(t), ray.direction * -1.0}, 0) * -1.0;
  }
  return Shape::normal(ray, t);
}

void BooleanShape::fill_rows(const RowBlock& block) const {
  // Members are queried in turn, in blocks of rows of up to a megabyte.
  constexpr size_t max_words = size_t{1} << 17;
  const size_t words = block.row_words();
  const uint64_t rows = std::clamp<uint64_t>(max_words / words, 1, block.rows());
  std::vector<uint64_t> scratch(words * rows);
  const bool is_union = operation_ == Operation::united;
  for (uint64_t k = block.z0; k < block.z1; ++k)
    for (uint64_t j = block.y0; j < block.y1; j += rows) {
      RowBlock part = block;
      part.z0 = k;
      part.z1 = k + 1;
      part.y0 = j;
      part.y1 = std::min(block.y1, j + rows);
      part.words = scratch.data();
      part.row_stride = words;
      part.layer_stride = words * rows;
      for (size_t m = 0; m < members_.size(); ++m) {
        check_cancelled();
        const bool is_near = members_[m]->bounds().overlaps(part.box());
        if (!is_near && m > 0 && operation_ != Operation::intersected) continue;
        std::fill(scratch.begin(), scratch.end(), 0);
        if (is_near) members_[m]->fill_rows(part);
        for (uint64_t y = part.y0; y < part.y1; ++y) {
          uint64_t* row = block.row(y, k);
          const uint64_t* found = part.row(y, k);
          for (size_t w = 0; w < words; ++w)
            row[w] = m == 0 || is_union ? row[w] | found[w]
                     : is_wanted(m)     ? row[w] & found[w]
                                        : row[w] & ~found[w];
        }
      }
    }
}

void BooleanShape::describe(HashInput& input) const {
  input.kind("shape: boolean");
  input.integer(static_cast<uint64_t>(operation_));
  input.integer(members_.size());
  for (const Ref<const Shape>& member : members_) input.object(*member);
}

}  // namespace msq
