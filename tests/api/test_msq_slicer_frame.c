/* SPDX-License-Identifier: Apache-2.0
 * msq_slicer_def.frame_origin and frame_axes: samples are where the header says, on every output,
 * and their bytes do not depend on the split. */
#include "layers.h"
#include "materials.h"

enum { WIDTH = 45, HEIGHT = 34, LAYERS = 9, FRAMES = 7, MODELS = 4, OUTPUTS = 5 };

static msq_context* context;
static msq_model* models[MODELS];

typedef struct frame {
  const char* name;
  double origin[3], axes[9];
} frame;

/* Axes of the model in another order, mirrored, and turned. */
static const frame frames[FRAMES] = {
    {"layers normal to x", {0, 0, 0}, {0, 1, 0, 0, 0, 1, 1, 0, 0}},
    {"layers normal to y", {0, 0, 0}, {1, 0, 0, 0, 0, 1, 0, 1, 0}},
    {"x and y exchanged", {0, 0, 0}, {0, 1, 0, 1, 0, 0, 0, 0, 1}},
    {"all axes exchanged", {0, 0, 0}, {0, 0, 1, 0, 1, 0, 1, 0, 0}},
    {"axes of the model, moved", {0.3, -0.7, 1.1}, {0, 0, 0, 0, 0, 0, 0, 0, 0}},
    {"upside down", {4, 0, 4}, {-1, 0, 0, 0, 1, 0, 0, 0, -1}},
    {"turned", {1, 2, 0.5}, {0.48, 0.64, -0.6, -0.8, 0.6, 0, 0.36, 0.48, 0.8}}};

/* Frames whose contours are those of msq_layer_contours with this axis; -1: none. */
static const int contour_axes[FRAMES] = {0, 1, -1, -1, -1, -1, -1};

static msq_model* make_regions(void) {
  msq_model* parts[2] = {
      make_model(context, make_box_of(context, 1, 3), make_foam(context, 0), NULL),
      make_model(context, make_cube_mesh(context), make_lattice(context), NULL)};
  const msq_model* const of[2] = {parts[0], parts[1]};
  msq_model* model;
  assert_ok(msq_model_regions(context, of, 2, &model));
  for (int i = 0; i < 2; ++i) msq_model_release(parts[i]);
  return model;
}

/* A skin whose thickness is a field, about a gyroid. */
static msq_model* make_skinned(void) {
  const double from[3] = {0, 0, 0}, to[3] = {4, 2, 1};
  msq_functional_def def;
  msq_structure* gyroid;
  msq_field* field;
  msq_model_def model_def;
  msq_model* model;
  msq_shape* shape = make_cube_mesh(context);
  assert_ok(msq_functional_def_init(&def, sizeof def));
  def.function = MSQ_FUNCTION_GYROID;
  def.grid.cell_size[0] = def.grid.cell_size[1] = def.grid.cell_size[2] = 1.5;
  assert_ok(msq_structure_functional(context, &def, &gyroid));
  assert_ok(msq_field_gradient(context, from, 0.05, to, 0.5, &field));
  msq_scale_def scales[2] = {{.shape = shape}, {.structure = gyroid, .skin = {0, field}}};
  assert_ok(msq_model_def_init(&model_def, sizeof model_def));
  model_def.scales = scales;
  model_def.scale_count = 2;
  model_def.scale_size = sizeof scales[0];
  assert_ok(msq_model_create(context, &model_def, &model));
  msq_field_release(field);
  msq_structure_release(gyroid);
  msq_shape_release(shape);
  return model;
}

static int set_up(void** state) {
  (void)state;
  context = make_context();
  models[0] = make_material_model(context, 1, 1, 1);
  models[1] = make_foam_model(context, 0);
  models[2] = make_regions();
  models[3] = make_skinned();
  return 0;
}

static int tear_down(void** state) {
  (void)state;
  for (int m = 0; m < MODELS; ++m) msq_model_release(models[m]);
  msq_context_release(context);
  return 0;
}

