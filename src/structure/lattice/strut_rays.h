// SPDX-License-Identifier: Apache-2.0
// Where rays enter and leave the struts of lattices: capsules, met one part of a cell after the
// other, each with a list of those that reach it.
//
// A strut holds one interval of a ray where the radius is constant or linear along it, since the
// distance to its axis is convex. Formulas give about where that begins (strut/capsule_list.h), and
// membership in that strut settles it.
#pragma once

#include <vector>

#include "field/field.h"
#include "structure/lattice/unit_cell.h"
#include "structure/structure.h"
#include "strut/capsule_list.h"

namespace msq {

/// The struts of a lattice by parts of its cells.
class StrutLists {
 public:
  virtual ~StrutLists() = default;
  struct Run {
    uint32_t begin, end;
  };
  /// From the corner of the cell.
  virtual const CapsuleList& struts() const = 0;
  /// Along each axis of a cell.
  virtual int parts() const = 0;
  /// Adds runs that hold all struts that can hold a point within 1e-7 cells of a part.
  virtual void find(CellIndex cell, const int (&part)[3], std::vector<Run>& runs) = 0;
};

class StrutRays {
 public:
  /// All must stay alive.
  StrutRays(const Structure& structure, StrutLists& lists, const Parameter& radius);

  /// Fills in `found`, `t` and `normal`, as Structure::enter().
  void enter(RaySearch* searches, size_t count);
  /// As Structure::leave().
  double leave(const Ray& ray, double from, double to);
  /// As Structure::normal(): of the strut whose surface is next to where the ray is at t.
  Vec3 normal(const Ray& ray, double t);

 private:
  /// A part of a cell and where the ray crosses it.
  struct Part {
    CellIndex cell;
    int number[3];
    double from, to;
  };
  struct Candidate {
    uint32_t strut;
    double enter, leave;  // along the ray
  };

  void enter(RaySearch& search);
  /// Calls visit(part), which answers whether to go on, along [from, to] of the ray.
  template <class Visit>
  void walk(const Ray& ray, double from, double to, Visit&& visit) const;
  /// What the radius may be in a part.
  Interval radii_in(const Ray& ray, const Part& part);
  /// Those that the ray meets in a part, were their radius the least or the greatest there.
  void find_candidates(const Ray& ray, const Part& part, bool greatest);
  /// The first t in [from, to] at which the strut holds the ray.
  bool enter_strut(const Ray& ray, const Part& part, const Candidate& candidate, double from,
                   double to, double& t) const;
  /// From t on, where the strut of a radius that varies first holds the ray, as inside(p) tells:
  /// about the first such t, behind it by tolerances where the ray grazes. False if nowhere before
  /// `to`.
  template <class Inside>
  bool approach(const Ray& ray, const Part& part, uint32_t strut, Inside&& inside, double& t,
                double to) const;
  bool holds(const Part& part, uint32_t strut, Vec3 p) const;
  /// From the corner of the part's cell.
  Vec3 locate(const Part& part, Vec3 p) const;
  Vec3 normal_of(const Part& part, uint32_t strut, const Ray& ray, double t) const;

  const Structure& structure_;
  StrutLists& lists_;
  const Parameter& radius_;
  const Neighbourhood& grid_;
  const double tolerance_, cell_;  // cell_: the smallest size
  std::vector<StrutLists::Run> runs_;
  std::vector<CapsuleList::Met> met_;
  std::vector<Candidate> candidates_;
  /// Of cells that rays came through last.
  struct CellRadii {
    CellIndex cell;
    bool is_known = false;
    Interval range{};
  };
  CellRadii radii_[64];
};

}  // namespace msq
