// SPDX-License-Identifier: Apache-2.0
// The generalised winding number of open meshes from their boundary loops, and what caps prove of
// it, against the sum of the solid angles of all triangles.
#include "meshes.h"
#include "random.h"
#include "shape/half_angles.h"
#include "shape/mesh_diagnosis.h"
#include "shape/open_mesh.h"
#include "shape/triangle_tree.h"
#include "suite.h"
#include "winding_number.h"

using namespace msq;
using namespace msq::test;

namespace {

struct Row {
  std::string name;
  TriangleSoup soup;
  size_t points;
};

std::vector<Row> rows() {
  const TriangleSoup cube = box_mesh({0, 0, 0}, {1, 1, 1}), ball = icosphere(0.5, 3);
  TriangleSoup lidless = cube, sheet = cube, far = with_holes(ball, 0.05, 3), two = cube;
  lidless.triangles.erase(lidless.triangles.begin() + 2, lidless.triangles.begin() + 4);
  sheet.triangles.resize(1);
  for (Vec3& v : far.vertices) v = v * 1e-3 + Vec3{50, 9, -70};
  append(two, ball, {0.25, 0.125, 0.25});
  TriangleSoup twice = lidless;
  append(twice, lidless);
  TriangleSoup crossed = inside_out(with_holes(cube, 0.3, 1));
  append(crossed, with_holes(cube, 0.3, 2), {0.5, 0.5, 0.5});
  // Many coordinates alike, or apart by less than others are rounded by.
  TriangleSoup alike;
  Random random(4);
  for (uint32_t i = 0; i < 60; ++i) {
    const double places[] = {0, 1e-30, -1e-17, 0.1, 0.3, 1.0 / 3, 0.7, 1, std::nextafter(1.0, 2.0)};
    alike.vertices.push_back(
        {places[random.below(9)], places[random.below(9)], places[random.below(9)]});
    if (i % 3 == 2) alike.triangles.push_back({i - 2, i - 1, i});
  }
  TriangleSoup half = ball;
  std::erase_if(half.triangles, [&](const Triangle& t) { return half.vertices[t[0]].z > 0.01; });
  return {{"a triangle", sheet, 40000},
          {"cube without a lid", lidless, 40000},
          {"cube without a lid, twice", twice, 20000},
          {"half a ball", half, 4000},
          {"ball, 1 % removed", with_holes(ball, 0.01, 1), 4000},
          {"ball, 20 % removed", with_holes(ball, 0.2, 1), 4000},
          {"torus, 60 % removed", with_holes(torus_mesh(0.375, 0.125, 24, 12), 0.6, 1), 4000},
          {"cubes, crossed, one inside out", crossed, 20000},
          {"two shells, 5 % removed", with_holes(two, 0.05, 1), 4000},
          {"small and far away", far, 4000},
          {"triangles on few planes", alike, 40000},
          {"loose triangles", torn(ball, 0.01, 1), 4000}};
}

/// Points about a mesh: anywhere, on a grid of its box, with coordinates of vertices, near
/// vertices, and behind and before vertices on the +x ray.
Vec3 some_point(Random& random, const TriangleSoup& soup, const Box3& box, size_t i) {
  const double extent = max_component(box.extent());
  const auto vertex = [&] {
    return soup.vertices[soup.triangles[random.below(soup.triangles.size())][random.below(3)]];
  };
  Vec3 p = random.in_box(box.grown(i % 7 ? 0 : 2 * extent));
  switch (i % 8) {
    case 1:
      for (int axis = 0; axis < 3; ++axis)
        p[axis] = box.min[axis] + box.extent()[axis] * static_cast<double>(random.below(9)) / 8;
      break;
    case 2:
      p = {p.x, vertex().y, vertex().z};
      if (i % 32 == 2) p.y = std::nextafter(p.y, random.between(-9, 9));
      if (i % 32 >= 18) p.z = std::nextafter(p.z, random.between(-9, 9));
      break;
    case 3: {
      const Vec3 v = vertex();
      p = {p.x, v.y, v.z};
      break;
    }
    case 4: {
      const Vec3 v = vertex();
      const double by = extent * std::pow(10.0, random.between(-17, 0));
      p = {p.x, v.y + by * random.between(-1, 1), v.z + by * random.between(-1, 1)};
      break;
    }
    case 5: {
      const double by = extent * std::pow(10.0, random.between(-12, 0));
      p = vertex() + random.in_box({{-by, -by, -by}, {by, by, by}});
      break;
    }
    case 6: {  // beside an edge or in a triangle
      const double s = i % 16 == 6 ? 0 : random.unit(), t = random.unit() * (1 - s);
      const Triangle& of = soup.triangles[random.below(soup.triangles.size())];
      p = soup.vertices[of[0]] * (1 - s - t) + soup.vertices[of[1]] * s + soup.vertices[of[2]] * t;
      p.x = i % 32 < 16 ? p.x : random.between(box.min.x, box.max.x);
      break;
    }
    default:
      break;
  }
  return p;
}

struct Parts {
  TriangleSoup soup;
  Box3 box;
  double scale;
  Loops loops;

