// SPDX-License-Identifier: Apache-2.0
#include "structure/functional/functional.h"

#include <cmath>

#include "base/borrowed.h"
#include "base/infinity.h"
#include "expression/period.h"
#include "structure/common/row_period.h"
#include "structure/common/shell_rays.h"
#include "structure/common/strut_distance_bound.h"
#include "structure/functional/function_lines.h"
#include "structure/functional/functional_rows.h"
#include "structure/functional/map_places.h"
#include "structure/functional/map_rows.h"
#include "structure/functional/ray_search.h"
#include "structure/functional/row_kernels.h"
#include "structure/functional/sheared_rows.h"
#include "structure/functional/single_wave_rows.h"
#include "structure/functional/tape_rows.h"
#include "structure/functional/turned_rows.h"
#include "structure/functional/warped_places.h"
#include "structure/functional/warped_rows.h"

namespace msq {

namespace {

/// Number along an axis of the cell: fewer for tapes whose enclosures take long.
int automatic_clusters(const Tape& tape) {
  return tape.nodes.size() > 200 ? 16 : 32;
}

Tape onset_of(const Tape& function, FunctionalKind kind) {
  if (kind == FunctionalKind::network) return function;
  TapeBuilder builder;
  std::vector<uint32_t> number;
  for (const Node& node : function.nodes)
    number.push_back(node.op == Op::constant ? builder.constant(node.value)
                     : node.op < Op::add
                         ? builder.coordinate(static_cast<int>(node.op) - static_cast<int>(Op::x))
                         : builder.apply(node.op, number[node.a],
                                         has_two_operands(node.op) ? number[node.b] : 0));
  return builder.finish(builder.apply(Op::absolute, number.back()));
}

/// Points that are evaluated together.
struct Points {
  static constexpr size_t room = batch_points + batch_padding;
  double coordinates[3][room] = {};
  double angles[3][room], levels[room] = {}, radii[room];
  Vec3 queried[batch_points];
  size_t index[batch_points];
  uint64_t in_place[batch_points / 64 + 1];

