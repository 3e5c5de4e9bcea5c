/* SPDX-License-Identifier: Apache-2.0
 * msq_slicer_def.outputs, msq_output_def and msq_output: each output of a layer has the bytes that
 * it has alone, in any company and however the layers are split. */
#include "layers.h"
#include "materials.h"

enum { WIDTH = 37, HEIGHT = 22, LAYERS = 12, KINDS = 11 };

static msq_context* context;
static msq_model* model; /* with a material at each scale, from 0 to 4 */
static msq_contours_def fine_rings, coarse_rings;

static int set_up(void** state) {
  (void)state;
  context = make_context();
  model = make_material_model(context, 1, 1, 1);
  assert_ok(msq_contours_def_init(&fine_rings, sizeof fine_rings));
  fine_rings.tolerance = 0.02;
  coarse_rings = fine_rings;
  coarse_rings.type = MSQ_INT32;
  coarse_rings.units = 1e5;
  coarse_rings.tolerance = 0.05;
  coarse_rings.has_window = 1;
  coarse_rings.window_max[0] = coarse_rings.window_max[1] = 3;
  return 0;
}

static int tear_down(void** state) {
  (void)state;
  msq_model_release(model);
  msq_context_release(context);
  return 0;
}

/* Every kind of output, some of them twice with other options. */
static msq_output_def kind(int number) {
  static const int32_t outputs[KINDS] = {MSQ_LAYER_BITS,     MSQ_LAYER_BYTES,    MSQ_LAYER_GREY,
                                         MSQ_LAYER_GREY,     MSQ_LAYER_DISTANCE, MSQ_LAYER_MATERIAL,
                                         MSQ_LAYER_ONSET,    MSQ_LAYER_ONSET,    MSQ_LAYER_CONTOURS,
                                         MSQ_LAYER_CONTOURS, MSQ_LAYER_CHANNEL};
  msq_output_def def;
  assert_ok(msq_output_def_init(&def, sizeof def));
  def.output = outputs[number];
  if (number == 3) {
    def.grey_samples = 8;
    def.grey_gamma = 2;
    def.grey_threshold = 20;
  }
  if (number == 7) {
    def.onset_scale = 1;
    def.onset_value = MSQ_ONSET_SIGNED;
  }
  if (number == 8) def.contours = &fine_rings;
  if (number == 9) def.contours = &coarse_rings;
  if (number == 10) def.channel = "modulus";
  return def;
}

/* About the middle of a side of the model, partly beyond it. No pitch is a power of two. */
static msq_slicer_def plan_def(void) {
  msq_slicer_def def;
  assert_ok(msq_slicer_def_init(&def, sizeof def));
  def.pitch[0] = def.pitch[1] = 0.11;
  def.resolution[0] = WIDTH;
  def.resolution[1] = HEIGHT;
  def.layer_height = 0.13;
  def.layer_count = LAYERS;
  def.has_region = 1;
  def.region_min[0] = -0.5;
  def.region_min[1] = 2;
  def.region_min[2] = 2.7;
  return def;
}

/* What a layer has of one output: bytes, and what describes them. */
typedef struct kept {
  uint8_t* bytes;
  uint64_t count, inside;
} kept;

static void keep(kept* to, const void* bytes, uint64_t count) {
  if (count == 0) return;
  to->bytes = (uint8_t*)realloc(to->bytes, to->count + count);
  memcpy(to->bytes + to->count, bytes, count);
  to->count += count;
}

static void keep_contours(kept* to, const msq_contours* contours) {
  msq_contours_report report;
  memset(&report, 0, sizeof report);
  report.struct_size = sizeof report;
  if (msq_contours_info(contours, &report) != MSQ_OK) return;
  keep(to, report.points,
       report.point_count * 2 * (report.type == MSQ_INT32 ? sizeof(int32_t) : sizeof(double)));
  keep(to, report.starts, (report.ring_count + 1) * sizeof report.starts[0]);
  keep(to, report.parents, report.ring_count * sizeof report.parents[0]);
  keep(to, report.holes, report.ring_count);
  keep(to, &report.unresolved_count, sizeof report.unresolved_count);
  keep(to, &report.pitch, sizeof report.pitch);
}

/* All layers of a run. take() asserts nothing, as it runs inside msq. */
typedef struct stack {
  uint64_t first, taken, stop_at;
  int32_t stop_code;
  const char* wrong;
  uint64_t output_count;
  kept kept[LAYERS][KINDS];
  msq_contours* rings[LAYERS]; /* of the first output that has some, retained */
} stack;

