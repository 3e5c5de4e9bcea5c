// SPDX-License-Identifier: Apache-2.0
// Models of regions: sets, grids, layers, materials, distances and rays against the definition,
// which is put together here from the regions alone: the first whose shape holds a point decides.
// Regions overlap in all orders, with structures, skins and none, by the origin and far from it.
#include "images.h"
#include "meshes.h"
#include "query/array_points.h"
#include "query/distance.h"
#include "query/grid_points.h"
#include "query/material.h"
#include "query/membership.h"
#include "random.h"
#include "ray/cast.h"
#include "shape/boolean.h"
#include "shape/mesh.h"
#include "shape/placed.h"
#include "shape/primitive.h"
#include "slice/slicer.h"
#include "structure/functional/presets.h"
#include "structures.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

using Parts = std::vector<Model::ScaleParts>;

Ref<const Material> material(uint32_t id) {
  return make_ref<PlainMaterial>(id, std::vector<std::string>{"density"},
                                 std::vector<Parameter>{Parameter(0.5 * id)});
}

/// Regions of a plate, at a place; in the order of a permutation.
std::vector<Ref<const Model>> make_regions(Vec3 at, unsigned order) {
  const auto& m = skew_rotation().m;
  const Neighbourhood coarse{at + Vec3{0.1, 0.2, 0.3}, {0.5, 0.5, 0.5}, {}};
  Neighbourhood fine{at, {0.21, 0.21, 0.21}, skew_rotation()};
  const auto box = [&](Vec3 low, Vec3 high) -> Ref<const Shape> {
    return make_ref<BoxShape>(Box3{at + low, at + high});
  };
  TriangleSoup ring = torus_mesh(0.5, 0.2, 24, 12);
  const Ref<const Shape> mesh =
      make_ref<Mesh>(ring, WindingRule::automatic, std::make_shared<MemoryBudget>(uint64_t{0}));
  const Ref<const Shape> placed = make_ref<PlacedShape>(
      mesh, Placement({1.5 * m[0], 1.5 * m[1], 1.5 * m[2], at.x + 1.4, 1.5 * m[3], 1.5 * m[4],
                       1.5 * m[5], at.y + 1, 1.5 * m[6], 1.5 * m[7], 1.5 * m[8], at.z + 0.4}));
  const Ref<const Shape> ball = make_ref<SphereShape>(at + Vec3{0.5, 0.5, 0.5}, 0.6);
  const auto lattice = lattice_factory(octet_unit_cell())(coarse, Parameter(0.08));
  const auto foam = foam_factory(FoamMethod::direct, 1)(coarse, Parameter(0.07));
  const auto sheet =
      functional_factory(preset_expressions[0], FunctionalKind::sheet, 8)(fine, Parameter(0.4));
  const auto model = [&](const Ref<const Shape>& shape, Parts parts, uint32_t id) {
    return Ref<const Model>(
        make_ref<Model>(shared_context(), shape, std::move(parts), material(id)));
  };
  std::vector<Ref<const Model>> all = {
      model(ball, {{foam}}, 1), model(placed, {}, 2),
      model(box({0, 0, 0}, {2, 1.5, 1}),
            {{lattice, Parameter(0.1), Ref<const Material>(), material(8)}, {sheet}}, 3),
      model(box({0.9, 0.3, 0.1}, {3, 2, 0.9}), {{sheet}}, 4)};
  std::vector<Ref<const Model>> ordered;
  std::vector<size_t> left = {0, 1, 2, 3};
  for (size_t n = 4; n > 0; --n) {
    const size_t pick = order % n;
    order /= static_cast<unsigned>(n);
    ordered.push_back(all[left[pick]]);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(pick));
  }
  return ordered;
}

struct Row {
  std::string name;
  Vec3 at;
  unsigned order;
  bool is_nested;
};

/// A model and its definition.
struct Plate {
  explicit Plate(const Row& row) : regions(make_regions(row.at, row.order)) {
    std::vector<Ref<const Model>> given = regions;
    if (row.is_nested) {
      const std::vector<Ref<const Model>> last(given.end() - 2, given.end());
      given.resize(2);
      given.push_back(make_ref<Model>(shared_context(), last));
    }
    model = make_ref<Model>(shared_context(), given);
    resolved = model->resolved(0);
    for (const Ref<const Model>& region : regions) scales.push_back(region->resolved(0));
  }

