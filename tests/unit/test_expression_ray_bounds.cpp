// SPDX-License-Identifier: Apache-2.0
// Bounds along pieces of rays hold at points all along them, long pieces and short ones, also in
// the cells that pieces run on into; they are as near as their order promises; and values are the
// evaluator's.
#include <algorithm>
#include <cmath>

#include "expression/parser.h"
#include "expression/period.h"
#include "expression/ray_bounds.h"
#include "random.h"
#include "structure/functional/presets.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

constexpr double coordinate_error = 0x1p-47;

struct Row {
  std::string name;
  double min_part;  ///< of the pieces of span 1/64 about which something is known
};

double wrapped(double angle) {
  const double fraction = angle / two_pi - std::floor(angle / two_pi);
  return fraction * two_pi;
}

/// The slopes are those of the bounds along each coordinate, also after a run along all of them.
void check_slopes(RayBatch& batch, const RayBatch::Pieces& pieces) {
  batch.run(pieces, RayBatch::lanes);
  double slopes[3][RayBatch::lanes];
  const RayBatch::Slopes found = batch.slopes(pieces.coordinates, RayBatch::lanes);
  for (size_t along = 0; along < 3; ++along)
    std::copy_n(found.along[along], RayBatch::lanes, slopes[along]);
  RayBatch::Pieces unit = pieces;
  for (size_t along = 0; along < 3; ++along) {
    for (size_t axis = 0; axis < 3; ++axis)
      std::fill_n(unit.rates[axis], RayBatch::lanes, axis == along ? 1 : 0);
    const RayBatch::Bounds bounds = batch.run(unit, RayBatch::lanes);
    for (size_t i = 0; i < RayBatch::lanes; ++i) {
      assert_true(slopes[along][i] == bounds.low[i]);
      assert_true(slopes[along][i] == bounds.high[i]);
    }
  }
}

void test_row(void** state) {
  const Row& row = *static_cast<const Row*>(*state);
  const Tape tape = parse_expression(row.name.c_str(), {});
  const std::array<bool, 3> repeats = msq::repeats(tape);
  const RayProgram program(tape);
  RayBatch batch(program);
  RayBatch::Pieces pieces;
  Random random(11);
  size_t known = 0, asked = 0;
  for (size_t n = 0; n < test_count(400); ++n) {
    const double span = std::exp2(-double(n % 16));
    for (size_t i = 0; i < RayBatch::lanes; ++i) {
      for (size_t axis = 0; axis < 3; ++axis) {
        double& rate = pieces.rates[axis][i];
        rate = i % 4 == 3 && axis > 0 ? 0 : random.between(-two_pi, two_pi);
        // Within the cell, and to its end where the function does not repeat.
        double low = 0, high = two_pi;
        if (!repeats[axis]) (rate < 0 ? low : high) -= rate * span;
        double& at = pieces.coordinates[axis][i];
        at = random.between(low, high);
        if (!(at >= low && at <= high)) rate = 0;
      }
      pieces.error[i] = coordinate_error;
      pieces.span[i] = span;
    }
    if (program.has_slopes()) check_slopes(batch, pieces);
    const RayBatch::Bounds bounds = batch.run(pieces, RayBatch::lanes);
    for (size_t i = 0; i < RayBatch::lanes; ++i) {
      const auto at = [&](double s) {
        Vec3 p;
        for (int axis = 0; axis < 3; ++axis) {
          const auto a = static_cast<size_t>(axis);
          p[axis] = pieces.coordinates[a][i] + pieces.rates[a][i] * s;
          if (repeats[a]) p[axis] = wrapped(p[axis]);
        }
        return evaluate(tape, p);
      };
      const Vec3 begin{pieces.coordinates[0][i], pieces.coordinates[1][i],
                       pieces.coordinates[2][i]};
      const double value = evaluate(tape, begin);
      assert_true(value == bounds.value[i] || (std::isnan(value) && std::isnan(bounds.value[i])));
      const bool is_known = std::isfinite(bounds.bend[i]);
      asked += span <= 1.0 / 64;
      known += span <= 1.0 / 64 && is_known;
      if (!is_known) continue;
      for (int k = 0; k <= 16; ++k) {
        const double s = span * (k == 0 ? random.unit() : k / 16.0), v = at(s);
        const double bend = bounds.bend[i] * s * s + bounds.error[i];
        if (!(v >= bounds.value[i] + bounds.low[i] * s - bend) ||
            !(v <= bounds.value[i] + bounds.high[i] * s + bend))
          fail_msg("%s: %.17g at %g of %g, expected %.17g + [%g, %g] s +- %g", row.name.c_str(), v,
                   s, span, bounds.value[i], bounds.low[i], bounds.high[i], bend);
      }
      if (span > 0x1p-10) continue;
      assert_true(bounds.high[i] >= bounds.low[i]);
      if (program.is_smooth() && row.min_part == 1) {
        assert_true(bounds.bend[i] < 1e5);
        assert_true(bounds.error[i] < 1e-11);
      }
    }
  }
  if (!(static_cast<double>(known) >= row.min_part * static_cast<double>(asked)))
    fail_msg("%s: %zu of %zu", row.name.c_str(), known, asked);
}

}  // namespace

