/* SPDX-License-Identifier: Apache-2.0
 * msq_layer_output beyond bits and bytes, and msq_layer_orientation: against finer layers, against
 * set queries, and pixel by pixel. */
#include "layers.h"
#include "materials.h"

enum { WIDTH = 40, HEIGHT = 23, LAYERS = 5 };

static msq_context* context;
static msq_model* model; /* with a material at each scale, from 0 to 4 */

static int set_up(void** state) {
  (void)state;
  context = make_context();
  model = make_material_model(context, 1, 1, 1);
  return 0;
}

static int tear_down(void** state) {
  (void)state;
  msq_model_release(model);
  msq_context_release(context);
  return 0;
}

/* Pixels of 1/8 about the middle of a side of the model: positions are exact. */
static msq_slicer_def plan_def(int32_t output) {
  msq_slicer_def def;
  assert_ok(msq_slicer_def_init(&def, sizeof def));
  def.output = output;
  def.pitch[0] = def.pitch[1] = 0.125;
  def.resolution[0] = WIDTH;
  def.resolution[1] = HEIGHT;
  def.layer_height = 0.25;
  def.layer_count = LAYERS;
  def.has_region = 1;
  def.region_min[0] = -0.5;
  def.region_min[1] = 2;
  def.region_min[2] = 1;
  return def;
}

static size_t pixel_bytes_of(int32_t output) {
  return output == MSQ_LAYER_DISTANCE || output == MSQ_LAYER_MATERIAL ? 4 : 1;
}

typedef struct taken {
  msq_slicer_report plan;
  uint8_t* data;
  uint64_t inside[LAYERS], count;
} taken;

static int32_t take(void* user, const msq_layer* layer) {
  taken* all = (taken*)user;
  memcpy(all->data + layer->index * all->plan.layer_bytes, layer->data, all->plan.layer_bytes);
  all->inside[layer->index] = layer->inside_count;
  ++all->count;
  return 0;
}

/* All layers by a run, which must be those that are computed one by one. */
static taken slice(const msq_slicer_def* def) {
  taken all;
  msq_slicer* slicer = make_slicer(model, def);
  uint8_t* one;
  memset(&all, 0, sizeof all);
  all.plan = plan_of(slicer);
  all.data = (uint8_t*)calloc(LAYERS, all.plan.layer_bytes);
  one = (uint8_t*)malloc(all.plan.layer_bytes);
  assert_true(all.data && one);
  assert_ok(msq_slicer_run(slicer, 0, UINT64_MAX, take, &all, NULL));
  assert_int_equal(all.count, all.plan.layer_count);
  for (uint64_t k = 0; k < all.count; ++k) {
    memset(one, 0xa5, all.plan.layer_bytes);
    assert_ok(msq_slice_layer(slicer, k, one, all.plan.layer_bytes, NULL));
    assert_memory_equal(one, all.data + k * all.plan.layer_bytes, all.plan.layer_bytes);
  }
  free(one);
  msq_slicer_release(slicer);
  return all;
}

static const uint8_t* row_of(const taken* all, uint64_t layer, uint64_t j) {
  return all->data + layer * all->plan.layer_bytes + j * all->plan.stride;
}

/* Rows of less than a vector of samples, and of several and a part. */
static void grey_counts_the_samples_of_a_pixel(void** state) {
  const uint32_t widths[2] = {WIDTH, 333};
  (void)state;
  for (uint32_t k = 2; k <= 16; k *= 2)
    for (int curve = 0; curve < 2; ++curve) {
      const uint32_t width = widths[curve];
      msq_slicer_def def = plan_def(MSQ_LAYER_GREY), fine = plan_def(MSQ_LAYER_BYTES);
      taken grey, samples;
      uint64_t between = 0;
      def.grey_samples = k;
      def.resolution[0] = fine.resolution[0] = width;
      if (width > WIDTH) def.pitch[0] = fine.pitch[0] = 0.125 / 8;
      def.grey_gamma = curve ? 2 : 1;
      def.grey_threshold = curve ? 30 : 0;
      for (int axis = 0; axis < 2; ++axis) {
        fine.pitch[axis] /= k;
        fine.resolution[axis] *= k;
      }
      grey = slice(&def);
      samples = slice(&fine);
      for (uint64_t layer = 0; layer < LAYERS; ++layer) {
        uint64_t inside = 0;
        for (uint64_t j = 0; j < HEIGHT; ++j) {
          for (uint64_t i = 0; i < width; ++i) {
            uint64_t n = 0;
            double part;
            int wanted;
            for (uint64_t b = 0; b < k; ++b)
              for (uint64_t a = 0; a < k; ++a)
                n += row_of(&samples, layer, j * k + b)[i * k + a] != 0;
            inside += n;
            between += n > 0 && n < (uint64_t)k * k;
            part = (double)n / (k * k);
            wanted = (int)floor(255 * (curve ? part * part : part) + 0.5);
            if (curve && wanted < 30) wanted = 0;
            assert_int_equal(row_of(&grey, layer, j)[i], wanted);
          }
          for (uint64_t i = width; i < grey.plan.stride; ++i)
            assert_int_equal(row_of(&grey, layer, j)[i], 0);
        }
        assert_int_equal(grey.inside[layer], inside);
      }
      assert_true(between > 100);
      free(grey.data);
      free(samples.data);
    }
}

