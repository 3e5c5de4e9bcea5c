// SPDX-License-Identifier: Apache-2.0
#include "api/guard.h"
#include "api/neighbourhood.h"
#include "structure/foam/delaunay.h"
#include "structure/foam/foam.h"
#include "structure/lattice/lattice.h"

using namespace msq;
using namespace msq::api;

namespace {

constexpr uint64_t most_custom = 4096;  // nodes or struts of a unit cell

msq_lattice_def lattice_defaults() {
  msq_lattice_def def{};
  def.unit_cell = MSQ_UNIT_CELL_BCC;
  def.grid = neighbourhood_defaults();
  return def;
}

msq_foam_def foam_defaults() {
  msq_foam_def def{};
  def.grid = neighbourhood_defaults();
  def.jitter = 1;
  def.density.value = 1;
  return def;
}

/// The radius of struts, at most `most_cells` of the smallest cell size.
Parameter read_radius(const msq_param& radius, const Neighbourhood& grid, double most_cells) {
  Parameter read;
  if (radius.field) {
    read = Parameter(Ref<const Field>(&object(radius.field, "radius.field")));
    const Interval range = read.range();
    if (!(range.low >= 0) || !(range.high > 0))
      fail(Status::argument,
           "the field of radius runs from %g to %g; it must not be negative, nor 0 everywhere",
           range.low, range.high);
  } else {
    read = Parameter(require_positive(radius.value, "radius"));
  }
  const double most = most_cells * min_component(grid.cell_size);
  if (read.range().high > most)
    fail(Status::limit, "radius reaches %g; the limit is %g (%g times the smallest cell size)",
         read.range().high, most, most_cells);
  return read;
}

Parameter read_density(const msq_param& density) {
  Parameter read;
  if (density.field) {
    read = Parameter(Ref<const Field>(&object(density.field, "density.field")));
    const Interval range = read.range();
    if (!(range.low >= 0))
      fail(Status::argument, "the field of density runs from %g to %g; it must not be negative",
           range.low, range.high);
  } else {
    if (!(density.value >= 0) || !std::isfinite(density.value))
      fail(Status::argument, "density is %g; it must be finite and not negative", density.value);
    read = Parameter(density.value);
  }
  if (!(read.range().high <= GradedSeeds::most_density))
    fail(Status::limit, "density reaches %g; the limit is %g seeds in the volume of a cell",
         read.range().high, GradedSeeds::most_density);
  return read;
}

UnitCell read_unit_cell(const msq_lattice_def& def) {
  switch (require_range(def.unit_cell, MSQ_UNIT_CELL_CUSTOM, MSQ_UNIT_CELL_OCTET, "unit_cell")) {
    case MSQ_UNIT_CELL_CUBIC:
      return cubic_unit_cell();
    case MSQ_UNIT_CELL_BCC:
      return bcc_unit_cell();
    case MSQ_UNIT_CELL_OCTET:
      return octet_unit_cell();
    default:
      break;
  }
  const auto check_count = [](uint64_t count, const char* name) {
    if (count < 1 || count > most_custom)
      fail(Status::argument, "%s is %llu; it must be from 1 to %llu", name,
           static_cast<unsigned long long>(count), static_cast<unsigned long long>(most_custom));
  };
  check_count(def.node_count, "node_count");
  check_count(def.strut_count, "strut_count");
  require(def.nodes, "nodes");
  require(def.struts, "struts");
  UnitCell cell;
  for (uint64_t i = 0; i < def.node_count; ++i) {
    const Vec3 node = require_vector(def.nodes + 3 * i, "a node");
    if (!Box3{{0, 0, 0}, {1, 1, 1}}.contains(node))
      fail(Status::argument, "node %llu is (%g, %g, %g); nodes must lie in the unit cube",
           static_cast<unsigned long long>(i), node.x, node.y, node.z);
    cell.nodes.push_back(node);
  }
  for (uint64_t i = 0; i < def.strut_count; ++i) {
    const uint32_t a = def.struts[2 * i], b = def.struts[2 * i + 1];
    if (a >= def.node_count || b >= def.node_count || a == b)
      fail(Status::argument,
           "strut %llu joins nodes %u and %u; there are %llu nodes, and they must "
           "differ",
           static_cast<unsigned long long>(i), a, b,
           static_cast<unsigned long long>(def.node_count));
    cell.struts.push_back({a, b});
  }
  return cell;
}

}  // namespace

msq_status msq_lattice_def_init(msq_lattice_def* def, size_t size) {
  return guard([&] { set_defaults(def, size, lattice_defaults(), "msq_lattice_def"); });
}

msq_status msq_structure_lattice(msq_context* context, const msq_lattice_def* def,
                                 msq_structure** structure) {
  return guard([&] {
    object(context, "context");
    require(structure, "structure");
    const msq_lattice_def known = read_def(def, lattice_defaults(), "def");
    const Neighbourhood grid = read_neighbourhood(known.grid);
    const UnitCell cell = read_unit_cell(known);
    *structure = new_handle<msq_structure>(
        Ref<Structure>(make_ref<Lattice>(grid, cell, read_radius(known.radius, grid, 4))));
  });
}

msq_status msq_foam_def_init(msq_foam_def* def, size_t size) {
  return guard([&] { set_defaults(def, size, foam_defaults(), "msq_foam_def"); });
}

msq_status msq_structure_foam(msq_context* context, const msq_foam_def* def,
                              msq_structure** structure) {
  return guard([&] {
    Context& owner = object(context, "context");
    require(structure, "structure");
    const msq_foam_def known = read_def(def, foam_defaults(), "def");
    const Neighbourhood grid = read_neighbourhood(known.grid);
    const double ratio = max_component(grid.cell_size) / min_component(grid.cell_size);
    if (ratio > 4)
      fail(Status::limit, "cell sizes of a foam differ by %g times; the limit is 4", ratio);
    const FoamMethod method = static_cast<FoamMethod>(
        require_range(known.method, MSQ_FOAM_AUTO, MSQ_FOAM_METHOD_1, "method"));
    if (method == FoamMethod::method_2 && !can_triangulate())
      fail(Status::unsupported, "MSQ_FOAM_METHOD_2 is not in this build (MSQ_WITH_CGAL is off)");
    if (!(known.jitter >= 0 && known.jitter <= 1))
      fail(Status::argument, "jitter is %g; it must be from 0 to 1", known.jitter);
    const Parameter density = read_density(known.density);
    if (density.range().high > 1 && method != FoamMethod::automatic && method != FoamMethod::direct)
      fail(Status::unsupported,
           "density reaches %g; above 1, the method of a foam must be MSQ_FOAM_AUTO or "
           "MSQ_FOAM_DIRECT",
           density.range().high);
    *structure = new_handle<msq_structure>(Ref<Structure>(
        make_ref<Foam>(Ref<Context>(&owner), grid, read_radius(known.radius, grid, 1), known.jitter,
                       known.seed, method, density)));
  });
}

void msq_structure_retain(msq_structure* structure) {
  retain(structure);
}
void msq_structure_release(msq_structure* structure) {
  release(structure);
}
