// SPDX-License-Identifier: Apache-2.0
#include "structure/functional/functional.h"

#include <cmath>

#include "structure/functional/axis_rows.h"
#include "structure/functional/row_kernels.h"
#include "structure/functional/turned_rows.h"

namespace msq {

namespace {

/// Along an axis of the cell: fewer for tapes whose enclosures take long.
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

/// Rotations by quarter turns permute the axes: each coordinate in the grid is then, to the last
/// bit, a function of one coordinate of the sample, as the products with 0 add nothing.
std::array<int, 3> sample_axes(const Rotation& rotation) {
  std::array<int, 3> axes{-1, -1, -1};
  for (int i = 0; i < 9; ++i) {
    const double m = std::abs(rotation.m[static_cast<size_t>(i)]);
    if (m == 1)
      axes[static_cast<size_t>(i % 3)] = i / 3;
    else if (m != 0)
      return {-1, -1, -1};
  }
  return axes;
}

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
      onset_(onset_of(function, kind)),
      program_(compile(onset_)),
      sample_axis_(sample_axes(neighbourhood.rotation)),
      side_(clusters ? clusters : automatic_clusters(onset_)) {
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

bool Functional::inside(Vec3 p) const {
  const Vec3 fraction = neighbourhood().locate(p).fraction;
  const Vec3 angles{angle_of(fraction.x), angle_of(fraction.y), angle_of(fraction.z)};
  return evaluate(onset_, angles) <= level_.at(p);
}

void Functional::keep_points(const Vec3* points, uint8_t* alive, size_t count) const {
  Batch batch(program_);
  double coordinates[3][batch_points + batch_padding] = {};
  double angles[3][batch_points + batch_padding], levels[batch_points + batch_padding] = {};
  Vec3 asked[batch_points];
  size_t index[batch_points];
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
    AxisRows(*this, block).keep(job);
  else if (form_)
    TurnedRows(*this, block).keep(job);
  else
    keep_turned_rows(*this, block, job);
}

}  // namespace msq
