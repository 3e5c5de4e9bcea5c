// SPDX-License-Identifier: Apache-2.0
// Where a ray enters the struts of single edges of a foam, exactly: from the edge's seeds, in
// double precision, and by membership where rounding leaves a doubt.
//
// Only the cylinder about an edge's line is looked at, between the planes through its ends. The
// balls about the ends are never seen: the edges that leave a Voronoi vertex point along the
// outward normals of the faces of a Delaunay tetrahedron, which, times the faces' areas, add up to
// nothing. So for any direction there is one among them that it has a positive product with: the
// graph's point nearest to a point of space is not a vertex, and a ray that enters a ball about one
// is in the cylinder of another edge by then.
#pragma once

#include <array>

#include "base/ray.h"
#include "structure/foam/edge_line.h"
#include "structure/foam/edges.h"
#include "structure/foam/foam.h"
#include "structure/foam/seeded_edges.h"

namespace msq {

/// A ray in foam units along the grid's axes, from the grid's origin on.
struct FoamRay {
  Vec3 origin, direction;
  double from, to;
  /// No coordinate of its part is larger.
  double most;
  const RaySearch* search;  ///< the same in model units

  Vec3 at(double t) const { return origin + direction * t; }
  /// In model units, `unit` being the foam's: the point whose membership is asked.
  Vec3 model_point(double t, double unit) const {
    return search->ray.at(t <= from ? search->from : t * unit);
  }
};

struct StrutEntry {
  bool is_met = false;
  bool at_from = false;  ///< the ray is inside where it begins
  bool by_ends = false;  ///< found without the strut's line, for sharpen_entry()
  double t = 0;          ///< foam units
  Vec3 normal;           ///< model frame; 0 where others are to find it
};

/// Whether a ray meets one entry before another. Edges that coincide are entered at one place: then
/// it is by what else tells them apart, so that no matter in which order they are asked.
bool comes_before(const StrutEntry& entry, const StrutEntry& other);

/// What of an edge does not depend on the ray.
struct StrutLine {
  Vec3 corner;            ///< the edge is relative to, foam units
  Vec3 a, ab;             ///< its ends, in single precision
  bool has_line = false;  ///< whether its seeds are known; if so:
  Vec3 home;              ///< corner of its owner's cell; from there:
  EdgeLine line;
  Vec3 along;         ///< the line's direction, of length 1
  double length = 0;  ///< from a along that
  double error = 0;   ///< of the line
};

class TaperedStrut;

/// Room for the error of ends, in single precision, and of the line that they are compared with.
constexpr double end_error = 4 * edge_error;

/// How far from 0 along the direction u the capsule of a segment is entered; infinite if it is
/// missed. As in strut/capsule_rays.cpp.
double capsule_entry(Vec3 a, Vec3 ab, Vec3 u, double radius);

class StrutEntries {
 public:
  explicit StrutEntries(const Foam& foam);

  StrutLine line(const SeededEdges& brick, size_t edge) const;
  /// As far as its three seeds tell, in their order: without ends.
  StrutLine line(const std::array<CellIndex, 3>& seeds) const;

  /// Sets the ends of a strut, from the corner of a cell, in single precision.
  void set_ends(const std::array<float, 3>& a, const std::array<float, 3>& b, CellIndex corner,
                StrutLine& strut) const;

  /// The frame that find() works in.
  FoamRay ray(const RaySearch& search) const;

  /// What does not depend on anything but ray and edge: the same bits whoever asks. Entries into
  /// the strut where another strut covers its surface may be left out.
  StrutEntry find(const FoamRay& ray, const StrutLine& strut) const;

  /// The first t in (before, beyond], a multiple of half the tolerance, at which the ray is inside:
  /// that does not depend on how near `before` and `beyond` are.
  StrutEntry settle(const FoamRay& ray, double before, double beyond) const;

  /// Where the radius is a field: the entry into a strut that is within `near` of `about`, if the
  /// ray comes in there; the bits that find() finds.
  StrutEntry find_tapered_near(const FoamRay& ray, const StrutLine& strut, double about,
                               double near) const;

 private:
  bool inside(const FoamRay& ray, double t) const;
  StrutEntry graze(const FoamRay& ray, const StrutLine& strut, double middle, double half) const;
  StrutEntry find_by_ends(const FoamRay& ray, const StrutLine& strut) const;
  // tapered_entry.cpp
  StrutEntry find_tapered(const FoamRay& ray, const StrutLine& strut) const;
  StrutEntry tapered_entry(const FoamRay& ray, const TaperedStrut& tapered, double at,
                           bool has_line) const;

  const Foam& foam_;
  const double radius_, inverse_radius_, tolerance_;  // foam units
};

}  // namespace msq
