/* SPDX-License-Identifier: Apache-2.0
 * msq_structure_smooth_boolean. */
#include "beams.h"
#include "combined.h"
#include "struts.h"

static const int32_t operations[3] = {MSQ_BOOLEAN_UNION, MSQ_BOOLEAN_INTERSECTION,
                                      MSQ_BOOLEAN_DIFFERENCE};

static msq_structure* smooth_of(int32_t operation, const msq_structure* a, const msq_structure* b,
                                double radius, const msq_field* field) {
  const msq_param size = {radius, field};
  msq_structure* made;
  assert_ok(msq_structure_smooth_boolean(operation, a, b, &size, &made));
  return made;
}

static msq_structure* plain_of(int32_t operation, const msq_structure* a, const msq_structure* b) {
  const msq_structure* both[2] = {a, b};
  msq_structure* made;
  assert_ok(msq_structure_boolean(operation, both, 2, &made));
  return made;
}

/* Beams from -4 to 4 along an axis, through `at` of the next axis. */
static msq_structure* beam_along(msq_context* context, int axis, double at, double radius) {
  double ends[2][3] = {{0}};
  const uint32_t pair[2] = {0, 1};
  msq_beams_def def;
  msq_structure* made;
  ends[0][axis] = -4;
  ends[1][axis] = 4;
  ends[0][(axis + 1) % 3] = ends[1][(axis + 1) % 3] = at;
  assert_ok(msq_beams_def_init(&def, sizeof def));
  def.nodes = ends;
  def.node_count = 2;
  def.beams = pair;
  def.beam_count = 1;
  def.radius = radius;
  def.cap = MSQ_CAP_SPHERE;
  assert_ok(msq_structure_beams(context, &def, &made, NULL));
  return made;
}

/* The signed distance to such a beam, computed here, for points that are not beyond its ends. */
static double to_beam(const double p[3], int axis, double at, double radius) {
  return hypot(p[(axis + 1) % 3] - at, p[(axis + 2) % 3]) - radius;
}

/* Two crossing beams: points are inside as the roots of the two distances tell, which the header
 * gives as another form of the definition; and |s| / (1 + L / 4) is the distance. */
static void fillets_are_parabolas(void** state) {
  msq_context* context = make_context();
  msq_structure *a = beam_along(context, 0, 0.1, 0.5), *b = beam_along(context, 1, 0, 0.4);
  const double from[3] = {-2, 0, 0}, to[3] = {2, 0, 0}, low = 0.05, high = 0.65;
  msq_field* field;
  assert_ok(msq_field_gradient(context, from, low, to, high, &field));
  (void)state;
  for (int n = 0; n < 6; ++n) {
    const int32_t operation = operations[n % 3];
    const int is_union = operation == MSQ_BOOLEAN_UNION;
    msq_structure* made = smooth_of(operation, a, b, 0.3, n < 3 ? NULL : field);
    msq_model* model = in_all_space(context, made);
    uint64_t random = 5;
    size_t changed = 0, held = 0;
    for (size_t i = 0; i < 20000; ++i) {
      double p[3], distance;
      for (int axis = 0; axis < 3; ++axis) p[axis] = random_between(&random, -1.2, 1.2);
      const double k = n < 3 ? 0.3 : low + (p[0] + 2) / 4 * (high - low);
      const double of_a = to_beam(p, 0, 0.1, 0.5), of_b = to_beam(p, 1, 0, 0.4);
      /* Of the union, or of the complements. */
      const double u = is_union ? of_a : -of_a;
      const double v = operation == MSQ_BOOLEAN_INTERSECTION ? -of_b : of_b;
      const double margin = sqrt(fmax(u, 0)) + sqrt(fmax(v, 0)) - sqrt(k);
      const int in_plain = u <= 0 || v <= 0, in_fillet = !in_plain && margin <= 0;
      const int in = is_inside(model, p[0], p[1], p[2]);
      if (fabs(u) > 1e-9 && fabs(v) > 1e-9 && fabs(margin) > 1e-9)
        assert_int_equal(in, (in_plain || in_fillet) == is_union);
      const double h = fmax(0, k - fabs(u - v)), s = fmin(u, v) - h * h / (4 * k);
      assert_ok(msq_point_distance(model, p, NULL, &distance));
      assert_true(in ? distance <= 0 : distance > 0);
      const double steep = n < 3 ? 1 : 1 + (high - low) / 16;
      assert_float_equal(fabs(distance), fmax(fabs(s) / steep, -fmin(u, v)), 2e-7);
      changed += (size_t)in_fillet;
      held += (size_t)in;
    }
    assert_in_range(changed, 100, 4000);
    assert_in_range(held, 200, 19800);
    msq_model_release(model);
    msq_structure_release(made);
  }
  msq_field_release(field);
  msq_structure_release(b);
  msq_structure_release(a);
  msq_context_release(context);
}

/* With a radius of 0 the layers are the bytes of the plain boolean; with more a union holds more
 * and the others less, the more the larger the radius. */
