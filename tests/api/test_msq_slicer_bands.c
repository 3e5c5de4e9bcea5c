/* SPDX-License-Identifier: Apache-2.0
 * Layers in bands of rows, where a memory limit does not hold the samples of a whole layer: the
 * same bytes, in less memory. */
#include "layers.h"
#include "materials.h"

enum { WIDTH = 150, HEIGHT = 133, LAYERS = 3 };

/* Turned or not, about a side of the model, and no pitch is a power of two. */
static msq_slicer_def plan_def(int32_t output, uint32_t grey_samples, uint32_t orientation) {
  msq_slicer_def def;
  assert_ok(msq_slicer_def_init(&def, sizeof def));
  def.output = output;
  def.grey_samples = grey_samples;
  def.pitch[0] = def.pitch[1] = 0.031;
  def.resolution[0] = WIDTH;
  def.resolution[1] = HEIGHT;
  def.layer_height = 0.13;
  def.layer_count = LAYERS;
  def.has_region = 1;
  def.region_min[0] = -0.5;
  def.region_min[1] = 1;
  def.region_min[2] = 2.7;
  def.orientation = orientation;
  return def;
}

typedef struct taken {
  msq_slicer_report plan;
  uint8_t* data;
  uint64_t inside[LAYERS], count, peak;
} taken;

static int32_t take(void* user, const msq_layer* layer) {
  taken* all = (taken*)user;
  memcpy(all->data + layer->index * all->plan.layer_bytes, layer->data, all->plan.layer_bytes);
  all->inside[layer->index] = layer->inside_count;
  ++all->count;
  return 0;
}

/* By a run, or layer by layer. */
static msq_status slice(const msq_slicer_def* def, int is_run, uint64_t limit, taken* all) {
  msq_context* context = make_context_of(2, 0, limit);
  msq_model* model = make_material_model(context, 1, 1, 1);
  msq_slicer* slicer = make_slicer(model, def);
  msq_status status = MSQ_OK;
  memset(all, 0, sizeof *all);
  all->plan = plan_of(slicer);
  all->data = (uint8_t*)malloc(LAYERS * all->plan.layer_bytes);
  memset(all->data, struct_pattern, LAYERS * all->plan.layer_bytes);
  if (is_run) {
    status = msq_slicer_run(slicer, 0, UINT64_MAX, take, all, NULL);
  } else {
    for (; status == MSQ_OK && all->count < LAYERS; all->count += status == MSQ_OK)
      status = msq_slice_layer(slicer, all->count, all->data + all->count * all->plan.layer_bytes,
                               all->plan.layer_bytes, NULL);
  }
  all->peak = memory_of(context).peak_bytes;
  assert_int_equal(memory_of(context).bytes, 0);
  msq_slicer_release(slicer);
  msq_model_release(model);
  msq_context_release(context);
  return status;
}

/* Down to the least memory that holds a layer and a band. */
static void check_bands(const msq_slicer_def* def, int is_run, double least_part) {
  taken whole, banded;
  uint64_t least = UINT64_MAX;
  assert_ok(slice(def, is_run, 0, &whole));
  assert_int_equal(whole.count, LAYERS);
  for (uint64_t limit = whole.peak;; limit -= limit / 16) {
    const msq_status status = slice(def, is_run, limit, &banded);
    assert_in_range(banded.peak, 0, limit);
    if (status != MSQ_OK) {
      assert_refused(status, MSQ_E_LIMIT, "memory_limit");
      assert_message_has_number(limit);
      assert_int_equal(banded.count, 0);
      assert_filled(banded.data, LAYERS * banded.plan.layer_bytes, struct_pattern);
      free(banded.data);
      break;
    }
    least = limit;
    assert_int_equal(banded.count, LAYERS);
    assert_memory_equal(banded.data, whole.data, LAYERS * whole.plan.layer_bytes);
    assert_memory_equal(banded.inside, whole.inside, sizeof whole.inside);
    free(banded.data);
  }
  assert_true(least >= whole.plan.layer_bytes);
  assert_true((double)least <= least_part * (double)whole.peak);
  free(whole.data);
}