  size_t region_at(Vec3 p) const {
    size_t r = 0;
    while (r < regions.size() && !regions[r]->shape().inside(p)) ++r;
    return r;
  }
  bool inside(Vec3 p) const {
    const size_t r = region_at(p);
    return r < regions.size() && regions[r]->inside(p, scales[r]);
  }

  std::vector<Ref<const Model>> regions;
  std::vector<Scales> scales;
  Ref<const Model> model;
  Scales resolved;
};

std::vector<Vec3> random_points(const Plate& plate, size_t count, Random& random) {
  const Box3 box = plate.model->bounds();
  std::vector<Vec3> points;
  for (size_t i = 0; i < count; ++i) {
    Vec3 p = random.in_box(box.grown(0.1));
    if (i % 4 == 0) {  // on faces of regions
      const Box3& of = plate.regions[i / 4 % plate.regions.size()]->bounds();
      const int axis = static_cast<int>(random.below(3));
      p[axis] = i % 8 ? of.min[axis] : of.max[axis];
    }
    points.push_back(p);
  }
  return points;
}

void test_sets(void** state) {
  const Row& row = *static_cast<const Row*>(*state);
  const Plate plate(row);
  Random random(1);
  const size_t count = std::max<size_t>(10000, test_count(30000));
  const std::vector<Vec3> points = random_points(plate, count, random);
  PointArray array;
  array.data = reinterpret_cast<const unsigned char*>(points.data());
  array.count = count;
  array.stride = sizeof(Vec3);
  const ArrayPoints set(array);
  size_t held = 0;
  for (const QueryMethod method : {QueryMethod::automatic, QueryMethod::point, QueryMethod::set}) {
    std::vector<uint8_t> inside(count, 7);
    QueryPlan plan;
    plan.method = method;
    Job job;
    set_membership(*plate.model, plate.resolved, set, plan, inside.data(), &job);
    assert_int_equal(job.counts().points, count);
    for (size_t i = 0; i < count; ++i) {
      const bool wanted = plate.inside(points[i]);
      assert_true(plate.model->inside(points[i], plate.resolved) == wanted);
      if (inside[i] != wanted)
        fail_msg("method %d: point %zu, (%.17g, %.17g, %.17g) of region %zu: %d, not %d",
                 static_cast<int>(method), i, points[i].x, points[i].y, points[i].z,
                 plate.region_at(points[i]), inside[i], wanted);
      held += wanted;
    }
  }
  assert_true(held > count / 8 && held < 3 * count);
  std::vector<int32_t> regions(count);
  std::vector<uint32_t> ids(count);
  std::vector<double> densities(count);
  set_regions(*plate.model, set, regions.data(), nullptr);
  set_material(*plate.model, plate.resolved, set, {}, {"density"}, ids.data(), densities.data(),
               nullptr);
  size_t of_region[5] = {}, of_skin = 0;
  for (size_t i = 0; i < count; ++i) {
    const size_t r = plate.region_at(points[i]);
    assert_int_equal(regions[i], r == plate.regions.size() ? -1 : static_cast<int32_t>(r));
    ++of_region[r];
    uint32_t wanted = 0, part = 0;
    if (plate.inside(points[i]))
      wanted = plate.regions[r]->material(points[i], plate.scales[r], part)->id();
    assert_int_equal(ids[i], wanted);
    assert_true(densities[i] == 0.5 * wanted);
    of_skin += wanted == 8;
  }
  for (size_t n : of_region) assert_true(n > count / 500);
  assert_true(of_skin > 0);
}

