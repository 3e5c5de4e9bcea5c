// SPDX-License-Identifier: Apache-2.0
// Struts as a graph: boxes that tile a box have its struts, each once; nodes with equal ids are one
// point; the struts near a box are those that its points are in.
#include <algorithm>
#include <cstring>
#include <map>
#include <memory>

#include "foam_structures.h"
#include "random.h"
#include "structure/common/struts.h"
#include "structures.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

StrutList list_of(const Structure& structure, const Box3& box, bool is_owned) {
  const std::unique_ptr<StrutParts> parts = structure.struts({box, is_owned});
  assert_non_null(parts.get());
  StrutList list;
  for (uint64_t i = 0; i < parts->count(); ++i) parts->append(i, list);
  assert_int_equal(list.struts.size(), list.factors.size());
  return list;
}

bool is_before(const Strut& a, const Strut& b) {
  return a.id < b.id;
}

std::vector<Strut> sorted(std::vector<Strut> struts) {
  std::sort(struts.begin(), struts.end(), is_before);
  return struts;
}

bool is_same(const Strut& a, const Strut& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

void check_tilings(const Structure& structure, const Box3& box, Random& random,
                   const std::vector<Strut>& whole) {
  for (size_t i = 1; i < whole.size(); ++i)
    if (whole[i - 1].id == whole[i].id) fail_msg("a strut comes twice");
  // Cut along two axes, in two and in three, sometimes at the middle of a strut.
  std::vector<double> cuts[3];
  const uint64_t uncut = random.below(3);
  for (int axis = 0; axis < 3; ++axis) {
    cuts[axis] = {box.min[axis], box.max[axis]};
    for (uint64_t n = (axis + 3 - uncut) % 3; n > 0; --n) {
      double cut = random.between(box.min[axis], box.max[axis]);
      if (random.below(2) && !whole.empty()) {
        const Strut& s = whole[random.below(whole.size())];
        cut = ((s.a + s.b) * 0.5)[axis];
      }
      cuts[axis].push_back(cut);
    }
    std::sort(cuts[axis].begin(), cuts[axis].end());
  }
  std::vector<Strut> all;
  for (size_t k = 1; k < cuts[2].size(); ++k)
    for (size_t j = 1; j < cuts[1].size(); ++j)
      for (size_t i = 1; i < cuts[0].size(); ++i) {
        const Box3 tile{{cuts[0][i - 1], cuts[1][j - 1], cuts[2][k - 1]},
                        {cuts[0][i], cuts[1][j], cuts[2][k]}};
        const std::vector<Strut> part = list_of(structure, tile, true).struts;
        all.insert(all.end(), part.begin(), part.end());
      }
  all = sorted(std::move(all));
  assert_int_equal(all.size(), whole.size());
  for (size_t i = 0; i < all.size(); ++i)
    if (!is_same(all[i], whole[i])) fail_msg("strut %zu of the tiles is another", i);
}

void check_nodes(const std::vector<Strut>& struts) {
  std::map<Id, Vec3> nodes;
  for (const Strut& s : struts)
    for (int end = 0; end < 2; ++end) {
      const Vec3 at = end ? s.b : s.a;
      const auto [known, is_new] = nodes.insert({s.nodes[end], at});
      if (!is_new && !(known->second == at)) fail_msg("a node is at two places");
    }
}

/// Whether a strut holds p if its radius is `extra` more.
bool holds(const StructureRow& row, const Strut& s, double factor, const Parameter& radius, Vec3 p,
           double extra) {
  if (row.is_beams())
    return Beam{s.a,
                s.b,
                s.radii[0] + extra,
                s.radii[1] + extra,
                static_cast<BeamCap>(s.caps[0]),
                static_cast<BeamCap>(s.caps[1])}
        .holds(p);
  return std::sqrt(Segment(s.a, s.b).distance_squared(p)) <= factor * radius.at(p) + extra;
}

FoamWarp warp_kind(const StructureRow& row) {
  if (row.kind.name.find("around a point") != std::string::npos) return FoamWarp::sphere;
  if (row.kind.name.find("by samples") != std::string::npos) return FoamWarp::sampled;
  return row.kind.name.starts_with("sheared") ? FoamWarp::sheared : FoamWarp::cylinder;
}

void test_row(void** state) {
  const StructureRow& row = *static_cast<const StructureRow*>(*state);
  const Neighbourhood& grid = row.variant.grid;
  const Vec3 centre = grid.from_grid(Vec3{0.3, -0.2, 0.4} * grid.cell_size);
  const Ref<const Structure> structure = row.make(centre);
  Random random(row.index + 3);
  const Vec3 half = Vec3{1.2, 0.9, 1.1} * row.unit();
  const Box3 box{centre - half, centre + half};
  if (!structure->struts({box, true})) {
    assert_false(structure->has_struts());
    return;
  }
  const std::vector<Strut> whole = sorted(list_of(*structure, box, true).struts);
  assert_true(whole.size() > 3);
  check_tilings(*structure, box, random, whole);

  const StrutList near = list_of(*structure, box, false);
  check_nodes(near.struts);
  const std::vector<Strut> by_id = sorted(near.struts);
  // No strut is longer than four cells, and its middle decides who owns it.
  const double half_length = 2 * row.unit();
  const std::vector<Strut> around =
      sorted(list_of(*structure, box.grown(half_length + row.radius()), true).struts);
  const auto is_among = [](const std::vector<Strut>& all, const Strut& s) {
    const auto at = std::lower_bound(all.begin(), all.end(), s, is_before);
    return at != all.end() && is_same(*at, s);
  };
  for (const Strut& s : whole)
    if (!is_among(by_id, s)) fail_msg("a strut of the box is not near it");
  for (const Strut& s : by_id)
    if (!is_among(around, s)) fail_msg("a strut near the box is not in a larger one");

  // Membership. The axes of foams in the solid's bricks are in single precision, and lattices' ends
  // are those of nodes within 1e-9 of a cell.
  const Parameter radius = row.parameter(centre);
  const double slack = 3e-9 * row.unit();
  const bool has_more = row.kind.name.find("and struts") != std::string::npos;  // walls
  // Struts are whole, the foam ends at its shell.
  std::shared_ptr<const CellShell> shell;
  if (row.kind.family == "warped foam") shell = shell_of_foams(grid, warp_kind(row));
  for (size_t i = 0; i < test_count(300); ++i) {
    const Vec3 p = random.in_box(box);
    bool may = false, must = false;
    for (size_t n = 0; n < near.struts.size(); ++n) {
      may = may || holds(row, near.struts[n], near.factors[n], radius, p, slack);
      must = must || holds(row, near.struts[n], near.factors[n], radius, p, -slack);
    }
    const bool is_inside = structure->inside(p);
    if (is_inside && !may && !has_more)
      fail_msg("(%.17g, %.17g, %.17g) is in no strut", p.x, p.y, p.z);
    if (!is_inside && must && !(shell && !shell->holds(p)))
      fail_msg("(%.17g, %.17g, %.17g) is outside", p.x, p.y, p.z);
  }
  // Radii are those of the field, of beams their own.
  if (!row.is_beams())
    for (size_t n = 0; n < near.struts.size(); ++n) {
      const Strut& s = near.struts[n];
      assert_true(s.radii[0] == near.factors[n] * radius.at(s.a));
      assert_true(s.radii[1] == near.factors[n] * radius.at(s.b));
    }
}

}  // namespace

