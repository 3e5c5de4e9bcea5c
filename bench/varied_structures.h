// SPDX-License-Identifier: Apache-2.0
// One structure of each newer kind, with so many cells across the unit cube.
#pragma once

#include "setup.h"

namespace bench {

/// Cells around the corner of the cube; foams need an outer radius.
inline msq_warp_def around_axis(int cells) {
  msq_warp_def warp = warp_of(MSQ_WARP_CYLINDRICAL, cells);
  warp.outer_radius = 1.5;
  return warp;
}

/// By a map that must live as long.
inline msq_warp_def in_map(const SampledCells& map, int cells) {
  msq_warp_def warp = warp_of(MSQ_WARP_SAMPLED, cells);
  map.set(warp);
  return warp;
}

struct Varied {
  const char* name;
  msq_structure* (*make)(msq_context* context, int cells);
};

template <class Change>
msq_structure* changed_foam(msq_context* context, int cells, Change&& change) {
  msq_foam_def def;
  check(msq_foam_def_init(&def, sizeof def));
  for (double& size : def.grid.cell_size) size = 1.0 / cells;
  def.radius.value = 0.1 / cells;
  change(def);
  msq_structure* made;
  check(msq_structure_foam(context, &def, &made));
  return made;
}

template <class Change>
msq_structure* changed_lattice(msq_context* context, int cells, Change&& change) {
  msq_lattice_def def;
  check(msq_lattice_def_init(&def, sizeof def));
  for (double& size : def.grid.cell_size) size = 1.0 / cells;
  def.radius.value = 0.1 / cells;
  change(def);
  msq_structure* made;
  check(msq_structure_lattice(context, &def, &made));
  return made;
}

inline msq_structure* plain_foam(msq_context* context, int cells) {
  return changed_foam(context, cells, [](msq_foam_def&) {});
}

inline msq_structure* plain_lattice(msq_context* context, int cells) {
  return changed_lattice(context, cells, [](msq_lattice_def&) {});
}

/// Takes over both.
template <class Combine>
msq_structure* combined(msq_structure* a, msq_structure* b, Combine&& combine) {
  msq_structure* made;
  check(combine(a, b, &made));
  msq_structure_release(a);
  msq_structure_release(b);
  return made;
}

inline const Varied varied_structures[] = {
    {"walls with holes",
     [](msq_context* context, int cells) {
       return changed_foam(context, cells, [&](msq_foam_def& def) {
         def.wall_thickness.value = 0.1 / cells;
         def.vent_radius.value = 0.1 / cells;
       });
     }},
    {"stretched foam",
     [](msq_context* context, int cells) {
       return changed_foam(context, cells, [](msq_foam_def& def) { def.stretch[0] = 2; });
     }},
    {"weighted foam",
     [](msq_context* context, int cells) {
       return changed_foam(context, cells, [&](msq_foam_def& def) { def.weight = 0.5 / cells; });
     }},
    {"foam around an axis",
     [](msq_context* context, int cells) {
       const msq_warp_def warp = around_axis(cells);
       return changed_foam(context, cells, [&](msq_foam_def& def) { def.warp = &warp; });
     }},
    {"foam in a sampled map",
     [](msq_context* context, int cells) {
       const SampledCells map(context, cells);
       const msq_warp_def warp = in_map(map, cells);
       return changed_foam(context, cells, [&](msq_foam_def& def) {
         def.radius.value = 0.05 / cells;
         def.warp = &warp;
       });
     }},
    {"lattice around an axis",
     [](msq_context* context, int cells) {
       const msq_warp_def warp = around_axis(cells);
       return changed_lattice(context, cells, [&](msq_lattice_def& def) { def.warp = &warp; });
     }},
    {"lattice in a sampled map",
     [](msq_context* context, int cells) {
       const SampledCells map(context, cells);
       const msq_warp_def warp = in_map(map, cells);
       return changed_lattice(context, cells, [&](msq_lattice_def& def) { def.warp = &warp; });
     }},
    {"gyroid in a sampled map",
     [](msq_context* context, int cells) {
       const SampledCells map(context, cells);
       const msq_warp_def warp = in_map(map, cells);
       msq_functional_def def;
       check(msq_functional_def_init(&def, sizeof def));
       def.warp = &warp;
       msq_structure* made;
       check(msq_structure_functional(context, &def, &made));
       return made;
     }},
    {"plates, turned",
     [](msq_context* context, int cells) {
       msq_plate_lattice_def def;
       check(msq_plate_lattice_def_init(&def, sizeof def));
       for (double& size : def.grid.cell_size) size = 1.0 / cells;
       turn(def.grid);
       def.thickness.value = 0.1 / cells;
       msq_structure* made;
       check(msq_structure_plate_lattice(context, &def, &made));
       return made;
     }},
    {"400 waves",
     [](msq_context* context, int cells) {
       msq_waves_def def;
       check(msq_waves_def_init(&def, sizeof def));
       def.count = 400;
       for (double& size : def.grid.cell_size) size = 1.0 / cells;
       msq_structure* made;
       check(msq_structure_waves(context, &def, &made));
       return made;
     }},
    {"union with fillets",
     [](msq_context* context, int cells) {
       return combined(plain_foam(context, cells), plain_lattice(context, cells),
                       [&](const msq_structure* a, const msq_structure* b, msq_structure** made) {
                         const msq_param radius = {0.1 / cells, nullptr};
                         return msq_structure_smooth_boolean(MSQ_BOOLEAN_UNION, a, b, &radius,
                                                             made);
                       });
     }},
    {"blend",
     [](msq_context* context, int cells) {
       const double from[3] = {0, 0, 0}, to[3] = {1, 0, 0};
       msq_field* field;
       check(msq_field_gradient(context, from, 0, to, 1, &field));
       msq_structure* const made =
           combined(plain_foam(context, cells), plain_lattice(context, cells),
                    [&](const msq_structure* a, const msq_structure* b, msq_structure** blend) {
                      const msq_param fraction = {0, field};
                      return msq_structure_blend(a, b, &fraction, blend);
                    });
       msq_field_release(field);
       return made;
     }},
};

}  // namespace bench