static void bands_have_the_bytes_of_the_layer(void** state) {
  const uint32_t flags[4] = {0, MSQ_LAYER_MIRROR_Y, MSQ_LAYER_MIRROR_X,
                             MSQ_LAYER_MIRROR_X | MSQ_LAYER_TRANSPOSE};
  (void)state;
  for (int i = 0; i < 4; ++i) {
    msq_slicer_def def = plan_def(MSQ_LAYER_GREY, 4, flags[i]);
    def.slab_layers = 1;
    check_bands(&def, 1, 0.7);
    check_bands(&def, 0, 0.8);
    def.output = MSQ_LAYER_BITS;
    check_bands(&def, 1, 0.8);
  }
  for (uint32_t samples = 2; samples <= 16; samples *= 2) {
    msq_slicer_def def = plan_def(MSQ_LAYER_GREY, samples, 0); /* slabs, then bands */
    check_bands(&def, 1, 0.7);
  }
}

/* Of these the rows before they are turned are in bands. */
static void values_are_turned_in_bands(void** state) {
  (void)state;
  for (uint32_t flags = MSQ_LAYER_MIRROR_X; flags <= MSQ_LAYER_TRANSPOSE; flags += 3) {
    const msq_slicer_def def = plan_def(MSQ_LAYER_DISTANCE, 4, flags);
    check_bands(&def, 1, 0.8);
    check_bands(&def, 0, 0.8);
  }
}

static msq_output_def output_def(int32_t output, uint32_t grey_samples) {
  msq_output_def def;
  assert_ok(msq_output_def_init(&def, sizeof def));
  def.output = output;
  def.grey_samples = grey_samples;
  return def;
}

/* Outputs of different samples go through the bands together. */
static void outputs_share_the_bands(void** state) {
  const msq_output_def outputs[3] = {output_def(MSQ_LAYER_GREY, 8), output_def(MSQ_LAYER_BITS, 4),
                                     output_def(MSQ_LAYER_MATERIAL, 4)};
  msq_slicer_def def = plan_def(MSQ_LAYER_BITS, 4, MSQ_LAYER_TRANSPOSE);
  (void)state;
  def.outputs = outputs;
  def.output_count = 3;
  check_bands(&def, 1, 0.8);
}

/* One thread takes bands that its caches hold, two whole layers. */
static void bands_of_one_thread_have_the_same_bytes(void** state) {
  const uint64_t samples = 4 * 1024 / 8 * 4 * 1400;
  taken by[2];
  (void)state;
  for (uint32_t threads = 1; threads <= 2; ++threads) {
    taken* all = &by[threads - 1];
    msq_slicer_def def = slicer_def(MSQ_LAYER_GREY, 1024, 1400, 0.25);
    msq_context* context = make_context_of(threads, 0, 0);
    msq_model* model = make_lattice_model(context);
    msq_slicer* slicer = make_slicer(model, &def);
    memset(all, 0, sizeof *all);
    all->plan = plan_of(slicer);
    all->data = (uint8_t*)malloc(LAYERS * all->plan.layer_bytes);
    assert_ok(msq_slicer_run(slicer, 0, LAYERS, take, all, NULL));
    all->peak = memory_of(context).peak_bytes;
    msq_slicer_release(slicer);
    msq_model_release(model);
    msq_context_release(context);
  }
  assert_memory_equal(by[0].data, by[1].data, LAYERS * by[1].plan.layer_bytes);
  assert_memory_equal(by[0].inside, by[1].inside, sizeof by[1].inside);
  assert_true(by[0].inside[0] > 0);
  assert_in_range(by[0].peak, by[0].plan.layer_bytes, 2 * samples - 1);
  for (int i = 0; i < 2; ++i) free(by[i].data);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(bands_have_the_bytes_of_the_layer),
      cmocka_unit_test(values_are_turned_in_bands),
      cmocka_unit_test(outputs_share_the_bands),
      cmocka_unit_test(bands_of_one_thread_have_the_same_bytes),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