static void values_are_those_of_set_queries(void** state) {
  msq_slicer_def def = plan_def(MSQ_LAYER_DISTANCE);
  const taken distances = slice(&def);
  taken materials, moduli;
  msq_output_def channel;
  static double wanted[WIDTH * HEIGHT], values[WIDTH * HEIGHT];
  static uint32_t ids[WIDTH * HEIGHT];
  uint64_t of[4] = {0};
  (void)state;
  def.output = MSQ_LAYER_MATERIAL;
  materials = slice(&def);
  assert_ok(msq_output_def_init(&channel, sizeof channel));
  channel.output = MSQ_LAYER_CHANNEL;
  channel.channel = material_channels[0];
  def.output = MSQ_LAYER_BITS;
  def.outputs = &channel;
  def.output_count = 1;
  moduli = slice(&def);
  for (uint64_t layer = 0; layer < LAYERS; ++layer) {
    msq_points_def points = grid_points(0, 1, 1);
    uint64_t inside = 0, solid = 0;
    points.counts[0] = WIDTH;
    points.counts[1] = HEIGHT;
    points.origin[0] = def.region_min[0] + 0.0625;
    points.origin[1] = def.region_min[1] + 0.0625;
    points.origin[2] = def.region_min[2] + 0.25 * (double)layer + 0.125;
    points.spacing[0] = points.spacing[1] = points.spacing[2] = 0.125;
    assert_ok(msq_set_distance(model, &points, NULL, wanted, WIDTH * HEIGHT, NULL));
    assert_ok(msq_set_material(model, &points, NULL, material_channels, 1, ids, WIDTH * HEIGHT,
                               values, WIDTH * HEIGHT, NULL));
    for (uint64_t j = 0; j < HEIGHT; ++j)
      for (uint64_t i = 0; i < WIDTH; ++i) {
        float distance, modulus;
        uint32_t id;
        memcpy(&distance, row_of(&distances, layer, j) + 4 * i, 4);
        memcpy(&id, row_of(&materials, layer, j) + 4 * i, 4);
        memcpy(&modulus, row_of(&moduli, layer, j) + 4 * i, 4);
        assert_true(modulus == (float)values[j * WIDTH + i]);
        assert_true(distance == (float)wanted[j * WIDTH + i]);
        assert_int_equal(id, ids[j * WIDTH + i]);
        inside += wanted[j * WIDTH + i] <= 0;
        solid += id != MSQ_MATERIAL_VOID;
        ++of[id];
      }
    assert_int_equal(distances.inside[layer], inside);
    assert_int_equal(materials.inside[layer], solid);
    assert_int_equal(moduli.inside[layer], solid);
  }
  assert_true(of[0] > 100 && of[2] > 100 && of[3] > 100);
  free(distances.data);
  free(materials.data);
  free(moduli.data);
}

static void pixel_of(const taken* all, int32_t output, uint64_t layer, uint64_t i, uint64_t j,
                     uint8_t pixel[4]) {
  const uint8_t* row = row_of(all, layer, j);
  const size_t bytes = pixel_bytes_of(output);
  memset(pixel, 0, 4);
  if (output == MSQ_LAYER_BITS)
    pixel[0] = row[i / 8] >> (7 - i % 8) & 1;
  else
    memcpy(pixel, row + i * bytes, bytes);
}

/* Outside a structure that has no distance, it is the least double above 0. */
static int32_t is_in_left_half(void* user, const msq_host_points* points, uint8_t* inside) {
  (void)user;
  for (uint64_t i = 0; i < points->count; ++i) inside[i] = points->points[3 * i] < 1;
  return 0;
}