static const char* output_fault(const msq_layer* layer, const msq_output* output) {
  const int is_rings = output->output == MSQ_LAYER_CONTOURS;
  if (output->struct_size != sizeof *output) return "struct_size of an output";
  if (is_rings != (output->contours != NULL)) return "contours";
  if (is_rings != (output->data == NULL)) return "data";
  if (is_rings && (output->stride || output->inside_count)) return "stride of contours";
  if (output != layer->outputs[0]) return NULL;
  if (layer->output != output->output || layer->data != output->data ||
      layer->stride != output->stride || layer->inside_count != output->inside_count)
    return "first output";
  return NULL;
}

static int32_t take(void* user, const msq_layer* layer) {
  stack* all = (stack*)user;
  const uint64_t k = layer->index;
  if (layer->struct_size != sizeof *layer) all->wrong = "struct_size";
  if (k != all->first + all->taken) all->wrong = "index";
  if (layer->output_count != all->output_count) all->wrong = "output_count";
  if (all->wrong) return -1;
  ++all->taken;
  for (uint64_t i = 0; i < layer->output_count; ++i) {
    const msq_output* output = layer->outputs[i];
    kept* to = &all->kept[k][i];
    const char* wrong = output_fault(layer, output);
    if (wrong) all->wrong = wrong;
    to->inside = output->inside_count;
    if (output->data) keep(to, output->data, output->stride * layer->height);
    if (!output->contours) continue;
    keep_contours(to, output->contours);
    if (all->rings[k]) continue;
    msq_contours_retain(output->contours);
    all->rings[k] = output->contours;
  }
  return all->stop_code && k == all->stop_at ? all->stop_code : 0;
}

static void free_kept(stack* all) {
  for (int k = 0; k < LAYERS; ++k) {
    for (int i = 0; i < KINDS; ++i) free(all->kept[k][i].bytes);
    msq_contours_release(all->rings[k]);
  }
}

/* A slicer of some of the kinds, in this order. */
static msq_slicer* slicer_of(const msq_model* of, msq_slicer_def def, const int* kinds, int count) {
  msq_output_def outputs[KINDS];
  for (int i = 0; i < count; ++i) outputs[i] = kind(kinds[i]);
  def.outputs = outputs;
  def.output_count = (uint32_t)count;
  return make_slicer(of, &def);
}

static stack run_layers(const msq_slicer* slicer, int count, uint64_t first, uint64_t layers) {
  stack all;
  memset(&all, 0, sizeof all);
  all.output_count = (uint64_t)count;
  all.first = first;
  assert_ok(msq_slicer_run(slicer, first, layers, take, &all, NULL));
  if (all.wrong) fail_msg("a layer's %s", all.wrong);
  assert_int_equal(all.taken, layers == UINT64_MAX ? plan_of(slicer).layer_count : layers);
  return all;
}

static void assert_same(const kept* got, const kept* wanted) {
  assert_int_equal(got->count, wanted->count);
  assert_memory_equal(got->bytes, wanted->bytes, wanted->count);
  assert_int_equal(got->inside, wanted->inside);
}

static const int every_kind[KINDS] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10};

/* One output by the calls for single layers. */
static kept single(const msq_slicer_def* plan, int number, uint64_t k) {
  const msq_output_def output = kind(number);
  msq_slicer_def def = *plan;
  kept made;
  memset(&made, 0, sizeof made);
  if (output.contours) {
    msq_slicer* slicer = make_slicer(model, &def);
    msq_contours* contours;
    assert_ok(msq_slicer_contours(slicer, k, output.contours, &contours, NULL));
    keep_contours(&made, contours);
    msq_contours_release(contours);
    msq_slicer_release(slicer);
    return made;
  }
  def.output = output.output;
  def.grey_samples = output.grey_samples;
  def.grey_gamma = output.grey_gamma;
  def.grey_threshold = output.grey_threshold;
  const int is_of_outputs = number == 7 || number == 10;
  msq_slicer* slicer =
      is_of_outputs ? slicer_of(model, *plan, &number, 1) : make_slicer(model, &def);
  made.count = plan_of(slicer).layer_bytes;
  made.bytes = (uint8_t*)malloc(made.count);
  assert_ok(msq_slice_layer(slicer, k, made.bytes, made.count, NULL));
  msq_slicer_release(slicer);
  return made;
}

