// SPDX-License-Identifier: Apache-2.0
// A centre line enters and leaves the shape as a ray does. Each computed end is corrected by
// membership, so ends are inside.
#include "query/strut_cuts.h"

#include <algorithm>
#include <cmath>

#include "base/ray.h"

namespace msq {

namespace {

class Cutter {
 public:
  Cutter(const Shape& shape, const StrutRadii& radii, StrutList& pieces, const Job* job)
      : shape_(shape), radii_(radii), pieces_(pieces), job_(job) {}

  void cut(const Strut& strut, double factor) {
    const Vec3 ab = strut.b - strut.a;
    length_ = length(ab);
    if (!(length_ > 0)) {
      if (shape_.inside(strut.a)) pieces_.add(strut, factor);
      return;
    }
    strut_ = &strut;
    factor_ = factor;
    ray_ = {strut.a, ab * (1 / length_)};
    double reach_from = 0, reach_to = length_;
    tolerance_ =
        std::max(shape_.ray_tolerance(), coordinate_rounding(max_coordinate(ray_, length_)));
    if (shape_.is_bounded() &&
        !clip_to_box(ray_, shape_.bounds().grown(2 * tolerance_), reach_from, reach_to))
      return;
    count_ = 0;
    PartSteps steps;
    double at = std::max(0.0, reach_from);
    const double end = std::min(length_, reach_to);
    while (at <= end) {
      double from = at;
      if (!inside(at)) {
        if (!shape_.enter(ray_, at, end, from, job_)) return;
        from = std::clamp(from, at, length_);
        if (!inside(from)) from = std::min(length_, from + tolerance_);
        if (!inside(from)) {  // a graze
          at = from + steps.behind(from, tolerance_, 0x1p-20 * length_);
          continue;
        }
      }
      const double to = leave(from);
      if (to > from) add(from, to);
      at = to + steps.behind(to, tolerance_, 0x1p-20 * length_);
    }
  }

 private:
  /// Membership on the line; its ends are those of the strut, to the last bit.
  bool inside(double t) const { return shape_.inside(point(t)); }
  Vec3 point(double t) const { return t <= 0 ? strut_->a : t >= length_ ? strut_->b : ray_.at(t); }

  /// The end of the part that is inside at `from`.
  double leave(double from) const {
    double at = from;
    PollEvery<64> poll(job_);
    LeastStep least(tolerance_, tolerance_, from);
    for (;;) {
      poll();
      const double step = least.of_step(at);
      const double next = std::min(length_, std::max(shape_.leave(ray_, at, length_, job_), at));
      // Up to `next` it is inside; is it beyond?
      const double beyond = std::min(length_, next + std::max(step, tolerance_));
      if (beyond >= length_ && inside(length_)) return length_;
      if (beyond <= next || !inside(beyond)) return last_inside(at, next, beyond);
      at = beyond;
    }
  }

  /// The last point inside, between one that is and one that is not.
  double last_inside(double known, double next, double beyond) const {
    double in = inside(next) ? next : known, out = in == next ? beyond : next;
    while (out - in > tolerance_) {
      const double middle = 0.5 * (in + out);
      if (!(middle > in && middle < out)) break;
      (inside(middle) ? in : out) = middle;
    }
    return in;
  }

  void add(double from, double to) {
    Strut piece = *strut_;
    const double ends[2] = {from, to};
    for (uint32_t end = 0; end < 2; ++end) {
      const double t = ends[end];
      piece.cut[end] = end == 0 ? t > 0 : t < length_;
      if (!piece.cut[end]) continue;
      const Vec3 p = point(t);
      (end == 0 ? piece.a : piece.b) = p;
      piece.radii[end] = radii_.radius_at(*strut_, factor_, t / length_, p);
      piece.nodes[end] = name(2 * count_ + end);
    }
    if (count_ > 0) piece.id = name(count_ << 1 | uint64_t{1} << 63);
    ++count_;
    pieces_.add(piece, factor_);
  }
  Id name(uint64_t number) const {
    IdHash hash(5);
    hash.add(strut_->id.low);
    hash.add(strut_->id.high);
    hash.add(number);
    return hash.id();
  }

  const Shape& shape_;
  const StrutRadii& radii_;
  StrutList& pieces_;
  const Job* job_;
  const Strut* strut_ = nullptr;
  double factor_ = 1, length_ = 0, tolerance_ = 0;
  Ray ray_;
  uint64_t count_ = 0;  // pieces of the strut so far
};

}  // namespace

void cut_struts(const Shape& shape, const StrutRadii& radii, const StrutList& list,
                StrutList& pieces, const Job* job) {
  Cutter cutter(shape, radii, pieces, job);
  JobPoll poll(job);
  for (size_t i = 0; i < list.struts.size(); ++i) {
    poll();
    cutter.cut(list.struts[i], list.factors[i]);
  }
}

}  // namespace msq
