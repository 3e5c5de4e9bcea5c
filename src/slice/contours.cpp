// SPDX-License-Identifier: Apache-2.0
#include "slice/contours.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <unordered_set>

#include "base/borrowed.h"
#include "base/memory.h"
#include "base/simd.h"
#include "base/status.h"
#include "query/reach.h"
#include "slice/contour_details.h"
#include "slice/contour_gaps.h"
#include "slice/contour_line.h"
#include "slice/contour_points.h"
#include "slice/contour_rings.h"
#include "slice/contour_section.h"
#include "slice/contour_topology.h"
#include "slice/nearest_unit.h"

namespace msq {

namespace {

/// Units to a pitch and to a tolerance: what rounding needs.
constexpr double min_units_of_pitch = 64, min_units_of_tolerance = 4;
/// Of crossings: of the tolerance.
constexpr double accuracy_of_tolerance = 0x1p-10;

/// The greatest number of three binary digits that is no greater.
double three_digits(double x) {
  int exponent;
  const double mantissa = std::frexp(x, &exponent);
  return std::ldexp(std::floor(mantissa * 8), exponent - 3);
}

/// Writes the rings, with no more points than needed.
class RingBuilder {
 public:
  RingBuilder(const ContourRings& rings, double tolerance, double units, Contours& out)
      : rings_(rings), tolerance_(tolerance), units_(units), out_(out) {}

  /// The rings that there are now.
  void build(const ContourDetails& details, const Job* job) {
    detail_ = details.points().data();
    end_ = detail_ + details.points().size();
    JobPoll poll(job);
    for (const ContourRings::Ring& ring : rings_.rings()) {
      poll();
      add_ring(ring);
    }
  }
  /// Rings that could not be drawn.
  uint64_t dropped() const { return dropped_; }

 private:
  struct Written {
    int64_t index, parent;  // of the rings that are returned; -1: none
    bool is_hole;
  };

  void add_ring(const ContourRings::Ring& from) {
    Written ring{-1, -1, from.is_hole};
    if (from.beside != ContourRings::none) {
      const Written& beside = written_[from.beside];
      ring.parent = beside.is_hole != ring.is_hole ? beside.index : beside.parent;
    }
    const size_t most = find_runs(from);
    if (points_.size() < most) points_.resize(most);
    const size_t count = simplify_ring(runs_.data(), runs_.size(), at_.data(), gates_.data(),
                                       units_, points_.data());
    const int64_t index = static_cast<int64_t>(out_.ring_count());
    // What cannot be drawn stands for what is around it.
    const bool is_drawn = out_.add_ring({points_.data(), count}, ring.parent, ring.is_hole);
    dropped_ += !is_drawn;
    ring.index = is_drawn ? index : ring.parent;
    written_.push_back(ring);
  }

  /// Finds what lies between the points that stay. `at_` and `gates_` then tell of crossings.
  /// Returns how many points there are.
  size_t find_runs(const ContourRings::Ring& ring) {
    // Room for the crossings before the first point that stays once more.
    const uint64_t room = 2 * uint64_t{ring.end - ring.first} + max_simd_doubles;
    if (at_.size() < room) {
      at_.resize(room);
      gates_.resize(room);
    }
    rings_.find_gates(ring, tolerance_, at_.data(), gates_.data());
    const DetailPoint *detail = detail_, *const end = details_until(ring.end);
    // Both crossings of a piece with several points of its own stay.
    const auto has_several = [&](const DetailPoint* d, uint32_t id) {
      return end - d >= 2 && d[0].id == id && d[1].id == id;
    };
    bool stays = end - detail >= 2 && has_several(end - 2, ring.end - 1);
    uint32_t kept = 0, before = 0;
    runs_.clear();
    const auto end_run = [&] { (runs_.empty() ? before : runs_.back().end) = kept; };
    for (uint32_t id = ring.first; id < ring.end; ++id) {
      if (ring.is_inner && !stays) {
        const uint32_t next = detail != end ? detail->id : ring.end;
        kept += next - id;
        if (next == ring.end) break;
        id = next;
      }
      const bool are_several = has_several(detail, id);
      if (!rings_.is_beyond(id)) {
        at_[kept] = at_[id - ring.first];
        gates_[kept] = gates_[id - ring.first];
        if (stays || are_several || rings_.is_on_seam(id)) {
          end_run();
          runs_.push_back({at_[kept], kept + 1, 0});
        }
        ++kept;
      } else if (rings_.is_horizontal(id) && rings_.is_on_seam(id)) {
        // Of these only the corners of the window count: once, though two crossings lie there.
        end_run();
        runs_.push_back({rings_.at(id), kept, 0});
      }
      for (; detail != end && detail->id == id; ++detail) {
        end_run();
        runs_.push_back({detail->at, kept, 0});
      }
      stays = are_several;
    }
    if (runs_.empty()) {
      if (kept > 0) runs_.push_back({at_[0], 1, kept});
      return kept;
    }
    std::copy_n(at_.begin(), before, at_.begin() + kept);
    std::copy_n(gates_.begin(), before, gates_.begin() + kept);
    runs_.back().end = kept + before;
    return kept + before + runs_.size();
  }