static void outputs_are_those_of_single_calls(void** state) {
  const double heights[LAYERS] = {0.1, 0.11, 0.5, 0.9, 1, 1.7, 2, 2.25, 3.9, 3.99, 4, 4.5};
  (void)state;
  for (int variant = 0; variant < 3; ++variant) {
    msq_slicer_def def = plan_def();
    if (variant == 1) {
      def.layer_z = heights;
      def.layer_z_count = LAYERS;
      def.orientation = MSQ_LAYER_TRANSPOSE | MSQ_LAYER_MIRROR_X;
    }
    if (variant == 2) {
      const msq_window window = {{5, 3, 2}, {21, 11, 7}};
      def.window = window;
    }
    msq_slicer* slicer = slicer_of(model, def, every_kind, KINDS);
    stack all = run_layers(slicer, KINDS, 0, UINT64_MAX);
    assert_true(all.kept[5][8].count > 200 && all.kept[5][0].inside > 0);
    for (uint64_t k = 0; k < all.taken; ++k)
      for (int i = 0; i < KINDS; ++i) {
        kept wanted = single(&def, i, k);
        wanted.inside = all.kept[k][i].inside; /* single calls do not count */
        assert_same(&all.kept[k][i], &wanted);
        free(wanted.bytes);
      }
    msq_slicer_release(slicer);
    free_kept(&all);
  }
}

/* Any of them, in any order, more than once. */
static void bytes_do_not_depend_on_the_company(void** state) {
  uint64_t random = 1;
  msq_slicer* slicer = slicer_of(model, plan_def(), every_kind, KINDS);
  stack wanted = run_layers(slicer, KINDS, 0, UINT64_MAX);
  (void)state;
  msq_slicer_release(slicer);
  for (int n = 0; n < 12; ++n) {
    int kinds[KINDS];
    const int count = n < 2 ? 1 : 1 + (int)random_between(&random, 0, 5);
    for (int i = 0; i < count; ++i)
      kinds[i] = n == 0 ? 8 : n == 1 ? 7 : (int)random_between(&random, 0, KINDS);
    slicer = slicer_of(model, plan_def(), kinds, count);
    stack all = run_layers(slicer, count, 0, UINT64_MAX);
    for (uint64_t k = 0; k < LAYERS; ++k)
      for (int i = 0; i < count; ++i) assert_same(&all.kept[k][i], &wanted.kept[k][kinds[i]]);
    free_kept(&all);
    msq_slicer_release(slicer);
  }
  free_kept(&wanted);
}

static void bytes_do_not_depend_on_the_split(void** state) {
  static const uint64_t cuts[4][5] = {
      {0, 1, 2, 11, 12}, {0, 5, 5, 6, 12}, {0, 3, 6, 9, 12}, {0, 0, 1, 7, 12}};
  msq_slicer_def def = plan_def();
  msq_slicer* slicer = slicer_of(model, def, every_kind, KINDS);
  stack wanted = run_layers(slicer, KINDS, 0, UINT64_MAX);
  (void)state;
  msq_slicer_release(slicer);
  for (int n = 0; n < 4; ++n) {
    msq_context* other = make_context_of(1 + (uint32_t)n % 2, n < 2 ? 0 : (uint64_t)1 << 28, 0);
    msq_model* same = make_material_model(other, 1, 1, 1);
    def.slab_layers = (uint32_t)n + 1;
    slicer = slicer_of(same, def, every_kind, KINDS);
    for (int part = 0; part < 4; ++part) {
      stack all = run_layers(slicer, KINDS, cuts[n][part], cuts[n][part + 1] - cuts[n][part]);
      for (uint64_t k = cuts[n][part]; k < cuts[n][part + 1]; ++k)
        for (int i = 0; i < KINDS; ++i) assert_same(&all.kept[k][i], &wanted.kept[k][i]);
      free_kept(&all);
    }
    msq_slicer_release(slicer);
    msq_model_release(same);
    msq_context_release(other);
  }
  free_kept(&wanted);
}

static void onsets_are_those_of_set_queries(void** state) {
  static double wanted[2][WIDTH * HEIGHT];
  const int kinds[2] = {6, 7};
  const msq_slicer_def def = plan_def();
  msq_structure* lattice = make_lattice(context);
  msq_slicer* slicer = slicer_of(model, def, kinds, 2);
  const msq_slicer_report plan = plan_of(slicer);
  stack all = run_layers(slicer, 2, 0, UINT64_MAX);
  int is_inside = 0;
  (void)state;
  for (uint64_t k = 0; k < LAYERS; k += 5) {
    msq_points_def points = grid_points(0, 1, 2);
    points.counts[0] = WIDTH;
    points.counts[1] = HEIGHT;
    points.counts[2] = 1;
    for (int axis = 0; axis < 2; ++axis) {
      points.origin[axis] = plan.origin[axis];
      points.spacing[axis] = plan.pitch[axis];
    }
    assert_ok(msq_slicer_layer_z(slicer, k, &points.origin[2]));
    for (int value = 0; value < 2; ++value)
      assert_ok(msq_set_onset(context, lattice, &points, value, wanted[value], WIDTH * HEIGHT, NULL,
                              0, NULL));
    for (int value = 0; value < 2; ++value)
      for (uint64_t n = 0; n < WIDTH * HEIGHT; ++n) {
        float onset;
        memcpy(&onset,
               all.kept[k][value].bytes + n / WIDTH * plan.stride + n % WIDTH * sizeof onset,
               sizeof onset);
        assert_true(onset == (float)wanted[value][n]);
        is_inside |= onset < 0;
      }
  }
  assert_true(is_inside);
  free_kept(&all);
  msq_slicer_release(slicer);
  msq_structure_release(lattice);
}

