// SPDX-License-Identifier: Apache-2.0
// Crossings on struts: where lines of nodes enter and leave capsules, in closed form.
//
// An edge between a node outside and one inside is entered first where the nearest of all capsules
// begins, and left last where the farthest ends: the least and the greatest of what the capsules
// propose, in any order. A line meets the infinite cylinder about a capsule's axis in an interval;
// where an end of it lies beyond an end of the axis, the sphere about that end makes the end
// instead.
#include "slice/contour_section.h"

#include <cmath>

namespace msq {

namespace {

/// Along an axis.
constexpr double max_cells_of_tile = 64;

/// A capsule, in coordinates along lines (s), across them (t) and off the plane (w), from its end
/// a.
struct CapsuleLines {
  double a_s, a_t, d_s, d_t, d_w, w, squared, rest, inverse, radius2;

  CapsuleLines(double a_s, double a_t, double w, double d_s, double d_t, double d_w, double radius)
      : a_s(a_s),
        a_t(a_t),
        d_s(d_s),
        d_t(d_t),
        d_w(d_w),
        w(w),
        squared(d_s * d_s + d_t * d_t + d_w * d_w),
        rest(d_t * d_t + d_w * d_w),
        inverse(rest > 1e-12 * squared ? 1 / rest : 0),
        radius2(radius * radius) {}

  /// Where the line at t begins and ends in it; false where it does not meet it.
  bool meet(double at, double& low, double& high) const {
    const double t = at - a_t, off2 = t * t + w * w;
    const double at_b = (t - d_t) * (t - d_t) + (w - d_w) * (w - d_w);
    const double m = t * d_t + w * d_w;
    const double c = (off2 - radius2) * squared - m * m;
    if (inverse == 0) {  // along the line, or a point
      if (!(radius2 >= off2)) return false;
      const double q = std::sqrt(radius2 - off2);
      low = a_s + std::min(d_s, 0.0) - q;
      high = a_s + std::max(d_s, 0.0) + q;
      return true;
    }
    const double b = m * d_s, under = b * b - rest * c;
    if (!(under >= 0)) return false;
    const double root = std::sqrt(under);
    return end((b - root) * inverse, m, off2, at_b, -1, low) &&
           end((b + root) * inverse, m, off2, at_b, 1, high);
  }

 private:
  bool end(double s, double m, double off2, double at_b, double sign, double& out) const {
    const double along = m + s * d_s;  // times the length
    if (along >= 0 && along <= squared) {
      out = a_s + s;
      return true;
    }
    const double q2 = radius2 - (along < 0 ? off2 : at_b);
    if (!(q2 >= 0)) return false;
    out = a_s + (along < 0 ? 0 : d_s) + sign * std::sqrt(q2);
    return true;
  }
};

}  // namespace

void ContourSection::index_words() {
  const auto index = [&](auto&& edges, uint32_t id, uint32_t end, std::vector<uint32_t>& first) {
    first.resize(size_t{end} * grid_.row_words());
    for (uint32_t r = 0; r < end; ++r)
      for (size_t w = 0; w < grid_.row_words(); ++w) {
        first[r * grid_.row_words() + w] = id;
        id += static_cast<uint32_t>(std::popcount(edges(r, w)));
      }
  };
  index([&](uint32_t r, size_t w) { return horizontal(r, w); }, 0, grid_.rows(), horizontal_index_);
  index([&](uint32_t r, size_t w) { return vertical(r, w); }, horizontal_count_, grid_.rows() - 1,
        vertical_index_);
}

void ContourSection::locate_by_struts(const ContourPoints& points, const Structure& structure) {
  index_words();
  const LayerPlane& plane = grid_.plane();
  const ContourAxis &u = grid_.u_nodes(), &v = grid_.v_nodes();
  const int u_axis = plane.u_axis(), v_axis = plane.v_axis();
  const auto take = [&](Vec3 a, Vec3 b, double radius) {
    const Vec3 d = b - a;
    const double w = plane.height - a[plane.axis], d_w = d[plane.axis];
    // The part of the axis within the radius of the plane.
    double from = 0, to = 1;
    if (d_w != 0) {
      const double p = (w - radius) / d_w, q = (w + radius) / d_w;
      from = std::max(from, std::min(p, q));
      to = std::min(to, std::max(p, q));
    } else if (std::abs(w) > radius) {
      return;
    }
    if (!(from <= to)) return;
    const auto lines = [&](int s, int t, const ContourAxis& along, const ContourAxis& across,
                           auto&& put) {
      const double p = a[t] + from * d[t], q = a[t] + to * d[t];
      const CapsuleLines capsule(a[s], a[t], w, d[s], d[t], d_w, radius);
      across.for_nodes(std::min(p, q) - radius, std::max(p, q) + radius,
                       [&](uint32_t line, double at) {
                         double low, high;
                         if (!capsule.meet(at, low, high)) return;
                         if (low >= along.low() && low < along.high())
                           put(line, along.edge_of(low), true, low);
                         if (high >= along.low() && high < along.high())
                           put(line, along.edge_of(high), false, high);
                       });
    };
    lines(u_axis, v_axis, u, v, [&](uint32_t line, uint32_t edge, bool enters, double at) {
      propose(true, ContourGrid::left_edge + edge, grid_.bottom_edge() + line, enters, at);
    });
    lines(v_axis, u_axis, v, u, [&](uint32_t line, uint32_t edge, bool enters, double at) {
      propose(false, ContourGrid::left_edge + line, grid_.bottom_edge() + edge, enters, at);
    });
  };
  // Tile by tile: a box about a layer of a turned grid holds far more cells than the layer.
  const double side = max_cells_of_tile * structure.cell_length();
  const auto tiles = [&](const ContourAxis& axis) {
    return std::max(1.0, std::ceil((axis.high() - axis.low()) / side));
  };
  const double across = tiles(u), up = tiles(v);
  for (double j = 0; j < up; ++j)
    for (double i = 0; i < across; ++i) {
      const auto part = [&](const ContourAxis& axis, double n) {
        return std::min(axis.high(), axis.low() + n * side);
      };
      const Vec3 low = plane.at(part(u, i), part(v, j));
      const Vec3 high = plane.at(part(u, i + 1), part(v, j + 1));
      structure.for_each_strut({low, high}, take, points.job());
    }
}

}  // namespace msq
