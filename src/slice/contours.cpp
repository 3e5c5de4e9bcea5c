// SPDX-License-Identifier: Apache-2.0
#include "slice/contours.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/borrowed.h"
#include "base/memory.h"
#include "base/status.h"
#include "slice/contour_details.h"
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
    line_.clear();
    bool is_next_fixed = false;
    for (uint32_t id = from.first; id < from.end; ++id) {
      add_crossing(id, is_next_fixed);
      is_next_fixed = detail_ != end_ && detail_->id == id && add_details();
    }
    if (is_next_fixed) line_.front().is_fixed = true;
    simplify_ring(line_, points_);
    for (Vec2& p : points_) p = p * units_;
    const int64_t index = static_cast<int64_t>(out_.ring_count());
    // What cannot be drawn stands for what is around it.
    const bool is_drawn = out_.add_ring(points_, ring.parent, ring.is_hole);
    dropped_ += !is_drawn;
    ring.index = is_drawn ? index : ring.parent;
    written_.push_back(ring);
  }

  void add_crossing(uint32_t id, bool is_fixed) {
    const Vec2 at = rings_.at(id);
    if (rings_.is_beyond(id)) {
      // Of these only the corners of the window count: once, though two crossings lie there.
      if (rings_.is_horizontal(id) && rings_.is_on_seam(id)) line_.push_back({at, true, {}, {}});
      return;
    }
    if (is_fixed || rings_.is_on_seam(id)) {
      line_.push_back({at, true, {}, {}});
      return;
    }
    // Horizontal and vertical edges alternate in no order: indices instead of branches.
    const uint32_t along = rings_.axis_along(id);
    const double both[2] = {at.x, at.y};
    const double middle = both[along];
    const auto [edge_low, edge_high] = rings_.ends(id);
    const double low = std::max(middle - tolerance_, edge_low + rings_.margin());
    const double high = std::min(middle + tolerance_, edge_high - rings_.margin());
    const bool starts_inside = rings_.starts_inside(id);
    const double ends[2] = {low, high};
    // Only stores: to load what was just stored in other pieces takes long.
    LinePoint& p = line_.emplace_back(LinePoint{at, false, {at.x, at.y}, {at.x, at.y}});
    p.left[along] = ends[!starts_inside];
    p.right[along] = ends[starts_inside];
  }

  /// The points that follow the last crossing. Whether the next crossing must stay.
  bool add_details() {
    const DetailPoint* const first = detail_;
    const size_t before = line_.size() - 1;
    for (; detail_ != end_ && detail_->id == first->id; ++detail_)
      line_.push_back({detail_->at, true, {}, {}});
    if (detail_ - first < 2) return false;
    line_[before].is_fixed = true;
    return true;
  }

  const ContourRings& rings_;
  const DetailPoint *detail_ = nullptr, *end_ = nullptr;
  const double tolerance_, units_;
  Contours& out_;
  uint64_t dropped_ = 0;
  std::vector<Written> written_;
  std::vector<LinePoint> line_;
  std::vector<Vec2> points_;
};

/// Whether crossings come from struts: of cells that are not smaller than this, few are asked
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

bool Contours::add_ring(const std::vector<Vec2>& ring, int64_t parent, bool is_hole) {
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
  const double pitch = three_digits(plan.pitch > 0 ? plan.pitch : plan.tolerance);
  Ref<Contours> out = make_ref<Contours>(plan.format, plan.topology_samples);
  out->set_pitch(pitch);
  double low[2], high[2];
  const bool is_empty = !find_window(model, plan, pitch, low, high);
  check_units(plan, pitch, low, high);
  if (is_empty) {
    scope.done();
    return out;
  }
  const double margin = margin_of(plan, pitch);
  check_sides(margin, pitch, low, high);
  const Scales resolved = model.resolved(plan.length_scale);
  ContourGrid grid(plan.plane, low, high, pitch);
  const std::shared_ptr<MemoryBudget>& budget = model.context().budget;
  const Reservation nodes(budget, grid.bytes(model, resolved), "the nodes of a layer");
  ContourPoints points(model, resolved, plan.plane, job);
  std::optional<LayerStruts> struts;
  if (gives_struts(resolved, pitch)) {
    const Structure& structure = *resolved[0]->structure;
    struts.emplace(model, structure, grid, 2 * plan.tolerance, job);
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
  constexpr uint64_t bytes = ContourSection::bytes_of_crossing + ContourRings::bytes_of_crossing +
                             sizeof(LinePoint) + 2 * sizeof(Vec2);
  const Reservation crossings(
      budget, section.count_crossings(job) * bytes + 2 * sizeof(uint32_t) * grid.words(),
      "the crossings of a layer");
  section.trace(points, accuracy_of_tolerance * std::min(plan.tolerance, pitch),
                struts ? &struts->all : nullptr, struts ? &struts->shape : nullptr);
  if (job) job->set_progress(0.75);
  ContourRings rings(section);
  const Borrowed<ContourNumbers> room;
  out->begin(*room);
  RingBuilder builder(rings, part, plan.units, *out);
  uint64_t unresolved = section.unresolved();
  rings.follow_all(section, job, [&] {
    ContourDetails details(rings, part, plan.format != ContourFormat::float64 ? plan.units : 0);
    details.find(points);
    builder.build(details, job);
    unresolved += details.unresolved();
  });
  out->set_unresolved(unresolved);
  out->close(*room);
  if (plan.topology_samples != 0)
    out->set_topology(builder.dropped() +
                      count_topology_steps(model, resolved, section, plan.topology_samples, job));
  scope.done();
  return out;
}

}  // namespace msq
