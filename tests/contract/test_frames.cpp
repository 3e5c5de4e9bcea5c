// SPDX-License-Identifier: Apache-2.0
// In a frame, rows of each structure hold the samples whose points of the model are inside: in
// frames that are turned anyhow or mirror, and in those whose axes are the model's in another
// order.
#include "bit_rows.h"
#include "images.h"
#include "random.h"
#include "shape/all_space.h"
#include "slice/framed_model.h"
#include "structures.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

struct FrameCase {
  const char* name;
  LayerFrame frame;
};

std::vector<FrameCase> frames(Vec3 origin) {
  const Rotation skew = skew_rotation();
  const auto& m = skew.m;
  const Vec3 a{m[0], m[3], m[6]}, b{m[1], m[4], m[7]}, c{m[2], m[5], m[8]};
  return {{"turned", {origin, {a, b, c}}},
          {"mirrored", {origin, {b, a, c}}},
          {"moved", {origin, {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}}},
          {"along y, z, x", {{}, {Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{1, 0, 0}}}},
          {"along x, z, y", {{}, {Vec3{1, 0, 0}, Vec3{0, 0, 1}, Vec3{0, 1, 0}}}}};
}

size_t differ(const StructureRow& row, const FrameCase& c, double per_cell, size_t samples) {
  const Vec3 centre = row.variant.grid.origin;
  const Ref<const Structure> structure = row.make(centre);
  const Ref<const Model> model = make_ref<Model>(shared_context(), make_ref<AllSpace>(),
                                                 std::vector<Ref<const Structure>>{structure});
  const Ref<const Model> framed = make_framed_model(*model, c.frame);
  const Scale& scale = *framed->resolved(0)[0];
  auto side = static_cast<uint64_t>(std::max(3.0, std::cbrt(static_cast<double>(samples) / 4)));
  // Whole boxes of samples are within a part of either structure.
  if (row.is_made_of_others() && structure->knows_boxes()) side = std::max<uint64_t>(side, 24);
  SampleGrid grid;
  grid.nx = row.has_dear_points() ? 8 : 4 * side;
  grid.ny = grid.nz = side;
  const double spacing = row.unit() / per_cell;
  grid.spacing = {spacing, spacing, spacing};
  grid.origin = c.frame.from_model(centre) -
                grid.spacing * Vec3{0.5 * double(grid.nx), 0.5 * double(side), 0.5 * double(side)};
  BitRows rows(grid, 0, grid.ny, 0, grid.nz);
  for (uint64_t k = 0; k < grid.nz; ++k)
    for (uint64_t j = 0; j < grid.ny; ++j)
      for (uint64_t i = 0; i < grid.nx; ++i) rows.set(i, j, k);
  scale.keep_rows(rows.block(), nullptr);
  assert_int_equal(rows.damage(), 0);
  size_t wrong = 0;
  for (uint64_t k = 0; k < grid.nz; ++k)
    for (uint64_t j = 0; j < grid.ny; ++j)
      for (uint64_t i = 0; i < grid.nx; ++i) {
        const Vec3 p = c.frame.to_model(grid.at(i, j, k));
        const bool is_inside = structure->inside(p);
        assert_int_equal(scale.structure->inside(grid.at(i, j, k)), is_inside);
        if (rows.get(i, j, k) == is_inside || may_differ(row, centre, p)) continue;
        if (!wrong++)
          print_error("%s, (%.17g, %.17g, %.17g): alone %d, in rows %d\n", c.name, p.x, p.y, p.z,
                      is_inside, rows.get(i, j, k));
      }
  return wrong;
}

void test_row(void** state) {
  const StructureRow& row = *static_cast<const StructureRow*>(*state);
  Random random(row.index + 1);
  const double unit = row.unit();
  const Vec3 away = random.in_box({Vec3{-3, -3, -3} * unit, Vec3{3, 3, 3} * unit});
  const std::vector<FrameCase> all = frames(row.variant.grid.origin + away);
  const size_t samples = row.samples(200000) / 2 + 1;
  size_t wrong = 0;
  // Fine and coarse, so that boxes of samples are within one part of a cell, or hold several.
  for (size_t n = 0; n < 2; ++n)
    wrong += differ(row, all[(row.index + n * 2) % all.size()], n ? 9.3 : 70.1, samples);
  if (wrong) fail_msg("%zu samples differ", wrong);
}

}  // namespace

int main() {
  std::vector<StructureRow> rows = structures();
  return run_for_each("frames", rows, test_row);
}