  explicit Parts(const Row& row) : soup(row.soup) {
    weld(soup, nullptr);
    box = diagnose(soup, nullptr).bounds;
    scale = std::ldexp(1.0, -std::ilogb(max_component(box.extent())));
    loops = join_edges(open_edges(soup, nullptr), soup.vertices.size());
  }
};

/// Numbers of all triangles, as count_crossings() takes them.
std::vector<uint32_t> all_triangles(const TriangleSoup& soup) {
  std::vector<uint32_t> all(soup.triangles.size());
  for (size_t i = 0; i < all.size(); ++i) all[i] = static_cast<uint32_t>(i);
  return all;
}

void test_loops(void** state) {
  const Parts parts(*static_cast<const Row*>(*state));
  // They run along each open edge as often as it counts.
  std::map<std::pair<uint32_t, uint32_t>, int64_t> uses;
  for (size_t i = 0; i < parts.loops.count(); ++i) {
    const uint64_t begin = parts.loops.starts[i], end = parts.loops.starts[i + 1];
    assert_true(end >= begin + 3);
    for (uint64_t n = begin; n < end; ++n)
      ++uses[{parts.loops.vertices[n], parts.loops.vertices[n + 1 == end ? begin : n + 1]}];
  }
  for (const Triangle& t : parts.soup.triangles)
    for (int i = 0; i < 3; ++i) {
      const uint32_t a = t[i], b = t[(i + 1) % 3];
      --uses[{a, b}];
    }
  for (const auto& [edge, count] : uses) {
    const auto back = uses.find({edge.second, edge.first});
    assert_int_equal(count, back == uses.end() ? 0 : back->second);
  }
}

void test_numbers(void** state) {
  const Row& row = *static_cast<const Row*>(*state);
  const Parts parts(row);
  const BoundaryLoops loops(parts.soup, parts.loops, parts.scale);
  const std::vector<uint32_t> all = all_triangles(parts.soup);
  std::vector<TreeTriangle> triangles;
  for (const Triangle& t : parts.soup.triangles)
    triangles.emplace_back(parts.soup.vertices[t[0]] * parts.scale,
                           parts.soup.vertices[t[1]] * parts.scale,
                           parts.soup.vertices[t[2]] * parts.scale);
  const TriangleTree tree(triangles, nullptr);
  Random random(5);
  size_t compared = 0;
  for (size_t i = 0; i < test_count(row.points); ++i) {
    const Vec3 p = some_point(random, parts.soup, parts.box, i);
    const int64_t row_winding = count_crossings(parts.soup, all, p).beyond;
    const double wanted = winding_number(parts.soup, p);
    const BoundaryLoops::Level level = loops.level(p);
    assert_int_equal(level.turns, loops.turns(p));
    // On a triangle there is no such number, and by its edges the sum over triangles loses digits.
    if (tree.distance(p * parts.scale) < 1e-8 * (1 + parts.scale * max_magnitude(p))) continue;
    const double room = 1e-9 + level.error;
    ++compared;
    const double got = static_cast<double>(row_winding - level.turns) - level.rest / (2 * pi);
    if (!(std::abs(got - wanted) <= room))
      fail_msg("(%.17g, %.17g, %.17g): %.17g, not %.17g", p.x, p.y, p.z, got, wanted);
    if (std::abs(wanted - std::floor(wanted) - 0.5) > room)
      assert_int_equal(row_winding - level.turns, std::floor(wanted + 0.5));
  }
  assert_true(compared > test_count(row.points) / 3);
}

/// Within the reach of a point, away from the caps, it is one number. is_widest: of the widest ball
/// of which that is proven, where bounds have least room.
void check_whole_ball(const OpenMesh& mesh, const BoundaryLoops& loops, Vec3 p, double scale,
                      bool is_widest, Random& random) {
  double size = is_widest ? 2 : std::pow(10.0, random.between(-3, 0));
  int64_t whole = 0;
  while (!mesh.is_whole_about(p, size / scale, whole)) {
    size *= 0.8;
    if (!is_widest || size < 1e-3) return;
  }
  for (int n = 0; n < (is_widest ? 24 : 4); ++n) {
    const double part = is_widest ? 1 - 1e-9 : n ? random.unit() : 1;
    const Vec3 q = p + random.direction() * (size * part / scale);
    assert_int_equal(mesh.caps().count_beyond(q) + loops.turns(q), whole);
  }
}

/// Views that points of a ball share. Returns how many are proven, of 2.
size_t check_near_views(const OpenMesh& mesh, const BoundaryLoops& loops, Vec3 p, double scale,
                        Random& random) {
  const double size = std::pow(10.0, random.between(-5, -1)) / scale;
  Caps::Nearby near;
  mesh.caps().gather(p, size, near);
  constexpr size_t count = 2;
  Vec3 points[count];
  Caps::View views[count];
  for (Vec3& q : points) q = p + random.direction() * (size * random.unit());
  mesh.caps().find_views(points, count, near, views);
  size_t proven = 0;
  for (size_t n = 0; n < count; ++n) {
    if (!(views[n].margin() > 0)) continue;
    ++proven;
    assert_int_equal(mesh.caps().count_beyond(points[n]) - views[n].whole(),
                     -loops.turns(points[n]));
    const double exact = winding_number(mesh.caps().soup(), points[n]);
    if (!(std::abs(views[n].turns - exact) <= views[n].error + 1e-12))
      fail_msg("(%.17g, %.17g, %.17g): the caps near make %.17g, to %g, not %.17g", points[n].x,
               points[n].y, points[n].z, views[n].turns, views[n].error, exact);
  }
  return proven;
}

/// The bound of what an expansion is off by holds at a point of the ball.
void check_expansion(const BoundaryLoops& loops, const Ball& ball, const Expansion& made, Vec3 q,
                     double scale) {
  const BoundaryLoops::Level level = loops.level(q);
  const Vec3 d = (q - ball.centre) * scale;
  const auto& [xx, yy, zz, xy, xz, yz] = made.second;
  const double got = made.turns + dot(made.first, d) + xx * d.x * d.x + yy * d.y * d.y +
                     zz * d.z * d.z + xy * d.x * d.y + xz * d.x * d.z + yz * d.y * d.z;
  const double off = got - static_cast<double>(level.turns) - level.rest / (2 * pi);
  if (!(std::abs(off - std::round(off)) <= made.error))  // strips add whole turns
    fail_msg(
        "(%.17g, %.17g, %.17g) in the ball of %g about (%.17g, %.17g, %.17g): off by %g, not %g",
        q.x, q.y, q.z, ball.radius, ball.centre.x, ball.centre.y, ball.centre.z,
        off - std::round(off), made.error);
}

/// Expansions about some balls: each number that their fields know is that of the definition, and
/// their bounds hold. Returns how many points were known, of 6 a ball, but for balls beside edges.
size_t check_fields(const OpenMesh& mesh, const BoundaryLoops& loops, Vec3 p, double scale,
                    Random& random) {
  constexpr size_t count = 5;
  Ball balls[count];
  Expansion made[count];
  for (Ball& ball : balls) {
    const double size = std::pow(10.0, random.between(-4, 0)) / scale;
    ball = {p + random.direction() * (size * random.unit()), size};
  }
  balls[0] = {p, 0};
  // Also of meshes with so many edges that OpenMesh::expand() leaves it out.
  loops.expand(balls, count, 0x1p-49 * (4 + scale * max_magnitude(p)), made);
  int64_t whole, wanted = mesh.caps().count_beyond(p) + loops.turns(p);
  if (mesh.find_whole(p, made[0], whole)) assert_int_equal(whole, wanted);
  size_t known = 0;
  WholeField field;
  for (size_t i = 1; i < count; ++i) {
    const Ball& ball = balls[i];
    if (!mesh.find_field(ball, made[i], field)) continue;
    const bool is_constant = field.is_constant(wanted);
    for (int n = 0; n < 6; ++n) {
      const Vec3 q =
          ball.centre + random.direction() * (ball.radius * (n % 2 ? random.unit() : 1 - 1e-9));
      check_expansion(loops, ball, made[i], q, scale);
      const bool is_known = field.whole_at(q, whole);
      if (!is_known && !is_constant) continue;
      ++known;
      if (is_constant && is_known) assert_int_equal(whole, wanted);
      const int64_t got = is_known ? whole : wanted;
      if (got != mesh.caps().count_beyond(q) + loops.turns(q))
        fail_msg("(%.17g, %.17g, %.17g) in the ball of %g about (%.17g, %.17g, %.17g): %lld", q.x,
                 q.y, q.z, ball.radius, ball.centre.x, ball.centre.y, ball.centre.z,
                 static_cast<long long>(got));
    }
  }
  return known;
}

/// Caps say the same as the definition wherever they say anything, and their bounds hold.
void test_caps(void** state) {
  const Row& row = *static_cast<const Row*>(*state);
  const Parts parts(row);
  const OpenMesh mesh(parts.soup, parts.box);
  const BoundaryLoops loops(parts.soup, parts.loops, parts.scale);
  Random random(6);
  size_t proven = 0, proven_near = 0, known_in_balls = 0;
  const size_t count = 4 * test_count(row.points);
  for (size_t i = 0; i < count; ++i) {
    const Vec3 p = some_point(random, i % 2 ? mesh.caps().soup() : parts.soup, parts.box, i);
    const int64_t turns = loops.turns(p);
    assert_int_equal(mesh.correction(p), -turns);
    for (const double opening : {2.0, 4.0, 12.0}) {
      const Caps::View view = mesh.caps().view(p, opening);
      if (!(view.margin() > 0)) continue;
      ++proven;
      const int64_t got = mesh.caps().count_beyond(p) - view.whole();
      if (got != -turns)
        fail_msg("(%.17g, %.17g, %.17g): %lld turns, not %lld", p.x, p.y, p.z,
                 static_cast<long long>(-got), static_cast<long long>(turns));
      if (!(std::abs(view.turns - winding_number(mesh.caps().soup(), p)) <= view.error + 1e-12))
        fail_msg("(%.17g, %.17g, %.17g): the caps make %.17g, to %g, not %.17g", p.x, p.y, p.z,
                 view.turns, view.error, winding_number(mesh.caps().soup(), p));
    }
    check_whole_ball(mesh, loops, p, parts.scale, i % 16 == 0, random);
    if (i % 4 == 2) known_in_balls += check_fields(mesh, loops, p, parts.scale, random);
    if (i % 8 == 1) proven_near += check_near_views(mesh, loops, p, parts.scale, random);
  }
  assert_true(proven_near > count / 8);
  assert_true(known_in_balls > 2 * count);
  assert_true(proven > count);
}

/// On the real axis the sign of a 0 says on which side of it an angle is.
void half_turns_add_up(void**) {
  for (const int way : {1, -1}) {
    HalfAngles sum;
    for (int count = 1; count <= 5; ++count) {
      sum.add(-1, way * 0.0);
      const double angle = 2 * pi * static_cast<double>(sum.turns()) + sum.rest();
      if (!(std::abs(angle - way * count * pi) < 1e-12))
        fail_msg("%d half turns make %.17g", way * count, angle);
      assert_true(sum.rest() > -pi && sum.rest() <= pi);
    }
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(half_turns_add_up)};
  std::vector<Row> all = rows();
  return cmocka_run_group_tests_name("half angles", tests, nullptr, nullptr) +
         run_for_each("loops", all, test_loops) + run_for_each("numbers", all, test_numbers) +
         run_for_each("caps", all, test_caps);
}
