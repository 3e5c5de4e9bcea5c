// SPDX-License-Identifier: Apache-2.0
// The named unit cells of plate lattices. Those of the first four are planes of cubic crystals:
// Tancogne-Dejean, Diamantopoulou, Gorji, Bonatti and Mohr, "3D plate-lattices: an emerging class
// of low-density metamaterial exhibiting optimal isotropic stiffness", 2018.
#include "structure/lattice/cell/plate_cell.h"

namespace msq {

namespace {

/// Corner i has coordinate 1 along the axes of the bits of i.
std::vector<Vec3> cube() {
  std::vector<Vec3> corners;
  corners.reserve(8);
  for (int i = 0; i < 8; ++i)
    corners.push_back({double(i & 1), double(i >> 1 & 1), double(i >> 2)});
  return corners;
}

void add_quadrilateral(PlateCell& cell, uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
  cell.faces.push_back({a, b, c});
  cell.faces.push_back({a, c, d});
}

/// A convex polygon about its centre, a node of the cell.
void add_fan(PlateCell& cell, uint32_t centre, const std::vector<uint32_t>& around) {
  for (size_t i = 0; i < around.size(); ++i)
    cell.faces.push_back({centre, around[i], around[(i + 1) % around.size()]});
}

/// The planes {111} through the nodes: x + y + z = 1 and 2, and those of the mirrored cells. Each
/// is a triangle of diagonals of faces: the corners with an odd, or an even, number of ones, less
/// one of them.
void add_octet(PlateCell& cell) {
  const std::array<uint32_t, 4> tetrahedra[] = {{1, 2, 4, 7}, {0, 3, 5, 6}};
  for (const auto& t : tetrahedra)
    for (size_t left_out = 0; left_out < 4; ++left_out)
      cell.faces.push_back({t[(left_out + 1) % 4], t[(left_out + 2) % 4], t[(left_out + 3) % 4]});
}

}  // namespace

/// The planes {100} of a simple cubic crystal: the cube's faces at 0.
PlateCell cubic_plate_cell() {
  PlateCell cell{cube(), {}, {}};
  add_quadrilateral(cell, 0, 2, 6, 4);
  add_quadrilateral(cell, 0, 1, 5, 4);
  add_quadrilateral(cell, 0, 1, 3, 2);
  return cell;
}

/// The planes {110} of a body-centred cubic crystal: the six rectangles through two opposite edges
/// of the cube.
PlateCell bcc_plate_cell() {
  PlateCell cell{cube(), {}, {}};
  for (const uint32_t axis : {1u, 2u, 4u}) {
    const uint32_t one = axis == 1 ? 2 : 1, other = axis == 4 ? 2 : 4;
    add_quadrilateral(cell, 0, axis, axis + one + other, one + other);
    add_quadrilateral(cell, one, axis + one, axis + other, other);
  }
  return cell;
}

/// The planes {111} of a face-centred cubic crystal: the faces of the tetrahedra and octahedra of
/// the octet truss.
PlateCell fcc_plate_cell() {
  PlateCell cell{cube(), {}, {}};
  add_octet(cell);
  return cell;
}

/// The planes {100}, then the planes {111}: Berger, Wadley and McMeeking, "Mechanical metamaterials
/// at the theoretical limit of isotropic elastic stiffness", 2017.
PlateCell cubic_octet_plate_cell() {
  PlateCell cell = cubic_plate_cell();
  add_octet(cell);
  return cell;
}

/// The faces of truncated octahedra (kelvin_unit_cell()), one about the centre of the cell and one
/// about its corners: Gibson and Ashby, "Cellular Solids", 1997. The squares between those about
/// the corners lie in the faces of the cell, about the middles of its edges: a quarter of each in
/// each cell.
PlateCell kelvin_plate_cell() {
  PlateCell cell;
  const auto add = [&](Vec3 node) {
    for (uint32_t i = 0; i < cell.nodes.size(); ++i)
      if (cell.nodes[i] == node) return i;
    cell.nodes.push_back(node);
    return static_cast<uint32_t>(cell.nodes.size() - 1);
  };
  const Vec3 centre{0.5, 0.5, 0.5};
  // Hexagons: with signs s, from (0, s/4, s/2) on through the permutations.
  for (const Vec3& corner : cube()) {
    const Vec3 sign = corner * 2 - Vec3{1, 1, 1};
    const auto vertex = [&](double x, double y, double z) {
      return add(centre + Vec3{x, y, z} * sign);
    };
    const std::vector<uint32_t> hexagon = {vertex(0, 0.25, 0.5), vertex(0.25, 0, 0.5),
                                           vertex(0.5, 0, 0.25), vertex(0.5, 0.25, 0),
                                           vertex(0.25, 0.5, 0), vertex(0, 0.5, 0.25)};
    add_fan(cell, add(centre + sign * 0.25), hexagon);
  }
  // Squares of the central one at 0: those at 1 are theirs, a cell on.
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 middle = centre, u, v;
    middle[axis] = 0;
    u[(axis + 1) % 3] = v[(axis + 2) % 3] = 0.25;
    add_fan(cell, add(middle),
            {add(middle + u), add(middle + v), add(middle - u), add(middle - v)});
  }
  // Quarters of the squares about the middles of edges.
  for (int axis = 0; axis < 3; ++axis)
    for (int edge = 0; edge < 4; ++edge) {
      const int second = (axis + 1) % 3, third = (axis + 2) % 3;
      Vec3 middle;
      middle[axis] = 0.5;
      middle[second] = edge & 1;
      middle[third] = edge >> 1;
      Vec3 along_second = middle, along_third = middle;
      along_second[second] += edge & 1 ? -0.25 : 0.25;
      along_third[third] += edge >> 1 ? -0.25 : 0.25;
      cell.faces.push_back({add(middle), add(along_second), add(along_third)});
    }
  return cell;
}

}  // namespace msq
