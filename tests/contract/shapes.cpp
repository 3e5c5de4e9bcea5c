// SPDX-License-Identifier: Apache-2.0
#include "shapes.h"

#include <algorithm>
#include <utility>

#include "images.h"
#include "meshes.h"
#include "random.h"
#include "shape/boolean.h"
#include "shape/host.h"
#include "shape/mesh.h"
#include "shape/offset.h"
#include "shape/placed.h"
#include "shape/primitive.h"
#include "shape/voxels.h"
#include "winding_number.h"

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

Ref<const Shape> mesh_of(const TriangleSoup& soup) {
  return make_ref<Mesh>(soup, WindingRule::automatic, std::make_shared<MemoryBudget>(uint64_t{0}));
}

Ref<const Shape> placed(const Ref<const Shape>& shape, const std::array<double, 12>& matrix) {
  return make_ref<PlacedShape>(shape, Placement(matrix));
}

/// Meshes, primitives, voxels and shapes of a host in all kinds of places.
void append_placed(std::vector<ShapeRow>& rows) {
  const auto& m = skew_rotation().m;
  const struct {
    const char* name;
    std::array<double, 12> matrix;
  } places[] = {
      {"moved", {1, 0, 0, 3, 0, 1, 0, -0.3, 0, 0, 1, 0.1}},
      {"turned", {m[0], m[1], m[2], 0.7, m[3], m[4], m[5], 1, m[6], m[7], m[8], -2}},
      {"mirrored and scaled", {0, -2.5, 0, 0, 2.5, 0, 0, 0.1, 0, 0, -2.5, 0}},
      {"stretched", {3, 0, 0, 0, 0, 0.25, 0, 1, 0, 0, -1, 0}},
      {"sheared", {1, 0.7, 0, 0.2, -0.1, 0.8, 0.4, 0, 0.3, 0, 1.1, 5}},
      {"far away", {m[0], m[1], m[2], 7e4, m[3], m[4], m[5], -9e4, m[6], m[7], m[8], 3e4}}};
  const TriangleSoup ring = torus_mesh(0.375, 0.125, 24, 12);
  TriangleSoup far = ring;
  for (Vec3& v : far.vertices) v = v + Vec3{-7e4, 9e4, -3e4};
  const struct {
    const char* name;
    std::function<Ref<const Shape>()> make;
  } shapes[] = {
      {"torus", [ring] { return mesh_of(ring); }},
      {"torus, 5 % removed", [ring] { return mesh_of(with_holes(ring, 0.05, 1)); }},
      {"distant torus", [far] { return mesh_of(far); }},
      {"box",
       [] {
         return Ref<const Shape>(make_ref<BoxShape>(Box3{{-0.5, -0.25, 0}, {0.5, 1, 0.375}}));
       }},
      {"cylinder",
       [] {
         return Ref<const Shape>(make_ref<CylinderShape>(Vec3{-1, 0.3, 0}, Vec3{1, 1, 0.8}, 0.3));
       }},
      {"voxels", [] {
         const ImageSize size{25, 17, 13};
         return Ref<const Shape>(make_ref<Voxels>(
             make_image(sampled<uint8_t>(size, balls), size, {{-1, 0, 0}, {0.1, 0.1, 0.1}, {}}),
             127.5, Voxels::Solid::above));
       }}};
  for (const auto& [name, make] : shapes)
    for (const auto& [place, matrix] : places)
      rows.push_back({std::string("placed: ") + name + ", " + place +
                          (std::string(name).find("removed") == std::string::npos ? "" : ", auto"),
                      [make = make, matrix = matrix] { return placed(make(), matrix); },
                      place == std::string("stretched") ? 0 : 0.005, 1});
  rows.push_back({"placed: host's ball",
                  [matrix = places[4].matrix] {
                    HostShapeCalls calls;
                    calls.inside = [](const Vec3* points, size_t count, uint8_t* inside) {
                      for (size_t i = 0; i < count; ++i) inside[i] = length(points[i]) <= 0.625;
                    };
                    calls.distance = [](const Vec3* points, size_t count, double* bounds) {
                      for (size_t i = 0; i < count; ++i) bounds[i] = length(points[i]) - 0.625;
                    };
                    return placed(
                        make_ref<HostShape>(calls, Box3{{-0.7, -0.7, -0.7}, {0.7, 0.7, 0.7}}, true),
                        matrix);
                  },
                  0.1, 1});
}

