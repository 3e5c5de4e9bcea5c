// SPDX-License-Identifier: Apache-2.0
// Where rays enter and leave the struts of lattices. The struts are capsules. Rays cross one part
// of a cell after the other, and each part has a list of the struts that reach it.
//
// A strut contains one interval of a ray if the radius is constant or linear along it, since the
// distance to its axis is convex. Formulas give its approximate start (strut/capsule_list.h), and
// membership in that strut corrects it.
#pragma once

#include <vector>

#include "field/field.h"
#include "structure/lattice/cell/unit_cell.h"
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
  /// From the corner of the cell; with box_about(), in grid coordinates, those of the cell that was
  /// found last.
  virtual const CapsuleList& struts() const = 0;
  /// Number along each axis of a cell.
  virtual int parts() const = 0;
  /// Adds runs with all struts that can contain a point within 1e-7 cells of a part.
  virtual void find(CellIndex cell, const int (&part)[3], std::vector<Run>& runs) = 0;
  /// For cells that are not boxes of the grid: finds the cell of a point, of one part. Returns a
  /// box in grid coordinates that holds the cell and at least 1e-7 of a cell about it, of whose
  /// points find() knows all struts. Null: cells are boxes of the grid.
  virtual const Box3* box_about(Vec3 p, CellIndex& cell) {
    (void)p;
    (void)cell;
    return nullptr;
  }
};

class StrutRays {
 public:
  /// All must stay alive. The job may be null; if it is cancelled, calls throw Error(cancelled).
  StrutRays(const Structure& structure, StrutLists& lists, const Parameter& radius, const Job* job);

  /// Sets `found`, `t` and `normal`, as Structure::enter().
  void enter(RaySearch* searches, size_t count);
  /// As Structure::leave().
  double leave(const Ray& ray, double from, double to);
  /// As Structure::normal(), of the strut whose surface is nearest to the ray's point at t.
  Vec3 normal(const Ray& ray, double t);

 private:
  /// A part of a cell and where the ray crosses it.
  struct Part {
    CellIndex cell;
    int number[3];
    double from, to;
    bool is_short = false;  // a piece of it, in which the radius varies less than in the cell
  };
  struct Candidate {
    uint32_t strut;
    double enter, leave;  // along the ray
  };

  void enter(RaySearch& search);
  /// Calls visit(part) for the parts along [from, to] of the ray, until visit returns false.
  template <class Visit>
  void walk(const Ray& ray, double from, double to, Visit&& visit);
  template <class Visit>
  void walk_boxes(const Ray& ray, const Box3* box, Part& part, double to, Visit&& visit);
  /// Bounds of the radius in a part.
  Interval radii_in(const Ray& ray, const Part& part);
  /// Moves `until`, at which the ray is inside, towards the end of the part, as long as struts that
  /// hold the ray there hold it. Returns false if only the minimum radius of the part tells.
  bool follow(const Ray& ray, const Part& part, double& until);
  /// The same of one strut that the ray is about to leave.
  bool follow_out(const Ray& ray, const Part& part, uint32_t strut, double& until) const;
  /// The struts that the ray meets in a part with the minimum or the maximum radius there.
  void find_candidates(const Ray& ray, const Part& part, bool greatest);
  /// Finds the first t in [from, to] at which the strut contains the ray's point.
  bool enter_strut(const Ray& ray, const Part& part, const Candidate& candidate, double from,
                   double to, double& t) const;
  /// Finds the first t at or after `t` at which the strut, with varying radius, contains the ray's
  /// point, as inside(p) tells. The result is approximate, late by some tolerances if the ray
  /// grazes. Returns false if there is none before `to`.
  template <class Inside>
  bool approach(const Ray& ray, const Part& part, uint32_t strut, Inside&& inside, double& t,
                double to) const;
  bool holds(const Part& part, uint32_t strut, Vec3 p) const;
  /// Relative to the corner of the part's cell.
  Vec3 locate(const Part& part, Vec3 p) const;
  Vec3 normal_of(const Part& part, uint32_t strut, const Ray& ray, double t) const;

  const Structure& structure_;
  StrutLists& lists_;
  const Parameter& radius_;
  const Job* const job_;
  const Neighbourhood& grid_;
  double tolerance_ = 0;      // of the current ray
  bool is_in_boxes_ = false;  // that ray's parts: box_about()
  const double cell_;         // the smallest size
  std::vector<StrutLists::Run> runs_;
  std::vector<CapsuleList::Met> met_;
  std::vector<Candidate> candidates_;
  /// Of the cells that rays crossed last.
  struct CellRadii {
    CellIndex cell;
    bool is_known = false;
    Interval range{};
  };
  CellRadii radii_[64];
};

}  // namespace msq
