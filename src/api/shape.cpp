// SPDX-License-Identifier: Apache-2.0
#include "api/defined_handle.h"
#include "api/file_def.h"
#include "api/guard.h"
#include "api/image.h"
#include "api/shape_size.h"
#include "api/warnings.h"
#include "io/mesh_file.h"
#include "shape/all_space.h"
#include "shape/mesh.h"
#include "shape/primitive.h"
#include "shape/voxels.h"

using namespace msq;
using namespace msq::api;

namespace {

msq_mesh_def mesh_defaults() {
  msq_mesh_def def{};
  def.coordinate_type = MSQ_FLOAT64;
  def.winding_rule = MSQ_WINDING_AUTO;
  return def;
}

msq_voxels_def voxels_defaults() {
  msq_voxels_def def{};
  def.image = image_defaults();
  return def;
}

/// A handle to a new mesh.
template <class Def>
msq_shape* mesh_handle(const Context& owner, Ref<Shape> mesh, WindingRule rule, const Def& def) {
  if (rule == WindingRule::automatic) warn_of_open_mesh(owner, *mesh);
  return defined_handle<msq_shape>(mesh, def);
}

/// The mesh of what read(options) returns.
template <class Def, class Read>
msq_shape* make_mesh(const Context& owner, FileRequest request, const Def& def, msq_job* job,
                     Read&& read) {
  Job* work = job ? &object(job, "job") : nullptr;
  JobScope scope(work);
  constexpr double reading = 0.4;  // of the call
  request.options.part = {work, 0, reading};
  Ref<Shape> mesh = make_ref<Mesh>(read(request.options), request.rule, request.options.budget,
                                   JobPart{work, reading, 1});
  scope.done();
  return mesh_handle(owner, std::move(mesh), request.rule, def);
}

}  // namespace

msq_mesh_def msq::api::mesh_def(WindingRule rule) {
  msq_mesh_def def = mesh_defaults();
  def.winding_rule = static_cast<int32_t>(rule);
  return def;
}

msq_status msq_file_def_init(msq_file_def* def, size_t size) {
  return guard([&] { set_defaults(def, size, file_defaults(), "msq_file_def"); });
}

msq_status msq_shape_from_file(msq_context* context, const char* path, const msq_file_def* def,
                               msq_shape** shape, msq_job* job) {
  return guard([&] {
    Context& owner = object(context, "context");
    const Ref<const Context> keep(&owner);  // the callback may release the host's last reference
    require(path, "path");
    require(shape, "shape");
    const FileRequest request = file_request(def, owner);
    const FileDef own{path, def ? read_def(def, file_defaults(), "def") : file_defaults()};
    *shape = make_mesh(owner, request, own, job, [&](const MeshFileOptions& options) {
      return read_mesh_file(path, options);
    });
  });
}

msq_status msq_shape_from_memory(msq_context* context, const void* data, uint64_t bytes,
                                 const msq_file_def* def, msq_shape** shape, msq_job* job) {
  return guard([&] {
    Context& owner = object(context, "context");
    const Ref<const Context> keep(&owner);  // the callback may release the host's last reference
    if (!data) fail(Status::argument, "data is NULL");
    require(shape, "shape");
    const FileRequest request = file_request(def, owner);
    *shape = make_mesh(
        owner, request, mesh_def(request.rule), job,
        [&](const MeshFileOptions& options) { return read_mesh_memory(data, bytes, options); });
  });
}

msq_status msq_mesh_def_init(msq_mesh_def* def, size_t size) {
  return guard([&] { set_defaults(def, size, mesh_defaults(), "msq_mesh_def"); });
}

msq_status msq_shape_from_mesh(msq_context* context, const msq_mesh_def* def, msq_shape** shape) {
  return guard([&] {
    Context& owner = object(context, "context");
    const Ref<const Context> keep(&owner);  // the callback may release the host's last reference
    require(shape, "shape");
    const msq_mesh_def known = read_def(def, mesh_defaults(), "def");
    require_reserved(known.reserved, "reserved");
    const WindingRule rule = winding_rule(known.winding_rule);
    const PointArray points = point_array(known.vertices, known.vertex_count, known.vertex_stride,
                                          known.coordinate_type, "vertices");
    if (known.triangle_count == 0) fail(Status::mesh, "the mesh has no triangles");
    require(known.triangles, "triangles");
    if (known.triangle_count > UINT32_MAX || known.vertex_count > UINT32_MAX)
      fail(Status::limit, "the mesh has %llu triangles and %llu vertices; the limit is %u of each",
           static_cast<unsigned long long>(known.triangle_count),
           static_cast<unsigned long long>(known.vertex_count), UINT32_MAX);
    Reservation staging(owner.budget,
                        known.vertex_count * sizeof(Vec3) + known.triangle_count * sizeof(Triangle),
                        "a mesh");
    TriangleSoup soup;
    soup.vertices.resize(known.vertex_count);
    for (uint64_t i = 0; i < known.vertex_count; ++i) soup.vertices[i] = points.at(i);
    soup.triangles.resize(known.triangle_count);
    std::memcpy(soup.triangles.data(), known.triangles, known.triangle_count * sizeof(Triangle));
    staging = {};  // the mesh takes its own
    *shape = mesh_handle(owner, make_ref<Mesh>(std::move(soup), rule, owner.budget), rule,
                         mesh_def(rule));
  });
}

