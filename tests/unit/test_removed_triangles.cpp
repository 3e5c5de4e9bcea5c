// SPDX-License-Identifier: Apache-2.0
// Meshes of which triangles were removed at random, by the rule `automatic`: as large as the whole
// one, and solid elsewhere only near the holes.
#include <set>

#include "meshes.h"
#include "random.h"
#include "shape/mesh.h"
#include "shape/triangle_tree.h"
#include "suite.h"
#include "winding_number.h"

using namespace msq;
using namespace msq::test;

namespace {

struct Row {
  std::string name;
  TriangleSoup soup;
  double part;  ///< of the triangles, removed
  double edge;  ///< the longest, about
};

std::vector<Row> rows() {
  TriangleSoup ball = icosphere(0.5, 4), ring = torus_mesh(0.375, 0.125, 96, 48), pair = ball;
  append(pair, ring, {0.2, 0.1, 0.4});
  std::vector<Row> rows;
  for (const double part : {0.01, 0.05, 0.2})
    for (const auto& [name, soup, edge] :
         {std::tuple{"ball", ball, 0.045}, {"torus", ring, 0.05}, {"ball and torus", pair, 0.05}})
      rows.push_back({std::string(name) + ", " + std::to_string(part), soup, part, edge});
  return rows;
}

Ref<const Mesh> make(const TriangleSoup& soup) {
  return make_ref<Mesh>(soup, WindingRule::automatic, std::make_shared<MemoryBudget>(uint64_t{0}));
}

void test_row(void** state) {
  const Row& row = *static_cast<const Row*>(*state);
  const Ref<const Mesh> whole = make(row.soup);
  const Box3 box = whole->bounds().grown(0.1);
  for (uint64_t seed = 1; seed <= 3; ++seed) {
    const TriangleSoup left = with_holes(row.soup, row.part, seed);
    const std::set<Triangle> kept(left.triangles.begin(), left.triangles.end());
    std::vector<TreeTriangle> removed;
    for (const Triangle& t : row.soup.triangles)
      if (!kept.count(t))
        removed.emplace_back(row.soup.vertices[t[0]], row.soup.vertices[t[1]],
                             row.soup.vertices[t[2]]);
    assert_true(!removed.empty());
    const TriangleTree holes(removed, nullptr);
    const Ref<const Mesh> open = make(left);
    Random random(seed);
    size_t in_whole = 0, in_open = 0;
    double farthest = 0;
    const size_t count = std::max<size_t>(test_count(40000), 4000);
    for (size_t i = 0; i < count; ++i) {
      const Vec3 p = random.in_box(box);
      const bool was = whole->inside(p), is = open->inside(p);
      in_whole += was;
      in_open += is;
      if (was != is) farthest = std::max(farthest, holes.distance(p));
    }
    // Holes of some triangles that touch are closed about as flat as their rims are.
    if (farthest > row.edge)
      fail_msg("%s: another answer %g from the next triangle that was removed", row.name.c_str(),
               farthest);
    const double change = static_cast<double>(in_open) / static_cast<double>(in_whole) - 1;
    if (std::abs(change) > 0.02)
      fail_msg("%s: the volume changes by %g %%", row.name.c_str(), 100 * change);
  }
}

}  // namespace

int main() {
  std::vector<Row> all = rows();
  return run_for_each("removed_triangles", all, test_row);
}
