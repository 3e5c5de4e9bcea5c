// SPDX-License-Identifier: Apache-2.0
// Files of beam lattices.
#include <optional>

#include "api/defined_handle.h"
#include "api/file_def.h"
#include "api/guard.h"
#include "api/warnings.h"
#include "base/ref.h"

namespace msq {

/// What a handle of a file of beams stands for.
class StoredBeams final : public RefCounted {
 public:
  StoredBeams(BeamFile file, const std::shared_ptr<MemoryBudget>& budget)
      : file_(std::move(file)), memory_(budget, bytes_of(file_), "the beams of a file") {}

  const TriangleSoup& mesh() const { return file_.mesh; }
  uint64_t size() const { return file_.lattices.size(); }
  const BeamLattice& lattice(uint64_t i) const {
    if (i >= size())
      fail(Status::argument, "lattice is %llu; the file has %llu",
           static_cast<unsigned long long>(i), static_cast<unsigned long long>(size()));
    return file_.lattices[i];
  }

 private:
  static uint64_t bytes_of(const BeamFile& file) {
    uint64_t bytes =
        file.mesh.vertices.size() * sizeof(Vec3) + file.mesh.triangles.size() * sizeof(Triangle);
    for (const BeamLattice& lattice : file.lattices) bytes += lattice.bytes();
    return bytes;
  }

  const BeamFile file_;
  const Reservation memory_;
};

namespace api {

template <>
struct ObjectOf<msq_beam_file> {
  using type = StoredBeams;
};

}  // namespace api
}  // namespace msq

using namespace msq;
using namespace msq::api;

namespace {

template <class Read>
msq_beam_file* make_file(const Context& owner, const msq_file_def* def, msq_job* job, Read&& read) {
  FileRequest request = file_request(def, owner);
  Job* work = job ? &object(job, "job") : nullptr;
  JobScope scope(work);
  request.options.part = {work, 0, 1};
  Ref<StoredBeams> made = make_ref<StoredBeams>(read(request.options), owner.budget);
  scope.done();
  return new_handle<msq_beam_file>(std::move(made));
}

/// Contains all beams and balls, whatever the caps: their ends with the balls there.
Box3 box_of(const BeamLattice& lattice) {
  std::optional<Box3> box;
  const auto add = [&](uint32_t node, double radius) {
    const Vec3 p = lattice.nodes[node], r{radius, radius, radius};
    box = box ? Box3{min(box->min, p - r), max(box->max, p + r)} : Box3{p - r, p + r};
  };
  for (size_t i = 0; i < lattice.beams.size(); ++i)
    for (size_t end : {0, 1}) add(lattice.beams[i][end], lattice.radii[i][end]);
  for (size_t i = 0; i < lattice.balls.size(); ++i) add(lattice.balls[i], lattice.ball_radii[i]);
  return *box;
}

}  // namespace

msq_status msq_beam_file_open(msq_context* context, const char* path, const msq_file_def* def,
                              msq_beam_file** file, msq_job* job) {
  return guard([&] {
    const Ref<const Context> owner(&object(context, "context"));
    require(path, "path");
    require(file, "file");
    *file = make_file(*owner, def, job, [&](const MeshFileOptions& options) {
      return read_beam_file(path, options);
    });
  });
}

msq_status msq_beam_file_open_memory(msq_context* context, const void* data, uint64_t bytes,
                                     const msq_file_def* def, msq_beam_file** file, msq_job* job) {
  return guard([&] {
    const Ref<const Context> owner(&object(context, "context"));
    if (!data) fail(Status::argument, "data is NULL");
    require(file, "file");
    *file = make_file(*owner, def, job, [&](const MeshFileOptions& options) {
      return read_beam_memory(data, bytes, options);
    });
  });
}

void msq_beam_file_retain(msq_beam_file* file) {
  retain(file);
}
void msq_beam_file_release(msq_beam_file* file) {
  release(file);
}

msq_status msq_beam_file_info(const msq_beam_file* file, uint64_t lattice,
                              msq_beam_file_report* report) {
  return guard([&] {
    const StoredBeams& known = object(file, "file");
    const BeamLattice& of = known.lattice(lattice);
    msq_beam_file_report found{};
    found.clipping = static_cast<int32_t>(of.clipping);
    found.lattice_count = known.size();
    found.mesh_triangle_count = known.mesh().triangles.size();
    found.node_count = of.nodes.size();
    found.beam_count = of.beams.size();
    found.ball_count = of.balls.size();
    found.clipping_triangle_count = of.clip.triangles.size();
    const Box3 box = box_of(of);
    for (int axis = 0; axis < 3; ++axis) {
      found.min[axis] = box.min[axis];
      found.max[axis] = box.max[axis];
    }
    write_report(report, found, "report");
  });
}

msq_status msq_beam_file_beams(const msq_beam_file* file, uint64_t lattice, msq_beams_def* def) {
  return guard([&] {
    const BeamLattice& of = object(file, "file").lattice(lattice);
    msq_beams_def found{};
    found.cap = MSQ_CAP_SPHERE;
    found.coordinate_type = MSQ_FLOAT64;
    found.nodes = of.nodes.data();
    found.node_count = of.nodes.size();
    if (!of.beams.empty()) {
      found.beams = of.beams[0].data();
      found.beam_count = of.beams.size();
      found.radii = of.radii.data();
      found.caps = of.caps[0].data();
    }
    if (!of.balls.empty()) {
      found.balls = of.balls.data();
      found.ball_count = of.balls.size();
      found.ball_radii = of.ball_radii.data();
    }
    write_report(def, found, "def");
  });
}

msq_status msq_beam_file_shape(msq_context* context, const msq_beam_file* file, uint64_t lattice,
                               int32_t mesh, int32_t rule, msq_shape** shape) {
  return guard([&] {
    Context& owner = object(context, "context");
    const Ref<const Context> keep(&owner);  // the callback may release the host's last reference
    const StoredBeams& known = object(file, "file");
    const BeamLattice& of = known.lattice(lattice);
    const bool is_solid = require_range(mesh, MSQ_BEAM_FILE_SOLID, MSQ_BEAM_FILE_CLIPPING,
                                        "mesh") == MSQ_BEAM_FILE_SOLID;
    if (is_solid && lattice != 0)
      fail(Status::argument, "lattice is %llu; the solid mesh is that of all, and needs 0",
           static_cast<unsigned long long>(lattice));
    const WindingRule known_rule = winding_rule(rule);
    require(shape, "shape");
    const TriangleSoup& soup = is_solid ? known.mesh() : of.clip;
    if (soup.triangles.empty())
      fail(Status::mesh,
           is_solid ? "the file has no mesh besides its beams" : "no mesh clips this lattice");
    const Ref<Shape> made = make_ref<Mesh>(TriangleSoup(soup), known_rule, owner.budget);
    if (known_rule == WindingRule::automatic) warn_of_open_mesh(owner, *made);
    *shape = defined_handle<msq_shape>(made, mesh_def(known_rule));
  });
}
