// SPDX-License-Identifier: Apache-2.0
#include "structure/beams/beam_rays.h"

#include "base/infinity.h"
#include "structure/beams/beams.h"

namespace msq {

namespace {

/// Calls visit(part) for each part of beams [begin, end).
template <class Visit>
void for_parts(const BeamList& beams, size_t begin, size_t end, Visit&& visit) {
  for (size_t i = begin; i < end; ++i) {
    const Beam beam = beams.at(i);
    for (const BeamPart::Kind kind : BeamPart::kinds) {
      const BeamPart part{beam, kind};
      if (part.exists()) visit(part);
    }
  }
}

}  // namespace

BeamRays::BeamRays(const Beams& beams)
    : beams_(beams),
      tolerance_(beams.ray_tolerance()),
      formula_error_(1e-6 * beams.cell_length()) {}

bool BeamRays::settle(const BeamPart& part, const Ray& ray, double enter, double leave, double from,
                      double to, double& t) const {
  const auto holds = [&](Vec3 p) { return part.holds(p); };
  t = std::clamp(enter, from, to);
  if (settle_entry(ray, from, to, tolerance_, holds, t)) return true;
  // Formulas may be too early, by much if the ray grazes the part or runs along it. In a slender
  // one the ray may end before the middle would be inside.
  const double first = t, last = std::min(leave, to);
  for (const double inner : {0.5 * (first + last), last}) {
    if (!(inner > first) || !holds(ray.at(inner))) continue;
    t = bisect(first, inner, tolerance_, [&](double at) { return holds(ray.at(at)); });
    return true;
  }
  return false;
}

void BeamRays::enter(RaySearch& search) const {
  search.found = false;
  search.normal = {};
  if (!(search.from <= search.to)) return;
  const Ray& ray = search.ray;
  double first = infinity;
  Vec3 normal;
  beams_.tree().find_along(ray, search.from, search.to, [&](size_t begin, size_t end) {
    for_parts(beams_.beams(), begin, end, [&](const BeamPart& part) {
      const double to = std::min(first, search.to);
      double enter, leave, t;
      if (!part.meet(ray, enter, leave)) return;
      if (enter > to + formula_error_ || leave < search.from - formula_error_) return;
      if (!settle(part, ray, enter, leave, search.from, to, t) || !(t < first)) return;
      first = t;
      normal = part.face_at(ray.at(t)).normal;
    });
    return std::min(first, search.to);
  });
  if (!(first < infinity)) return;
  search.found = true;
  search.t = std::min(first, search.to);
  search.normal = dot(normal, normal) > 0 ? normal : ray.direction * -1.0;
}

double BeamRays::leave(const Ray& ray, double from, double to, const Job* job) const {
  constexpr int max_steps = 64;
  double until = from;
  bool is_longer = true;
  for (int step = 0; is_longer && until < to && step < max_steps; ++step) {
    is_longer = false;
    const Vec3 p = ray.at(until);
    const double here = until;
    beams_.tree().find_overlapping({p, p}, [&](size_t begin, size_t end) {
      for_parts(beams_.beams(), begin, end, [&](const BeamPart& part) {
        double enter, leave;
        if (!part.holds(p) || !part.meet(ray, enter, leave)) return;
        const double last = std::min(leave, to);
        if (!(last > until)) return;
        // Parts are convex: all points between two points inside are inside.
        const auto is_out = [&](double t) { return !part.holds(ray.at(t)); };
        const double t = is_out(last) ? bisect(here, last, tolerance_, is_out) - tolerance_ : last;
        if (!(t > until)) return;
        until = t;
        is_longer = true;
      });
      return until < to;
    });
  }
  return until > from ? until : beams_.Structure::leave(ray, from, to, job);
}

Vec3 BeamRays::normal(const Ray& ray, double t) const {
  const Vec3 p = ray.at(t);
  const double margin = 4 * tolerance_ + 0x1p-48 * max_magnitude(p);
  // The normal of the part that contains the point or is nearest to it.
  double least = infinity;
  Vec3 normal;
  beams_.tree().find_overlapping(Box3{p, p}.grown(margin), [&](size_t begin, size_t end) {
    for_parts(beams_.beams(), begin, end, [&](const BeamPart& part) {
      const BeamPart::Face face = part.face_at(p);
      if (!(face.above < least) || !(dot(face.normal, face.normal) > 0)) return;
      least = face.above;
      normal = face.normal;
    });
    return true;
  });
  return least < infinity ? normal : ray.direction * -1.0;
}

}  // namespace msq
