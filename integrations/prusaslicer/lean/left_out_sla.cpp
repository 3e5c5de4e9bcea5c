// SPDX-License-Identifier: Apache-2.0
// Functions for resin printers whose files this build leaves out. Calls of them throw: hollowing,
// drain holes, supports and pads are not to be had. Those without an effect are called even if all
// of these are off.
#include "libslic3r/MeshBoolean.hpp"
#include "libslic3r/SLA/Hollowing.hpp"
#include "libslic3r/SLA/IndexedMesh.hpp"
#include "libslic3r/SLA/Pad.hpp"
#include "libslic3r/SLA/SupportPointGenerator.hpp"
#include "libslic3r/SLA/SupportTree.hpp"

namespace Slic3r {

[[noreturn]] static void leave_out() {
  throw RuntimeError(
      "this build of libslic3r leaves out hollowing, drain holes, supports and pads");
}

namespace sla {
struct Interior {};
class IndexedMesh::AABBImpl {};

void InteriorDeleter::operator()(Interior* interior) {
  delete interior;
}
indexed_triangle_set& get_mesh(Interior&) {
  leave_out();
}
const indexed_triangle_set& get_mesh(const Interior&) {
  leave_out();
}
InteriorPtr generate_interior(const TriangleMesh&, const HollowingConfig&, const JobController&) {
  leave_out();
}
void hollow_mesh(TriangleMesh&, const Interior&, int) {
  leave_out();
}
void remove_inside_triangles(TriangleMesh&, const Interior&, const std::vector<bool>&) {
  leave_out();
}
double get_distance(const Vec3f&, const Interior&) {
  leave_out();
}
indexed_triangle_set DrainHole::to_mesh() const {
  leave_out();
}
bool DrainHole::operator==(const DrainHole&) const {
  leave_out();
}

IndexedMesh::IndexedMesh(const indexed_triangle_set&, bool) {
  leave_out();
}
IndexedMesh::~IndexedMesh() {}
SupportPointGenerator::SupportPointGenerator(const IndexedMesh& mesh,
                                             const std::vector<ExPolygons>&,
                                             const std::vector<float>&, const Config&,
                                             std::function<void()>, std::function<void(int)>)
    : m_emesh(mesh) {
  leave_out();
}
void remove_bottom_points(std::vector<SupportPoint>&, float) {
  leave_out();
}
SupportTree::UPtr SupportTree::create(const SupportableMesh&, const JobController&) {
  leave_out();
}
std::vector<ExPolygons> SupportTree::slice(const std::vector<float>&, float) const {
  leave_out();
}
void pad_blueprint(const indexed_triangle_set&, ExPolygons&, float, float, ThrowOnCancel) {
  leave_out();
}
std::string PadConfig::validate() const {
  return {};
}
}  // namespace sla

namespace MeshBoolean::cgal {
struct CGALMesh {};

void CGALMeshDeleter::operator()(CGALMesh* mesh) {
  delete mesh;
}
std::unique_ptr<CGALMesh, CGALMeshDeleter> triangle_mesh_to_cgal(
    const std::vector<stl_vertex>&, const std::vector<stl_triangle_vertex_indices>&) {
  leave_out();
}
TriangleMesh cgal_to_triangle_mesh(const CGALMesh&) {
  leave_out();
}
void minus(CGALMesh&, CGALMesh&) {
  leave_out();
}
void plus(CGALMesh&, CGALMesh&) {
  leave_out();
}
bool does_self_intersect(const CGALMesh&) {
  leave_out();
}
bool does_bound_a_volume(const CGALMesh&) {
  leave_out();
}
bool empty(const CGALMesh&) {
  leave_out();
}
}  // namespace MeshBoolean::cgal

}  // namespace Slic3r