void test_grids(void** state) {
  const Row& row = *static_cast<const Row*>(*state);
  const Plate plate(row);
  Random random(2);
  const Box3 box = plate.model->bounds().grown(0.05);
  for (uint64_t n : {uint64_t{29}, uint64_t{70}}) {
    SampleGrid grid;
    grid.nx = n + 3;
    grid.ny = n;
    grid.nz = n / 2;
    grid.origin = box.min + Vec3{1, 1, 1} * (0.01 * random.unit());
    for (int axis = 0; axis < 3; ++axis)
      grid.spacing[axis] = box.extent()[axis] / static_cast<double>(axis == 0   ? grid.nx
                                                                    : axis == 1 ? grid.ny
                                                                                : grid.nz);
    const GridPoints set(grid);
    std::vector<uint8_t> inside(set.count(), 7);
    Job job;
    set_membership(*plate.model, plate.resolved, set, {}, inside.data(), &job);
    assert_int_equal(job.counts().points, set.count());
    assert_true(job.counts().by_shape > 0 && job.counts().by_shape < set.count());
    SlicePlan plan;
    plan.outputs[0].format = LayerFormat::bytes;
    plan.pitch[0] = grid.spacing.x;
    plan.pitch[1] = grid.spacing.y;
    plan.slab_layers = 5;
    plan.has_region = true;
    plan.region = {grid.origin - grid.spacing * 0.5, {}};
    plan.resolution[0] = static_cast<uint32_t>(grid.nx);
    plan.resolution[1] = static_cast<uint32_t>(grid.ny);
    for (uint64_t k = 0; k < grid.nz; ++k) plan.heights.push_back(grid.z(k));
    const Ref<const Slicer> slicer = make_ref<Slicer>(plate.model, plan);
    size_t differ = 0;
    slicer->run(
        0, grid.nz,
        [&](const Layer& layer) {
          for (uint64_t j = 0; j < grid.ny; ++j)
            for (uint64_t i = 0; i < grid.nx; ++i)
              differ += (layer.main().data[j * slicer->stride() + i] != 0) !=
                        plate.inside(slicer->grid().at(i, j, layer.index));
        },
        nullptr);
    if (differ) fail_msg("%zu samples of layers differ", differ);
    for (uint64_t k = 0; k < grid.nz; ++k)
      for (uint64_t j = 0; j < grid.ny; ++j)
        for (uint64_t i = 0; i < grid.nx; ++i)
          if (inside[i + grid.nx * (j + grid.ny * k)] != plate.inside(grid.at(i, j, k)))
            fail_msg("sample %d, %d, %d differs", static_cast<int>(i), static_cast<int>(j),
                     static_cast<int>(k));
  }
}

void test_distances(void** state) {
  const Row& row = *static_cast<const Row*>(*state);
  const Plate plate(row);
  Random random(3);
  const size_t count = test_count(5000);
  const std::vector<Vec3> points = random_points(plate, count, random);
  size_t long_ones = 0;
  for (Vec3 p : points) {
    const double d = plate.model->distance(p, plate.resolved);
    const bool is_inside = plate.inside(p);
    if (is_inside ? d > 0 : !(d > 0)) fail_msg("inside %d, distance %.17g", is_inside, d);
    long_ones += std::abs(d) > 0.01;
    for (int n = 0; n < 8 && std::abs(d) > 1e-300; ++n) {
      Vec3 way = random.in_box({{-1, -1, -1}, {1, 1, 1}});
      way = way * (1 / length(way));
      const double part = n < 4 ? 1 - 1e-12 : random.unit();
      if (plate.inside(p + way * (std::abs(d) * part)) != is_inside)
        fail_msg(
            "at (%.17g, %.17g, %.17g), region %zu, inside %d: the ball of %.17g meets the "
            "boundary",
            p.x, p.y, p.z, plate.region_at(p), is_inside, d);
    }
  }
  assert_true(long_ones > count / 4);
  // Far from all regions: that of the nearest box, or more.
  const Vec3 far = row.at + Vec3{0, 0, 1000};
  const double d = plate.model->distance(far, plate.resolved);
  assert_true(d > 997 && d < 1001);
}

