// SPDX-License-Identifier: Apache-2.0
#include "shapes.h"

#include <algorithm>
#include <utility>

#include "images.h"
#include "meshes.h"
#include "random.h"
#include "shape/host.h"
#include "shape/mesh.h"
#include "shape/primitive.h"
#include "shape/voxels.h"

namespace msq::test {

namespace {

TriangleSoup drop_triangles(TriangleSoup soup, size_t every) {
  std::vector<Triangle> kept;
  for (size_t i = 0; i < soup.triangles.size(); ++i)
    if (i % every != 1) kept.push_back(soup.triangles[i]);
  soup.triangles = kept;
  return soup;
}

/// Steps of horizontal and vertical faces: coplanar triangles at many heights, shared vertices.
TriangleSoup staircase() {
  TriangleSoup soup;
  for (int i = 0; i < 4; ++i) {
    const double x = 0.25 * i, z = 0.25 * (i + 1);
    append(soup, box_mesh({x, 0, 0}, {x + 0.25, 1, z}));
  }
  return soup;
}

/// Triangles in planes of x, y and z, with edges on the rows of a grid of 1/8, and slanted roofs.
TriangleSoup roof() {
  TriangleSoup soup;
  soup.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0.5}, {0.5, 0.5, -0.5}};
  soup.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4},
                    {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}};
  return soup;
}

/// Two crossing balls, 0 to 255 over about two voxels of their surface, cut off by the image's
/// border.
double balls(Vec3 u) {
  const double one = 7 - length(u - Vec3{8, 8, 8}), other = 6 - length(u - Vec3{19, 9, 3});
  return std::clamp(128 + 64 * std::max(one, other), 0.0, 255.0);
}

template <class T>
void append_voxels(std::vector<ShapeRow>& rows, const char* name, const std::vector<T>& values,
                   ImageSize size, double threshold, double least, double most) {
  const Rotation quarter{{0, -1, 0, 1, 0, 0, 0, 0, 1}};
  const struct {
    const char* name;
    ImageFrame frame;
  } frames[] = {{"", {}},
                {", uneven", {{-3, 0.5, 10}, {0.25, 0.375, 0.75}, {}}},
                {", quarter turn", {{0, 0, 0}, {0.5, 0.25, 0.25}, quarter}},
                {", turned", {{1, 2, 3}, {0.3, 0.2, 0.4}, skew_rotation()}}};
  for (const auto& [frame_name, frame] : frames)
    for (const auto solid : {Voxels::Solid::above, Voxels::Solid::below}) {
      const bool is_above = solid == Voxels::Solid::above;
      rows.push_back({std::string("voxels, ") + name + frame_name + (is_above ? "" : ", below"),
                      [=, frame = frame]() -> Ref<const Shape> {
                        return make_ref<Voxels>(make_image(values, size, frame), threshold, solid);
                      },
                      is_above ? least : 0.02, is_above ? most : 1});
    }
}

void append_voxels(std::vector<ShapeRow>& rows) {
  const ImageSize size{25, 17, 13};
  append_voxels(rows, "balls", sampled<uint8_t>(size, balls), size, 127.5, 0.05, 0.8);
  append_voxels(rows, "balls that reach a value", sampled<int16_t>(size, balls), size, 128, 0.05,
                0.8);
  Random random(12);
  append_voxels(rows, "noise", sampled<float>({9, 5, 14}, [&](Vec3) { return random.unit(); }),
                {9, 5, 14}, 0.6, 0.02, 0.8);
  append_voxels(
      rows, "bits",
      sampled<uint16_t>({9, 10, 6}, [&](Vec3 u) { return u.x < 5 && random.unit() < 0.8; }),
      {9, 10, 6}, 1, 0.0005, 0.8);
  append_voxels(rows, "solid throughout", sampled<double>({2, 3, 2}, [](Vec3) { return 0.3; }),
                {2, 3, 2}, 0.3, 0.1, 1);
}

}  // namespace

