// SPDX-License-Identifier: Apache-2.0
// The interface of fine-scale structures (scales 1 and finer). inside() is the definition. All
// other functions agree with it bit for bit, and have defaults that call it. A new kind is a new
// folder beside this file that implements inside(), plus its constructor in src/api.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>

#include "base/described.h"
#include "base/job.h"
#include "base/ray.h"
#include "base/ref.h"
#include "base/sample_grid.h"
#include "base/signed_distance.h"
#include "base/vec.h"
#include "cell/neighbourhood.h"
#include "structure/common/line_graph.h"

namespace msq {

enum class BoxClass { mixed, outside, inside };

class Parameter;
class StrutParts;
struct StrutSelection;

class Structure : public Described {
 public:
  explicit Structure(const Neighbourhood& neighbourhood)
      : neighbourhood_(neighbourhood),
        cell_length_(max_component(neighbourhood.cell_size)),
        characteristic_length_(cell_length_) {}

  /// The grid. For kinds without a grid, cubes by which points are grouped. If cells vary in size,
  /// the grid of the smallest ones.
  const Neighbourhood& neighbourhood() const { return neighbourhood_; }
  /// If false, cells have no meaning: their indices are not limited, and hits name no cell.
  bool is_on_grid() const { return is_on_grid_; }
  using TakeGrid = std::function<void(const Neighbourhood&)>;
  /// Calls take() for each grid in which the indices of cells are limited: that of a kind on a
  /// grid, those of the structures that it is made of.
  virtual void for_each_grid(const TakeGrid& take) const {
    if (is_on_grid_) take(neighbourhood_);
  }
  /// The cell that contains a point, for kinds on a grid.
  virtual CellIndex cell_of(Vec3 p) const { return neighbourhood_.locate(p).cell; }
  /// The largest cell size of the grid: the unit of tolerances and steps. The largest of those that
  /// a structure is made of.
  double cell_length() const { return cell_length_; }
  /// The largest cell size; for kinds without a grid, or with cells of varying size, the length
  /// given at construction.
  double characteristic_length() const { return characteristic_length_; }

  /// How many structures made of other structures are within each other.
  virtual unsigned nesting() const { return 0; }

  /// Membership of a point. The boundary is inside. Points have a cell index below max_cell_index
  /// in each grid (for_each_grid()).
  virtual bool inside(Vec3 p) const = 0;

  /// Whether several threads at once may evaluate the structure. Otherwise only the thread that
  /// made the host's call may. A structure with parameters is concurrent if those are: their fields
  /// may be the host's.
  virtual bool is_concurrent() const { return true; }

  /// Signed distance of the same points: at most 0 if inside(p), otherwise positive. Its magnitude
  /// is at most the distance from p to the boundary of the solid.
  double distance(Vec3 p) const { return signed_distance(inside(p), distance_bound(p)); }

  /// A lower bound on the distance from a point to the boundary of the solid, on either side of it.
  /// It is finite and not negative, and the rounding of this function and of inside() is
  /// subtracted. Apart from that rounding, its values at two points differ by at most the points'
  /// distance, unless a parameter has a Lipschitz constant in boxes only. Each kind documents where
  /// its bound is exact. The default, 0, is always valid.
  virtual double distance_bound(Vec3) const { return 0; }
  /// Whether distance_bound() has the Lipschitz constant 1 everywhere, and is more than 0 away from
  /// the boundary, rounding, and borders of cells where a function jumps. Default: where
  /// sloped_parameter() has a slope that bounds it everywhere.
  virtual bool has_steady_distance() const { return is_sloped_everywhere(); }

