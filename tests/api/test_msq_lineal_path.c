/* SPDX-License-Identifier: Apache-2.0
 * msq_lineal_path against closed forms. */
#include "samples.h"

enum { count = 5 };
static const double lengths[count] = {0, 0.05, 0.1, 0.2, 0.25};

/* A segment along x of length s lies in one plate of thickness p with p - s; in a random direction
 * with p - s / 2, s up to p. In the void between them likewise, and there are no other plates to
 * meet, unlike in the two-point correlation. */
static void plates_have_theirs(void** state) {
  const double along[3] = {2, 0, 0}, across[3] = {0, 1, 0}, oblique[3] = {3, 0, -4};
  const double* directions[4] = {along, across, oblique, NULL};
  const double slopes[4] = {1, 0, 0.6, 0.5};
  msq_context* context = make_context();
  msq_model* model = make_plates(context);
  const msq_points_def sample =
      sample_of(-3, 3, (uint64_t)cbrt((double)test_count(25 * 25 * 25)), 2);
  (void)state;
  for (int d = 0; d < 4; ++d)
    for (int32_t phase = MSQ_PHASE_SOLID; phase <= MSQ_PHASE_VOID; ++phase) {
      msq_segments_def def = segments_of(lengths, count, phase, directions[d]);
      const double share = phase == MSQ_PHASE_SOLID ? 0.3 : 0.7;
      msq_estimate found[count];
      def.step = 1.0 / 64;
      assert_ok(msq_lineal_path(model, &sample, NULL, &def, found, count, NULL));
      for (int i = 0; i < count; ++i)
        assert_within(&found[i], share - slopes[d] * lengths[i], 2e-5);
    }
  msq_model_release(model);
  msq_context_release(context);
}

/* In a ball, which is convex, a segment lies in it where its ends do. Steps of the length of the
 * ball: the distance alone finds the boundary. */
static void a_ball_has_its_own(void** state) {
  const double centre[3] = {2, 2, 2};
  const double apart[count] = {0, 0.3, 0.8, 1.5, 2.1};
  msq_context* context = make_context();
  msq_shape* ball;
  (void)state;
  assert_ok(msq_shape_from_sphere(context, centre, 1, &ball));
  msq_model* model = make_shape_model(context, ball);
  const msq_points_def sample = sample_of(0, 4, 30, 2);
  msq_segments_def def = segments_of(apart, count, MSQ_PHASE_SOLID, NULL);
  msq_estimate found[count];
  assert_ok(msq_lineal_path(model, &sample, NULL, &def, found, count, NULL));
  for (int i = 0; i < count; ++i) {
    const double s = apart[i];
    const double shape = s < 2 ? 1 - 3 * s / 4 + s * s * s / 16 : 0;
    assert_within(&found[i], 4.0 / 3 * pi / 64 * shape, 1e-5);
  }
  msq_model_release(model);
  msq_context_release(context);
}

/* Between the walls of a lattice of thin struts a long segment meets one, however long the step,
 * if the distances are those of struts: never more than to the next one. */
static void struts_thinner_than_the_step_are_met(void** state) {
  const double along[3] = {1, 0, 0}, apart[1] = {3};
  msq_context* context = make_context();
  msq_lattice_def lattice;
  msq_structure* structure;
  (void)state;
  assert_ok(msq_lattice_def_init(&lattice, sizeof lattice));
  lattice.unit_cell = MSQ_UNIT_CELL_CUBIC;
  lattice.radius.value = 0.1;
  assert_ok(msq_structure_lattice(context, &lattice, &structure));
  msq_model* model = make_model(context, make_box_of(context, -20, 20), structure, NULL);
  const msq_points_def sample = sample_of(0, 1, 16, 8);
  msq_segments_def def = segments_of(apart, 1, MSQ_PHASE_VOID, along);
  def.step = 0.01;
  msq_estimate found;
  assert_ok(msq_lineal_path(model, &sample, NULL, &def, &found, 1, NULL));
  /* Of the y, z square of side 1: what is off struts of x, y and z. A line along x meets those of y
   * where z is within r of a whole number, and those of z likewise. */
  assert_within(&found, 0.8 * 0.8, 0.002);
  msq_model_release(model);
  msq_context_release(context);
}

static void threads_do_not_matter(void** state) {
  (void)state;
  check_threads(msq_lineal_path);
}

static void jobs_show_progress(void** state) {
  (void)state;
  check_segments_job(msq_lineal_path);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(plates_have_theirs),
      cmocka_unit_test(a_ball_has_its_own),
      cmocka_unit_test(struts_thinner_than_the_step_are_met),
      cmocka_unit_test(threads_do_not_matter),
      cmocka_unit_test(jobs_show_progress),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
