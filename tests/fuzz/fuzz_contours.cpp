// SPDX-License-Identifier: Apache-2.0
// Contours of models of every kind: rings are closed, simple and apart, with the inside on the
// left; what is around a point for more than the pitch and the tolerance is on the same side of the
// rings as the point.
#include <algorithm>
#include <cmath>

#include "objects.h"

namespace msq::fuzz {

namespace {

struct Ring {
  const double* points;
  size_t count;
  const double* at(size_t i) const { return points + 2 * (i % count); }
};

double area_of(const Ring& ring) {
  double area = 0;
  const double* o = ring.at(0);
  for (size_t i = 0; i < ring.count; ++i) {
    const double *a = ring.at(i), *b = ring.at(i + 1);
    area += 0.5 * ((a[0] - o[0]) * (b[1] - o[1]) - (b[0] - o[0]) * (a[1] - o[1]));
  }
  return area;
}

/// Of the longest coordinate about the first point.
double square_of(const Ring& ring) {
  double longest = 0;
  for (size_t i = 0; i < 2 * ring.count; ++i)
    longest = std::max(longest, std::abs(ring.points[i] - ring.points[i % 2]));
  return longest * longest;
}

bool encloses(const Ring& ring, double u, double v) {
  bool is_inside = false;
  for (size_t i = 0; i < ring.count; ++i) {
    const double *a = ring.at(i), *b = ring.at(i + 1);
    if ((a[1] > v) != (b[1] > v) && u < a[0] + (v - a[1]) / (b[1] - a[1]) * (b[0] - a[0]))
      is_inside = !is_inside;
  }
  return is_inside;
}

/// The sign of the area of a, b, c; 0 where rounding decides.
int turn_of(const double* a, const double* b, const double* c) {
  const double left = (b[0] - a[0]) * (c[1] - a[1]), right = (b[1] - a[1]) * (c[0] - a[0]);
  const double margin = 1e-13 * (std::abs(left) + std::abs(right));
  return left - right > margin ? 1 : left - right < -margin ? -1 : 0;
}

class RingChecker {
 public:
  explicit RingChecker(const msq_contours_report& report) : report_(report) {
    const auto* points = static_cast<const double*>(report.points);
    for (uint64_t i = 0; i < report.ring_count; ++i) {
      if (report.starts[i] > report.starts[i + 1] || report.starts[i + 1] > report.point_count)
        wrong("ring %zu begins at %zu", static_cast<size_t>(i),
              static_cast<size_t>(report.starts[i]));
      rings_.push_back({points + 2 * report.starts[i],
                        static_cast<size_t>(report.starts[i + 1] - report.starts[i])});
    }
    if (report.ring_count > 0 && report.starts[report.ring_count] != report.point_count)
      wrong("points without a ring");
  }

  void check() const {
    for (size_t i = 0; i < rings_.size(); ++i) check_ring(i);
    if (report_.point_count < 400) check_apart();
  }

  bool is_inside(double u, double v) const {
    bool inside = false;
    for (const Ring& ring : rings_) inside = inside != encloses(ring, u, v);
    return inside;
  }

 private:
  void check_ring(size_t i) const {
    const Ring& ring = rings_[i];
    if (ring.count < 3) wrong("ring %zu has %zu points", i, ring.count);
    for (size_t k = 0; k < ring.count; ++k) {
      const double *a = ring.at(k), *b = ring.at(k + 1);
      if (!std::isfinite(a[0]) || !std::isfinite(a[1]))
        wrong("ring %zu has a point that is not finite", i);
      if (a[0] == b[0] && a[1] == b[1]) wrong("ring %zu has a point twice", i);
    }
    double area = area_of(ring);
    if (std::abs(area) <= 1e-12 * square_of(ring)) area = 0;  // rounding
    if (report_.holes[i] > 1 || (report_.holes[i] ? area > 0 : area < 0))
      wrong("ring %zu, hole %d, has the area %.17g", i, report_.holes[i], area);
    const int64_t parent = report_.parents[i];
    if (parent >= static_cast<int64_t>(i) || parent < -1)
      wrong("ring %zu has parent %d", i, static_cast<int>(parent));
    if (parent < 0) {
      if (report_.holes[i]) wrong("hole %zu has no parent", i);
      return;
    }
    const auto p = static_cast<size_t>(parent);
    if (report_.holes[p] == report_.holes[i])
      wrong("ring %zu is in ring %zu, and both have hole %d", i, p, report_.holes[i]);
    const double* a = ring.at(0);
    if (!encloses(rings_[p], a[0], a[1])) wrong("ring %zu is not in its parent %zu", i, p);
  }