static msq_slicer_def plan_def(const frame* in) {
  msq_slicer_def def;
  assert_ok(msq_slicer_def_init(&def, sizeof def));
  def.pitch[0] = 0.11;
  def.pitch[1] = 0.13;
  def.resolution[0] = WIDTH;
  def.resolution[1] = HEIGHT;
  def.layer_height = 0.17;
  def.layer_count = LAYERS;
  def.has_region = 1;
  def.region_min[0] = def.region_min[1] = -0.4;
  def.region_min[2] = 0.3;
  memcpy(def.frame_origin, in->origin, sizeof in->origin);
  memcpy(def.frame_axes, in->axes, sizeof in->axes);
  return def;
}

/* In the order of operations of the header. */
static void to_model(const frame* in, double u, double v, double w, double point[3]) {
  static const double model_axes[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  const double* m = in->axes;
  int is_given = 0;
  for (int i = 0; i < 9; ++i) is_given |= m[i] != 0;
  if (!is_given) m = model_axes;
  for (int i = 0; i < 3; ++i) point[i] = in->origin[i] + ((m[i] * u + m[3 + i] * v) + m[6 + i] * w);
}

/* Layers of bytes, distances, materials or onsets, and bits. */
typedef struct stack {
  uint64_t count, bytes[OUTPUTS], inside[LAYERS][OUTPUTS];
  double z[LAYERS];
  uint8_t* data[LAYERS][OUTPUTS];
} stack;

static int32_t take(void* user, const msq_layer* layer) {
  stack* all = (stack*)user;
  const uint64_t k = layer->index;
  all->z[k] = layer->z;
  ++all->count;
  for (uint64_t i = 0; i < layer->output_count; ++i) {
    const msq_output* output = layer->outputs[i];
    if (!output->data) continue;
    all->bytes[i] = output->stride * layer->height;
    all->inside[k][i] = output->inside_count;
    all->data[k][i] = (uint8_t*)realloc(all->data[k][i], all->bytes[i]);
    memcpy(all->data[k][i], output->data, all->bytes[i]);
  }
  return 0;
}

static void free_stack_of(stack* all) {
  for (int k = 0; k < LAYERS; ++k)
    for (int i = 0; i < OUTPUTS; ++i) free(all->data[k][i]);
}

/* bytes, distances, bits, grey, and materials (the first model only) */
static msq_slicer* slicer_of(int m, msq_slicer_def def) {
  static const int32_t kinds[OUTPUTS] = {MSQ_LAYER_BYTES, MSQ_LAYER_DISTANCE, MSQ_LAYER_BITS,
                                         MSQ_LAYER_GREY, MSQ_LAYER_MATERIAL};
  msq_output_def outputs[OUTPUTS];
  for (int i = 0; i < OUTPUTS; ++i) {
    assert_ok(msq_output_def_init(&outputs[i], sizeof outputs[i]));
    outputs[i].output = kinds[i];
    outputs[i].grey_samples = 2;
  }
  def.outputs = outputs;
  def.output_count = m == 0 ? OUTPUTS : OUTPUTS - 1;
  return make_slicer(models[m], &def);
}

static void check_layer(int m, const frame* in, const msq_slicer_report* plan, const stack* all,
                        uint64_t k) {
  uint64_t inside = 0;
  for (uint32_t j = 0; j < plan->height; ++j)
    for (uint32_t i = 0; i < plan->width; ++i) {
      const uint64_t stride = plan->stride; /* of bytes */
      const uint64_t floats = ((uint64_t)plan->width * 4 + 7) / 8 * 8;
      double point[3], distance;
      float got;
      int32_t is_in;
      to_model(in, plan->origin[0] + (double)(plan->window.first[0] + i) * plan->pitch[0],
               plan->origin[1] + (double)(plan->window.first[1] + j) * plan->pitch[1], all->z[k],
               point);
      assert_ok(msq_point_membership(models[m], point, NULL, &is_in));
      if (all->data[k][0][j * stride + i] != (is_in ? 255 : 0))
        fail_msg("%s, model %d: pixel %u, %u of layer %d", in->name, m, i, j, (int)k);
      inside += (uint64_t)is_in;
      if ((i + j) % 5) continue;
      assert_ok(msq_point_distance(models[m], point, NULL, &distance));
      memcpy(&got, all->data[k][1] + j * floats + 4 * i, 4);
      assert_true(got == (float)distance);
      if (m == 0) {
        uint32_t id, wanted;
        memcpy(&id, all->data[k][4] + j * floats + 4 * i, 4);
        assert_ok(msq_point_material(models[m], point, NULL, NULL, 0, &wanted, NULL));
        assert_int_equal(id, wanted);
      }
    }
  assert_int_equal(all->inside[k][0], inside);
  assert_int_equal(all->inside[k][2], inside);
  assert_true(all->inside[k][3] > 0);
}

static void samples_are_where_the_frame_says(void** state) {
  (void)state;
  for (int m = 0; m < MODELS; ++m)
    for (int f = 0; f < FRAMES; ++f) {
      msq_slicer* slicer = slicer_of(m, plan_def(&frames[f]));
      const msq_slicer_report plan = plan_of(slicer);
      stack all;
      memset(&all, 0, sizeof all);
      assert_ok(msq_slicer_run(slicer, 0, UINT64_MAX, take, &all, NULL));
      assert_int_equal(all.count, LAYERS);
      for (uint64_t k = (uint64_t)(m + f) % 3; k < LAYERS; k += 3)
        check_layer(m, &frames[f], &plan, &all, k);
      free_stack_of(&all);
      msq_slicer_release(slicer);
    }
}

static void the_split_changes_nothing(void** state) {
  const double heights[LAYERS] = {0.31, 0.32, 0.5, 0.9, 1.3, 1.31, 2, 2.5, 3.1};
  const msq_window window = {{5, 3, 2}, {33, 17, 6}};
  (void)state;
  for (int m = 0; m < MODELS; ++m)
    for (int f = 0; f < FRAMES; f += m % 2 + 1) {
      msq_slicer_def def = plan_def(&frames[f]);
      def.layer_z = heights;
      def.layer_z_count = LAYERS;
      msq_slicer* slicer = slicer_of(m, def);
      stack whole, split, part;
      memset(&whole, 0, sizeof whole);
      memset(&split, 0, sizeof split);
      memset(&part, 0, sizeof part);
      assert_ok(msq_slicer_run(slicer, 0, UINT64_MAX, take, &whole, NULL));
      check_layer(m, &frames[f], (const msq_slicer_report[]){plan_of(slicer)}, &whole, 4);
      msq_slicer_release(slicer);
      def.slab_layers = 2;
      slicer = slicer_of(m, def);
      assert_ok(msq_slicer_run(slicer, 3, 6, take, &split, NULL));
      for (uint64_t k = 0; k < 3; ++k) assert_ok(msq_slicer_run(slicer, k, 1, take, &split, NULL));
      for (int k = 0; k < LAYERS; ++k)
        for (int i = 0; i < 4; ++i)
          assert_memory_equal(split.data[k][i], whole.data[k][i], whole.bytes[i]);
      msq_slicer_release(slicer);
      def.window = window;
      slicer = slicer_of(m, def);
      assert_ok(msq_slicer_run(slicer, 0, UINT64_MAX, take, &part, NULL));
      assert_int_equal(part.count, 6);
      for (int k = 0; k < 6; ++k)
        for (int j = 0; j < 17; ++j) {
          assert_memory_equal(part.data[k][0] + j * 40, whole.data[k + 2][0] + (j + 3) * 48 + 5,
                              33);
          assert_memory_equal(part.data[k][1] + j * 136,
                              whole.data[k + 2][1] + (j + 3) * 184 + 5 * 4, 33 * 4);
        }
      msq_slicer_release(slicer);
      free_stack_of(&whole);
      free_stack_of(&split);
      free_stack_of(&part);
    }
}

static msq_contours_report contents_of(const msq_contours* contours) {
  msq_contours_report report;
  memset(&report, 0, sizeof report);
  report.struct_size = sizeof report;
  assert_ok(msq_contours_info(contours, &report));
  return report;
}

/* Rings lie on the boundary, enclose the pixels' area, and are those of the plane normal to an
 * axis where there is one. */
static void contours_lie_in_the_frame(void** state) {
  (void)state;
  for (int f = 0; f < FRAMES; ++f) {
    msq_slicer_def def = plan_def(&frames[f]);
    msq_contours_def rings;
    msq_contours *contours, *of_axis;
    double w, area = 0;
    stack all;
    assert_ok(msq_contours_def_init(&rings, sizeof rings));
    rings.tolerance = 0.02;
    msq_slicer* slicer = slicer_of(0, def);
    const msq_slicer_report plan = plan_of(slicer);
    memset(&all, 0, sizeof all);
    assert_ok(msq_slicer_run(slicer, 4, 1, take, &all, NULL));
    assert_ok(msq_slicer_contours(slicer, 4, &rings, &contours, NULL));
    assert_ok(msq_slicer_layer_z(slicer, 4, &w));
    const msq_contours_report report = contents_of(contours);
    const double* points = (const double*)report.points;
    assert_true(report.ring_count > 0);
    for (uint64_t r = 0; r < report.ring_count; ++r)
      for (uint64_t i = report.starts[r]; i < report.starts[r + 1]; ++i) {
        const uint64_t n = i + 1 < report.starts[r + 1] ? i + 1 : report.starts[r];
        double point[3], distance;
        area += 0.5 * (points[2 * i] * points[2 * n + 1] - points[2 * n] * points[2 * i + 1]);
        to_model(&frames[f], points[2 * i], points[2 * i + 1], w, point);
        assert_ok(msq_point_distance(models[0], point, NULL, &distance));
        /* Rings close along the window. */
        const double high[2] = {-0.4 + WIDTH * 0.11, -0.4 + HEIGHT * 0.13};
        int is_on_window = 0;
        for (int axis = 0; axis < 2; ++axis)
          is_on_window |= fabs(points[2 * i + (uint64_t)axis] + 0.4) < 1e-9 ||
                          fabs(points[2 * i + (uint64_t)axis] - high[axis]) < 1e-9;
        assert_true(is_on_window || fabs(distance) <= 0.02);
      }
    assert_near(area, (double)all.inside[4][0] * plan.pitch[0] * plan.pitch[1], 0.1 * area);
    if (contour_axes[f] >= 0) {
      rings.axis = contour_axes[f];
      rings.has_window = 1;
      for (int i = 0; i < 2; ++i) {
        rings.window_min[i] = plan.origin[i] - 0.5 * plan.pitch[i];
        rings.window_max[i] = plan.origin[i] + ((i ? HEIGHT : WIDTH) - 0.5) * plan.pitch[i];
      }
      assert_ok(msq_layer_contours(models[0], w, &rings, &of_axis, NULL));
      const msq_contours_report wanted = contents_of(of_axis);
      assert_int_equal(wanted.point_count, report.point_count);
      assert_memory_equal(wanted.points, report.points, 16 * wanted.point_count);
      msq_contours_release(of_axis);
    }
    msq_contours_release(contours);
    msq_slicer_release(slicer);
    free_stack_of(&all);
  }
}

/* Without a region: the bounding box of the model in the frame. */
static void the_region_is_that_of_the_frame(void** state) {
  const double min[3] = {1, 2, 3}, max[3] = {2, 4, 7};
  msq_shape* shape;
  (void)state;
  assert_ok(msq_shape_from_box(context, min, max, &shape));
  msq_model* model = make_model(context, shape, NULL, NULL);
  for (int f = 0; f < FRAMES; ++f) {
    msq_slicer_def def;
    assert_ok(msq_slicer_def_init(&def, sizeof def));
    def.pitch[0] = def.pitch[1] = def.layer_height = 0.0625;
    memcpy(def.frame_origin, frames[f].origin, sizeof frames[f].origin);
    memcpy(def.frame_axes, frames[f].axes, sizeof frames[f].axes);
    msq_slicer* slicer = make_slicer(model, &def);
    const msq_slicer_report plan = plan_of(slicer);
    stack all;
    double volume = 0;
    memset(&all, 0, sizeof all);
    if (f == 0) {
      assert_int_equal(plan.width, 32);
      assert_int_equal(plan.height, 64);
      assert_int_equal(plan.layer_count, 16);
      assert_true(plan.origin[0] == 2.03125 && plan.origin[1] == 3.03125);
    }
    for (uint64_t k = 0; k < plan.layer_count; k += LAYERS) {
      const uint64_t count = plan.layer_count - k < LAYERS ? plan.layer_count - k : LAYERS;
      uint8_t* layer = (uint8_t*)malloc(plan.layer_bytes);
      for (uint64_t n = k; n < k + count; ++n) {
        assert_ok(msq_slice_layer(slicer, n, layer, plan.layer_bytes, NULL));
        volume += (double)count_bits(layer, plan.layer_bytes) * 0x1p-12;
      }
      free(layer);
    }
    assert_near(volume, 8, f < 6 ? 1e-9 : 0.1);
    msq_slicer_release(slicer);
  }
  msq_model_release(model);
}

/* Layers of all space have no box to be turned. */
static void all_space_is_turned(void** state) {
  msq_shape* space;
  (void)state;
  assert_ok(msq_shape_all_space(context, &space));
  msq_model* model = make_model(context, space, make_lattice(context), NULL);
  for (int f = 0; f < FRAMES; ++f) {
    const msq_slicer_def def = plan_def(&frames[f]);
    msq_slicer* slicer = make_slicer(model, &def);
    const msq_slicer_report plan = plan_of(slicer);
    uint8_t layer[64 * HEIGHT];
    double w, point[3];
    assert_ok(msq_slice_layer(slicer, 3, layer, sizeof layer, NULL));
    assert_ok(msq_slicer_layer_z(slicer, 3, &w));
    for (uint32_t j = 0; j < HEIGHT; ++j)
      for (uint32_t i = 0; i < WIDTH; ++i) {
        to_model(&frames[f], plan.origin[0] + i * plan.pitch[0], plan.origin[1] + j * plan.pitch[1],
                 w, point);
        assert_int_equal(layer[j * plan.stride + i / 8] >> (7 - i % 8) & 1,
                         is_inside(model, point[0], point[1], point[2]));
      }
    msq_slicer_release(slicer);
  }
  msq_model_release(model);
}

/* Blocks of bits are turned in parts: more samples than a part holds, and more than 64 along each
 * axis. */
static void large_layers_are_turned_in_parts(void** state) {
  static uint8_t layer[40 * 250];
  (void)state;
  for (int f = 0; f < 4; ++f) {
    msq_slicer_def def = plan_def(&frames[f]);
    def.pitch[0] = 0.013;
    def.pitch[1] = 0.017;
    def.resolution[0] = 300;
    def.resolution[1] = 250;
    msq_slicer* slicer = make_slicer(models[0], &def);
    const msq_slicer_report plan = plan_of(slicer);
    double w, point[3];
    uint64_t inside = 0;
    assert_ok(msq_slice_layer(slicer, 4, layer, sizeof layer, NULL));
    assert_ok(msq_slicer_layer_z(slicer, 4, &w));
    for (uint32_t j = 0; j < plan.height; ++j)
      for (uint32_t i = 0; i < plan.width; ++i) {
        const int got = layer[j * plan.stride + i / 8] >> (7 - i % 8) & 1;
        inside += (uint64_t)got;
        if (i % 64 > 2 && j % 8 && i % 7) continue;
        to_model(&frames[f], plan.origin[0] + i * plan.pitch[0], plan.origin[1] + j * plan.pitch[1],
                 w, point);
        assert_int_equal(got, is_inside(models[0], point[0], point[1], point[2]));
      }
    assert_true(inside > 1000);
    msq_slicer_release(slicer);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(samples_are_where_the_frame_says),
      cmocka_unit_test(the_split_changes_nothing),
      cmocka_unit_test(contours_lie_in_the_frame),
      cmocka_unit_test(the_region_is_that_of_the_frame),
      cmocka_unit_test(all_space_is_turned),
      cmocka_unit_test(large_layers_are_turned_in_parts),
  };
  return cmocka_run_group_tests_name("msq_slicer_frame", tests, set_up, tear_down);
}
