// SPDX-License-Identifier: Apache-2.0
#include "api/warnings.h"

#include <cstdarg>
#include <cstdio>

#include "api/guard.h"
#include "base/attributes.h"
#include "base/infinity.h"
#include "structure/lattice/cell/unit_cell_faces.h"

namespace msq::api {

namespace {

/// Cells of fewer samples across are coarsely sampled.
constexpr double min_samples_across = 4;

void warn(const Context& context, int32_t code, const char* format, ...) MSQ_PRINTF_FORMAT(3, 4);

void warn(const Context& context, int32_t code, const char* format, ...) {
  char message[512];  // a failure of memory must not follow from a warning
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(message, sizeof message, format, arguments);
  va_end(arguments);
  call_host(context.warnings.fn, context.warnings.user, code, static_cast<const char*>(message));
}

unsigned long long number(uint64_t n) {
  return static_cast<unsigned long long>(n);
}

/// Whether the smallest cells of a scale have too few samples across; then it warns.
bool is_coarse(const Slicer& slicer, const Model& model, const Scale& scale) {
  double cell = infinity;
  scale.structure->for_each_grid([&](const Neighbourhood& of_structure) {
    cell = std::min(cell, min_component(of_structure.cell_size));
  });
  const SampleGrid& grid = slicer.grid();
  const auto count = static_cast<double>(grid.nz);
  const double height = grid.nz > 1 ? (grid.z(grid.nz - 1) - grid.z(0)) / (count - 1) : 0;
  const double pitches[3] = {grid.spacing.x, grid.spacing.y, height};
  const char* const names[3] = {"pixels along x", "pixels along y", "layers"};
  for (int axis = 0; axis < 3; ++axis) {
    const double pitch = pitches[axis];
    if (!(cell < min_samples_across * pitch)) continue;
    warn(slicer.model().context(), MSQ_WARNING_COARSE_PITCH,
         "the smallest cells of scale %zu have a size of %g: %.3g %s of %g; with fewer than %g the "
         "structure falls between samples",
         model.number(scale), cell, cell / pitch, names[axis], pitch, min_samples_across);
    return true;
  }
  return false;
}

}  // namespace

void warn_of_open_mesh(const Context& context, const Shape& mesh) {
  if (!context.warnings.fn || mesh.facts().closed) return;
  warn(context, MSQ_WARNING_OPEN_MESH,
       "the mesh of %llu triangles is not closed (%llu open edges); it is read by its generalised "
       "winding number",
       number(mesh.facts().triangles), number(mesh.facts().open_edges));
}

void warn_of_faces(const Context& context, const std::vector<UnitCell>& library) {
  if (!context.warnings.fn) return;
  for (size_t low = 0; low < library.size(); ++low)
    for (size_t high = 0; high < library.size(); ++high)
      for (int axis = 0; axis < 3; ++axis) {
        const size_t alone = unmatched_nodes(library[low], axis, Side::high, library[high]).size() +
                             unmatched_nodes(library[high], axis, Side::low, library[low]).size();
        if (!alone) continue;
        warn(context, MSQ_WARNING_UNMATCHED_CELLS,
             "%zu nodes on the face between unit cell %zu and, along axis %d, unit cell %zu are on "
             "one side only; struts end there",
             alone, low, axis, high);
        return;
      }
}

void warn_of_pitch(const Slicer& slicer) {
  const Model& model = slicer.model();
  if (!model.context().warnings.fn) return;
  const auto check = [&](const Model& one) {
    for (const Scale* scale : one.resolved(slicer.length_scale()))
      if (is_coarse(slicer, one, *scale)) return true;
    return false;
  };
  if (model.regions().empty()) {
    check(model);
    return;
  }
  for (const Ref<const Model>& region : model.regions())
    if (check(*region)) return;
}

void warn_of_cache(Context& context) {
  WarningHook& hook = context.warnings;
  if (!hook.fn || hook.has_warned_of_cache.load(std::memory_order_relaxed)) return;
  if (context.cache.limit() == 0) return;  // the host wants none
  const CellCache::Counters counters = context.cache.counters();
  if (counters.unkept == 0 || hook.has_warned_of_cache.exchange(true)) return;
  char within[64] = "";
  if (const uint64_t memory = context.budget->limit())
    std::snprintf(within, sizeof within, ", within a memory_limit of %llu,", number(memory));
  warn(context, MSQ_WARNING_SMALL_CACHE,
       "%llu of %llu cells were built for one use, because the cache of %llu bytes%s had no room "
       "for them",
       number(counters.unkept), number(counters.misses), number(context.cache.limit()), within);
}

}  // namespace msq::api
