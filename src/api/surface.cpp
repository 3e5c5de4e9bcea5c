// SPDX-License-Identifier: Apache-2.0
// Triangles of a model's boundary.
#include "api/guard.h"
#include "api/host.h"
#include "surface/mesh_file.h"

using namespace msq;
using namespace msq::api;

namespace {

msq_surface_def surface_defaults() {
  return {};
}

MeshPlan read_plan(const msq_surface_def& def) {
  MeshPlan plan;
  plan.has_box = require_range(def.has_box, 0, 1, "has_box") != 0;
  for (int axis = 0; axis < 3; ++axis)
    if (!plan.has_box && (def.min[axis] != 0 || def.max[axis] != 0))
      fail(Status::argument, "a box is given from %g to %g along axis %d, and has_box is 0",
           def.min[axis], def.max[axis], axis);
  if (plan.has_box) {
    plan.box = {require_vector(def.min, "min"), require_vector(def.max, "max")};
    for (int axis = 0; axis < 3; ++axis)
      if (!(plan.box.min[axis] < plan.box.max[axis]))
        fail(Status::argument, "min is %g and max is %g along axis %d; min must be less",
             plan.box.min[axis], plan.box.max[axis], axis);
  }
  plan.pitch = require_positive(def.pitch, "pitch");
  plan.length_scale = require_zero_or_more(def.length_scale, "length_scale");
  plan.slab_layers = def.slab_layers;
  require_reserved(def.reserved, "reserved");
  return plan;
}

/// A call, and what it keeps alive: callbacks may release the host's last references.
struct SurfaceCall {
  SurfaceCall(const msq_model* model, const msq_surface_def* def, msq_job* job)
      : model(&object(model, "model")),
        plan(read_plan(read_def(def, surface_defaults(), "def"))),
        job(job ? &object(job, "job") : nullptr) {}

  const Ref<const Model> model;
  const MeshPlan plan;
  Job* const job;
};

}  // namespace

msq_status msq_surface_def_init(msq_surface_def* def, size_t size) {
  return guard([&] { set_defaults(def, size, surface_defaults(), "msq_surface_def"); });
}

msq_status msq_surface_mesh(const msq_model* model, const msq_surface_def* def, msq_surface_fn fn,
                            void* user, msq_job* job) {
  return guard([&] {
    const SurfaceCall call(model, def, job);
    if (!fn) fail(Status::argument, "fn is NULL");
    JobScope scope(call.job);
    make_mesh(*call.model, call.plan,
              [&](const MeshSlab& slab) {
                msq_surface_slab view{};
                view.struct_size = sizeof view;
                view.first_vertex = slab.first_vertex;
                view.vertex_count = slab.vertex_count;
                view.vertices = coordinates(slab.vertices);
                view.normals = slab.normals;
                view.first_triangle = slab.first_triangle;
                view.triangle_count = slab.triangle_count;
                view.triangles = slab.triangles;
                check_code(call_host(fn, user, static_cast<const msq_surface_slab*>(&view)),
                           "of surfaces");
              },
              {call.job, 0, 1});
    scope.done();
  });
}

msq_status msq_surface_file(const msq_model* model, const msq_surface_def* def, int32_t format,
                            msq_file_fn fn, void* user, msq_job* job) {
  return guard([&] {
    const SurfaceCall call(model, def, job);
    const SurfaceFormat known = static_cast<SurfaceFormat>(
        require_range(format, MSQ_SURFACE_STL, MSQ_SURFACE_PLY, "format"));
    if (!fn) fail(Status::argument, "fn is NULL");
    JobScope scope(call.job);
    write_mesh(
        *call.model, call.plan, known,
        [&](const FilePart& part) {
          msq_file_part view{};
          view.struct_size = sizeof view;
          view.offset = part.offset;
          view.size = part.size;
          view.total = part.total;
          view.bytes = part.bytes;
          check_code(call_host(fn, user, static_cast<const msq_file_part*>(&view)), "of files");
        },
        call.job);
    scope.done();
  });
}
