// SPDX-License-Identifier: Apache-2.0
// Foams of varying seed density against a global Delaunay triangulation (CGAL) of all seeds of a
// box: membership is the distance to the dual edges of the whole diagram, and the edges of the
// bricks are those dual edges.
#include <string>

#include "field/gradient.h"
#include "foam_diagram.h"
#include "graded_cells.h"
#include "random.h"
#include "structure/foam/edges/graded_edges.h"
#include "structure/foam/foam.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

/// A grid whose largest cell size is 1, so that foam units are model units.
Neighbourhood turned_grid() {
  const double c = std::cos(0.7), s = std::sin(0.7), d = std::cos(-1.1), t = std::sin(-1.1);
  return {{0.3, 0.2, -0.7}, {1, 0.5, 0.75}, {{c, -s * d, s * t, s, c * d, -c * t, 0, t, d}}};
}

/// A box of cells [-half, half)^3, of which [-middle, middle]^3 is asked. Seeds beyond the box
/// neither own nor cut edges there: balls that hold no seed have radius below 1.74.
struct DensityRow {
  std::string name;
  double jitter;
  int half, middle;
  std::vector<double> radii;  ///< in cells
  double low, high;           ///< density: along a line through the grid's origin, over `length`
  double length;
  Vec3 direction;
  Neighbourhood grid = {};

  Parameter density() const {
    if (low == high) return Parameter(low);
    const Vec3 reach = direction * (0.5 * length / msq::length(direction));
    return Parameter(Ref<const Field>(
        make_ref<GradientField>(grid.origin - reach, low, grid.origin + reach, high)));
  }
  std::shared_ptr<const GradedSeeds> seeds() const {
    return std::make_shared<const GradedSeeds>(FoamSeeds(77, jitter, grid.cell_size), grid,
                                               density());
  }
};

std::vector<DensityRow> density_rows() {
  const Vec3 x{1, 0, 0}, oblique{1, 0.7, -0.4};
  return {
      {"constant 3", 1, 7, 3, {0.05, 0.2, 0.5}, 3, 3, 0, x},
      {"constant 8", 1, 5, 2, {0.03, 0.13, 0.25}, 8, 8, 0, x},
      {"linear 1 to 64", 1, 6, 2, {0.02, 0.1, 0.3}, 1, 64, 4, oblique},
      {"step 1 to 512", 1, 5, 1, {0.01, 0.05, 0.2}, 1, 512, 0.2, oblique},
      {"linear 1 to 64, jitter 0.2", 0.2, 6, 2, {0.02, 0.1}, 1, 64, 4, x},
      {"linear 1 to 100, turned, uneven", 1, 6, 2, {0.015, 0.1}, 1, 100, 3, x, turned_grid()},
  };
}

double squared_distance(const DualEdge& edge, Vec3 p) {
  const Vec3 ab = edge.b - edge.a, ap = p - edge.a;
  const double l2 = dot(ab, ab);
  const double t = l2 > 0 ? std::clamp(dot(ap, ab) / l2, 0.0, 1.0) : 0;
  const Vec3 d = ap - ab * t;
  return dot(d, d);
}

/// Edges by the boxes of 1/8 that they come within a distance of.
class EdgeGrid {
 public:
  EdgeGrid(const std::vector<DualEdge>& edges, int middle, double reach)
      : edges_(edges), middle_(middle), size_(2 * middle * bins), bins_(size_ * size_ * size_) {
    for (uint32_t e = 0; e < edges.size(); ++e) {
      const Vec3 low = min(edges[e].a, edges[e].b), high = max(edges[e].a, edges[e].b);
      int from[3], to[3];
      for (int axis = 0; axis < 3; ++axis) {
        from[axis] =
            static_cast<int>(std::max(0.0, std::floor(bins * (low[axis] - reach + middle))));
        to[axis] = static_cast<int>(
            std::min(size_ - 1.0, std::floor(bins * (high[axis] + reach + middle))));
      }
      const double close = reach + 0.5 * std::sqrt(3.0) / bins;  // from the middle of a box
      for (int z = from[2]; z <= to[2]; ++z)
        for (int y = from[1]; y <= to[1]; ++y)
          for (int x = from[0]; x <= to[0]; ++x) {
            const Vec3 centre = Vec3{x + 0.5, y + 0.5, z + 0.5} * (1.0 / bins) -
                                Vec3{double(middle), double(middle), double(middle)};
            if (squared_distance(edges[e], centre) <= close * close * (1 + 1e-9))
              bins_[(z * size_ + y) * size_ + x].push_back(e);
          }
    }
  }
  /// Exact up to the reach.
  double distance(Vec3 p) const {
    const auto bin = [&](double v) {
      return std::min(size_ - 1, static_cast<int>(bins * (v + middle_)));
    };
    double least = 1e300;
    for (uint32_t e : bins_[(bin(p.z) * size_ + bin(p.y)) * size_ + bin(p.x)])
      least = std::min(least, squared_distance(edges_[e], p));
    return std::sqrt(least);
  }

 private:
  static constexpr int bins = 8;
  const std::vector<DualEdge>& edges_;
  int middle_, size_;
  std::vector<std::vector<uint32_t>> bins_;
};

struct Diagram {
  std::vector<GradedSeed> seeds;
  std::vector<DualEdge> edges;
};

Diagram diagram_of(const DensityRow& row) {
  Diagram diagram;
  diagram.seeds = graded_cells(*row.seeds(), -row.half, row.half);
  std::vector<Vec3> positions;
  for (const GradedSeed& seed : diagram.seeds) positions.push_back(seed.position);
  diagram.edges = dual_edges(positions);
  return diagram;
}

