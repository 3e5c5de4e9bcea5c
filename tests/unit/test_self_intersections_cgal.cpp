// SPDX-License-Identifier: Apache-2.0
// Self-intersections against CGAL's own function, on the manifold meshes that it takes. It gives
// each triangle without area as a pair with itself; those are not compared.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <chrono>
#include <thread>

#include "meshes.h"
#include "msq_test.h"
#include "shape/self_intersections.h"

using namespace msq;
using namespace msq::test;

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;
using FacePair = std::pair<SurfaceMesh::Face_index, SurfaceMesh::Face_index>;

Mesh to_mesh(const TriangleSoup& soup) {
  return Mesh(soup, WindingRule::nonzero, std::make_shared<MemoryBudget>(uint64_t{0}));
}

SurfaceMesh to_cgal(const TriangleSoup& soup) {
  SurfaceMesh mesh;
  std::vector<SurfaceMesh::Vertex_index> vertex;
  for (const Vec3& v : soup.vertices)
    vertex.push_back(mesh.add_vertex(Kernel::Point_3(v.x, v.y, v.z)));
  for (const Triangle& t : soup.triangles)
    if (mesh.add_face(vertex[t[0]], vertex[t[1]], vertex[t[2]]) == SurfaceMesh::null_face())
      fail_msg("CGAL does not take a triangle");
  return mesh;
}

void compare(const char* name, const TriangleSoup& soup, bool is_clean) {
  const Mesh mesh = to_mesh(soup);
  assert_int_equal(mesh.facts().vertices, soup.vertices.size());  // CGAL welds nothing
  std::vector<FacePair> theirs;
  CGAL::Polygon_mesh_processing::self_intersections(to_cgal(soup), std::back_inserter(theirs));
  size_t flat = 0;
  for (const auto& [a, b] : theirs) flat += a == b;
  const uint64_t pairs = count_self_intersections(mesh, nullptr);
  print_message("%s: %zu triangles, %zu without area, %llu pairs\n", name, soup.triangles.size(),
                flat, static_cast<unsigned long long>(pairs));
  assert_int_equal(pairs, theirs.size() - flat);
  assert_int_equal(pairs == 0, is_clean);
}

/// A ball whose top is pushed out through its bottom.
TriangleSoup dented_ball() {
  TriangleSoup soup = icosphere(1, 5);
  for (Vec3& v : soup.vertices)
    if (v.z > 0.5) v.z -= 6 * (v.z - 0.5);
  return soup;
}

/// A sheet of n by n squares in the plane z = 0, folded along a line that is no row of vertices. In
/// some squares a triangle has lost its area.
TriangleSoup folded_sheet(uint32_t n) {
  TriangleSoup soup;
  for (uint32_t j = 0; j <= n; ++j)
    for (uint32_t i = 0; i <= n; ++i)
      soup.vertices.push_back({std::abs(i - 0.5 * n + 0.125), static_cast<double>(j), 0});
  for (uint32_t j = 0; j < n; ++j)
    for (uint32_t i = 0; i < n; ++i) {
      const uint32_t a = j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
      soup.triangles.push_back({a, b, c});
      soup.triangles.push_back({a, c, d});
      if (i % 5 == 3 && j % 7 == 2) soup.vertices[b] = (soup.vertices[a] + soup.vertices[c]) * 0.5;
    }
  return soup;
}

void test_clean(void**) {
  compare("ball", icosphere(1, 4), true);
  compare("ring", torus_mesh(3, 1, 90, 57), true);
}
void test_ring_through_itself(void**) {
  compare("ring through itself", torus_mesh(1, 1.5, 101, 53), false);
}
void test_ball_through_itself(void**) {
  compare("ball through itself", dented_ball(), false);
}
void test_linked_rings(void**) {
  TriangleSoup soup = torus_mesh(3, 1, 80, 31);
  append(soup, torus_mesh(3, 1, 80, 31), {2.1, 0.3, 0.2});
  compare("crossing rings", soup, false);
}
void test_folded_sheet(void**) {
  compare("folded sheet", folded_sheet(70), false);
}

/// All boxes meet: minutes if it were not cancelled, and the test's time limit says that it is.
void test_cancel_while_at_work(void**) {
  TriangleSoup soup;
  for (uint32_t i = 0; i < 100000; ++i) {
    const double u = i * 1e-3;
    soup.vertices.insert(soup.vertices.end(), {{-1, -1, u}, {1, 1, u}, {-1, 1, u + 200}});
    soup.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const Mesh mesh = to_mesh(soup);
  const Ref<Job> job = make_ref<Job>();
  std::thread host([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    job->cancel();
  });
  Status status = Status::internal;
  try {
    count_self_intersections(mesh, job.get());
  } catch (const Error& error) {
    status = error.status;
  }
  host.join();
  assert_int_equal(status, Status::cancelled);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(test_clean),
      cmocka_unit_test(test_ring_through_itself),
      cmocka_unit_test(test_ball_through_itself),
      cmocka_unit_test(test_linked_rings),
      cmocka_unit_test(test_folded_sheet),
      cmocka_unit_test(test_cancel_while_at_work),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
