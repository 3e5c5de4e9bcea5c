// SPDX-License-Identifier: Apache-2.0
#include "structure/lattice/warped/warped_lattice.h"

#include <algorithm>
#include <cmath>

#include "base/infinity.h"
#include "structure/common/known_onset.h"
#include "structure/common/strut_distance_bound.h"
#include "structure/common/strut_rows.h"
#include "structure/lattice/warped/recent_lists.h"
#include "structure/lattice/warped/warped_struts.h"

namespace msq {

namespace {

/// Samples per cell above which spans are faster than the point query.
constexpr double critical_samples = 4;

}  // namespace

WarpedLattice::WarpedLattice(Ref<Context> context, std::unique_ptr<const CellPlaces> places,
                             const UnitCell& cell, Parameter radius)
    : Structure(places->smallest(), places->largest()),
      context_(std::move(context)),
      id_(context_->new_structure_id()),
      places_(std::move(places)),
      cell_(cell),
      radius_(std::move(radius)),
      graph_(cell_, *places_) {}

WarpedLattice::~WarpedLattice() {
  context_->cache.drop(id_);
}

WarpedLattice::List WarpedLattice::near(CellIndex list) const {
  return std::static_pointer_cast<const NearStruts>(context_->cache.fetch(id_, list, [&] {
    return std::make_shared<const NearStruts>(graph_, list, widened(),
                                              graph_.max_factor() * radius_.range().high);
  }));
}

template <class Measure, class Reach>
double WarpedLattice::least(Vec3 q, Measure&& measure, Reach&& reach) const {
  double least = infinity;
  std::vector<Vec3> corners;
  const auto visit = [&](CellIndex cell) {
    graph_.place(cell, corners);
    for (const PlacedGraph::Strut& s : graph_.struts_of(cell)) {
      if (!PlacedGraph::is_placed(corners, s)) continue;
      const Segment axis(corners[s.a], corners[s.b]);
      least = std::min(least, measure(std::sqrt(axis.distance_squared(q)), s.factor));
    }
  };
  visit(places_->nearest_with_struts(places_->cell_of(q)));
  const auto slack = [&] { return reach(least) * (1 + 1e-9) + widened(); };
  places_->for_each_cell(
      Box3{q, q}.grown(slack()),
      [&](const Box3& bounds) {
        check_cancelled();
        return length(q - max(bounds.min, min(bounds.max, q))) <= slack();
      },
      visit);
  return least;
}

bool WarpedLattice::inside(Vec3 p) const {
  const Vec3 q = neighbourhood().to_grid(p);
  return near(places_->list_of(q))->holds(q, radius_.at(p));
}

void WarpedLattice::keep_points(const Vec3* points, uint8_t* alive, size_t count) const {
  RecentLists lists(*this);
  constexpr size_t batch = 256;
  double radii[batch];
  for (size_t first = 0; first < count; first += batch) {
    check_cancelled();
    const size_t size = std::min(batch, count - first);
    radius_.values(points + first, size, radii);
    for (size_t i = 0; i < size; ++i) {
      if (!alive[first + i]) continue;
      const Vec3 q = neighbourhood().to_grid(points[first + i]);
      alive[first + i] = lists.find(places_->list_of(q)).holds(q, radii[i]);
    }
  }
}

double WarpedLattice::distance_bound(Vec3 p) const {
  const Vec3 q = neighbourhood().to_grid(p);
  const Interval r = radius_.range(Box3{p, p});
  const double factor = graph_.max_factor();
  const double most = max_distance * min_component(neighbourhood().cell_size);
  const double gap = std::min(
      most, least(
                q, [&](double distance, double f) { return distance - f * r.low; },
                [&](double gap_so_far) { return std::min(gap_so_far, most) + factor * r.low; }));
  // The error of positions, here and at the boundary.
  const double slack = locating_slack(p - neighbourhood().origin, std::abs(gap)) +
                       0x1p-46 * (cell_length() + std::abs(gap));
  return factored_distance_bound(gap, graph_.max_factor(), slack, radius_, p);
}

double WarpedLattice::onset_limit() const {
  return max_radius * min_component(neighbourhood().cell_size) / graph_.max_factor();
}

double WarpedLattice::onset(Vec3 p) const {
  const Vec3 q = neighbourhood().to_grid(p);
  const double limit = onset_limit(), factor = graph_.max_factor();
  const double onset = least(
      q, [](double distance, double f) { return distance / f; },
      [&](double onset_so_far) { return std::min(onset_so_far, limit) * factor; });
  return known_onset(*this, onset);
}

std::unique_ptr<StrutParts> WarpedLattice::struts(const StrutSelection& selection) const {
  return std::make_unique<WarpedStruts>(graph_, neighbourhood(), radius_, selection);
}

template <class Visit, class GoesOn>
void WarpedLattice::for_each_cell(const Box3& box, Visit&& visit, GoesOn&& goes_on) const {
  const Neighbourhood& grid = neighbourhood();
  const Box3 in_grid = grid.to_grid(box).grown(widened());
  const bool is_turned = grid.sample_axes()[0] < 0;
  places_->for_each_cell(
      in_grid,
      [&](const Box3& bounds) {
        return goes_on() && bounds.overlaps(in_grid) &&
               (!is_turned || grid.from_grid(bounds).overlaps(box));
      },
      visit);
}

void WarpedLattice::for_each_strut(const Box3& box, const TakeStrut& take, const Job* job) const {
  const Neighbourhood& grid = neighbourhood();
  const double radius = radius_.range().high;
  std::vector<Vec3> corners;
  const auto take_cell = [&](CellIndex cell) {
    graph_.place(cell, corners);
    for (Vec3& corner : corners) corner = grid.from_grid(corner);
    for (const PlacedGraph::Strut& s : graph_.struts_of(cell))
      if (PlacedGraph::is_placed(corners, s)) take(corners[s.a], corners[s.b], s.factor * radius);
  };
  for_each_cell(box.grown(graph_.max_factor() * radius + widened()), take_cell, [&] {
    check_cancelled(job);
    return true;
  });
}

void WarpedLattice::keep_rows(const RowBlock& block, const Job* job) const {
  const Neighbourhood& grid = neighbourhood();
  const double most = graph_.max_factor();
  StrutRows rows(block, grid, radius_, 1e-9 * most * radius_.range().high, most);
  if (rows.empty()) return;
  std::vector<CellIndex> cells;
  const auto pays = [&] { return rows.pays(static_cast<double>(cells.size()), critical_samples); };
  // There may be far more cells than samples.
  for_each_cell(
      rows.reach(), [&](CellIndex cell) { cells.push_back(cell); },
      [&] {
        check_cancelled(job);
        return pays();
      });
  if (!pays()) return Structure::keep_rows(block, job);
  std::vector<Vec3> corners;
  // The struts of one factor one after the other.
  for (const double factor : graph_.factors())
    for (const CellIndex cell : cells) {
      check_cancelled(job);
      const std::vector<PlacedGraph::Strut>& struts = graph_.struts_of(cell);
      auto s = std::lower_bound(
          struts.begin(), struts.end(), factor,
          [](const PlacedGraph::Strut& strut, double f) { return strut.factor > f; });
      if (s == struts.end() || s->factor != factor) continue;
      graph_.place(cell, corners);
      for (Vec3& corner : corners) corner = grid.from_grid(corner);
      for (; s != struts.end() && s->factor == factor; ++s)
        if (PlacedGraph::is_placed(corners, *s)) rows.add(corners[s->a], corners[s->b], factor);
    }
  rows.finish(job, [this](Vec3 p) { return inside(p); });
}

void WarpedLattice::enter(RaySearch* searches, size_t count, const Job* job) const {
  RecentLists lists(*this);
  StrutRays(*this, lists, radius_, job).enter(searches, count);
}

double WarpedLattice::leave(const Ray& ray, double from, double to, const Job* job) const {
  RecentLists lists(*this);
  return StrutRays(*this, lists, radius_, job).leave(ray, from, to);
}

Vec3 WarpedLattice::normal(const Ray& ray, double t) const {
  RecentLists lists(*this);
  return StrutRays(*this, lists, radius_, nullptr).normal(ray, t);
}

void WarpedLattice::describe(HashInput& input) const {
  input.kind("structure: lattice in warped cells");
  neighbourhood().describe(input);
  places_->describe(input);
  cell_.describe(input);
  radius_.describe(input);
}

}  // namespace msq
