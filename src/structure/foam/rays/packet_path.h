// SPDX-License-Identifier: Apache-2.0
// The path of a packet of rays through slabs of cells: its course and its ends in double precision,
// and positions in single precision, as precise as the sieve of its capsules (strut/capsule_rays.h)
// requires.
#pragma once

#include <cstdint>

#include "structure/foam/rays/packet_rays.h"
#include "strut/capsule_rays.h"

namespace msq {

/// How a packet crosses the grid.
struct PacketCourse {
  int axis = 0;      ///< along which it crosses most cells
  bool up = true;    ///< its direction along that
  double begin = 0;  ///< the first coordinate of its rays along that, foam units
  double error = 0;  ///< the maximum error of its rays
  alignas(64) double inverse[RayPacket::most];  ///< of directions along the axis; 0 for other rays
};

/// Chooses the course of the rays `live`, and sets the directions of the packet. Returns false if
/// the rays cross too different cells along the axis. `scale`: the size of a cell.
bool set_course(const PacketRays& rays, uint32_t live, Vec3 scale, PacketCourse& course,
                RayPacket& packet);

/// Rays from a plane across the grid on, in foam units. Slab n is n slabs behind the plane. Along
/// the two other axes, positions are relative to a corner on that plane.
struct PacketPath {
  static constexpr size_t most = RayPacket::most;

  alignas(64) double enter[most];  ///< t on the plane
  alignas(64) double way[most];    ///< change of t per slab, above 0
  alignas(64) double last[most];   ///< t up to which the sieve has seen all struts in the way

  alignas(64) float place[2][most];  ///< position on the plane
  alignas(64) float slope[2][most];  ///< change of position per slab
  alignas(64) float step[most];      ///< as `way`
  alignas(64) float from[most];      ///< where rays begin and end; t is 0 on the plane
  alignas(64) float to[most];
};

/// The plane of a path, and the corner on it.
struct PathBase {
  double plane;
  double corner[2];
};

/// Sets the path of the rays `live`, and the positions of the packet relative to the base.
void set_path(const PacketRays& rays, const PacketCourse& course, const PathBase& base, Vec3 scale,
              uint32_t live, PacketPath& path, RayPacket& packet);

struct PathSlab {
  int number;
  int axis;     ///< across it
  float begin;  ///< coordinate along that axis where rays enter
  float rise;   ///< from there to where they leave
};

/// What part of a packet does in a slab.
struct SlabCrossing {
  uint32_t active = 0;  ///< rays that are in it
  uint32_t ended = 0;   ///< and rays that end before it
  /// The box of the active rays' positions.
  float low[2], high[2];
};

/// Examines the rays of `live`. If any is active, it sets the packet's line to one in their middle,
/// in this slab. If the packet is parallel, `along` is unchanged.
SlabCrossing cross_slab(const PacketPath& path, const PathSlab& slab, uint32_t live,
                        RayPacket& packet);

/// Cells of a slab: numbers along the two other axes, inclusive, at most `most` along each; and
/// their size.
struct SlabCells {
  static constexpr int most = 4;
  int32_t first[2], last[2];
  float size[2];
};

struct CrossedCell {
  int32_t cell[2];
  uint32_t rays;  ///< that cross it
  /// The parts of their way through the slab where the first one enters and the last one leaves.
  float enter, leave;
};

/// The least slope, per slab, with which it pays to find out which rays cross which cells.
constexpr float least_crossing_slope = 1e-3f;
/// Writes those of the cells that active rays cross in slab `number`, and returns how many they
/// are: all of them, as if crossed from end to end by all rays, if the first one is less steep than
/// that. The active rays are in the cells. A point of a ray that no cell found seems to contain is
/// within 1e-5 of one.
size_t find_crossed_cells(const PacketPath& path, int number, uint32_t active,
                          const SlabCells& cells,
                          CrossedCell (&found)[SlabCells::most * SlabCells::most]);

/// Sets path.last of the rays `active` in a slab, and returns those that may meet a strut up to
/// there. `seen`: the part of their way through the slab that the sieve has seen, infinite for all
/// of it.
uint32_t who_may_meet(const PacketRays& rays, int slab, const PacketHits& hits, uint32_t active,
                      double seen, PacketPath& path);

}  // namespace msq