void append_booleans(std::vector<ShapeRow>& rows) {
  using Operation = BooleanShape::Operation;
  const TriangleSoup ring = torus_mesh(0.375, 0.125, 24, 12);
  const auto members = [ring] {
    const auto& m = skew_rotation().m;
    return std::vector<Ref<const Shape>>{
        make_ref<BoxShape>(Box3{{-0.5, -0.5, -0.25}, {0.5, 0.5, 0.25}}),
        make_ref<SphereShape>(Vec3{0.25, 0.125, 0}, 0.375), mesh_of(ring),
        placed(mesh_of(ring), {m[0], m[1], m[2], 0, m[3], m[4], m[5], 0, m[6], m[7], m[8], 0})};
  };
  const std::pair<const char*, Operation> operations[] = {{"union", Operation::united},
                                                          {"intersection", Operation::intersected},
                                                          {"difference", Operation::subtracted}};
  for (const auto& [name, operation] : operations)
    for (size_t count : {size_t{1}, size_t{2}, size_t{4}})
      rows.push_back({std::string("boolean: ") + name + " of " + std::to_string(count),
                      [=, operation = operation]() -> Ref<const Shape> {
                        auto all = members();
                        all.resize(count);
                        return make_ref<BooleanShape>(operation, all);
                      },
                      0.0005, 1});
  rows.push_back({"boolean: equal boxes subtracted",
                  []() -> Ref<const Shape> {
                    const Ref<const Shape> box = make_ref<BoxShape>(Box3{{0, 0, 0}, {1, 1, 1}});
                    return make_ref<BooleanShape>(Operation::subtracted,
                                                  std::vector<Ref<const Shape>>{box, box});
                  },
                  0, 0});
  rows.push_back({"boolean: touching boxes",
                  []() -> Ref<const Shape> {
                    return make_ref<BooleanShape>(
                        Operation::united, std::vector<Ref<const Shape>>{
                                               make_ref<BoxShape>(Box3{{0, 0, 0}, {1, 1, 1}}),
                                               make_ref<BoxShape>(Box3{{1, 0, 0}, {2, 1, 0.5}})});
                  },
                  0.5, 1});
  const auto add_offset = [&](const char* name, double by, std::function<Ref<const Shape>()> make) {
    rows.push_back({std::string("offset: ") + name,
                    [=]() -> Ref<const Shape> { return make_ref<OffsetShape>(make(), by); }, 0.05,
                    1});
  };
  const auto box = []() -> Ref<const Shape> {
    return make_ref<BoxShape>(Box3{{-0.5, -0.25, 0}, {0.5, 1, 0.375}});
  };
  add_offset("box, outwards", 0.25, box);
  add_offset("box, inwards", -0.125, box);
  add_offset("torus, outwards", 0.0625, [ring] { return mesh_of(ring); });
  add_offset("torus, inwards", -0.0625, [ring] { return mesh_of(ring); });
  add_offset("difference, inwards", -0.0625, [members, operation = Operation::subtracted] {
    auto all = members();
    all.resize(2);
    return Ref<const Shape>(make_ref<BooleanShape>(operation, all));
  });
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
  // Open meshes by their generalised winding number.
  TriangleSoup lidless = cube;
  std::erase_if(lidless.triangles, [&](const Triangle& t) {
    return cube.vertices[t[0]].x + cube.vertices[t[1]].x + cube.vertices[t[2]].x > 1.4;
  });
  // Samples on its triangles and on those that close its holes.
  TriangleSoup coarse = ball;
  for (Vec3& v : coarse.vertices)
    for (int axis = 0; axis < 3; ++axis) v[axis] = std::round(16 * v[axis]) / 16;
  const Soup open[] = {
      {"open icosphere", drop_triangles(ball, 9), 0.4, 0.6},
      {"open cube", drop_triangles(cube, 12), 0.7, 1},
      {"cube without a side", lidless, 0.99, 1},
      {"some triangles twice", some_twice, 0, 1},
      {"sheet and ball", sheet, 0.01, 0.9},
      {"ball, 20 % removed", with_holes(ball, 0.2, 1), 0.4, 0.6},
      {"ball on the grid, 20 % removed", with_holes(coarse, 0.2, 2), 0.3, 0.7},
      {"inside out torus, 5 % removed", inside_out(with_holes(ring, 0.05, 1)), 0.2, 0.8},
      {"crossing pair, 5 % removed", with_holes(pair, 0.05, 1), 0.2, 0.9},
      {"loose triangles", torn(ball, 0.005, 1), 0.4, 0.6},
      {"many loose triangles", torn(icosphere(0.5, 4), 0.002, 1), 0.4, 0.6}};
  for (const Soup& s : open)
    rows.push_back({std::string(s.name) + ", auto",
                    [soup = s.soup]() -> Ref<const Shape> {
                      return make_ref<Mesh>(soup, WindingRule::automatic,
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
  append_placed(rows);
  append_booleans(rows);
  return rows;
}

}  // namespace msq::test