  /// Those that are left of crossings before one; the others are left.
  const DetailPoint* details_until(uint32_t id) {
    while (detail_ != end_ && detail_->id < id) ++detail_;
    return detail_;
  }

  const ContourRings& rings_;
  const DetailPoint *detail_ = nullptr, *end_ = nullptr;
  const double tolerance_, units_;
  Contours& out_;
  uint64_t dropped_ = 0;
  std::vector<Written> written_;
  // Of the current ring.
  std::vector<Vec2> at_;
  std::vector<LineGate> gates_;
  std::vector<LineRun> runs_;
  std::vector<Vec2> points_;
};

/// Whether crossings come from struts: of cells that are not smaller than this, few are queried
/// about.
bool gives_struts(const Scales& resolved, double pitch) {
  return resolved.regions.empty() && resolved.size() == 1 && resolved[0]->skin.is_none() &&
         resolved[0]->structure->has_struts() && resolved[0]->structure->cell_length() >= 2 * pitch;
}

/// The struts of a layer, and its nodes in the shape alone.
struct LayerStruts {
  LayerStruts(const Model& model, const Structure& structure, const ContourGrid& grid,
              double around, const Job* job)
      : held(model.context().budget, grid.words() * sizeof(uint64_t), "the nodes of a layer"),
        shape(grid.alike()),
        all(structure, grid, around, model.context().budget, job) {
    shape.find_nodes(model, {}, job);
  }
  const Reservation held;
  ContourGrid shape;
  const PlaneStruts all;
};

/// The window, no larger than what is around the model. False if there is nothing in it.
bool find_window(const Model& model, const ContourPlan& plan, double pitch, double low[2],
                 double high[2]) {
  const Box3& box = model.bounds();
  const int axes[2] = {plan.plane.u_axis(), plan.plane.v_axis()};
  bool is_empty =
      plan.plane.height < box.min[plan.plane.axis] || plan.plane.height > box.max[plan.plane.axis];
  for (int i = 0; i < 2; ++i) {
    const double a = box.min[axes[i]], b = box.max[axes[i]];
    low[i] = plan.has_window ? std::max(plan.window_min[i], a - 2 * pitch) : a;
    high[i] = plan.has_window ? std::min(plan.window_max[i], b + 2 * pitch) : b;
    is_empty = is_empty || !(low[i] < high[i]) || high[i] < a || low[i] > b;
  }
  return !is_empty;
}

/// How far crossings keep from nodes.
double margin_of(const ContourPlan& plan, double pitch) {
  const bool is_integer = plan.format != ContourFormat::float64;
  return std::max(0x1p-20 * pitch, is_integer ? 2 / plan.units : 0);
}

/// A side is the only edge along an axis that has no node but at its ends.
void check_sides(double margin, double pitch, const double low[2], const double high[2]) {
  for (int i = 0; i < 2; ++i)
    if (!(high[i] - low[i] >= 4 * margin))
      fail(Status::argument,
           "a side of the window is %g; with a pitch of %g and these units it must be at least %g",
           high[i] - low[i], pitch, 4 * margin);
}

void check_units(const ContourPlan& plan, double pitch, const double low[2], const double high[2]) {
  // Beyond 2^53 doubles skip whole numbers.
  double limit = plan.format == ContourFormat::int32 ? double{INT32_MAX} : 0x1p53;
  if (plan.format == ContourFormat::float64) {
    limit = std::numeric_limits<double>::max();
  } else {
    if (!(pitch * plan.units >= min_units_of_pitch))
      fail(Status::argument, "a pitch of %g is %g units; it must be at least %g", pitch,
           pitch * plan.units, min_units_of_pitch);
    if (!(plan.tolerance * plan.units >= min_units_of_tolerance))
      fail(Status::argument, "a tolerance of %g is %g units; it must be at least %g",
           plan.tolerance, plan.tolerance * plan.units, min_units_of_tolerance);
  }
  for (int i = 0; i < 2; ++i)
    for (const double at : {low[i], high[i]})
      if (std::isfinite(at) && !(std::abs(at * plan.units) <= limit))
        fail(Status::limit, "coordinate %g is %.17g units; the limit is %.17g", at, at * plan.units,
             limit);
}

/// The unit of LayerPlane: near the pitch, or near the window's size if that is less. So the unit
/// times the plan's units does not overflow if the window's coordinates times these do not. Nor
/// does it underflow.
double plane_unit(double pitch, double size, double units) {
  constexpr int max_exponent = 1000;  // then the inverse is in range, too
  const int least = std::min(std::max(0, -std::ilogb(units)) - max_exponent, max_exponent);
  int exponent;
  std::frexp(std::min(pitch, size), &exponent);
  return std::ldexp(1, std::clamp(exponent - 2, least, max_exponent));
}

/// The window of a layer and what its grid needs.
struct WindowGrid {
  double low[2], high[2];
  double pitch, margin;
};

/// The same in another unit of the plane.
ContourPlan in_unit(ContourPlan plan, double unit) {
  plan.plane.unit = unit;
  plan.tolerance /= unit;
  plan.units *= unit;
  return plan;
}
WindowGrid in_unit(WindowGrid grid, double unit) {
  for (double* x :
       {&grid.low[0], &grid.low[1], &grid.high[0], &grid.high[1], &grid.pitch, &grid.margin})
    *x /= unit;
  return grid;
}

/// All lengths of the plane are in its unit.
void find_contours(const Model& model, const Scales& resolved, const ContourPlan& plan,
                   const WindowGrid& at, Contours& out, Job* job) {
  const std::shared_ptr<MemoryBudget>& budget = model.context().budget;
  const double pitch = at.pitch, margin = at.margin;
  ContourGrid grid(plan.plane, at.low, at.high, pitch);
  const Reservation nodes(budget, grid.bytes(model, resolved), "the nodes of a layer");
  ContourPoints points(model, resolved, plan.plane, job);
  std::optional<LayerStruts> struts;
  if (gives_struts(resolved, pitch * plan.plane.unit)) {
    const Structure& structure = *resolved[0]->structure;
    // Points lie in the window, however large the tolerance is.
    const double size = std::max(at.high[0] - at.low[0], at.high[1] - at.low[1]);
    struts.emplace(model, structure, grid, 2 * std::min(plan.tolerance, size), job);
    points.use_struts(struts->all);
    // Else rows of lattices cost less.
    if (structure.gains_by_layers())
      grid.find_nodes(struts->all, struts->shape, points);
    else
      grid.find_nodes(model, resolved, job);
  } else {
    grid.find_nodes(model, resolved, job);
  }
  if (job) job->set_progress(0.25);

  // Half of the tolerance is for what the boundary does between crossings, half for leaving points
  // out.
  const double part = 0.5 * plan.tolerance;
  ContourSection section(grid, margin);
  // Of a ring, gates may be there twice, and three times the points.
  constexpr uint64_t bytes = ContourSection::bytes_of_crossing + 2 * sizeof(LineGate) +
                             2 * sizeof(Vec2) + 3 * sizeof(Vec2);
  const Reservation edges(budget, ContourSection::bytes_of_edges(grid), "the edges of a layer");
  const uint64_t crossing_count = section.count_crossings(job);
  const Reservation crossings(budget, crossing_count * bytes + ContourRings::bytes(crossing_count),
                              "the crossings of a layer");
  section.trace(points, accuracy_of_tolerance * std::min(plan.tolerance, pitch),
                struts ? &struts->all : nullptr, struts ? &struts->shape : nullptr);
  ContourGaps gaps(section, gap_parts(pitch, plan.tolerance, margin));
  gaps.find(points);
  const Reservation more(budget,
                         gaps.crossing_count() * (ContourRings::bytes_of_gap_crossing + bytes),
                         "the gaps of a layer");
  if (job) job->set_progress(0.75);
  ContourRings rings(section, gaps, struts.has_value(), plan.tolerance / 32);
  const Borrowed<ContourNumbers> room;
  out.begin(*room);
  RingBuilder builder(rings, part, plan.units, out);
  std::unordered_set<uint64_t> taken;
  uint64_t unresolved = section.unresolved() - gaps.saddles() + gaps.unresolved();
  rings.follow_all(section, points, [&] {
    ContourDetails details(rings, part, plan.format != ContourFormat::float64 ? plan.units : 0,
                           struts.has_value(), taken);
    details.find(points);
    builder.build(details, job);
    unresolved += details.unresolved();
  });
  out.set_unresolved(unresolved);
  out.close(*room);
  if (plan.topology_samples != 0)
    out.set_topology(builder.dropped() + gaps.count_topology_steps(job) +
                     count_topology_steps(model, resolved, section, plan.topology_samples, job));
}

}  // namespace

const void* Contours::points() const {
  switch (format_) {
    case ContourFormat::int32:
      return numbers_.int32.data();
    case ContourFormat::int64:
      return numbers_.int64.data();
    default:
      return numbers_.float64.data();
  }
}

bool Contours::add_ring(std::span<const Vec2> ring, int64_t parent, bool is_hole) {
  const auto add = [&]<class T>(std::vector<T>& out) {
    const size_t first = out.size();
    const auto put = [&](T u, T v) {
      if (out.size() > first && out[out.size() - 2] == u && out.back() == v) return;
      out.push_back(u);
      out.push_back(v);
    };
    for (const Vec2 p : ring) {
      if constexpr (std::is_integral_v<T>)
        put(static_cast<T>(nearest_unit(p.x)), static_cast<T>(nearest_unit(p.y)));
      else
        put(p.x, p.y);
    }
    while (out.size() >= first + 4 && out[first] == out[out.size() - 2] &&
           out[first + 1] == out.back())
      out.resize(out.size() - 2);
    if (out.size() < first + 6) {
      out.resize(first);
      return false;
    }
    starts_.push_back(out.size() / 2);
    return true;
  };
  const bool is_added = format_ == ContourFormat::int32   ? add(numbers_.int32)
                        : format_ == ContourFormat::int64 ? add(numbers_.int64)
                                                          : add(numbers_.float64);
  if (!is_added) return false;
  parents_.push_back(parent);
  holes_.push_back(is_hole);
  return true;
}

void Contours::begin(ContourNumbers& room) {
  room.int32.clear();
  room.int64.clear();
  room.float64.clear();
  std::swap(numbers_, room);
}

void Contours::close(ContourNumbers& room) {
  ContourNumbers own = numbers_;  // copies take no more memory than needed
  std::swap(numbers_, room);
  std::swap(numbers_, own);
}

Ref<Contours> layer_contours(const Model& model, const ContourPlan& plan, Job* job) {
  JobScope scope(job);
  if (!plan.has_window && !model.shape().is_bounded())
    fail(Status::argument, "has_window is 0; a model of all space has no bounds, so give a window");
  const double pitch = three_digits(plan.pitch > 0 ? plan.pitch : plan.tolerance);
  Ref<Contours> out = make_ref<Contours>(plan.format, plan.topology_samples);
  out->set_pitch(pitch);
  WindowGrid at{{}, {}, pitch, margin_of(plan, pitch)};
  const bool is_empty = !find_window(model, plan, pitch, at.low, at.high);
  check_units(plan, pitch, at.low, at.high);
  if (is_empty) {
    scope.done();
    return out;
  }
  check_sides(at.margin, pitch, at.low, at.high);
  const Scales resolved = model.resolved(plan.length_scale);
  ContourGrid::check(plan.plane, at.low, at.high, pitch);
  require_reach(
      model, resolved,
      Box3{plan.plane.at(at.low[0], at.low[1]), plan.plane.at(at.high[0], at.high[1])}.grown(pitch),
      "the window");
  const double size = std::max(at.high[0] - at.low[0], at.high[1] - at.low[1]);
  const double unit = plane_unit(pitch, size, plan.units);
  find_contours(model, resolved, in_unit(plan, unit), in_unit(at, unit), *out, job);
  scope.done();
  return out;
}

}  // namespace msq
