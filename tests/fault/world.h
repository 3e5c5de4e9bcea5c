// SPDX-License-Identifier: Apache-2.0
// Small objects of every kind, for one scenario; all are released with it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "stage.h"

namespace msq::test {

inline void release(msq_context* handle) {
  msq_context_release(handle);
}
inline void release(msq_job* handle) {
  msq_job_release(handle);
}
inline void release(msq_shape* handle) {
  msq_shape_release(handle);
}
inline void release(msq_field* handle) {
  msq_field_release(handle);
}
inline void release(msq_structure* handle) {
  msq_structure_release(handle);
}
inline void release(msq_material* handle) {
  msq_material_release(handle);
}
inline void release(msq_model* handle) {
  msq_model_release(handle);
}
inline void release(msq_fill* handle) {
  msq_fill_release(handle);
}
inline void release(msq_slicer* handle) {
  msq_slicer_release(handle);
}

/// With the defaults of msq.h.
template <class Def>
Def make_def(msq_status (*init)(Def*, size_t)) {
  Def def;
  require_ok(init(&def, sizeof def));
  return def;
}

class World {
 public:
  explicit World(const Stage& stage);
  World(const World&) = delete;
  World& operator=(const World&) = delete;
  ~World();

  /// Released with the world.
  template <class Handle>
  Handle* keep(Handle* handle) {
    kept_.push_back([handle] { release(handle); });
    return handle;
  }

  // Of about 4 x 4 x 4.
  msq_shape* box();
  msq_shape* mesh();
  msq_shape* voxels();
  msq_shape* host_shape();

  /// From 0.1 to 0.25 in the box.
  msq_field* gradient();
  msq_field* expression();
  msq_field* host_field();

  /// A material with the channel "density", which is a field.
  msq_material* material(uint32_t id);

  msq_model* model(msq_shape* shape, msq_structure* structure, double skin = 0);
  /// Layers of bits, of few pixels where they are slow.
  msq_slicer* slicer(const msq_model* model, bool is_slow = false);

  msq_context* context = nullptr;

 private:
  std::vector<std::function<void()>> kept_;
};

/// A structure of cells of size 1.
using MakeStructure = std::function<msq_status(msq_structure**)>;
struct Kind {
  std::string name;
  std::function<MakeStructure(World&)> prepare;  ///< all but the last call
  bool has_onset = true;
  bool is_cgal = false;
  bool is_slow = false;

  msq_structure* make(World& world) const;
};
const std::vector<Kind>& kinds();

/// Points in and about the box.
std::vector<double> some_points(size_t count);
msq_points_def array_of(const std::vector<double>& coordinates);
msq_points_def grid_of(uint64_t side);
msq_points_def strata_of(uint64_t side, uint32_t per_cell);

msq_slicer_report plan_of(const msq_slicer* slicer);

// Callbacks of the host.
int32_t host_values(void* user, const double* points, uint64_t count, double* values);
int32_t host_range(void* user, const double min[3], const double max[3], double* low, double* high);
int32_t host_inside(void* user, const double* points, uint64_t count, uint8_t* inside);

}  // namespace msq::test