static void retained_contours_outlive_the_run(void** state) {
  const int kinds[2] = {0, 8};
  msq_slicer* slicer = slicer_of(model, plan_def(), kinds, 2);
  stack all = run_layers(slicer, 2, 0, UINT64_MAX);
  (void)state;
  msq_slicer_release(slicer);
  for (int k = 0; k < LAYERS; ++k) {
    kept again;
    memset(&again, 0, sizeof again);
    assert_non_null(all.rings[k]);
    keep_contours(&again, all.rings[k]);
    assert_same(&again, &all.kept[k][1]);
    free(again.bytes);
  }
  free_kept(&all);
}

static void the_host_stops_and_cancels(void** state) {
  msq_slicer* slicer = slicer_of(model, plan_def(), every_kind, KINDS);
  msq_job* job;
  stack all;
  (void)state;
  memset(&all, 0, sizeof all);
  all.output_count = KINDS;
  all.stop_at = 4;
  all.stop_code = -9;
  assert_status(msq_slicer_run(slicer, 0, UINT64_MAX, take, &all, NULL), MSQ_E_HOST);
  assert_int_equal(msq_error_host_code(), -9);
  assert_int_equal(all.taken, 5);
  assert_null(all.wrong);
  assert_ok(msq_job_create(&job));
  assert_ok(msq_slicer_run(slicer, 5, 2, take,
                           (all.first = 5, all.taken = 0, all.stop_code = 0, &all), job));
  assert_near(progress_of(job), 1, 0);
  assert_ok(msq_job_cancel(job));
  assert_refused(msq_slicer_run(slicer, 0, UINT64_MAX, take, &all, job), MSQ_E_CANCELLED,
                 "cancelled");
  assert_int_equal(memory_of(context).bytes, 0);
  msq_job_release(job);
  msq_slicer_release(slicer);
  free_kept(&all);
}

/* Bytes at the peak of a run, or of the contours of single layers, in a context of its own. */
static uint64_t peak_of(int kind_alone, int is_run) {
  msq_context* own = make_context_of(2, 0, 0);
  msq_model* same = make_material_model(own, 1, 1, 1);
  msq_slicer* slicer = slicer_of(same, plan_def(), &kind_alone, 1);
  uint64_t peak;
  if (is_run) {
    stack all = run_layers(slicer, 1, 0, UINT64_MAX);
    free_kept(&all);
  }
  for (uint64_t k = 0; k < LAYERS && !is_run; ++k) {
    msq_contours* contours;
    assert_ok(msq_slicer_contours(slicer, k, &fine_rings, &contours, NULL));
    msq_contours_release(contours);
  }
  peak = memory_of(own).peak_bytes;
  msq_slicer_release(slicer);
  msq_model_release(same);
  msq_context_release(own);
  return peak;
}

/* Where a limit holds the slabs and the contours of one layer, it holds the run, though less is
 * computed ahead; and not where it is smaller. */
static void a_limit_that_holds_a_layer_holds_all(void** state) {
  const int kinds[2] = {0, 8};
  msq_slicer* slicer = slicer_of(model, plan_def(), kinds, 2);
  stack wanted = run_layers(slicer, 2, 0, UINT64_MAX);
  const uint64_t least = peak_of(0, 1) + peak_of(8, 0);
  (void)state;
  msq_slicer_release(slicer);
  for (int n = 0; n < 6; ++n) {
    const uint64_t limit = n == 5 ? least - 1 : least + least * (uint64_t)n / 3;
    msq_context* tight = make_context_of(2, 0, limit);
    msq_model* same = make_material_model(tight, 1, 1, 1);
    stack all;
    slicer = slicer_of(same, plan_def(), kinds, 2);
    memset(&all, 0, sizeof all);
    all.output_count = 2;
    if (n == 5)
      assert_refused(msq_slicer_run(slicer, 0, UINT64_MAX, take, &all, NULL), MSQ_E_LIMIT,
                     "memory_limit");
    else
      assert_ok(msq_slicer_run(slicer, 0, UINT64_MAX, take, &all, NULL));
    assert_true(n == 5 ? all.taken < LAYERS : all.taken == LAYERS);
    for (uint64_t k = 0; k < all.taken; ++k)
      for (int i = 0; i < 2; ++i) assert_same(&all.kept[k][i], &wanted.kept[k][i]);
    assert_true(memory_of(tight).peak_bytes <= limit);
    assert_int_equal(memory_of(tight).bytes, 0);
    free_kept(&all);
    msq_slicer_release(slicer);
    msq_model_release(same);
    msq_context_release(tight);
  }
  free_kept(&wanted);
}