  /// Whether onset() is implemented.
  virtual bool has_onset() const { return false; }
  /// The minimum value of the parameter, radius or level, at which p is inside, for a parameter
  /// that is constant in space. Infinity if there is none, or if it is above onset_limit(). The
  /// comparison with the parameter equals inside(p), except for rounding of at most 1e-9 of a cell.
  virtual double onset(Vec3) const { return std::numeric_limits<double>::infinity(); }
  /// onset() of many points, to the last bit. Stops early, by Error(cancelled), with the thread's
  /// job. Default: one after the other.
  virtual void onsets(const Vec3* points, size_t count, double* to) const;
  /// The parameter at p, for kinds that have an onset.
  virtual double parameter(Vec3) const { return 0; }
  /// The maximum value that the parameter may have.
  virtual double onset_limit() const { return std::numeric_limits<double>::infinity(); }
  /// Whether all cells are equal, apart from the effect of fields.
  virtual bool is_periodic() const { return false; }
  /// Whether the cells from the grid's origin on are like those elsewhere.
  virtual bool is_alike_from_origin() const { return true; }

  /// Sets alive[i] to 0 where points[i] is outside. Evaluates only points with alive[i] != 0, which
  /// are 1. Takes fewer than 2^32 points, in any order.
  virtual void keep_points(const Vec3* points, uint8_t* alive, size_t count) const;
  /// Whether keep_points is faster for points that share cells. Then large sets come in groups,
  /// each from a box of few cells.
  virtual bool gains_by_groups() const { return false; }
  /// The best number of parts along each axis of a cell for such groups. Groups are from parts of
  /// cells only if these contain hundreds of points.
  virtual uint32_t group_parts() const { return 1; }
  /// The minimum number of points in a group for which keep_points is faster than single points, as
  /// measured (docs/benchmarks.md).
  virtual uint64_t critical_count() const { return 1; }

  /// The coverage of a box, valid for all its points; `mixed` is always valid. For kinds with
  /// knows_boxes(), boxes are evaluated before their points.
  virtual BoxClass classify(const Box3&) const { return BoxClass::mixed; }
  virtual bool knows_boxes() const { return false; }

  /// For each search, finds the first t in [from, to] at which the ray is inside, at most
  /// ray_tolerance(ray, to) past it. It may miss parts shorter than that, or no deeper than the
  /// rounding of coordinates. Points of the parts have a cell index below max_cell_index. Stops
  /// early, by Error(cancelled), with the job, within some milliseconds. Default: marches by
  /// distance_bound() and by min_ray_step().
  virtual void enter(RaySearch* searches, size_t count, const Job* job) const;
  /// A t, at most `to`, up to which a ray that is inside at `from` stays inside; as far as one step
  /// can tell. Default: as enter().
  virtual double leave(const Ray& ray, double from, double to, const Job* job) const;
  /// The outward normal, of length 1, where the ray enters at t. If there is none, the direction
  /// back along the ray. Default: from membership around the point.
  virtual Vec3 normal(const Ray& ray, double t) const;
  /// The distance from a point at which normals by membership sample.
  double normal_distance() const { return 0x1p-12 * min_component(neighbourhood().cell_size); }
  double ray_tolerance() const { return 0x1p-36 * cell_length(); }
  /// The same for a ray up to `to`: larger if the coordinates are so large that their rounding is.
  /// Membership rounds them in the model's frame, and then relative to the grid's origin.
  virtual double ray_tolerance(const Ray& ray, double to) const {
    // Most rays: no coordinate exceeds this sum, which is rounded by far less than a factor of 2.
    const double reach =
        max_magnitude(ray.origin) + std::abs(to) + max_magnitude(neighbourhood_.origin);
    if (coordinate_rounding(2 * reach) <= ray_tolerance()) return ray_tolerance();
    const double max =
        std::max(max_coordinate(ray, to), max_coordinate(ray, to, neighbourhood_.origin));
    return std::max(ray_tolerance(), coordinate_rounding(max));
  }
  /// The radius or the thickness, if distance_bound() takes its slope into account: 0 where it has
  /// none. Null: no such parameter.
  virtual const Parameter* sloped_parameter() const { return nullptr; }
  /// The minimum step of rays that march, for any value of distance_bound(). Steps are smaller only
  /// where distance_bound() is 0 only on the boundary.
  virtual double min_ray_step() const;

