// SPDX-License-Identifier: Apache-2.0
// One structure of each newer kind, with so many cells across the unit cube.
#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "setup.h"

namespace bench {

/// The map of a sampled warp: cells that sway along the axes.
class SwayingMap {
 public:
  SwayingMap(msq_context* context, int cells) {
    constexpr size_t side = 33;
    std::vector<double> values(side * side * side);
    for (int axis = 0; axis < 3; ++axis) {
      for (size_t i = 0; i < values.size(); ++i) {
        const double at[3] = {static_cast<double>(i % side) / (side - 1),
                              static_cast<double>(i / side % side) / (side - 1),
                              static_cast<double>(i / (side * side)) / (side - 1)};
        values[i] = cells * (at[axis] + 0.03 * std::sin(6 * at[(axis + 1) % 3]));
      }
      msq_grid_field_def def;
      check(msq_grid_field_def_init(&def, sizeof def));
      def.image.values = values.data();
      def.image.value_type = MSQ_FLOAT64;
      for (int along = 0; along < 3; ++along) {
        def.image.size[along] = side;
        def.image.grid.cell_size[along] = 1.0 / (side - 1);
      }
      check(msq_field_grid(context, &def, &fields_[axis]));
    }
    check(msq_warp_def_init(&warp, sizeof warp));
    warp.kind = MSQ_WARP_SAMPLED;
    warp.u = fields_[0], warp.v = fields_[1], warp.w = fields_[2];
  }
  SwayingMap(const SwayingMap&) = delete;
  SwayingMap& operator=(const SwayingMap&) = delete;
  ~SwayingMap() {
    for (msq_field* field : fields_) msq_field_release(field);
  }

  msq_warp_def warp;

 private:
  msq_field* fields_[3] = {};
};

inline msq_warp_def around_axis(int cells) {
  msq_warp_def warp;
  check(msq_warp_def_init(&warp, sizeof warp));
  warp.count = static_cast<uint32_t>(4 * cells);
  warp.inner_radius = 0.3;
  warp.outer_radius = 1.5;
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
       const SwayingMap map(context, cells);
       return changed_foam(context, cells, [&](msq_foam_def& def) {
         def.radius.value = 0.05 / cells;
         def.warp = &map.warp;
       });
     }},
    {"lattice around an axis",
     [](msq_context* context, int cells) {
       const msq_warp_def warp = around_axis(cells);
       return changed_lattice(context, cells, [&](msq_lattice_def& def) { def.warp = &warp; });
     }},
    {"lattice in a sampled map",
     [](msq_context* context, int cells) {
       const SwayingMap map(context, cells);
       return changed_lattice(context, cells, [&](msq_lattice_def& def) { def.warp = &map.warp; });
     }},
    {"gyroid in a sampled map",
     [](msq_context* context, int cells) {
       const SwayingMap map(context, cells);
       msq_functional_def def;
       check(msq_functional_def_init(&def, sizeof def));
       def.warp = &map.warp;
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
