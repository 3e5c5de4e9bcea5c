// SPDX-License-Identifier: Apache-2.0
#include "structure/functional/functional.h"

#include <cmath>

#include "base/borrowed.h"
#include "expression/period.h"
#include "structure/common/strut_distance_bound.h"
#include "structure/functional/functional_rows.h"
#include "structure/functional/level_lines.h"
#include "structure/functional/ray_search.h"
#include "structure/functional/row_kernels.h"
#include "structure/functional/turned_rows.h"

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
  double angles[3][room], levels[room] = {};
  Vec3 asked[batch_points];
  size_t index[batch_points];
};

std::vector<RowPlan> row_plans(const Clusters& clusters, const std::array<int, 3>& sample_axis) {
  std::vector<RowPlan> plans;
  if (sample_axis[0] >= 0)
    for (const Tape& tape : clusters.tapes()) plans.emplace_back(tape, sample_axis);
  return plans;
}

}  // namespace

Functional::Functional(const Neighbourhood& neighbourhood, const Tape& function,
                       FunctionalKind kind, Parameter level, int clusters)
    : Structure(neighbourhood),
      level_(std::move(level)),
      kind_(kind),
      function_(function),
      onset_(onset_of(function, kind)),
      program_(compile(onset_)),
      ray_program_(onset_),
      sample_axis_(neighbourhood.sample_axes()),
      side_(clusters ? clusters : automatic_clusters(onset_)),
      repeats_(msq::repeats(onset_)) {
  if (sample_axis_[0] < 0) form_ = TrigonometricForm::of(onset_);
}

const Functional::Prepared& Functional::prepared() const {
  std::call_once(once_, [this] {
    Clusters clusters(onset_, side_, level_.range());
    std::vector<RowPlan> plans = msq::row_plans(clusters, sample_axis_);
    prepared_ = Prepared{std::move(clusters), std::move(plans)};
  });
  return *prepared_;
}

double Functional::value(Vec3 p) const {
  const Vec3 fraction = neighbourhood().locate(p).fraction;
  const Vec3 angles{angle_of(fraction.x), angle_of(fraction.y), angle_of(fraction.z)};
  return evaluate(onset_, angles);
}

double Functional::onset(Vec3 p) const {
  const double onset = value(p);
  return std::isnan(onset) ? std::numeric_limits<double>::infinity() : onset;
}

bool Functional::inside(Vec3 p) const {
  return value(p) <= level_.at(p);
}

const Slope& Functional::slope() const {
  return slope_.get([&] {
    const Neighbourhood& grid = neighbourhood();
    // Angles are rounded, and so is two_pi.
    const Interval cell{0, two_pi};
    const Vec3 angles_per_unit{two_pi / grid.cell_size.x, two_pi / grid.cell_size.y,
                               two_pi / grid.cell_size.z};
    return std::make_unique<const Slope>(
        bound_slope(onset_, {cell, cell, cell}, angles_per_unit * (1 + 0x1p-50), 0x1p-49));
  });
}

double Functional::min_ray_step() const {
  return std::isfinite(slope().most)
             ? ray_tolerance()
             : FunctionalRays::max_blind_step * min_component(neighbourhood().cell_size);
}

void Functional::enter(RaySearch* searches, size_t count, const Job* job) const {
  FunctionalRays rays(*this, job);
  rays.find(true, searches, count);
  rays.find_normals(searches, count);
}

double Functional::leave(const Ray& ray, double from, double to, const Job* job) const {
  RaySearch search{ray, from, to};
  FunctionalRays(*this, job).find(false, &search, 1);
  return search.found ? search.t : to;
}

Vec3 Functional::normal(const Ray& ray, double t) const {
  RaySearch search{ray, t, t, true, t};
  FunctionalRays(*this, nullptr).find_normals(&search, 1);
  return dot(search.normal, search.normal) > 0 ? search.normal : ray.direction * -1.0;
}

double Functional::distance_bound(Vec3 p) const {
  const Neighbourhood& grid = neighbourhood();
  const Slope& slope = this->slope();
  if (!std::isfinite(slope.most)) return 0;
  const Vec3 fraction = grid.locate(p).fraction;
  const Vec3 angles{angle_of(fraction.x), angle_of(fraction.y), angle_of(fraction.z)};
  const double onset = evaluate(onset_, angles);
  const Interval level = level_.range(Box3{p, p});
  // The error of the level there, and the same at the boundary.
  const double rounding = 2 * (level.high - level.low) + 2 * slope.error;
  const double gap = std::max(onset - level.high, level.low - onset) - rounding;
  // The grid's rotation may stretch distances in the last bits. A constant function has no
  // boundary.
  double distance_bound = std::min(steady_distance((1 - 0x1p-40) * gap, slope.most, 1, level_, p),
                                   0x1p30 * characteristic_length());
  for (int axis = 0; axis < 3; ++axis)
    if (!repeats_[static_cast<size_t>(axis)])
      distance_bound = std::min(
          distance_bound, std::min(fraction[axis], 1 - fraction[axis]) * grid.cell_size[axis]);
  if (!(distance_bound > 0)) return 0;
  return std::max(0.0, distance_bound - 2 * locating_slack(p - grid.origin, distance_bound));
}

void Functional::keep_points(const Vec3* points, uint8_t* alive, size_t count) const {
  Batch batch(program_);
  const Borrowed<Points> borrowed;
  auto& [coordinates, angles, levels, asked, index] = *borrowed;
  for (size_t axis = 0; axis < 3; ++axis) batch.set_input(axis, {angles[axis], false});
  for (size_t next = 0; next < count;) {
    size_t size = 0;
    for (; next < count && size < batch_points; ++next) {
      if (!alive[next]) continue;
      for (int axis = 0; axis < 3; ++axis) coordinates[axis][size] = points[next][axis];
      asked[size] = points[next];
      index[size++] = next;
    }
    level_.values(asked, size, levels);
    find_angles(neighbourhood(), {coordinates[0], false}, {coordinates[1], false},
                {coordinates[2], false}, size, {angles[0], angles[1], angles[2]});
    batch.run(size);
    uint64_t bits[batch_points / 64 + 1];
    compare_values(batch.output(0), {levels, false}, size, bits);
    for (size_t i = 0; i < size; ++i) alive[index[i]] = bits[i / 64] >> (i % 64) & 1;
  }
}

void Functional::keep_rows(const RowBlock& block, const Job* job) const {
  if (sample_axis_[0] >= 0)
    FunctionalRows(*this, block).keep(job);
  else if (form_)
    TurnedRows(*this, block).keep(job);
  else
    keep_turned_rows(*this, block, job);
}

LineGraph Functional::wall_lines(const WallSection& section) const {
  return LevelLines(*this, section).find();
}

}  // namespace msq