  /// No two edges meet but at the point that they share.
  void check_apart() const {
    struct Edge {
      const double *a, *b;
      size_t ring, index;
    };
    std::vector<Edge> edges;
    for (size_t r = 0; r < rings_.size(); ++r)
      for (size_t i = 0; i < rings_[r].count; ++i)
        edges.push_back({rings_[r].at(i), rings_[r].at(i + 1), r, i});
    for (size_t i = 0; i < edges.size(); ++i)
      for (size_t j = i + 1; j < edges.size(); ++j) {
        const Edge &e = edges[i], &f = edges[j];
        if (e.ring == f.ring && (e.b == f.a || f.b == e.a)) continue;
        const int a = turn_of(e.a, e.b, f.a), b = turn_of(e.a, e.b, f.b),
                  c = turn_of(f.a, f.b, e.a), d = turn_of(f.a, f.b, e.b);
        if (a * b < 0 && c * d < 0)
          wrong(
              "edge %zu of ring %zu, from (%.17g, %.17g), crosses edge %zu of ring %zu, from "
              "(%.17g, %.17g)",
              e.index, e.ring, e.a[0], e.a[1], f.index, f.ring, f.a[0], f.a[1]);
      }
  }

  const msq_contours_report& report_;
  std::vector<Ring> rings_;
};

}  // namespace

void run_contours(const uint8_t* data, size_t size) {
  Input input(data, size);
  const Owner<msq_context> context = make_context();
  const Job job;
  msq_contours_def def = make_def(msq_contours_def_init);
  def.axis = static_cast<int32_t>(input.below(3));
  const double tolerance = input.number(0.004, 0.1), pitch = input.number(0.05, 0.4);
  const bool has_pitch = input.chance(200), has_window = input.chance(100);
  const double height = input.number(-1.5, 1.5);
  const double corner[2] = {input.number(-3, 1), input.number(-3, 1)};
  Random random(input.word(4));
  Maker maker(input, context.get(), job);
  const Sight& sight = maker.sight();
  const Owner<msq_model> model = maker.model();
  if (!model || job.is_cancelled()) return;
  def.tolerance = sight.unit * tolerance;
  def.pitch = has_pitch ? sight.unit * pitch : 0;
  const int axes[2] = {def.axis == 0 ? 1 : 0, def.axis == 2 ? 1 : 2};
  double low[3], high[3];
  if (!MSQ_FUZZ(msq_model_bounds, model.get(), low, high)) return;
  for (int i = 0; i < 2; ++i) {
    const double middle = sight.at[axes[i]];
    if (has_window || !std::isfinite(low[axes[i]]) ||
        high[axes[i]] - low[axes[i]] > 16 * sight.unit) {
      def.has_window = 1;
      def.window_min[i] = middle + sight.unit * corner[i];
      def.window_max[i] = middle + sight.unit * (corner[i] + 2.5);
    }
  }
  for (int i = 0; i < 2 && def.has_window; ++i)
    if (def.window_min[i] == 0 && def.window_max[i] == 0) {
      def.window_min[i] = sight.at[axes[i]] - 2 * sight.unit;
      def.window_max[i] = sight.at[axes[i]] + 2 * sight.unit;
    }
  // A fine pitch is dear, not different.
  const double step = def.pitch > 0 ? def.pitch : def.tolerance;
  if (step > 0 && step < 0.02 * sight.unit) return;
  const double at = sight.at[def.axis] + sight.unit * height;
  const Owner<msq_contours> contours = make<msq_contours>(
      "msq_layer_contours",
      [&](msq_contours** c) { return msq_layer_contours(model.get(), at, &def, c, job); });
  if (!contours || job.is_cancelled()) return;
  msq_contours_report report{};
  report.struct_size = sizeof report;
  if (!MSQ_FUZZ(msq_contours_info, contours.get(), &report)) wrong("contours have no report");
  const RingChecker rings(report);
  rings.check();

  const double reach = 2 * (def.tolerance + 1.4143 * step);
  for (int i = 0; i < 64; ++i) {
    double p[3];
    double margin = INFINITY;
    p[def.axis] = at;
    for (int k = 0; k < 2; ++k) {
      const double a = def.has_window ? def.window_min[k] : low[axes[k]];
      const double b = def.has_window ? def.window_max[k] : high[axes[k]];
      p[axes[k]] = random.between(a, b);
      margin = std::min({margin, p[axes[k]] - a, b - p[axes[k]]});
    }
    double distance;
    if (!MSQ_FUZZ(msq_point_distance, model.get(), p, nullptr, &distance)) return;
    // Beyond the window nothing is inside.
    if (std::abs(distance) <= reach || margin <= reach) continue;
    if (rings.is_inside(p[axes[0]], p[axes[1]]) != (distance <= 0))
      wrong("(%.17g, %.17g, %.17g) is %s, by %.3g of the pitch; the rings say otherwise", p[0],
            p[1], p[2], distance <= 0 ? "inside" : "outside", std::abs(distance) / step);
  }
}

}  // namespace msq::fuzz
