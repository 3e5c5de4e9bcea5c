// SPDX-License-Identifier: Apache-2.0
// Lattices of plates, or of plates and struts.
#include "structure/lattice/plates/plate_lattice.h"

#include "api/definitions.h"
#include "api/guard.h"
#include "api/neighbourhood.h"
#include "api/strut_radius.h"
#include "api/unit_cell.h"
#include "structure/lattice/plated_lattice.h"

using namespace msq;
using namespace msq::api;

namespace {

constexpr double min_face_factor = 1e-3, max_face_factor = 1e3;
/// Area of a triangle over the square of its longest side.
constexpr double min_area = 1e-5;
/// Radius of the thickest struts, in units of the smallest cell size.
constexpr double max_strut_radius = 4;

unsigned long long as_count(uint64_t n) {
  return static_cast<unsigned long long>(n);
}

msq_plate_lattice_def plate_lattice_defaults() {
  msq_plate_lattice_def def{};
  def.plate_cell = MSQ_PLATE_CELL_CUBIC;
  def.grid = neighbourhood_defaults();
  def.unit_cell = MSQ_UNIT_CELL_CUBIC;
  return def;
}

bool has_struts(const msq_plate_lattice_def& def) {
  return def.radius.field || def.radius.value != 0;
}

PlateCell read_custom_plates(const msq_plate_lattice_def& def) {
  const auto check_count = [](uint64_t count, const char* name) {
    if (count < 1 || count > max_custom)
      fail(Status::argument, "%s is %llu; it must be from 1 to %llu", name, as_count(count),
           as_count(max_custom));
  };
  check_count(def.node_count, "node_count");
  check_count(def.face_count, "face_count");
  require(def.nodes, "nodes");
  require(def.faces, "faces");
  PlateCell cell;
  for (uint64_t i = 0; i < def.node_count; ++i) {
    const Vec3 node = require_vector(def.nodes + 3 * i, "a node");
    if (!Box3{{0, 0, 0}, {1, 1, 1}}.contains(node))
      fail(Status::argument, "node %llu is (%g, %g, %g); nodes must lie in the unit cube",
           as_count(i), node.x, node.y, node.z);
    cell.nodes.push_back(node);
  }
  for (uint64_t i = 0; i < def.face_count; ++i) {
    const uint32_t* const face = def.faces + 3 * i;
    const uint32_t a = face[0], b = face[1], c = face[2];
    if (std::max({a, b, c}) >= def.node_count || a == b || b == c || c == a)
      fail(Status::argument,
           "face %llu joins nodes %u, %u and %u; there are %llu nodes, and they must differ",
           as_count(i), a, b, c, as_count(def.node_count));
    cell.faces.push_back({a, b, c});
  }
  return cell;
}

PlateCell plate_preset(int32_t plate_cell) {
  switch (plate_cell) {
    case MSQ_PLATE_CELL_CUBIC:
      return cubic_plate_cell();
    case MSQ_PLATE_CELL_BCC:
      return bcc_plate_cell();
    case MSQ_PLATE_CELL_FCC:
      return fcc_plate_cell();
    case MSQ_PLATE_CELL_CUBIC_OCTET:
      return cubic_octet_plate_cell();
    default:
      return kelvin_plate_cell();
  }
}

PlateCell read_plates(const msq_plate_lattice_def& def, Vec3 cell_size) {
  require_range(def.plate_cell, MSQ_PLATE_CELL_CUSTOM, MSQ_PLATE_CELL_KELVIN, "plate_cell");
  PlateCell cell = def.plate_cell == MSQ_PLATE_CELL_CUSTOM ? read_custom_plates(def)
                                                           : plate_preset(def.plate_cell);
  for (size_t i = 0; i < cell.faces.size(); ++i) {
    const auto [a, b, c] = cell.faces[i];
    // In units of the largest cell size, so that no square overflows.
    const Vec3 scale = cell_size * (1 / max_component(cell_size));
    const Vec3 ab = (cell.nodes[b] - cell.nodes[a]) * scale,
               bc = (cell.nodes[c] - cell.nodes[b]) * scale,
               ca = (cell.nodes[a] - cell.nodes[c]) * scale;
    const double longest = std::max({dot(ab, ab), dot(bc, bc), dot(ca, ca)});
    const double area = 0.5 * length(cross(ab, ca));
    if (!(area >= min_area * longest))
      fail(Status::argument,
           "face %zu, in model units, has %g of the area of the square on its longest side; it "
           "must have at least %g",
           i, longest > 0 ? area / longest : 0.0, min_area);
  }
  if (!def.face_factors) return cell;
  if (def.face_count != cell.faces.size())
    fail(Status::argument,
         "face_count is %llu; with face_factors it must be the plate cell's, %llu",
         as_count(def.face_count), as_count(cell.faces.size()));
  for (uint64_t i = 0; i < def.face_count; ++i) {
    const double factor = def.face_factors[i];
    if (!(factor >= min_face_factor && factor <= max_face_factor))
      fail(Status::argument, "the factor of face %llu is %g; it must be from %g to %g", as_count(i),
           factor, min_face_factor, max_face_factor);
    cell.factors.push_back(factor);
  }
  return cell;
}

Parameter read_plate_thickness(const msq_param& thickness, const Neighbourhood& grid,
                               const PlateCell& cell) {
  Parameter read;
  if (thickness.field) {
    read = Parameter(Ref<const Field>(&object(thickness.field, "thickness.field")));
    const Interval range = read.range();
    if (!(range.low >= 0) || !(range.high > 0))
      fail(Status::argument,
           "the field of thickness runs from %g to %g; it must not be negative, nor 0 everywhere",
           range.low, range.high);
  } else {
    read = Parameter(require_positive(thickness.value, "thickness"));
  }
  double max_factor = 0;
  for (size_t face = 0; face < cell.faces.size(); ++face)
    max_factor = std::max(max_factor, cell.factor(face));
  const double most = PlateLattice::max_thickness * min_component(grid.cell_size);
  const double reached = max_factor * read.range().high;
  if (reached > most)
    fail(Status::limit, "thickness%s reaches %g; the limit is %g (%g times the smallest cell size)",
         max_factor == 1 ? "" : " times the greatest face factor", reached, most,
         PlateLattice::max_thickness);
  return read;
}

/// The lattice of the struts.
Ref<Lattice> read_struts(const msq_plate_lattice_def& def, const Neighbourhood& grid) {
  msq_unit_cell_def struts = unit_cell_defaults();
  struts.unit_cell = def.unit_cell;
  struts.nodes = def.nodes;
  struts.node_count = def.node_count;
  struts.struts = def.struts;
  struts.strut_count = def.strut_count;
  struts.strut_factors = def.strut_factors;
  const UnitCell cell = read_unit_cell(struts);
  double max_factor = 0;
  for (size_t s = 0; s < cell.struts.size(); ++s) max_factor = std::max(max_factor, cell.factor(s));
  return make_ref<Lattice>(grid, cell, read_radius(def.radius, grid, max_strut_radius, max_factor));
}

/// Keeps the definition without what is not read.
void keep_plate_lattice(Structure& made, msq_plate_lattice_def def) {
  bool needs_nodes = def.plate_cell == MSQ_PLATE_CELL_CUSTOM;
  if (!needs_nodes) {
    def.faces = nullptr;
    if (!def.face_factors) def.face_count = 0;
  }
  if (!has_struts(def)) {
    def.unit_cell = MSQ_UNIT_CELL_CUBIC;
    def.strut_count = 0;
  } else if (def.unit_cell == MSQ_UNIT_CELL_CUSTOM) {
    needs_nodes = true;
  } else {
    def.struts = nullptr;
    if (!def.strut_factors) def.strut_count = 0;
  }
  if (!needs_nodes) {
    def.nodes = nullptr;
    def.node_count = 0;
  }
  keep(made, def);
}

}  // namespace