void test_rays(void** state) {
  const Row& row = *static_cast<const Row*>(*state);
  const Plate plate(row);
  Random random(4);
  const size_t count = std::max<size_t>(600, test_count(1200));
  const Box3 box = plate.model->bounds();
  std::vector<RaySearch> rays;
  for (size_t i = 0; i < count; ++i) {
    Vec3 a = random.in_box(box.grown(i % 2 ? 2 : 0)), b = random.in_box(box);
    if (i % 5 == 0) {
      b = a;
      b[static_cast<int>(random.below(3))] += i % 2 ? 1 : -1;
    }
    const Ray ray{a, (b - a) * (1 / length(b - a))};
    rays.push_back({ray, i % 3 ? 0 : random.between(-1, 1), i % 4 ? 1e300 : 1.5});
  }
  std::vector<RayHit> hits(count);
  cast_rays(
      *plate.model, plate.resolved, count,
      [&](std::span<const uint64_t> numbers, RaySearch* searches) {
        for (size_t n = 0; n < numbers.size(); ++n) searches[n] = rays[numbers[n]];
      },
      [&](std::span<const uint64_t> numbers, const RayHit* found) {
        for (size_t n = 0; n < numbers.size(); ++n) hits[numbers[n]] = found[n];
      },
      nullptr);
  const double tolerance = std::max(plate.model->shape().ray_tolerance(),
                                    8 * coordinate_rounding(max_magnitude(row.at) + 10));
  size_t of_region[4] = {}, by_scale[3] = {}, at_start = 0, bad_normals = 0, misses = 0;
  for (size_t i = 0; i < count; ++i) {
    const RaySearch& s = rays[i];
    const RayHit& hit = hits[i];
    const auto inside = [&](double t) { return plate.inside(s.ray.at(t)); };
    const bool is_hit = hit.scale >= 0;
    const double far = std::min(s.to, 12.0), end = is_hit ? hit.t : far;
    const auto fail_at = [&](const char* what, double t) {
      fail_msg("ray %zu, from %g to %g, t %.17g, scale %d, region %u: %s at %.17g", i, s.from, s.to,
               end, hit.scale, hit.region, what, t);
    };
    if (end < s.from || end > s.to) fail_at("it is out of range", end);
    for (int n = 0; n < 900; ++n) {
      const double t = n < 600 ? s.from + (end - s.from) * n / 600 : end - 0.02 * (n - 599) / 300;
      if (t < s.from || t > end - 4 * tolerance || !inside(t)) continue;
      if (inside(t - tolerance) && inside(t + tolerance) && inside(t + 2 * tolerance))
        fail_at("it is inside before", t);
    }
    if (!is_hit) {
      ++misses;
      continue;
    }
    if (!inside(end) && !inside(end + 2 * tolerance)) fail_at("it is outside", end);
    assert_true(std::abs(length(hit.normal) - 1) < 1e-9);
    assert_true(hit.starts_inside == (hit.t == s.from));
    at_start += hit.starts_inside;
    ++of_region[hit.region];
    assert_true(static_cast<size_t>(hit.scale) < 1 + plate.scales[hit.region].size());
    if (!hit.starts_inside) ++by_scale[hit.scale];
    const size_t about = plate.region_at(s.ray.at(end + 2 * tolerance));
    if (about != hit.region && plate.region_at(s.ray.at(end)) != hit.region)
      fail_at("it is in another region", end);
    if (!hit.starts_inside && dot(hit.normal, s.ray.direction) > 1e-6)
      fail_at("it looks away", end);
    // Along the normal the solid ends.
    const Vec3 p = s.ray.at(end);
    const double away = std::max(1e-5, 100 * tolerance);
    if (!hit.starts_inside)
      bad_normals += plate.inside(p + hit.normal * away) || !plate.inside(p - hit.normal * away);
  }
  if (bad_normals > count / 50) fail_msg("%zu of %zu normals are wrong", bad_normals, count);
  if (count < 300) return;
  for (size_t n : of_region) assert_true(n > 5);
  for (size_t n : by_scale) assert_true(n > count / 100);
  assert_true(at_start > count / 20 && misses > 0);
}

/// One region is the model itself, to the last bit.
void test_one_region(void**) {
  for (const Ref<const Model>& region : make_regions({}, 0)) {
    const Ref<const Model> model =
        make_ref<Model>(shared_context(), std::vector<Ref<const Model>>{region});
    const Scales one = region->resolved(0), resolved = model->resolved(0);
    Random random(5);
    for (size_t i = 0; i < test_count(2000); ++i) {
      const Vec3 p = random.in_box(region->bounds().grown(0.1));
      assert_true(model->inside(p, resolved) == region->inside(p, one));
      assert_true(model->distance(p, resolved) == region->distance(p, one));
    }
  }
}

}  // namespace

int main() {
  std::vector<Row> rows;
  for (unsigned order : {0u, 23u, 9u, 14u})
    rows.push_back({"order " + std::to_string(order), {}, order, order == 9});
  rows.push_back({"far away", {7e3, -9e3, 5e3}, 5, false});
  const CMUnitTest single[] = {cmocka_unit_test(test_one_region)};
  return run_for_each("sets", rows, test_sets) + run_for_each("grids", rows, test_grids) +
         run_for_each("distances", rows, test_distances) + run_for_each("rays", rows, test_rays) +
         cmocka_run_group_tests(single, nullptr, nullptr);
}