int main() {
  std::vector<StructureRow> rows;
  for (StructureRow& row : structures()) {
    // All methods of a foam have the same graph, whatever the radius.
    const bool is_foam = row.kind.family.rfind("foam", 0) == 0;
    const bool has_density = row.kind.name.rfind("density", 0) == 0 && row.kind.radius == 0.06;
    const bool has_other = row.kind.name.find("and struts") != std::string::npos;
    const bool is_wanted =
        (row.kind.family == "foam DIRECT" && row.kind.radius == 0.1) ||
        (row.kind.family == "foam stretched" &&
         (row.kind.name == "along z" || row.kind.name == "jitter 0")) ||
        (row.kind.family == "foam weighted" &&
         (row.kind.name == "most" || row.kind.name == "jitter 0")) ||
        (row.kind.family == "foam placed" &&
         (row.kind.name == "period along z" || row.kind.name == "period, jitter 0"));
    if (is_foam ? !(is_wanted || has_density || has_other) : row.kind.radius > 0.2) continue;
    // Around an axis, seeds without jitter are on one sphere by dozens, which takes long.
    if (row.kind.family == "warped foam" &&
        (row.kind.jitter == 0 ? row.is_graded || !row.variant.name.empty()
                              : !row.kind.name.starts_with("struts") &&
                                    row.kind.name != "sheared struts" && !has_other))
      continue;
    // Foams with octrees of seeds take seconds, in slow builds tens of them.
    const bool is_slow = test_scale() < 1;
    if ((has_density || is_slow) && row.index % 4 != 1) continue;
    if (has_density && is_slow) continue;
    rows.push_back(row);
  }
  return run_for_each("struts", rows, test_row);
}
