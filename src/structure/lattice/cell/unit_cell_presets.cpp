// SPDX-License-Identifier: Apache-2.0
// The named unit cells. All but the last are those of cubic crystals: nodes at known sites and
// struts between all pairs at one distance. Nodes on a face have copies on the opposite face, also
// if no strut of the cell itself ends there.
#include <cmath>

#include "structure/lattice/cell/unit_cell.h"

namespace msq {

namespace {

std::vector<Vec3> cube_corners() {
  std::vector<Vec3> corners;
  corners.reserve(8);
  for (int i = 0; i < 8; ++i)
    corners.push_back({double(i & 1), double(i >> 1 & 1), double(i >> 2)});
  return corners;
}

/// The sites of the face-centred cubic lattice: corners and centres of the faces.
std::vector<Vec3> fcc_sites() {
  std::vector<Vec3> sites = cube_corners();
  for (double side : {0.0, 1.0}) {
    sites.push_back({side, 0.5, 0.5});
    sites.push_back({0.5, side, 0.5});
    sites.push_back({0.5, 0.5, side});
  }
  return sites;
}

/// Whether the number of coordinates at 3/4 of a site whose coordinates are 1/4 and 3/4 is even.
bool is_even(Vec3 site) {
  return ((site.x > 0.5) + (site.y > 0.5) + (site.z > 0.5)) % 2 == 0;
}

/// The centres of the eighths of the cube, or of every second one.
void add_eighths(std::vector<Vec3>& sites, bool even_only) {
  for (const Vec3& corner : cube_corners()) {
    const Vec3 site = Vec3{0.25, 0.25, 0.25} + corner * 0.5;
    if (!even_only || is_even(site)) sites.push_back(site);
  }
}

/// Struts between all pairs of nodes at this squared distance, which is exact for nodes at
/// sixteenths.
UnitCell connect(std::vector<Vec3> nodes, double distance_squared) {
  UnitCell cell;
  cell.nodes = std::move(nodes);
  for (uint32_t i = 0; i < cell.nodes.size(); ++i)
    for (uint32_t j = i + 1; j < cell.nodes.size(); ++j) {
      const Vec3 d = cell.nodes[j] - cell.nodes[i];
      if (dot(d, d) == distance_squared) cell.struts.push_back({i, j});
    }
  return cell;
}

}  // namespace

/// The cube's edges.
UnitCell cubic_unit_cell() {
  return connect(cube_corners(), 1);
}

/// The centre to the 8 corners.
UnitCell bcc_unit_cell() {
  std::vector<Vec3> nodes = cube_corners();
  nodes.push_back({0.5, 0.5, 0.5});
  return connect(std::move(nodes), 0.75);
}

/// Nearest sites of the face-centred cubic lattice: Deshpande, Fleck and Ashby, "Effective
/// properties of the octet-truss lattice material", 2001.
UnitCell octet_unit_cell() {
  return connect(fcc_sites(), 0.5);
}

/// The diagonals of all faces: the octet without the octahedron of face centres. Maconachie et al.,
/// "SLM lattice structures: properties, performance, applications and challenges", 2019; some leave
/// out the horizontal faces.
UnitCell fcc_unit_cell() {
  UnitCell cell = octet_unit_cell();
  std::erase_if(cell.struts, [](const auto& s) { return s[0] >= 8 && s[1] >= 8; });
  return cell;
}

/// The edges of a packing of truncated octahedra, the bitruncated cubic honeycomb, whose centres
/// are the corners and the centre of the cube: Thomson (Lord Kelvin), "On the division of space
/// with minimum partitional area", 1887, with plane faces. All edges are equal and all vertices
/// alike.
UnitCell kelvin_unit_cell() {
  std::vector<Vec3> nodes;  // the permutations of (0, +-1/4, +-1/2), from the centre
  for (int axis = 0; axis < 3; ++axis)
    for (int order = 1; order <= 2; ++order)
      for (double quarter : {-0.25, 0.25})
        for (double half : {-0.5, 0.5}) {
          Vec3 node{0.5, 0.5, 0.5};
          node[(axis + order) % 3] += quarter;
          node[(axis + 3 - order) % 3] += half;
          nodes.push_back(node);
        }
  return connect(std::move(nodes), 0.125);
}

/// The bonds of the diamond crystal: Bragg and Bragg, "The structure of the diamond", 1913.
UnitCell diamond_unit_cell() {
  std::vector<Vec3> nodes = fcc_sites();
  add_eighths(nodes, true);
  return connect(std::move(nodes), 0.1875);
}

/// The edges of a packing of rhombic dodecahedra, one about the centre of the cube and one about
/// the middle of each of its edges: Babaee, Jahromi, Ajdari, Nayeb-Hashemi and Vaziri, "Mechanical
/// properties of open-cell rhombic dodecahedron cellular structures", 2012.
UnitCell rhombic_dodecahedron_unit_cell() {
  std::vector<Vec3> nodes = fcc_sites();
  add_eighths(nodes, false);
  return connect(std::move(nodes), 0.1875);
}

/// Re-entrant honeycombs, whose hexagons have two opposite corners pushed in, in all planes x or y
/// = n/2, after Yang, Harrysson, West and Cormier, "Mechanical properties of 3D re-entrant
/// honeycomb auxetic structures realized via additive manufacturing", 2015. Vertical struts, 3/4 of
/// the cell high, stand half a cell apart in x and y; every second one is half a cell higher than
/// its four neighbours. So its end is 1/4 of the cell beyond those of its neighbours, and slanted
/// struts lead back from it to them. Pulled along z, the slanted struts become more level and push
/// the vertical ones apart: Poisson's ratio is negative in x-z and y-z.
UnitCell reentrant_unit_cell() {
  UnitCell cell;
  const auto add_node = [&](double x, double y, double z) {
    cell.nodes.push_back({x, y, z});
    return static_cast<uint32_t>(cell.nodes.size() - 1);
  };
  for (double y : {0.0, 0.5, 1.0})
    for (double x : {0.0, 0.5, 1.0}) {
      if ((x == 0.5) == (y == 0.5)) {  // corners and centre
        const uint32_t foot = add_node(x, y, 0.125), head = add_node(x, y, 0.875);
        cell.struts.push_back({foot, head});
      } else {  // halves of those below and above
        const uint32_t floor = add_node(x, y, 0), head = add_node(x, y, 0.375),
                       foot = add_node(x, y, 0.625), ceiling = add_node(x, y, 1);
        cell.struts.push_back({floor, head});
        cell.struts.push_back({foot, ceiling});
      }
    }
  const auto nodes = static_cast<uint32_t>(cell.nodes.size());
  for (uint32_t i = 0; i < nodes; ++i)
    for (uint32_t j = i + 1; j < nodes; ++j) {
      const Vec3 d = cell.nodes[j] - cell.nodes[i];
      if (std::abs(d.x) + std::abs(d.y) == 0.5 && std::abs(d.z) == 0.25)
        cell.struts.push_back({i, j});
    }
  return cell;
}

}  // namespace msq