msq_status msq_plate_lattice_def_init(msq_plate_lattice_def* def, size_t size) {
  return guard([&] { set_defaults(def, size, plate_lattice_defaults(), "msq_plate_lattice_def"); });
}

msq_status msq_structure_plate_lattice(msq_context* context, const msq_plate_lattice_def* def,
                                       msq_structure** structure) {
  return guard([&] {
    object(context, "context");
    require(structure, "structure");
    const msq_plate_lattice_def known = read_def(def, plate_lattice_defaults(), "def");
    require_reserved(known.reserved, "reserved");
    const Neighbourhood grid = read_neighbourhood(known.grid);
    require_proportions(grid);
    const PlateCell cell = read_plates(known, grid.cell_size);
    Parameter thickness = read_plate_thickness(known.thickness, grid, cell);
    if (!has_struts(known) && (known.struts || known.strut_factors))
      fail(Status::argument, "%s is not NULL, but radius is 0",
           known.struts ? "struts" : "strut_factors");
    const Ref<PlateLattice> plates = make_ref<PlateLattice>(grid, cell, std::move(thickness));
    const Ref<Structure> made =
        has_struts(known)
            ? Ref<Structure>(make_ref<PlatedLattice>(read_struts(known, grid), plates))
            : Ref<Structure>(plates);
    keep_plate_lattice(*made, known);
    *structure = new_handle<msq_structure>(made);
  });
}
