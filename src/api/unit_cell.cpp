// SPDX-License-Identifier: Apache-2.0
// Unit cells of strut lattices.
#include "api/unit_cell.h"

#include <set>

#include "api/guard.h"
#include "structure/lattice/cell/unit_cell_faces.h"

using namespace msq;
using namespace msq::api;

namespace {

constexpr double min_factor = 1e-3, max_factor = 1e3;

unsigned long long number(uint64_t n) {
  return static_cast<unsigned long long>(n);
}

UnitCell read_custom(const msq_unit_cell_def& def) {
  const auto check_count = [](uint64_t count, const char* name) {
    if (count < 1 || count > max_custom)
      fail(Status::argument, "%s is %llu; it must be from 1 to %llu", name, number(count),
           number(max_custom));
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
           number(i), node.x, node.y, node.z);
    cell.nodes.push_back(node);
  }
  for (uint64_t i = 0; i < def.strut_count; ++i) {
    const uint32_t a = def.struts[2 * i], b = def.struts[2 * i + 1];
    if (a >= def.node_count || b >= def.node_count || a == b)
      fail(Status::argument,
           "strut %llu joins nodes %u and %u; there are %llu nodes, and they must differ",
           number(i), a, b, number(def.node_count));
    cell.struts.push_back({a, b});
  }
  return cell;
}

UnitCell preset(int32_t unit_cell) {
  switch (unit_cell) {
    case MSQ_UNIT_CELL_CUBIC:
      return cubic_unit_cell();
    case MSQ_UNIT_CELL_BCC:
      return bcc_unit_cell();
    case MSQ_UNIT_CELL_OCTET:
      return octet_unit_cell();
    case MSQ_UNIT_CELL_FCC:
      return fcc_unit_cell();
    case MSQ_UNIT_CELL_KELVIN:
      return kelvin_unit_cell();
    case MSQ_UNIT_CELL_DIAMOND:
      return diamond_unit_cell();
    case MSQ_UNIT_CELL_RHOMBIC_DODECAHEDRON:
      return rhombic_dodecahedron_unit_cell();
    default:
      return reentrant_unit_cell();
  }
}

/// A host's cell, which may not be NULL.
UnitCell read_unit_cell(const msq_unit_cell_def* def) {
  return api::read_unit_cell(read_def(def, unit_cell_defaults(), "cell"));
}

}  // namespace

namespace msq::api {

msq_unit_cell_def unit_cell_defaults() {
  msq_unit_cell_def def{};
  def.unit_cell = MSQ_UNIT_CELL_BCC;
  return def;
}

UnitCell read_unit_cell(const msq_unit_cell_def& def) {
  require_range(def.unit_cell, MSQ_UNIT_CELL_CUSTOM, MSQ_UNIT_CELL_REENTRANT, "unit_cell");
  UnitCell cell = def.unit_cell == MSQ_UNIT_CELL_CUSTOM ? read_custom(def) : preset(def.unit_cell);
  if (!def.strut_factors) return cell;
  if (def.strut_count != cell.struts.size())
    fail(Status::argument,
         "strut_count is %llu; with strut_factors it must be the unit cell's, %llu",
         number(def.strut_count), number(cell.struts.size()));
  for (uint64_t i = 0; i < def.strut_count; ++i) {
    const double factor = def.strut_factors[i];
    if (!(factor >= min_factor && factor <= max_factor))
      fail(Status::argument, "the factor of strut %llu is %g; it must be from %g to %g", number(i),
           factor, min_factor, max_factor);
    cell.factors.push_back(factor);
  }
  return cell;
}

}  // namespace msq::api

msq_status msq_unit_cell_def_init(msq_unit_cell_def* def, size_t size) {
  return guard([&] { set_defaults(def, size, unit_cell_defaults(), "msq_unit_cell_def"); });
}

msq_status msq_unit_cell_info(const msq_unit_cell_def* cell, msq_unit_cell_report* report,
                              uint32_t* unmatched, uint64_t unmatched_room) {
  return guard([&] {
    const UnitCell known = read_unit_cell(cell);
    if (unmatched_room) require(unmatched, "unmatched");
    msq_unit_cell_report found{};
    found.node_count = known.nodes.size();
    found.strut_count = known.struts.size();
    for (const PeriodicStrut& s : periodic_struts(known)) {
      ++found.tiled_strut_count;
      found.tiled_length += length(s.b - s.a);
    }
    std::set<uint32_t> alone;
    for (int axis = 0; axis < 3; ++axis) {
      found.low_nodes[axis] = nodes_on_face(known, axis, Side::low).size();
      found.high_nodes[axis] = nodes_on_face(known, axis, Side::high).size();
      for (const Side side : {Side::low, Side::high}) {
        const std::vector<uint32_t> nodes = unmatched_nodes(known, axis, side, known);
        found.unmatched_nodes[axis] += nodes.size();
        alone.insert(nodes.begin(), nodes.end());
      }
    }
    found.unmatched_count = alone.size();
    found.is_periodic = alone.empty();
    write_report(report, found, "report");
    for (const uint32_t node : alone) {
      if (!unmatched_room--) break;
      *unmatched++ = node;
    }
  });
}

msq_status msq_unit_cell_geometry(const msq_unit_cell_def* cell, double* nodes, uint64_t node_count,
                                  uint32_t* struts, uint64_t strut_count) {
  return guard([&] {
    const UnitCell known = read_unit_cell(cell);
    require(nodes, "nodes");
    require(struts, "struts");
    const auto check_count = [](uint64_t count, uint64_t wanted, const char* name) {
      if (count != wanted)
        fail(Status::argument, "%s is %llu; the unit cell has %llu", name, number(count),
             number(wanted));
    };
    check_count(node_count, known.nodes.size(), "node_count");
    check_count(strut_count, known.struts.size(), "strut_count");
    for (const Vec3& node : known.nodes)
      for (int axis = 0; axis < 3; ++axis) *nodes++ = node[axis];
    for (const auto& ends : known.struts)
      for (const uint32_t node : ends) *struts++ = node;
  });
}
