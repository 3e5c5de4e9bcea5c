// SPDX-License-Identifier: Apache-2.0
// Exact entries of a ray into the struts of single edges of a foam: from the edge's seeds, in
// double precision, and by membership if rounding leaves a doubt.
//
// Only the cylinder around an edge's line is tested, between the planes through its ends. The balls
// around the ends are never seen. Proof: the edges at a Voronoi vertex point along the outward
// normals of the faces of a Delaunay tetrahedron, and these, times the faces' areas, add up to 0.
// So for any direction, one of them has a positive product with it. So the graph's point nearest to
// a point of space is not a vertex, and a ray that enters a ball around a vertex is already in the
// cylinder of another edge.
#pragma once

#include <array>

#include "base/ray.h"
#include "structure/foam/edges/edge_brick.h"
#include "structure/foam/foam_data.h"
#include "structure/foam/point/edge_line.h"
#include "structure/foam/rays/ray_brick.h"

namespace msq {

/// A ray in foam units along the grid's axes, from the grid's origin on.
struct FoamRay {
  Vec3 origin, direction;
  double from, to;
  double error;             ///< of points: maximum distance from those that membership uses
  double tolerance;         ///< of positions along it
  const RaySearch* search;  ///< the same in model units

  Vec3 at(double t) const { return origin + direction * t; }
  /// In model units, `unit` being the foam's: the point at which membership is evaluated.
  Vec3 model_point(double t, double unit) const {
    return search->ray.at(t <= from ? search->from : t * unit);
  }
};

/// How rays are seen in a foam.
struct FoamFrame {
  const Neighbourhood* grid;
  double to_foam;    ///< of lengths, from model units
  double tolerance;  ///< of rays with small coordinates, foam units

  FoamRay ray(const RaySearch& search) const;
};

struct StrutEntry {
  bool is_met = false;
  /// Whether every query of the strut finds this entry, with any data on its ends. Otherwise
  /// queries agree only if they use the same data.
  bool is_sure = false;
  bool at_from = false;  ///< the ray is inside at its start
  bool by_ends = false;  ///< found without the strut's line, for sharpen_entry()
  double t = 0;          ///< foam units
  Vec3 normal;           ///< model frame; 0 if the caller is to compute it
};

/// Whether a ray meets one entry before another. Edges that coincide have the same entry. Then
/// other properties decide, so that the order of tests does not matter.
bool comes_before(const StrutEntry& entry, const StrutEntry& other);

/// The properties of an edge that do not depend on the ray.
struct StrutLine {
  Vec3 corner;            ///< origin of the edge's coordinates, foam units
  Vec3 a, ab;             ///< its ends, in single precision
  bool has_line = false;  ///< whether its seeds are known; if so:
  Vec3 home;              ///< corner of its owner's cell; relative to that:
  EdgeLine line;
  Vec3 along;         ///< the line's direction, of length 1
  double length = 0;  ///< along that, from a
  double error = 0;   ///< of the line
};

class TaperedStrut;

/// Slack for the error of ends, in single precision, and of the line that they are compared with.
constexpr double end_error = 4 * edge_error;

/// Slack for the rounding of positions along rays in single precision, foam units.
constexpr float along_rounding = 4e-6f;

/// Squared sine of an angle. A ray at a smaller angle to a line keeps its distance from it. It is
/// far below the rounding of directions, except for rays exactly along a line.
constexpr double parallel_squared = 1e-60;

/// Distance from 0 along the direction u at which a ray enters the capsule of a segment; infinite
/// if it misses. As in strut/capsule_rays.cpp.
double capsule_entry(Vec3 a, Vec3 ab, Vec3 u, double radius);

class StrutEntries {
 public:
  explicit StrutEntries(const FoamData& foam);

  StrutLine line(const RayBrick& brick, size_t edge) const;
  /// The line from its three seeds, in their order, without ends.
  StrutLine line(const std::array<CellIndex, 3>& seeds) const;

  /// Sets the ends of a strut, relative to the corner of a cell, in single precision.
  void set_ends(const std::array<float, 3>& a, const std::array<float, 3>& b, CellIndex corner,
                StrutLine& strut) const;

  /// The frame that find() works in.
  const FoamFrame& frame() const { return frame_; }
  FoamRay ray(const RaySearch& search) const { return frame_.ray(search); }

  /// Depends on ray and edge alone: the same bits in every query. May leave out entries into the
  /// strut where another strut covers its surface.
  StrutEntry find(const FoamRay& ray, const StrutLine& strut) const;

  /// The first t in (before, beyond], a multiple of half the tolerance, at which the ray is inside,
  /// as it is at `beyond`. Rounding may make several such t. The result does not depend on how
  /// close `before` and `beyond` are, as long as all of these t are between them.
  StrutEntry settle(const FoamRay& ray, double before, double beyond) const;

  /// For a radius that is a field: the entry into a strut that is within `near` of `about`, if the
  /// ray enters there; the bits that find() finds.
  StrutEntry find_tapered_near(const FoamRay& ray, const StrutLine& strut, double about,
                               double near) const;

 private:
  bool inside(const FoamRay& ray, double t) const;
  StrutEntry graze(const FoamRay& ray, const StrutLine& strut, double middle, double half) const;
  /// The part of a ray within the infinite cylinder of a strut.
  struct Section {
    double under;     ///< what the root of its length is taken of; may be below 0
    double room;      ///< the error of that
    double inverse;   ///< times that root: half the length
    double middle;    ///< along the ray
    double end_room;  ///< the error of distances from the strut's ends
  };
  /// find() of a ray so shallow in the strut that rounding may move its entry too far.
  StrutEntry find_shallow(const FoamRay& ray, const StrutLine& strut, const Section& section) const;
  /// find() of a ray that begins within the cylinder, which it leaves at `out`.
  StrutEntry begin(const FoamRay& ray, const StrutLine& strut, double out, double end_room) const;
  StrutEntry find_by_ends(const FoamRay& ray, const StrutLine& strut) const;
  // tapered_entry.cpp
  StrutEntry find_tapered(const FoamRay& ray, const StrutLine& strut) const;
  StrutEntry tapered_entry(const FoamRay& ray, const TaperedStrut& tapered, double at,
                           bool has_line) const;

  const FoamData& foam_;
  const double radius_, inverse_radius_;  // foam units
  const FoamFrame frame_;
};

}  // namespace msq