/* The definitions are copied, and elements may be larger than this version's. */
static void definitions_are_copied(void** state) {
  struct {
    msq_output_def def;
    uint64_t newer;
  } outputs[2];
  const int kinds[2] = {4, 8};
  msq_contours_def rings = fine_rings;
  msq_slicer_def def = plan_def();
  msq_slicer* slicer = slicer_of(model, def, kinds, 2);
  stack wanted = run_layers(slicer, 2, 0, 3);
  (void)state;
  msq_slicer_release(slicer);
  memset(outputs, 0, sizeof outputs);
  for (int i = 0; i < 2; ++i) {
    outputs[i].def = kind(kinds[i]);
    outputs[i].def.struct_size = sizeof outputs[i];
  }
  outputs[1].def.contours = &rings;
  def.outputs = &outputs[0].def;
  def.output_count = 2;
  slicer = make_slicer(model, &def);
  memset(outputs, 0xa5, sizeof outputs);
  memset(&rings, 0xa5, sizeof rings);
  stack all = run_layers(slicer, 2, 0, 3);
  for (uint64_t k = 0; k < 3; ++k)
    for (int i = 0; i < 2; ++i) assert_same(&all.kept[k][i], &wanted.kept[k][i]);
  free_kept(&all);
  free_kept(&wanted);
  msq_slicer_release(slicer);
}

static void defaults_are_as_said(void** state) {
  msq_output_def def;
  (void)state;
  assert_ok(msq_output_def_init(&def, sizeof def));
  assert_int_equal(def.struct_size, sizeof def);
  assert_int_equal(def.output, MSQ_LAYER_BITS);
  assert_int_equal(def.grey_samples, 4);
  assert_int_equal(def.grey_threshold, 0);
  assert_true(def.grey_gamma == 1);
  assert_int_equal(def.onset_scale, 0);
  assert_int_equal(def.onset_value, MSQ_ONSET_PLAIN);
  assert_null(def.contours);
}

/* Elements as large as they were before CHANNEL. */
static void definitions_may_be_older(void** state) {
  enum { first_size = offsetof(msq_output_def, channel) };
  const int kinds[2] = {4, 8};
  msq_output_def older[3];
  msq_slicer_def def = plan_def();
  msq_slicer* slicer = slicer_of(model, def, kinds, 2);
  stack wanted = run_layers(slicer, 2, 0, 3);
  (void)state;
  msq_slicer_release(slicer);
  memset(older, 0xa5, sizeof older);
  for (int i = 0; i < 2; ++i) {
    msq_output_def output = kind(kinds[i]);
    output.struct_size = first_size;
    memcpy((char*)older + i * first_size, &output, first_size);
  }
  def.outputs = older;
  def.output_count = 2;
  slicer = make_slicer(model, &def);
  stack all = run_layers(slicer, 2, 0, 3);
  for (uint64_t k = 0; k < 3; ++k)
    for (int i = 0; i < 2; ++i) assert_same(&all.kept[k][i], &wanted.kept[k][i]);
  free_kept(&all);
  free_kept(&wanted);
  msq_slicer_release(slicer);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(outputs_are_those_of_single_calls),
      cmocka_unit_test(bytes_do_not_depend_on_the_company),
      cmocka_unit_test(bytes_do_not_depend_on_the_split),
      cmocka_unit_test(onsets_are_those_of_set_queries),
      cmocka_unit_test(retained_contours_outlive_the_run),
      cmocka_unit_test(the_host_stops_and_cancels),
      cmocka_unit_test(a_limit_that_holds_a_layer_holds_all),
      cmocka_unit_test(definitions_are_copied),
      cmocka_unit_test(definitions_may_be_older),
      cmocka_unit_test(defaults_are_as_said),
  };
  return cmocka_run_group_tests_name("msq_output", tests, set_up, tear_down);
}