static void distances_keep_the_sign_of_membership(void** state) {
  msq_host_structure_def host;
  msq_structure* structure;
  msq_slicer_def def = plan_def(MSQ_LAYER_DISTANCE);
  (void)state;
  assert_ok(msq_host_structure_def_init(&host, sizeof host));
  host.inside = is_in_left_half;
  assert_ok(msq_structure_host(context, &host, &structure));
  msq_model* half = make_model(context, make_box_of(context, -3, 8), structure, NULL);
  msq_slicer* slicer;
  assert_ok(msq_slicer_create(half, &def, &slicer));
  msq_slicer_report plan = {.struct_size = sizeof plan};
  assert_ok(msq_slicer_info(slicer, &plan));
  uint8_t* data = (uint8_t*)malloc(plan.layer_bytes);
  assert_ok(msq_slice_layer(slicer, 0, data, plan.layer_bytes, NULL));
  for (uint64_t i = 0; i < WIDTH; ++i) {
    float distance;
    memcpy(&distance, data + 4 * i, 4);
    assert_int_equal(distance <= 0, def.region_min[0] + 0.125 * ((double)i + 0.5) < 1);
  }
  free(data);
  msq_slicer_release(slicer);
  msq_model_release(half);
}

static void layers_are_turned_as_said(void** state) {
  (void)state;
  for (int32_t output = MSQ_LAYER_BITS; output <= MSQ_LAYER_MATERIAL; ++output) {
    msq_slicer_def def = plan_def(output);
    const taken plain = slice(&def);
    for (uint32_t flags = 1; flags < 8; ++flags) {
      taken turned;
      uint64_t w = WIDTH, h = HEIGHT;
      def.orientation = flags;
      turned = slice(&def);
      if (flags & MSQ_LAYER_TRANSPOSE) w = HEIGHT, h = WIDTH;
      assert_int_equal(turned.plan.width, w);
      assert_int_equal(turned.plan.height, h);
      assert_int_equal(turned.plan.layer_bytes, turned.plan.stride * h);
      for (uint64_t layer = 0; layer < LAYERS; ++layer) {
        assert_int_equal(turned.inside[layer], plain.inside[layer]);
        for (uint64_t j = 0; j < h; ++j)
          for (uint64_t i = 0; i < w; ++i) {
            uint64_t u = flags & MSQ_LAYER_MIRROR_X ? w - 1 - i : i;
            uint64_t v = flags & MSQ_LAYER_MIRROR_Y ? h - 1 - j : j;
            uint8_t got[4], wanted[4];
            if (flags & MSQ_LAYER_TRANSPOSE) {
              const uint64_t exchanged = u;
              u = v;
              v = exchanged;
            }
            pixel_of(&turned, output, layer, i, j, got);
            pixel_of(&plain, output, layer, u, v, wanted);
            assert_memory_equal(got, wanted, 4);
          }
      }
      free(turned.data);
    }
    free(plain.data);
  }
}

static void windows_are_cut_from_the_whole(void** state) {
  (void)state;
  for (int32_t output = MSQ_LAYER_GREY; output <= MSQ_LAYER_MATERIAL; ++output) {
    msq_slicer_def def = plan_def(output);
    taken whole, part;
    const msq_window window = {{7, 3, 2}, {21, 11, 2}};
    /* No pitch that is a power of two: positions are rounded. */
    def.pitch[0] = def.pitch[1] = 0.11;
    whole = slice(&def);
    def.window = window;
    part = slice(&def);
    for (uint64_t layer = 0; layer < 2; ++layer)
      for (uint64_t j = 0; j < 11; ++j)
        assert_memory_equal(row_of(&part, layer, j),
                            row_of(&whole, layer + 2, j + 3) + 7 * pixel_bytes_of(output),
                            21 * pixel_bytes_of(output));
    free(whole.data);
    free(part.data);
  }
}

static void cancelled_layers_leave_the_buffer(void** state) {
  (void)state;
  for (int32_t output = MSQ_LAYER_GREY; output <= MSQ_LAYER_MATERIAL; ++output) {
    const msq_slicer_def def = plan_def(output);
    msq_slicer* slicer = make_slicer(model, &def);
    const uint64_t bytes = plan_of(slicer).layer_bytes;
    uint8_t* buffer = (uint8_t*)malloc(bytes);
    msq_job* job;
    memset(buffer, 0xa5, bytes);
    assert_ok(msq_job_create(&job));
    assert_ok(msq_job_cancel(job));
    assert_refused(msq_slice_layer(slicer, 0, buffer, bytes, job), MSQ_E_CANCELLED, "cancelled");
    for (uint64_t i = 0; i < bytes; ++i) assert_int_equal(buffer[i], 0xa5);
    msq_job_release(job);
    free(buffer);
    msq_slicer_release(slicer);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(grey_counts_the_samples_of_a_pixel),
      cmocka_unit_test(values_are_those_of_set_queries),
      cmocka_unit_test(distances_keep_the_sign_of_membership),
      cmocka_unit_test(layers_are_turned_as_said),
      cmocka_unit_test(windows_are_cut_from_the_whole),
      cmocka_unit_test(cancelled_layers_leave_the_buffer),
  };
  return cmocka_run_group_tests_name("msq_layer_output", tests, set_up, tear_down);
}
