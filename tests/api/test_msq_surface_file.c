/* SPDX-License-Identifier: Apache-2.0 */
#include "definitions.h"
#include "surfaces.h"

static float float_at(const uint8_t* bytes) {
  const uint32_t bits = (uint32_t)bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 |
                        (uint32_t)bytes[3] << 24;
  float number;
  memcpy(&number, &bits, sizeof number);
  return number;
}

/* msq reads the file back: with Assimp if it is STL. The mesh has no edge with one triangle, three,
 * or two of the same direction, and its volume. */
static void read_back(const file_bytes* file, int32_t format, const surface* known) {
  msq_context* context = make_context();
  msq_file_def def;
  msq_shape* shape;
  assert_ok(msq_file_def_init(&def, sizeof def));
  def.format = format;
  assert_ok(msq_shape_from_memory(context, file->bytes, file->size, &def, &shape, NULL));
  const msq_shape_report report = info_of(shape);
  assert_int_equal(report.vertices, known->vertex_count);
  assert_int_equal(report.triangles, known->triangle_count);
  assert_int_equal(report.open_edges, 0);
  assert_int_equal(report.non_manifold_edges, 0);
  assert_int_equal(report.flipped_edges, 0);
  assert_int_equal(report.closed, 1);
  assert_near(report.volume / surface_volume(known), 1, 1e-5);
  msq_shape_release(shape);
  msq_context_release(context);
}

static void check_model(msq_model* model) {
  msq_surface_def def = surface_def(0.09);
  surface known = surface_of(model, &def);
  file_bytes stl = file_of(model, &def, MSQ_SURFACE_STL);
  file_bytes ply = file_of(model, &def, MSQ_SURFACE_PLY);

  assert_true(stl.is_in_order);
  assert_int_equal(stl.size, 84 + 50 * known.triangle_count);
  for (uint64_t t = 0; t < known.triangle_count; ++t)
    for (uint64_t i = 0; i < 3; ++i)
      for (uint64_t axis = 0; axis < 3; ++axis)
        assert_true(float_at(stl.bytes + 84 + 50 * t + 12 * (i + 1) + 4 * axis) ==
                    (float)known.vertices[3 * known.triangles[3 * t + i] + axis]);
  const uint8_t* behind = ply.bytes + ply.size - 13 * known.triangle_count;
  const uint8_t* first = behind - 24 * known.vertex_count;
  assert_memory_equal(ply.bytes, "ply\nformat binary_little_endian 1.0\n", 36);
  assert_memory_equal(first - 11, "end_header\n", 11);
  for (uint64_t v = 0; v < known.vertex_count; ++v)
    for (uint64_t axis = 0; axis < 3; ++axis) {
      assert_true(float_at(first + 24 * v + 4 * axis) == (float)known.vertices[3 * v + axis]);
      assert_true(float_at(first + 24 * v + 12 + 4 * axis) == known.normals[3 * v + axis]);
    }

  msq_build_report build;
  memset(&build, 0, sizeof build);
  build.struct_size = sizeof build;
  assert_ok(msq_build_info(&build));
  if (build.with_assimp) read_back(&stl, MSQ_FORMAT_STL, &known);
  read_back(&ply, MSQ_FORMAT_PLY, &known);

  /* The same bytes in other slabs. */
  def.slab_layers = 5;
  file_bytes again = file_of(model, &def, MSQ_SURFACE_PLY);
  assert_int_equal(again.size, ply.size);
  assert_memory_equal(again.bytes, ply.bytes, ply.size);
  free(again.bytes);
  again = file_of(model, &def, MSQ_SURFACE_STL);
  assert_memory_equal(again.bytes, stl.bytes, stl.size);
  free(again.bytes);
  free(ply.bytes);
  free(stl.bytes);
  free_surface(&known);
  msq_model_release(model);
}

static void lattices(void** state) {
  msq_context* context = make_context();
  (void)state;
  check_model(make_lattice_model(context));
  msq_context_release(context);
}

static void foams(void** state) {
  msq_context* context = make_context_of(1, 1 << 20, 0);
  (void)state;
  check_model(make_foam_model(context, MSQ_FOAM_AUTO));
  msq_context_release(context);
}

static void nothing_is_a_file_too(void** state) {
  msq_context* context = make_context();
  msq_model* model = make_box_model(context);
  msq_surface_def def = surface_def(0.1);
  (void)state;
  def.has_box = 1;
  for (int axis = 0; axis < 3; ++axis) {
    def.min[axis] = 5;
    def.max[axis] = 6;
  }
  file_bytes stl = file_of(model, &def, MSQ_SURFACE_STL);
  assert_int_equal(stl.size, 84);
  assert_filled(stl.bytes + 80, 4, 0);
  free(stl.bytes);
  file_bytes ply = file_of(model, &def, MSQ_SURFACE_PLY);
  assert_memory_equal(ply.bytes + ply.size - 11, "end_header\n", 11);
  free(ply.bytes);
  msq_model_release(model);
  msq_context_release(context);
}

static void callbacks_stop_it(void** state) {
  msq_context* context = make_context();
  msq_model* model = make_lattice_model(context);
  const msq_surface_def def = surface_def(0.2);
  file_bytes file;
  msq_job* job;
  (void)state;
  memset(&file, 0, sizeof file);
  file.stop_with = 12;
  assert_refused(msq_surface_file(model, &def, MSQ_SURFACE_STL, take_file, &file, NULL), MSQ_E_HOST,
                 "12");
  assert_int_equal(msq_error_host_code(), 12);
  assert_int_equal(file.calls, 1);
  free(file.bytes);
  memset(&file, 0, sizeof file);
  assert_ok(msq_job_create(&job));
  assert_ok(msq_surface_file(model, &def, MSQ_SURFACE_STL, take_file, &file, job));
  assert_true(progress_of(job) == 1);
  free(file.bytes);
  msq_job_release(job);
  msq_model_release(model);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(lattices),
      cmocka_unit_test(foams),
      cmocka_unit_test(nothing_is_a_file_too),
      cmocka_unit_test(callbacks_stop_it),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