int main() {
  std::vector<Row> rows;
  for (const char* preset : preset_expressions) rows.push_back({preset, 1});
  for (const Row& row : {Row{"x", 1},
                         Row{"0.25", 1},
                         Row{"x*y-z", 1},
                         Row{"-x/(y+1)", 1},
                         Row{"sin(3*x+2*y-z)*cos(5*z)", 1},
                         Row{"sin(60*x)+cos(x+x+x)", 1},
                         Row{"max(sin(x),cos(y))", 1},
                         Row{"min(x*y,max(y,z)-1)", 1},
                         Row{"abs(sin(x)-cos(z))", 1},
                         Row{"abs(x-3)", 1},
                         Row{"exp(sin(x)*2)-cos(y)", 1},
                         Row{"sqrt(4+cos(x)+cos(y)*cos(z))", 1},
                         Row{"sqrt((x-3)*(x-3)+(y-3)*(y-3)+(z-3)*(z-3))-2", 0.9},
                         Row{"log(x+0.1)*y", 1},
                         Row{"1/(1.5+sin(x))", 1},
                         Row{"1/sin(x)", 0.8},
                         Row{"sqrt(x-3)", 0.4},
                         Row{"max(abs(x-3),max(abs(y-3),abs(z-3)))-2", 1},
                         Row{"log(x-3)", 0.4},
                         Row{"min(sqrt(x-3),0.5)", 0.4},
                         Row{"min(0.5,sqrt(x-3))", 0.4},
                         Row{"max(log(x-3),y)", 0.4},
                         Row{"max(y,log(x-3))", 0.4},
                         Row{"abs(min(sqrt(x-3),z-2))-1", 0.4},
                         Row{"max(1,sqrt(y-3))*min(1,1/(x-3))", 0.3},
                         Row{"min(1e200*x*1e200*y,3)", 0},
                         Row{"max(exp(99*x)-exp(99*y),z)", 0.1},
                         Row{"tanh(4*sin(x))*y", 1},
                         Row{"hypot(x-3,y-3)-z", 1},
                         Row{"hypot(sin(x),hypot(cos(y),sin(2*z)))", 1},
                         Row{"atan2(y-3,x-3)", 0.9},
                         Row{"atan2(sin(z),1.5+cos(x))", 1},
                         Row{"floor(2*x)+y", 0.8},
                         Row{"mod(x,1.5)-mod(y,2)", 0.8},
                         Row{"round(3*sin(x))*cos(y)", 0.7},
                         Row{"select(x<y,sin(z),x*y)", 0.9},
                         Row{"select(x>3,sqrt(x-3),0.5)", 0.9},
                         Row{"select((x<y)*(y<z),1,hypot(x,z))", 0.9},
                         Row{"abs(x-3)<=1", 0.9},
                         Row{"exp(57*x)", 0.999},
                         Row{"1e154*sin(x)", 0.999},
                         Row{"1e-200*sin(x)", 1},
                         Row{"1e-300*cos(x)*cos(y)", 1}})
    rows.push_back(row);
  return run_for_each("ray_bounds", rows, test_row);
}