  /// Sets angles of the first points from their coordinates, and bits of those whose place the
  /// cells fill.
  void find_angles(const CellAngles& cells, size_t count) {
    const Values x{coordinates[0], false}, y{coordinates[1], false}, z{coordinates[2], false};
    double* const all[3] = {angles[0], angles[1], angles[2]};
    if (cells.sampled()) return find_map_places(*cells.sampled(), x, y, z, count, all, in_place);
    std::fill(std::begin(in_place), std::end(in_place), ~uint64_t{0});
    if (!cells.warp()) return cells.find(x, y, z, count, all);
    find_warped_places(*cells.warp(), x, y, z, count, all, radii);
    for (size_t i = 0; i < count; ++i)
      if (!cells.warp()->is_in_shell(radii[i])) in_place[i / 64] &= ~(uint64_t{1} << i % 64);
  }
};

std::vector<RowPlan> row_plans(const Clusters& clusters, const std::array<int, 3>& sample_axis) {
  std::vector<RowPlan> plans;
  if (sample_axis[0] >= 0)
    for (const Tape& tape : clusters.tapes()) plans.emplace_back(tape, sample_axis);
  return plans;
}

}  // namespace

Functional::Functional(const Neighbourhood& neighbourhood, const Tape& function,
                       FunctionalKind kind, Parameter level, int clusters, CellShape cells)
    : Structure(smallest_cells(neighbourhood, cells), largest_cell(neighbourhood, cells)),
      angles_(this->neighbourhood(), std::move(cells)),
      level_(std::move(level)),
      kind_(kind),
      function_(function),
      onset_(onset_of(function, kind)),
      program_(compile(onset_)),
      ray_program_(onset_),
      sample_axis_(neighbourhood.sample_axes()),
      side_(clusters ? clusters : automatic_clusters(onset_)),
      repeats_(msq::repeats(onset_)),
      is_continuous_(onset_.is_continuous() && std::isfinite(level_.lipschitz())) {
  // Steps of rows have the same angles only in cells of one size.
  const bool is_uniform = angles_.is_uniform();
  const bool is_mapped_along = angles_.sampled() && this->neighbourhood().sample_axes()[0] >= 0;
  const bool is_sheared = angles_.warp() && angles_.warp()->shell().is_sheared();
  if (is_mapped_along || (is_uniform && sample_axis_[0] < 0) ||
      (is_sheared && sample_axis_[0] >= 0))
    form_ = TrigonometricForm::of(onset_);
  if (is_uniform || angles_.sampled()) return;
  double most = 0;
  if (angles_.period()) most = angles_.period()->most() * (1 + 0x1p-45);
  if (angles_.warp()) {
    // Half the inner radius, so that the bounds are not 0 at the shell.
    most = 2 * angles_.warp()->numbers().around / angles_.warp()->shell().inner;
    has_steepest_ = angles_.warp()->kind() == Warp::Kind::cylindrical;
  }
  while (slopes_ < slope_.size() && frequency(slopes_ - 1) < most) ++slopes_;
  has_steepest_ = has_steepest_ && frequency(slopes_ - 1) >= most;
}

const Functional::Prepared& Functional::prepared() const {
  return prepared_.get([this] {
    Clusters clusters(onset_, side_, level_.range());
    std::vector<RowPlan> plans = msq::row_plans(clusters, sample_axis_);
    return std::make_unique<const Prepared>(Prepared{std::move(clusters), std::move(plans)});
  });
}

double Functional::value(Vec3 p) const {
  return evaluate(onset_, angles_.at(p));
}

double Functional::onset(Vec3 p) const {
  const double onset = value(p);
  return std::isnan(onset) || !angles_.holds(p) ? std::numeric_limits<double>::infinity() : onset;
}

void Functional::onsets(const Vec3* points, size_t count, double* to) const {
  Batch batch(program_);
  const Borrowed<Points> borrowed;
  for (size_t axis = 0; axis < 3; ++axis) batch.set_input(axis, {borrowed->angles[axis], false});
  for (size_t begin = 0; begin < count; begin += batch_points) {
    const size_t size = std::min(count - begin, batch_points);
    check_cancelled();
    for (size_t i = 0; i < size; ++i)
      for (int axis = 0; axis < 3; ++axis) borrowed->coordinates[axis][i] = points[begin + i][axis];
    borrowed->find_angles(angles_, size);
    batch.run(size);
    const Values values = batch.output(0);
    for (size_t i = 0; i < size; ++i) {
      const bool is_there = borrowed->in_place[i / 64] >> (i % 64) & 1;
      to[begin + i] = std::isnan(values[i]) || !is_there ? infinity : values[i];
    }
  }
}

bool Functional::inside(Vec3 p) const {
  return angles_.holds(p) && value(p) <= level_.at(p);
}

double Functional::frequency(size_t n) const {
  const double least = angles_.period() ? angles_.period()->least()
                                        : 0.25 / max_component(neighbourhood().cell_size);
  const double whole = std::ldexp(least, static_cast<int>(n / 2));
  return whole * (n % 2 ? std::sqrt(2.0) : 1.0) * (1 + 0x1p-40);
}

const Slope& Functional::slope(size_t n) const {
  return slope_[n].get([&] {
    const Neighbourhood& grid = neighbourhood();
    // Angles are rounded, and so is two_pi.
    const Interval cell{0, two_pi};
    Vec3 angles_per_unit{two_pi / grid.cell_size.x, two_pi / grid.cell_size.y,
                         two_pi / grid.cell_size.z};
    if (angles_.period()) angles_per_unit[angles_.period()->axis()] = two_pi * frequency(n);
    if (angles_.warp()) {
      const double rho = axis_distance(n);
      angles_per_unit = angles_.warp()->slopes(rho, rho) * two_pi;
    }
    double coordinate_error = 0x1p-49;
    if (const SampledMap* map = angles_.sampled()) {
      // With J the map's derivatives, |J^T g| is at most its steepness times |g|.
      angles_per_unit = Vec3{1, 1, 1} * (two_pi * map->steepness());
      coordinate_error += two_pi * map->rounding();
    }
    return std::make_unique<const Slope>(
        bound_slope(onset_, {cell, cell, cell}, angles_per_unit * (1 + 0x1p-50), coordinate_error));
  });
}

double Functional::min_ray_step() const {
  return has_steepest_ && std::isfinite(steepest().most)
             ? ray_tolerance()
             : FunctionalRays::max_blind_step * min_component(neighbourhood().cell_size);
}

void Functional::enter(RaySearch* searches, size_t count, const Job* job) const {
  FunctionalRays rays(*this, job);
  if (const std::unique_ptr<const CellShell> shell = angles_.shell())
    return enter_in_shell(*shell, *this, searches, count, [&](RaySearch* queried, size_t n) {
      rays.find(true, queried, n);
      rays.find_normals(queried, n);
    });
  rays.find(true, searches, count);
  rays.find_normals(searches, count);
}

double Functional::leave(const Ray& ray, double from, double to, const Job* job) const {
  FunctionalRays rays(*this, job);
  if (const std::unique_ptr<const CellShell> shell = angles_.shell())
    return leave_in_shell(*shell, *this, ray, from, to, [&](double begin, double end, double& t) {
      RaySearch search{ray, begin, end};
      rays.find(false, &search, 1);
      t = search.t;
      return search.found;
    });
  RaySearch search{ray, from, to};
  rays.find(false, &search, 1);
  return search.found ? search.t : to;
}

Vec3 Functional::normal(const Ray& ray, double t) const {
  const std::unique_ptr<const CellShell> shell = angles_.shell();
  if (shell && enters_shell(*shell, *this, ray, t)) return shell->normal(ray.at(t));
  RaySearch search{ray, t, t, true, t};
  FunctionalRays(*this, nullptr).find_normals(&search, 1);
  return dot(search.normal, search.normal) > 0 ? search.normal : ray.direction * -1.0;
}

/// Where cells vary in size, each frequency has a slope that holds as far as cells have at most
/// that frequency: the smaller of that distance and the gap over the slope. That is 0 where such
/// cells end, so it changes by at most the points' distance. The largest of these bounds is taken.
double Functional::steady_distance_of(double gap, Vec3 p) const {
  if (!angles_.period()) return steady_distance(gap, steepest().most, 1, level_, p);
  const GradedPeriod& period = *angles_.period();
  const double s = angles_.position(p), far = 0x1p30 * characteristic_length();
  double best = 0;
  for (size_t n = 0; n < slopes_ && gap > 0; ++n) {
    const double reach = period.distance_to(s, frequency(n), far);
    if (reach == 0) continue;
    const double steady = steady_distance(gap, slope(n).most, 1, level_, p);
    best = std::max(best, std::min(reach, steady));
    if (steady <= reach) break;  // larger frequencies have larger slopes
  }
  return best;
}

double Functional::axis_distance(size_t n) const {
  return angles_.warp()->numbers().around / frequency(n);
}

/// As above: cells at least axis_distance(n) from the axis have slope(n), and so far that holds.
/// With F the points where the onset is at most the level, and S the shell, the solid is that of
/// both. Where bounds of the distances to their boundaries have the sign of "outside", the larger
/// bounds the distance to that of the solid.
double Functional::warped_distance(double gap, bool is_inside, Vec3 fraction, Vec3 p) const {
  const Warp& warp = *angles_.warp();
  const double rho = warp.axis_distance(p), r = warp.radius(p);
  double best = 0;
  for (size_t n = 0; n < slopes_ && gap > 0; ++n) {
    const double away = axis_distance(n), reach = rho - away;
    if (!(reach > 0)) continue;
    double steady = steady_distance(gap, slope(n).most, 1, level_, p);
    const Vec3 slopes = warp.slopes(away, away);
    for (int axis = 0; axis < 3; ++axis)
      if (!repeats_[static_cast<size_t>(axis)])
        steady = std::min(steady, std::min(fraction[axis], 1 - fraction[axis]) / slopes[axis]);
    best = std::max(best, std::min(reach, steady));
    if (steady <= reach) break;
  }
  const double inner = warp.shell().inner > 0 ? r - warp.shell().inner : infinity;
  const double within = std::min(inner, warp.outer() - r);
  if (within < 0) return is_inside ? -within : std::max(best, -within);
  return is_inside ? std::min(best, within) : best;
}

/// As above, of the box of the samples in place of the shell.
double Functional::sampled_distance(double gap, bool is_inside, Vec3 fraction, Vec3 p) const {
  const SampledMap& map = *angles_.sampled();
  double best = gap > 0 ? steady_distance(gap, steepest().most, 1, level_, p) : 0;
  for (int axis = 0; axis < 3; ++axis)
    if (!repeats_[static_cast<size_t>(axis)])
      best = std::min(best, (std::min(fraction[axis], 1 - fraction[axis]) - 2 * map.rounding()) /
                                map.slopes()[axis]);
  best = std::max(0.0, best);
  const double within = map.distance_within(p);
  if (within < 0) return is_inside ? -within : std::max(best, -within);
  return is_inside ? std::min(best, within) : best;
}

bool Functional::has_steady_distance() const {
  return has_steepest_ && std::isfinite(steepest().most) && std::isfinite(level_.lipschitz());
}

double Functional::distance_bound(Vec3 p) const {
  const Neighbourhood& grid = neighbourhood();
  const Slope& slope = steepest();
  if (!std::isfinite(slope.most)) return 0;
  const Vec3 fraction = angles_.fraction(p);
  const double onset = evaluate(onset_, angles_of(fraction));
  const Interval level = level_.range(Box3{p, p});
  // The error of the level there, and the same at the boundary.
  const double rounding = 2 * (level.high - level.low) + 2 * slope.error;
  const double gap = std::max(onset - level.high, level.low - onset) - rounding;
  if (angles_.warp()) {
    const double far = 0x1p30 * characteristic_length();
    const double bound =
        std::min(warped_distance((1 - 0x1p-40) * gap, onset <= level.low, fraction, p), far);
    return std::max(0.0, (1 - 0x1p-40) * bound - 2 * angles_.warp()->slack(p, bound));
  }
  if (const SampledMap* map = angles_.sampled()) {
    const double far = 0x1p30 * characteristic_length();
    const double bound =
        std::min(sampled_distance((1 - 0x1p-40) * gap, onset <= level.low, fraction, p), far);
    return std::max(0.0, (1 - 0x1p-40) * bound - 2 * map->slack(p, bound));
  }
  // The grid's rotation may stretch distances in the last bits. A constant function has no
  // boundary.
  double distance_bound =
      std::min(steady_distance_of((1 - 0x1p-40) * gap, p), 0x1p30 * characteristic_length());
  for (int axis = 0; axis < 3; ++axis)
    if (!repeats_[static_cast<size_t>(axis)])
      distance_bound = std::min(
          distance_bound, std::min(fraction[axis], 1 - fraction[axis]) * grid.cell_size[axis]);
  if (!(distance_bound > 0)) return 0;
  double slack = 2 * locating_slack(p - grid.origin, distance_bound);
  // In cells, of which the largest is the longest.
  if (angles_.period()) slack += 4 * angles_.error(p, distance_bound) * angles_.period()->largest();
  return std::max(0.0, distance_bound - slack);
}

void Functional::keep_points(const Vec3* points, uint8_t* alive, size_t count) const {
  Batch batch(program_);
  const Borrowed<Points> borrowed;
  auto& [coordinates, angles, levels, radii, queried, index, in_place] = *borrowed;
  for (size_t axis = 0; axis < 3; ++axis) batch.set_input(axis, {angles[axis], false});
  for (size_t next = 0; next < count;) {
    size_t size = 0;
    for (; next < count && size < batch_points; ++next) {
      if (!alive[next]) continue;
      for (int axis = 0; axis < 3; ++axis) coordinates[axis][size] = points[next][axis];
      queried[size] = points[next];
      index[size++] = next;
    }
    level_.values(queried, size, levels);
    borrowed->find_angles(angles_, size);
    batch.run(size);
    uint64_t bits[batch_points / 64 + 1];
    compare_values(batch.output(0), {levels, false}, size, bits);
    for (size_t i = 0; i < size; ++i)
      alive[index[i]] = (bits[i / 64] & in_place[i / 64]) >> (i % 64) & 1;
  }
}

void Functional::keep_rows(const RowBlock& block, const Job* job) const {
  if (angles_.sampled() && form_) {
    MapRows rows(*this, block);
    if (rows.serves()) return rows.keep(job);
  }
  if (angles_.warp() && form_) {
    ShearedRows rows(*this, block);
    if (rows.serves()) return rows.keep(job);
  }
  if (angles_.warp() && WarpedRows::serves(*this))
    WarpedRows(*this, block).keep(job);
  else if (angles_.is_mapped())
    Structure::keep_rows(block, job);
  else if (SingleWaveRows::serves(*this, block))
    SingleWaveRows(*this, block).keep(job);
  else if (sample_axis_[0] >= 0)
    FunctionalRows(*this, block).keep(job);
  else if (form_)
    TurnedRows(*this, block).keep(job);
  else
    keep_tape_rows(*this, block, job);
}

uint64_t Functional::row_period(const SampleGrid& grid, uint64_t y0, uint64_t y1) const {
  if (sample_axis_[0] < 0 || !angles_.is_uniform() || !level_.is_constant()) return 0;
  const size_t count = y1 - y0;
  std::vector<double> y(count + batch_padding), angles[3];
  for (size_t i = 0; i < count; ++i) y[i] = grid.y(y0 + i);
  for (std::vector<double>& of_axis : angles) of_axis.resize(count + batch_padding);
  const double x = grid.x(0), z = grid.z(0);  // which do not matter
  angles_.find({&x, true}, {y.data(), false}, {&z, true}, count,
               {angles[0].data(), angles[1].data(), angles[2].data()});
  const auto axis = std::find(sample_axis_.begin(), sample_axis_.end(), 1) - sample_axis_.begin();
  return period_of(angles[axis].data(), count, 0);
}

BoxClass Functional::classify(const Box3& box) const {
  return angles_.is_mapped() ? classify_warped(*this, box) : BoxClass::mixed;
}

const RowPlan& Functional::warped_plan(unsigned changing) const {
  return warped_plans_[changing == 3 ? 0 : 1].get([&] {
    std::array<int, 3> axes;
    for (size_t axis = 0; axis < 3; ++axis) axes[axis] = changing >> axis & 1 ? 0 : 1;
    return std::make_unique<const RowPlan>(onset_, axes);
  });
}

const RowPlan* Functional::wave_plan() const {
  const std::optional<RowPlan>& plan = wave_plan_.get([&] {
    auto made = std::make_unique<std::optional<RowPlan>>();
    if (sample_axis_[0] >= 0) made->emplace(onset_, sample_axis_);
    if (*made && !(*made)->wave) made->reset();
    return made;
  });
  return plan ? &*plan : nullptr;
}

LineGraph Functional::wall_lines(const WallSection& section) const {
  return find_function_lines(*this, section);
}

void Functional::describe(HashInput& input) const {
  input.kind("structure: functional");
  neighbourhood().describe(input);
  input.integer(static_cast<uint64_t>(kind_));
  function_.describe(input);
  level_.describe(input);
  input.integer(angles_.period() ? 1 : 0);
  if (angles_.period()) angles_.period()->describe(input);
  if (angles_.warp()) angles_.warp()->describe(input);
  if (angles_.sampled()) angles_.sampled()->describe(input);
}

}  // namespace msq
