// SPDX-License-Identifier: Apache-2.0
// Strut lattices.
#include "structure/lattice/lattice.h"

#include "api/definitions.h"
#include "api/guard.h"
#include "api/neighbourhood.h"
#include "api/period.h"
#include "api/strut_radius.h"
#include "api/unit_cell.h"
#include "api/warnings.h"
#include "api/warp.h"
#include "structure/common/max_clusters.h"
#include "structure/lattice/mixed/mixed_lattice.h"
#include "structure/lattice/warped/graded_places.h"
#include "structure/lattice/warped/round_places.h"
#include "structure/lattice/warped/sampled_places.h"
#include "structure/lattice/warped/warped_lattice.h"

using namespace msq;
using namespace msq::api;

namespace {

/// Radius of the thickest struts, in units of the smallest cell size.
constexpr double max_radius = 4;
static_assert(max_radius == WarpedLattice::max_radius);
/// Cells that msq_lattice_faces looks at.
constexpr double max_cells = 0x1p30;

msq_lattice_def lattice_defaults() {
  msq_lattice_def def{};
  def.unit_cell = MSQ_UNIT_CELL_BCC;
  def.grid = neighbourhood_defaults();
  return def;
}

/// The unit cells that a lattice is made of, at least one.
std::vector<UnitCell> read_library(const msq_lattice_def& def) {
  if (!def.cells) {
    if (def.cell_count)
      fail(Status::argument, "cells is NULL, but cell_count is %u", def.cell_count);
    msq_unit_cell_def own = unit_cell_defaults();
    own.unit_cell = def.unit_cell;
    own.nodes = def.nodes;
    own.node_count = def.node_count;
    own.struts = def.struts;
    own.strut_count = def.strut_count;
    own.strut_factors = def.strut_factors;
    return {read_unit_cell(own)};
  }
  if (def.cell_count < 1 || def.cell_count > MixedLattice::max_types)
    fail(Status::argument, "cell_count is %u; it must be from 1 to %zu", def.cell_count,
         MixedLattice::max_types);
  if (def.nodes || def.struts || def.strut_factors)
    fail(Status::argument, "cells are given: nodes, struts and strut_factors must be NULL");
  std::vector<UnitCell> library;
  const uint32_t size = def.cells->struct_size;  // from one to the next
  uint64_t nodes = 0, struts = 0;
  for (uint32_t i = 0; i < def.cell_count; ++i) {
    try {
      const auto* cell = reinterpret_cast<const msq_unit_cell_def*>(
          reinterpret_cast<const unsigned char*>(def.cells) + uint64_t{i} * size);
      const msq_unit_cell_def known = read_def(cell, unit_cell_defaults(), "it");
      if (known.struct_size != size)
        fail(Status::argument, "struct_size is %u, but that of the first is %u", known.struct_size,
             size);
      library.push_back(read_unit_cell(known));
    } catch (const Error& error) {
      fail(error.status, "unit cell %u: %s", i, error.what());
    }
    nodes += library.back().nodes.size();
    struts += library.back().struts.size();
  }
  if (std::max(nodes, struts) > max_custom)
    fail(Status::limit, "the unit cells have %llu nodes and %llu struts; the limit is %llu",
         static_cast<unsigned long long>(nodes), static_cast<unsigned long long>(struts),
         static_cast<unsigned long long>(max_custom));
  return library;
}

Parameter read_choice(const msq_param& choice) {
  if (!choice.field) return Parameter(require_finite(choice.value, "cell_choice"));
  return Parameter(Ref<const Field>(&object(choice.field, "cell_choice.field")));
}

/// Without what a named cell does not read.
template <class Def>
void forget_unread(Def& def) {
  if (def.unit_cell == MSQ_UNIT_CELL_CUSTOM) return;
  def.nodes = nullptr;
  def.struts = nullptr;
  def.node_count = 0;
  if (!def.strut_factors) def.strut_count = 0;
}

/// Keeps the definition as this version knows it.
void keep_lattice(Structure& made, msq_lattice_def def) {
  std::vector<msq_unit_cell_def> cells;
  for (uint32_t i = 0; i < def.cell_count; ++i) {
    const auto* bytes =
        reinterpret_cast<const unsigned char*>(def.cells) + uint64_t{i} * def.cells->struct_size;
    cells.push_back(
        read_def(reinterpret_cast<const msq_unit_cell_def*>(bytes), unit_cell_defaults(), "it"));
    forget_unread(cells.back());
  }
  if (def.cells) {
    def.cells = cells.data();
    def.unit_cell = MSQ_UNIT_CELL_BCC;
  }
  forget_unread(def);
  keep(made, def);
}

}  // namespace

msq_status msq_lattice_def_init(msq_lattice_def* def, size_t size) {
  return guard([&] { set_defaults(def, size, lattice_defaults(), "msq_lattice_def"); });
}