std::vector<ShapeRow> shape_rows() {
  struct Soup {
    const char* name;
    TriangleSoup soup;
    double least, most;
  };
  const TriangleSoup cube = box_mesh({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
  const TriangleSoup ball = icosphere(0.5, 3), ring = torus_mesh(0.375, 0.125, 24, 12);
  std::vector<Soup> soups = {{"cube", cube, 1, 1},
                             {"off-grid box", box_mesh({-0.3, 0.1, -0.7}, {0.35, 0.77, 0.2}), 1, 1},
                             {"icosphere", ball, 0.4, 0.6},
                             {"octahedron on the grid", roof(), 0.2, 0.8},
                             {"torus", ring, 0.2, 0.8},
                             {"open icosphere", drop_triangles(ball, 9), 0, 1},
                             {"open cube", drop_triangles(cube, 12), 0, 1}};
  TriangleSoup pair = cube;
  append(pair, ball, {0.25, 0.125, 0.25});
  soups.push_back({"crossing pair", pair, 0.2, 0.9});
  TriangleSoup twice = cube;
  append(twice, cube);
  soups.push_back({"every triangle twice", twice, 0, 1});
  TriangleSoup hollow = cube;
  append(hollow, inside_out(box_mesh({-0.25, -0.25, -0.25}, {0.25, 0.25, 0.25})));
  soups.push_back({"hollow cube", hollow, 0.8, 0.95});
  TriangleSoup some_twice = ring;
  for (size_t i = 0; i < ring.triangles.size(); i += 5)
    some_twice.triangles.push_back(ring.triangles[i]);
  soups.push_back({"some triangles twice", some_twice, 0, 1});
  soups.push_back({"inside out", inside_out(ring), 0, 0.8});
  TriangleSoup mixed = inside_out(cube);
  append(mixed, cube, {0.5, 0.5, 0.5});
  soups.push_back({"one of two inside out", mixed, 0, 0.9});
  soups.push_back({"staircase of touching boxes", staircase(), 0.3, 0.8});
  TriangleSoup sheet = cube;
  sheet.triangles.resize(2);
  append(sheet, ball, {0, 0, 0.5});
  soups.push_back({"sheet and ball", sheet, 0, 0.9});

  std::vector<ShapeRow> rows;
  const char* rules[] = {"nonzero", "even-odd", "positive"};
  for (const Soup& s : soups)
    for (int rule = 0; rule < 3; ++rule)
      rows.push_back({std::string(s.name) + ", " + rules[rule],
                      [soup = s.soup, rule]() -> Ref<const Shape> {
                        return make_ref<Mesh>(soup, static_cast<WindingRule>(rule),
                                              std::make_shared<MemoryBudget>(uint64_t{0}));
                      },
                      s.least, s.most});
  const auto add = [&](const char* name, std::function<Ref<const Shape>()> make) {
    rows.push_back({name, std::move(make), 0.1, 1});
  };
  add("box", [] {
    return Ref<const Shape>(make_ref<BoxShape>(Box3{{-0.5, -0.25, 0}, {0.5, 1, 0.375}}));
  });
  add("sphere", [] { return Ref<const Shape>(make_ref<SphereShape>(Vec3{0.5, 0, -1}, 0.625)); });
  add("upright cylinder", [] {
    return Ref<const Shape>(make_ref<CylinderShape>(Vec3{0, 0, -0.5}, Vec3{0, 0, 0.5}, 0.5));
  });
  add("lying cylinder", [] {
    return Ref<const Shape>(make_ref<CylinderShape>(Vec3{-1, 0, 0}, Vec3{1, 0, 0}, 0.25));
  });
  add("slanted cylinder", [] {
    return Ref<const Shape>(make_ref<CylinderShape>(Vec3{-1, 0.3, 0.1}, Vec3{1, 1, 0.8}, 0.3));
  });
  // A ball again, in a box that is larger.
  add("host's ball", [] {
    HostShapeCalls calls;
    calls.inside = [](const Vec3* points, size_t count, uint8_t* inside) {
      for (size_t i = 0; i < count; ++i) inside[i] = length(points[i]) <= 0.625 ? 2 : 0;
    };
    calls.distance = [](const Vec3* points, size_t count, double* bounds) {
      for (size_t i = 0; i < count; ++i) bounds[i] = 0.9 * (length(points[i]) - 0.625);
    };
    return Ref<const Shape>(
        make_ref<HostShape>(calls, Box3{{-0.7, -0.625, -0.75}, {0.625, 0.8, 0.625}}, true));
  });
  append_voxels(rows);
  return rows;
}

}  // namespace msq::test