static void layers_gain_or_lose(void** state) {
  msq_context* context = make_context();
  msq_structure* lattice = make_lattice_of(context, MSQ_UNIT_CELL_BCC, 1, 0.12);
  msq_structure* gyroid = make_gyroid(context);
  (void)state;
  for (int n = 0; n < 3; ++n) {
    const double sizes[3] = {0, 0.1, 0.3};
    const int is_union = operations[n] == MSQ_BOOLEAN_UNION;
    msq_structure* plain = plain_of(operations[n], lattice, gyroid);
    layer_stack before = layers_of(context, plain);
    for (int i = 0; i < 3; ++i) {
      msq_structure* made = smooth_of(operations[n], lattice, gyroid, sizes[i], NULL);
      layer_stack found = layers_of(context, made);
      const uint64_t bytes = found.taken * found.plan.layer_bytes;
      size_t changed = 0;
      if (i == 0) assert_memory_equal(found.data, before.data, bytes);
      for (uint64_t at = 0; at < bytes; ++at) {
        const unsigned less = is_union ? before.data[at] : found.data[at];
        const unsigned more = is_union ? found.data[at] : before.data[at];
        assert_int_equal(less & ~more, 0);
        changed += less != more;
      }
      assert_int_equal(changed > 500, i > 0);
      free_stack(&before);
      before = found;
      msq_structure_release(made);
    }
    free_stack(&before);
    msq_structure_release(plain);
  }
  msq_structure_release(gyroid);
  msq_structure_release(lattice);
  msq_context_release(context);
}

/* A radius that has a Lipschitz constant in boxes only, or none near 0: the same membership in
 * sets, layers and points, and a distance whose balls meet no boundary. */
static void any_field_may_be_the_radius(void** state) {
  msq_context* context = make_context();
  msq_structure* lattice = make_lattice_of(context, MSQ_UNIT_CELL_OCTET, 1, 0.1);
  msq_structure* foam = make_foam_with(context, 0.1, 0);
  const char* const texts[2] = {"0.2 + 0.2 * sin(2 * x + y) * cos(z)", "sqrt(max(0, x - 2)) / 5"};
  enum { side = 23, count = side * side * side };
  (void)state;
  for (int n = 0; n < 4; ++n) {
    msq_expression_field_def def;
    msq_field* field;
    assert_ok(msq_expression_field_def_init(&def, sizeof def));
    def.expression = texts[n % 2];
    def.low = 0;
    def.high = 0.4;
    assert_ok(msq_field_expression(context, &def, &field));
    msq_structure* made = smooth_of(operations[n / 2 * 2], lattice, foam, 0, field);
    msq_structure* plain = plain_of(operations[n / 2 * 2], lattice, foam);
    msq_model* model = model_with(context, make_box(context), made);
    msq_model* of_plain = model_with(context, make_box(context), plain);
    const msq_points_def points = grid_points(0.3, 3.7, side);
    uint8_t* inside = (uint8_t*)calloc(count, 1);
    uint64_t random = 11;
    size_t held = 0, changed = 0;
    assert_ok(msq_set_membership(model, &points, NULL, inside, count, NULL));
    for (int i = 0; i < count; ++i) {
      double p[3];
      for (int axis = 0, rest = i; axis < 3; ++axis, rest /= side)
        p[axis] = points.origin[axis] + rest % side * points.spacing[axis];
      assert_int_equal(inside[i], is_inside(model, p[0], p[1], p[2]));
      held += inside[i];
      changed += inside[i] != is_inside(of_plain, p[0], p[1], p[2]);
      if (i % 7) continue;
      double distance, way[3], length = 0;
      assert_ok(msq_point_distance(model, p, NULL, &distance));
      for (int axis = 0; axis < 3; ++axis) {
        way[axis] = random_between(&random, -1, 1);
        length += way[axis] * way[axis];
      }
      const double s = fabs(distance) * (1 - 1e-9) / sqrt(length);
      if (fabs(distance) > 1e-12)
        assert_int_equal(inside[i],
                         is_inside(model, p[0] + s * way[0], p[1] + s * way[1], p[2] + s * way[2]));
    }
    assert_in_range(held, 100, count - 100);
    assert_true(changed > 100);
    free(inside);
    msq_model_release(of_plain);
    msq_model_release(model);
    msq_structure_release(plain);
    msq_structure_release(made);
    msq_field_release(field);
  }
  msq_structure_release(foam);
  msq_structure_release(lattice);
  msq_context_release(context);
}

/* Rays into two crossing beams, along a diagonal of the plane z = 0: of the union they meet the
 * fillet, of the intersection the rounded edge. Both distances are k / 4 there. */
static void rays_meet_the_fillet(void** state) {
  const double origin[3] = {3, 3, 0}, r = sqrt(0.5), direction[3] = {-r, -r, 0}, k = 0.4;
  msq_context* context = make_context();
  msq_structure *a = beam_along(context, 0, 0, 0.5), *b = beam_along(context, 1, 0, 0.5);
  (void)state;
  for (int n = 0; n < 2; ++n) {
    msq_structure* made = smooth_of(operations[n], a, b, k, NULL);
    msq_model* model = model_with(context, make_box_of(context, -4, 4), made);
    const double at = n == 0 ? 0.5 + k / 4 : 0.5 - k / 4;
    msq_rays_def rays;
    msq_ray_hit hit;
    assert_ok(msq_rays_def_init(&rays, sizeof rays));
    rays.origins = origin;
    rays.directions = direction;
    rays.count = 1;
    assert_ok(msq_ray_cast(model, &rays, NULL, &hit, 1, NULL));
    assert_int_equal(hit.scale, 1);
    assert_float_equal(hit.t, (3 - at) / r, 1e-8);
    for (int axis = 0; axis < 3; ++axis)
      assert_float_equal(hit.normal[axis], axis < 2 ? r : 0, 1e-4);
    msq_model_release(model);
    msq_structure_release(made);
  }
  msq_structure_release(b);
  msq_structure_release(a);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(fillets_are_parabolas),
      cmocka_unit_test(layers_gain_or_lose),
      cmocka_unit_test(any_field_may_be_the_radius),
      cmocka_unit_test(rays_meet_the_fillet),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