msq_status msq_structure_lattice(msq_context* context, const msq_lattice_def* def,
                                 msq_structure** structure) {
  return guard([&] {
    const Ref<Context> owner(&object(context, "context"));
    require(structure, "structure");
    msq_lattice_def known = read_def(def, lattice_defaults(), "def");
    if (known.clusters > uint32_t{max_clusters})
      fail(Status::argument, "clusters is %u; it must be from 0 to %d", known.clusters,
           max_clusters);
    const Neighbourhood grid = read_neighbourhood(known.grid);
    std::vector<UnitCell> library = read_library(known);
    msq_period_def known_period;
    std::optional<GradedPeriod> period = read_period(known.period, known_period);
    std::unique_ptr<const CellPlaces> places;
    if (period) {
      if (library.size() > 1)
        fail(Status::unsupported,
             "a period is given, and a library of %zu unit cells; a lattice with a period has one",
             library.size());
      for (const double size : {period->smallest(), period->largest()})
        require_proportions(period->resized(grid, size));
      places = std::make_unique<const GradedPlaces>(grid, *std::move(period));
    }
    msq_warp_def known_warp;
    if (const CellMap map = read_warp(known.warp, known_warp, grid)) {
      if (places)
        fail(Status::unsupported, "a period and a warp are given; a lattice takes one of them");
      if (library.size() > 1)
        fail(Status::unsupported,
             "a warp is given, and a library of %zu unit cells; a lattice with a warp has one",
             library.size());
      if (map.sampled)
        places = std::make_unique<const SampledPlaces>(map.sampled, library[0], owner->budget);
      else
        places = std::make_unique<const RoundPlaces>(*map.round);
    }
    if (!places) require_proportions(grid);
    double max_factor = 0;
    for (const UnitCell& cell : library)
      for (size_t s = 0; s < cell.struts.size(); ++s)
        max_factor = std::max(max_factor, cell.factor(s));
    const Parameter choice = read_choice(known.cell_choice);
    Parameter radius =
        read_radius(known.radius, places ? places->smallest() : grid, max_radius, max_factor);
    Ref<Structure> made;
    if (places)
      made = make_ref<WarpedLattice>(owner, std::move(places), library[0], std::move(radius));
    else if (library.size() == 1)
      made =
          make_ref<Lattice>(grid, library[0], std::move(radius), static_cast<int>(known.clusters));
    else
      made = make_ref<MixedLattice>(grid, library, choice, std::move(radius));
    keep_lattice(*made, known);
    warn_of_faces(*owner, library);
    *structure = new_handle<msq_structure>(std::move(made));
  });
}

msq_status msq_lattice_faces(const msq_structure* lattice, const double min[3], const double max[3],
                             msq_lattice_faces_report* report, msq_job* job) {
  return guard([&] {
    const Structure& structure = object(lattice, "lattice");
    const Ref<const Structure> keep(&structure);  // callbacks may release the host's last reference
    const auto* mixed = dynamic_cast<const MixedLattice*>(&structure);
    if (dynamic_cast<const WarpedLattice*>(&structure))
      fail(Status::unsupported,
           "the lattice has a period or a warp, and so one unit cell: its faces are those of that "
           "cell "
           "(msq_unit_cell_info)");
    if (!mixed && !dynamic_cast<const Lattice*>(&structure))
      fail(Status::argument, "the structure is not a lattice");
    const Box3 box{require_vector(min, "min"), require_vector(max, "max")};
    for (int axis = 0; axis < 3; ++axis)
      if (!(box.min[axis] < box.max[axis]))
        fail(Status::argument, "min is %g and max is %g along axis %d; min must be less",
             box.min[axis], box.max[axis], axis);
    const Neighbourhood& grid = structure.neighbourhood();
    const CellRange range = cells_of(grid, box);
    for (int axis = 0; axis < 3; ++axis)
      if (!(std::max(std::abs(range.first[axis]), std::abs(range.last[axis])) < max_cell_index))
        fail(Status::limit, "the box reaches cells %g to %g along axis %d; the limit is %g",
             range.first[axis], range.last[axis], axis, max_cell_index);
    if (range.count() > max_cells)
      fail(Status::limit, "the box meets %g cells; the limit is %g", range.count(), max_cells);
    check_struct_size<msq_lattice_faces_report>(require(report, "report").struct_size, "report");

    msq_lattice_faces_report known{};
    known.axis = -1;
    known.cells = static_cast<uint64_t>(range.count());
    Job* work = job ? &object(job, "job") : nullptr;
    JobScope scope(work);
    if (mixed) {
      const MixedFaces found = mixed->faces(range, work);
      known.faces = found.faces;
      known.unmatched = found.unmatched;
      if (found.unmatched) {
        known.axis = found.axis;
        Vec3 centre{0.5, 0.5, 0.5};
        centre[found.axis] = 1;
        centre = centre + Vec3{double(found.cell.x), double(found.cell.y), double(found.cell.z)};
        centre = grid.from_grid(centre * grid.cell_size);
        const int32_t cell[3] = {found.cell.x, found.cell.y, found.cell.z};
        for (int axis = 0; axis < 3; ++axis) {
          known.cell[axis] = cell[axis];
          known.point[axis] = centre[axis];
        }
        for (int side = 0; side < 2; ++side)
          known.types[side] = static_cast<uint32_t>(found.types[side]);
      }
    }
    write_report(report, known, "report");
    scope.done();
  });
}