msq_status msq_shape_from_box(msq_context* context, const double min[3], const double max[3],
                              msq_shape** shape) {
  return guard([&] {
    object(context, "context");
    const Box3 box = read_box(min, max);
    require(shape, "shape");
    *shape = defined_handle<msq_shape>(
        make_ref<BoxShape>(box),
        BoxDef{{box.min.x, box.min.y, box.min.z}, {box.max.x, box.max.y, box.max.z}});
  });
}

msq_status msq_shape_from_sphere(msq_context* context, const double center[3], double radius,
                                 msq_shape** shape) {
  return guard([&] {
    object(context, "context");
    const Vec3 centre = require_vector(center, "center");
    require_positive(radius, "radius");
    require(shape, "shape");
    check_size(radius, centre);
    *shape = defined_handle<msq_shape>(make_ref<SphereShape>(centre, radius),
                                       SphereDef{{centre.x, centre.y, centre.z}, radius});
  });
}

msq_status msq_shape_from_cylinder(msq_context* context, const double from[3], const double to[3],
                                   double radius, msq_shape** shape) {
  return guard([&] {
    object(context, "context");
    const Vec3 a = require_vector(from, "from"), b = require_vector(to, "to");
    require_positive(radius, "radius");
    require(shape, "shape");
    check_size(radius, a);
    check_size(max_magnitude(b - a), b);
    if (!(dot(b - a, b - a) > 0))
      fail(Status::argument, "from and to are both (%g, %g, %g); they must differ", a.x, a.y, a.z);
    *shape = defined_handle<msq_shape>(make_ref<CylinderShape>(a, b, radius),
                                       CylinderDef{{a.x, a.y, a.z}, {b.x, b.y, b.z}, radius});
  });
}

msq_status msq_shape_all_space(msq_context* context, msq_shape** shape) {
  return guard([&] {
    object(context, "context");
    require(shape, "shape");
    *shape = defined_handle<msq_shape>(make_ref<AllSpace>(), AllSpaceDef{});
  });
}

msq_status msq_voxels_def_init(msq_voxels_def* def, size_t size) {
  return guard([&] { set_defaults(def, size, voxels_defaults(), "msq_voxels_def"); });
}

msq_status msq_shape_from_voxels(msq_context* context, const msq_voxels_def* def,
                                 msq_shape** shape) {
  return guard([&] {
    const Context& owner = object(context, "context");
    require(shape, "shape");
    const msq_voxels_def known = read_def(def, voxels_defaults(), "def");
    const auto solid = static_cast<Voxels::Solid>(
        require_range(known.solid, MSQ_SOLID_ABOVE, MSQ_SOLID_BELOW, "solid"));
    require_finite(known.threshold, "threshold");
    double reach = 0;
    for (int axis = 0; axis < 3; ++axis)
      reach += static_cast<double>(known.image.size[axis]) * known.image.grid.cell_size[axis];
    const Vec3 origin = require_vector(known.image.grid.origin, "grid.origin");
    Image image = read_image(known.image, 2, owner.budget);
    check_size(reach, origin);
    *shape = defined_handle<msq_shape>(make_ref<Voxels>(std::move(image), known.threshold, solid),
                                       VoxelsDef{known, {}});
  });
}

void msq_shape_retain(msq_shape* shape) {
  retain(shape);
}
void msq_shape_release(msq_shape* shape) {
  release(shape);
}

msq_status msq_shape_info(const msq_shape* shape, msq_shape_report* report) {
  return guard([&] {
    const ShapeFacts& facts = object(shape, "shape").facts();
    msq_shape_report known{};
    known.is_mesh = facts.is_mesh;
    for (int axis = 0; axis < 3; ++axis) {
      known.min[axis] = facts.bounds.min[axis];
      known.max[axis] = facts.bounds.max[axis];
    }
    known.volume = facts.volume;
    known.area = facts.area;
    known.vertices = facts.vertices;
    known.triangles = facts.triangles;
    known.degenerate_triangles = facts.degenerate_triangles;
    known.duplicate_triangles = facts.duplicate_triangles;
    known.open_edges = facts.open_edges;
    known.non_manifold_edges = facts.non_manifold_edges;
    known.flipped_edges = facts.flipped_edges;
    known.closed = facts.closed;
    write_report(report, known, "report");
  });
}

msq_status msq_shape_self_intersections(const msq_shape* shape, uint64_t* pairs, msq_job* job) {
  return guard([&] {
    const Shape& known = object(shape, "shape");
    require(pairs, "pairs");
    Job* work = job ? &object(job, "job") : nullptr;
    JobScope scope(work);
    const uint64_t found = known.self_intersections(work);
    scope.done();
    *pairs = found;
  });
}