  /// Whether wall_lines() finds anything.
  virtual ThinWalls thin_walls() const { return ThinWalls::none; }
  /// The middle lines of thin walls in a plane, at least all in the window. Where they are does not
  /// depend on the window. Stops early, by Error(cancelled), with the thread's job. Default: throws
  /// Error(unsupported).
  virtual LineGraph wall_lines(const WallSection& section) const;

  /// Whether the solid is a union of capsules, each of one radius.
  virtual bool has_struts() const { return false; }
  using TakeStrut = std::function<void(Vec3 a, Vec3 b, double radius)>;
  /// Calls take() for all struts that may touch a box, at least once each, with the same numbers in
  /// every call. Their error is at most that of samples in doubt (keep_rows()).
  virtual void for_each_strut(const Box3&, const TakeStrut&, const Job*) const {}

  /// The selected struts as a graph (common/struts.h), for as long as the structure lives; null for
  /// kinds without struts.
  virtual std::unique_ptr<StrutParts> struts(const StrutSelection&) const;

  /// Whether rows cost less in blocks of many layers, because the work per cell serves all of its
  /// samples in a block.
  virtual bool gains_by_layers() const { return false; }
  /// How many copies of a block's bits keep_rows() holds at once, in memory of its own.
  virtual unsigned row_copies() const { return 0; }
  /// Clears the bits of samples that are outside. Stops early, by Error(cancelled), with the job.
  virtual void keep_rows(const RowBlock& block, const Job* job) const;
  /// The same of a block all of whose samples are alive, though no bits say so: sets its words.
  /// Default: sets all bits, and calls keep_rows().
  virtual void draw_rows(const RowBlock& block, const Job* job) const;

 protected:
  /// A kind whose cells vary in size.
  Structure(const Neighbourhood& smallest, double characteristic_length)
      : neighbourhood_(smallest),
        cell_length_(max_component(smallest.cell_size)),
        characteristic_length_(characteristic_length) {}
  /// A kind without a grid. The cubes have a side about as long as the kind's parts.
  Structure(Vec3 origin, double side, double characteristic_length)
      : neighbourhood_{origin, {side, side, side}, {}},
        cell_length_(side),
        characteristic_length_(characteristic_length),
        is_on_grid_(false) {}
  /// A kind made of other structures: no grid of its own. Points are grouped by the cells of
  /// `groups`.
  Structure(const Neighbourhood& groups, double cell_length, double characteristic_length)
      : neighbourhood_(groups),
        cell_length_(cell_length),
        characteristic_length_(characteristic_length),
        is_on_grid_(false) {}

  /// The first t in [from, to] at which membership is `wanted`, by distance_bound() and
  /// min_ray_step().
  bool march(bool wanted, const Ray& ray, double from, double to, double& t, const Job* job) const {
    return march(wanted, ray, from, to, t, job, [this](Vec3 p) { return inside(p); });
  }
  /// The same with holds(p) in place of inside(p), to the last bit.
  template <class Holds>
  bool march(bool wanted, const Ray& ray, double from, double to, double& t, const Job* job,
             Holds&& holds) const {
    const double tolerance = ray_tolerance(ray, to), coarse = std::max(min_ray_step(), tolerance);
    const RayMarch steps{sloped_parameter() ? tolerance : coarse, tolerance};
    return steps.find(
        wanted, ray, from, to, holds, [&](Vec3 p) { return march_step(p, coarse); }, t, job);
  }

 private:
  /// Whether the parameter has a slope that bounds it everywhere.
  bool is_sloped_everywhere() const;
  /// distance_bound(), or `coarse` where a sloped parameter has no slope about p.
  double march_step(Vec3 p, double coarse) const;

  Neighbourhood neighbourhood_;
  double cell_length_, characteristic_length_;
  bool is_on_grid_ = true;
};

}  // namespace msq
