// SPDX-License-Identifier: Apache-2.0
// How the boundary crosses a cell of the grid: as loops of crossings, each the border of one piece
// of surface.
//
// The corner (dx, dy, dz) of a cell has the number dx + 2 dy + 4 dz. The edge along an axis has the
// number 4 * axis + d1 + 2 * d2, with the offsets of the other two axes in their order. The face
// normal to an axis, at its low or high side, has the number 2 * axis + side.
//
// On each face of a cell, arcs join the crossings on its edges in pairs. A face with four crossings
// is ambiguous: if its centre is inside, the arcs go around the corners outside, else around those
// inside. So the two cells of a face agree. Source: Nielson and Hamann, "The asymptotic decider",
// 1991; Nielson, "Dual marching cubes", 2004.
#pragma once

#include <array>
#include <cstdint>

namespace msq {

struct CellLoops {
  static constexpr uint8_t none = 255;
  uint8_t count = 0;
  std::array<uint8_t, 12> of_edge{};  ///< number of the loop; none where nothing crosses
};

constexpr unsigned cell_edge(int axis, unsigned d1, unsigned d2) {
  return 4 * static_cast<unsigned>(axis) + d1 + 2 * d2;
}
constexpr int axis_of_edge(unsigned edge) {
  return static_cast<int>(edge / 4);
}
/// Offset of an edge from its cell's corner 0: 0 or 1 along each axis, 0 along its own.
constexpr std::array<uint8_t, 3> offset_of_edge(unsigned edge) {
  const uint8_t d1 = edge & 1, d2 = edge >> 1 & 1;
  return edge < 4   ? std::array<uint8_t, 3>{0, d1, d2}
         : edge < 8 ? std::array<uint8_t, 3>{d1, 0, d2}
                    : std::array<uint8_t, 3>{d1, d2, 0};
}
constexpr unsigned first_corner(unsigned edge) {
  const std::array<uint8_t, 3> d = offset_of_edge(edge);
  return d[0] + 2u * d[1] + 4u * d[2];
}
constexpr unsigned second_corner(unsigned edge) {
  return first_corner(edge) + (1u << axis_of_edge(edge));
}

/// Corners and edges of a face in turn: edge q runs from corner q to corner q + 1.
struct CellFace {
  std::array<uint8_t, 4> corners, edges;
};
constexpr CellFace cell_face(unsigned face) {
  const int axis = static_cast<int>(face / 2);
  const unsigned side = face & 1;
  const int b = axis == 0 ? 1 : 0, c = axis == 2 ? 1 : 2;
  const auto corner = [&](unsigned db, unsigned dc) {
    return static_cast<uint8_t>((side << axis) + (db << b) + (dc << c));
  };
  // Of the two other axes of an edge along b, the face's axis comes first where it is before c.
  const auto along_b = [&](unsigned dc) {
    return static_cast<uint8_t>(axis < c ? cell_edge(b, side, dc) : cell_edge(b, dc, side));
  };
  const auto along_c = [&](unsigned db) {
    return static_cast<uint8_t>(axis < b ? cell_edge(c, side, db) : cell_edge(c, db, side));
  };
  return {{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)},
          {along_b(0), along_c(1), along_b(1), along_c(0)}};
}
inline constexpr std::array<CellFace, 6> cell_faces = {cell_face(0), cell_face(1), cell_face(2),
                                                       cell_face(3), cell_face(4), cell_face(5)};

constexpr bool is_ambiguous(unsigned corners, const CellFace& face) {
  const auto inside = [&](size_t q) { return corners >> face.corners[q] & 1; };
  return inside(0) == inside(2) && inside(1) == inside(3) && inside(0) != inside(1);
}
/// The ambiguous faces of a cell, as bits. `corners`: those inside, as bits.
constexpr uint8_t ambiguous_faces(unsigned corners) {
  unsigned faces = 0;
  for (unsigned f = 0; f < 6; ++f) faces |= is_ambiguous(corners, cell_faces[f]) ? 1u << f : 0;
  return static_cast<uint8_t>(faces);
}

/// `centres`: the ambiguous faces whose centre is inside, as bits.
constexpr CellLoops find_loops(unsigned corners, unsigned centres) {
  std::array<uint8_t, 12> parent{};
  for (uint8_t e = 0; e < 12; ++e) parent[e] = e;
  const auto root = [&](uint8_t e) {
    while (parent[e] != e) e = parent[e];
    return e;
  };
  const auto join = [&](uint8_t a, uint8_t b) { parent[root(a)] = root(b); };
  const auto inside = [&](unsigned corner) { return corners >> corner & 1; };
  for (unsigned f = 0; f < 6; ++f) {
    const CellFace& face = cell_faces[f];
    const bool four = is_ambiguous(corners, face);
    const unsigned centre = centres >> f & 1;
    uint8_t first = CellLoops::none;
    for (size_t q = 0; q < 4; ++q) {
      const unsigned here = inside(face.corners[q]), next = inside(face.corners[(q + 1) % 4]);
      if (four && here != centre) join(face.edges[(q + 3) % 4], face.edges[q]);
      if (four || here == next) continue;
      if (first == CellLoops::none)
        first = face.edges[q];
      else
        join(first, face.edges[q]);
    }
  }
  CellLoops loops;
  std::array<uint8_t, 12> number{};
  for (uint8_t& n : number) n = CellLoops::none;
  for (uint8_t e = 0; e < 12; ++e) {
    loops.of_edge[e] = CellLoops::none;
    if (inside(first_corner(e)) == inside(second_corner(e))) continue;
    uint8_t& n = number[root(e)];
    if (n == CellLoops::none) n = loops.count++;
    loops.of_edge[e] = n;
  }
  return loops;
}

/// Loops of cells without ambiguous faces, and the ambiguous faces, by corners.
struct CellTable {
  std::array<CellLoops, 256> loops;
  std::array<uint8_t, 256> ambiguous;
};
inline const CellTable& cell_table() {
  static const CellTable table = [] {
    CellTable made;
    for (unsigned corners = 0; corners < 256; ++corners) {
      made.loops[corners] = find_loops(corners, 0);
      made.ambiguous[corners] = ambiguous_faces(corners);
    }
    return made;
  }();
  return table;
}

}  // namespace msq
