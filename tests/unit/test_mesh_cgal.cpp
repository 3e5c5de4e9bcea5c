// SPDX-License-Identifier: Apache-2.0
// Meshes against an independent judge: CGAL's side of a closed triangle mesh, decided exactly. A
// point may differ only within 1e-9 of the mesh's size from the surface.
#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>

#include <cstdio>
#include <tuple>

#include "meshes.h"
#include "msq_test.h"
#include "random.h"
#include "shape/mesh.h"

using namespace msq;
using namespace msq::test;

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using SurfaceMesh = CGAL::Surface_mesh<Point>;
using Primitive = CGAL::AABB_face_graph_triangle_primitive<SurfaceMesh>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

/// Triangles of a binary STL file, vertices not shared; none if there is no such file.
TriangleSoup read_stl(const char* path) {
  TriangleSoup soup;
  std::FILE* file = std::fopen(path, "rb");
  if (!file) return soup;
  char header[80];
  uint32_t count = 0;
  if (std::fread(header, 1, 80, file) != 80 || std::fread(&count, 4, 1, file) != 1) count = 0;
  for (uint32_t i = 0; i < count; ++i) {
    unsigned char record[50];
    if (std::fread(record, 1, sizeof record, file) != sizeof record) break;
    float v[9];
    std::memcpy(v, record + 12, sizeof v);
    const uint32_t first = static_cast<uint32_t>(soup.vertices.size());
    for (int n = 0; n < 3; ++n) soup.vertices.push_back({v[3 * n], v[3 * n + 1], v[3 * n + 2]});
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  std::fclose(file);
  return soup;
}

SurfaceMesh to_cgal(const TriangleSoup& soup) {
  SurfaceMesh mesh;
  std::map<std::tuple<double, double, double>, SurfaceMesh::Vertex_index> known;
  std::vector<SurfaceMesh::Vertex_index> vertex;
  for (const Vec3& v : soup.vertices) {
    const auto [found, is_new] = known.try_emplace({v.x, v.y, v.z});
    if (is_new) found->second = mesh.add_vertex(Point(v.x, v.y, v.z));
    vertex.push_back(found->second);
  }
  for (const Triangle& t : soup.triangles)
    if (mesh.add_face(vertex[t[0]], vertex[t[1]], vertex[t[2]]) == SurfaceMesh::null_face())
      fail_msg("CGAL does not take a triangle");
  assert_true(CGAL::is_closed(mesh));
  return mesh;
}

void compare(const char* name, const TriangleSoup& soup, size_t count) {
  const Mesh mesh(soup, WindingRule::nonzero, std::make_shared<MemoryBudget>(uint64_t{0}));
  const SurfaceMesh surface = to_cgal(soup);
  Tree tree(faces(surface).first, faces(surface).second, surface);
  const CGAL::Side_of_triangle_mesh<SurfaceMesh, Kernel> side(tree);
  const Box3 box = mesh.bounds();
  const double near = 1e-9 * max_component(box.extent());
  Random random(17);
  size_t differ = 0, at_surface = 0, held = 0;
  for (size_t i = 0; i < count; ++i) {
    Vec3 p = random.in_box(box);
    if (i % 4 == 1) {  // beside a triangle
      const Triangle& t = mesh.triangles()[random.below(mesh.triangles().size())];
      double u = random.unit(), v = random.unit();
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const Vec3 a = mesh.vertices()[t[0]], b = mesh.vertices()[t[1]], c = mesh.vertices()[t[2]];
      const double away = std::pow(10, random.between(-9, -1)) * max_component(box.extent());
      p = a + (b - a) * u + (c - a) * v +
          Vec3{random.normal(), random.normal(), random.normal()} * away;
    } else if (i % 4 == 2) {  // in line with a vertex
      const Vec3 v = mesh.vertices()[random.below(mesh.vertices().size())];
      p = {p.x, v.y, v.z};
    }
    const Point point(p.x, p.y, p.z);
    const CGAL::Bounded_side where = side(point);
    const bool is_inside = mesh.inside(p);
    held += is_inside;
    if (is_inside == (where != CGAL::ON_UNBOUNDED_SIDE)) continue;
    if (std::sqrt(tree.squared_distance(point)) <= near) {
      ++at_surface;
      continue;
    }
    if (!differ++)
      print_error("(%.17g, %.17g, %.17g): msq %d, CGAL %d\n", p.x, p.y, p.z, is_inside, where);
  }
  print_message("%s: %zu points, %zu inside, %zu differ at the surface, %zu elsewhere\n", name,
                count, held, at_surface, differ);
  assert_int_equal(differ, 0);
  assert_in_range(held, 1, count - 1);
}

void test_icosphere(void**) {
  compare("icosphere", icosphere(1, 4), test_count(300000));
}
void test_torus(void**) {
  compare("torus", torus_mesh(3, 1, 90, 37), test_count(300000));
}

void test_nested(void**) {
  TriangleSoup soup = icosphere(2, 3);
  append(soup, inside_out(icosphere(1, 3)), {0.3, 0.2, -0.1});
  append(soup, torus_mesh(0.5, 0.1, 30, 11), {0.3, 0.2, -0.1});
  compare("ring in a hollow ball", soup, test_count(200000));
}

void test_bracket(void**) {
  const TriangleSoup soup = read_stl(MSQ_SOURCE_DIR "/examples/parts/bracket.stl");
  if (soup.triangles.empty()) {
    print_message("no bracket.stl in this tree\n");
    return;
  }
  compare("bracket", soup, test_count(200000));
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(test_icosphere), cmocka_unit_test(test_torus),
                              cmocka_unit_test(test_nested), cmocka_unit_test(test_bracket)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