void check_membership(const DensityRow& row, const Diagram& diagram) {
  const size_t count = test_count(60000) / row.radii.size();
  Random random(3);
  for (double radius : row.radii) {
    const EdgeGrid grid(diagram.edges, row.middle, radius + 0.01);
    const Ref<Foam> foam =
        make_ref<Foam>(make_ref<Context>(1u, uint64_t{0}, uint64_t{0}), row.grid, Parameter(radius),
                       row.jitter, uint64_t{77}, FoamMethod::direct, row.density());
    size_t held = 0, near = 0, differ = 0;
    for (size_t i = 0; i < count; ++i) {
      const Vec3 p = random.in_box(Box3{}.grown(row.middle)) * row.grid.cell_size;
      const double distance = grid.distance(p);
      const bool is_inside = foam->inside(row.grid.from_grid(p));
      held += is_inside;
      if (i % 4 == 0) {  // distances, as far as the edges at hand reach
        const double d = foam->distance(row.grid.from_grid(p));
        assert_true(is_inside ? d <= 0 : d > 0);
        if (distance < radius + 0.009)
          assert_true(std::abs(d - (distance - radius)) <= 3e-9);
        else
          assert_true(d > 0.008);
      }
      if (is_inside == (distance <= radius)) continue;
      if (std::abs(distance - radius) <= 1e-9) {
        ++near;
        continue;
      }
      if (!differ++)
        print_error("(%.17g, %.17g, %.17g) is %.17g from an edge; msq: %d at radius %g\n", p.x, p.y,
                    p.z, distance, is_inside, radius);
    }
    print_message(
        "%zu seeds, r %g: %zu points, %zu inside, %zu differ within 1e-9, %zu elsewhere\n",
        diagram.seeds.size(), radius, count, held, near, differ);
    assert_int_equal(differ, 0);
  }
}

void check_edges(const DensityRow& row, const Diagram& diagram) {
  const std::shared_ptr<const GradedSeeds> seeds = row.seeds();
  const int side = seeds->brick_side(), bricks = (2 * row.middle + side - 1) / side;
  const auto corner = [&](int i) { return i * side - row.middle; };
  const auto brick_of = [&](CellIndex c) {
    const int at[3] = {c.x + row.middle, c.y + row.middle, c.z + row.middle};
    if (std::min({at[0], at[1], at[2]}) < 0 || std::max({at[0], at[1], at[2]}) >= bricks * side)
      return -1;
    return (at[2] / side * bricks + at[1] / side) * bricks + at[0] / side;
  };
  std::vector<std::vector<DualEdge>> expected(bricks * bricks * bricks);
  for (const DualEdge& e : diagram.edges) {
    const int brick = brick_of(diagram.seeds[e.first].leaf.cell);
    if (brick >= 0) expected[brick].push_back(e);
  }
  size_t count = 0, missing = 0, extra = 0;
  double worst = 0;
  for (int z = 0; z < bricks; ++z)
    for (int y = 0; y < bricks; ++y)
      for (int x = 0; x < bricks; ++x) {
        const CellIndex cell{corner(x), corner(y), corner(z)};
        const Vec3 shift =
            Vec3{double(cell.x), double(cell.y), double(cell.z)} * row.grid.cell_size;
        const auto brick = graded_edge_brick(seeds, cell);
        // By their middles along x, so that partners are found fast.
        std::vector<std::pair<double, DualEdge>> built;
        for (const FoamEdge& e : brick->edges()) {
          const DualEdge edge{shift + Vec3{e.a[0], e.a[1], e.a[2]},
                              shift + Vec3{e.b[0], e.b[1], e.b[2]}, 0};
          built.push_back({edge.a.x + edge.b.x, edge});
        }
        std::sort(built.begin(), built.end(),
                  [](const auto& a, const auto& b) { return a.first < b.first; });
        std::vector<bool> used(built.size());
        for (const DualEdge& e : expected[(z * bricks + y) * bricks + x]) {
          const double at = e.a.x + e.b.x;
          size_t i = static_cast<size_t>(
              std::lower_bound(built.begin(), built.end(), at - 4 * edge_error,
                               [](const auto& b, double value) { return b.first < value; }) -
              built.begin());
          double best = 1e300;
          size_t best_at = 0;
          for (; i < built.size() && built[i].first <= at + 4 * edge_error; ++i) {
            if (used[i]) continue;
            const DualEdge& b = built[i].second;
            const double d = std::min(std::max(max_magnitude(b.a - e.a), max_magnitude(b.b - e.b)),
                                      std::max(max_magnitude(b.a - e.b), max_magnitude(b.b - e.a)));
            if (d < best) best = d, best_at = i;
          }
          ++count;
          if (best > edge_error) {  // ends are single precision
            if (!missing++)
              print_error("no edge from (%.12g, %.12g, %.12g) to (%.12g, %.12g, %.12g)\n", e.a.x,
                          e.a.y, e.a.z, e.b.x, e.b.y, e.b.z);
            continue;
          }
          worst = std::max(worst, best);
          used[best_at] = true;
        }
        for (bool is_used : used) extra += !is_used;
      }
  print_message("%zu edges, %zu missing, %zu extra, ends within %g\n", count, missing, extra,
                worst);
  assert_int_equal(missing, 0);
  assert_int_equal(extra, 0);
  assert_true(count > 1000);
}

void test_row(void** state) {
  const DensityRow& row = *static_cast<const DensityRow*>(*state);
  const Diagram diagram = diagram_of(row);
  check_membership(row, diagram);
  check_edges(row, diagram);
}

}  // namespace

int main() {
  std::vector<DensityRow> rows = density_rows();
  return run_for_each("graded foam", rows, test_row);
}
