/* SPDX-License-Identifier: Apache-2.0
 * msq_beam_file_open, _open_memory, _info, _beams, _shape. Malformed files:
 * unit/test_mesh_file_beams.cpp. */
#define _POSIX_C_SOURCE 200809L
#include <unistd.h>

#include "beams.h"
#include "threemf.h"

#if MSQ_WITH_ASSIMP

static msq_file_def threemf_def(void) {
  msq_file_def def;
  assert_ok(msq_file_def_init(&def, sizeof def));
  def.format = MSQ_FORMAT_3MF;
  return def;
}

static msq_beam_file* open_text(msq_context* context, const char* model) {
  const msq_file_def def = threemf_def();
  const threemf_bytes bytes = threemf_of(model);
  msq_beam_file* file;
  assert_ok(msq_beam_file_open_memory(context, bytes.data, bytes.size, &def, &file, NULL));
  free(bytes.data);
  return file;
}

static msq_beam_file_report report_of(const msq_beam_file* file, uint64_t lattice) {
  msq_beam_file_report report;
  memset(&report, 0, sizeof report);
  report.struct_size = sizeof report;
  assert_ok(msq_beam_file_info(file, lattice, &report));
  return report;
}

static msq_beams_def beams_of(const msq_beam_file* file, uint64_t lattice) {
  msq_beams_def def;
  assert_ok(msq_beams_def_init(&def, sizeof def));
  assert_ok(msq_beam_file_beams(file, lattice, &def));
  return def;
}

static void lattices_are_in_millimetres(void** state) {
  const double clipped_nodes[4][3] = {{0, 0, 0}, {40, 0, 0}, {0, 40, 0}, {0, 0, 40}};
  const double clipped_radii[3][2] = {{5, 5}, {2.5, 2.5}, {2.5, 1.25}};
  const uint8_t clipped_caps[3][2] = {{2, 2}, {2, 2}, {0, 1}};
  /* The second one is turned from x to y, and twice as large. */
  const double free_nodes[4][3] = {{0, 0, 0}, {10, 0, 0}, {0, 0, 100}, {0, 20, 100}};
  const double free_radii[2][2] = {{2.5, 2.5}, {5, 5}};
  msq_context* context = make_context();
  const uint64_t before = memory_of(context).bytes;
  msq_beam_file* file = open_text(context, THREEMF_BEAMS);
  msq_beam_file_report report = report_of(file, 0);
  msq_beams_def def = beams_of(file, 0);
  const double* nodes_found = (const double*)def.nodes;
  (void)state;
  assert_true(memory_of(context).bytes > before);
  assert_int_equal(report.lattice_count, 2);
  assert_int_equal(report.mesh_triangle_count, 4);
  assert_int_equal(report.clipping, MSQ_CLIPPING_INSIDE);
  assert_int_equal(report.clipping_triangle_count, 4);
  assert_int_equal(report.node_count, 4);
  assert_int_equal(report.beam_count, 3);
  assert_int_equal(report.ball_count, 1);
  for (int axis = 0; axis < 3; ++axis) {
    assert_true(report.min[axis] == (axis == 2 ? -5 : -7.5));
    assert_true(report.max[axis] == (axis == 2 ? 47.5 : axis == 1 ? 42.5 : 45));
  }
  assert_int_equal(def.node_count, 4);
  for (int i = 0; i < 12; ++i) assert_true(nodes_found[i] == clipped_nodes[i / 3][i % 3]);
  assert_int_equal(def.beam_count, 3);
  assert_memory_equal(def.radii, clipped_radii, sizeof clipped_radii);
  assert_memory_equal(def.caps, clipped_caps, sizeof clipped_caps);
  assert_int_equal(def.ball_count, 1);
  assert_int_equal(def.balls[0], 3);
  assert_true(*(const double*)def.ball_radii == 7.5);
  assert_int_equal(def.coordinate_type, MSQ_FLOAT64);

  report = report_of(file, 1);
  def = beams_of(file, 1);
  assert_int_equal(report.clipping, MSQ_CLIPPING_NONE);
  assert_int_equal(report.clipping_triangle_count, 0);
  assert_int_equal(report.beam_count, 2);
  assert_int_equal(report.ball_count, 0);
  assert_int_equal(def.node_count, 4); /* without the vertex that nothing uses */
  nodes_found = (const double*)def.nodes;
  for (int i = 0; i < 12; ++i) assert_true(nodes_found[i] == free_nodes[i / 3][i % 3]);
  assert_memory_equal(def.radii, free_radii, sizeof free_radii);
  assert_int_equal(def.caps[0], MSQ_CAP_SPHERE);

  msq_beam_file_retain(file);
  msq_beam_file_release(file);
  msq_beam_file_release(file);
  msq_beam_file_release(NULL);
  msq_beam_file_retain(NULL);
  assert_int_equal(memory_of(context).bytes, before);
  msq_context_release(context);
}

/* A model that is written and read again is the same. */
static void check_json(msq_context* context, const msq_model* model) {
  uint64_t bytes;
  msq_document* document;
  msq_model* again;
  uint8_t hashes[2][16];
  assert_ok(msq_model_to_json(model, NULL, NULL, 0, &bytes));
  char* text = (char*)malloc(bytes);
  assert_non_null(text);
  assert_ok(msq_model_to_json(model, NULL, text, bytes, &bytes));
  assert_ok(msq_document_from_json(context, text, bytes, NULL, &document, NULL));
  free(text);
  assert_ok(msq_document_model(document, &again));
  msq_document_release(document);
  if (MSQ_WITH_XXHASH) {
    assert_ok(msq_model_hash(model, hashes[0]));
    assert_ok(msq_model_hash(again, hashes[1]));
    assert_memory_equal(hashes[0], hashes[1], 16);
  }
  msq_model_release(again);
}

/* The solid of the file: the mesh, and the beams within what clips them. */
static void models_are_composed(void** state) {
  msq_context* context = make_context();
  msq_beam_file* file = open_text(context, THREEMF_BEAMS);
  const msq_beams_def def = beams_of(file, 0);
  msq_shape *mesh, *clip;
  msq_structure* made;
  msq_shape_report info;
  (void)state;
  assert_ok(msq_beam_file_shape(context, file, 0, MSQ_BEAM_FILE_SOLID, MSQ_WINDING_AUTO, &mesh));
  assert_ok(msq_beam_file_shape(context, file, 0, MSQ_BEAM_FILE_CLIPPING, MSQ_WINDING_AUTO, &clip));
  assert_ok(msq_structure_beams(context, &def, &made, NULL));
  msq_beam_file_release(file);
  memset(&info, 0, sizeof info);
  info.struct_size = sizeof info;
  assert_ok(msq_shape_info(mesh, &info));
  assert_true(fabs(info.volume - 40.0 * 40 * 40 / 6) < 1e-9);
  assert_ok(msq_shape_info(clip, &info));
  assert_int_equal(info.triangles, 4);
  const msq_scale_def scales[2] = {{.shape = clip}, {.structure = made}};
  msq_model_def model_def;
  msq_model* model;
  assert_ok(msq_model_def_init(&model_def, sizeof model_def));
  model_def.scales = scales;
  model_def.scale_count = 2;
  model_def.scale_size = sizeof scales[0];
  assert_ok(msq_model_create(context, &model_def, &model));
  assert_int_equal(is_inside(model, 20, 1, 1), 1);
  assert_int_equal(is_inside(model, 20, -1, 1), 0); /* clipped */
  assert_int_equal(is_inside(model, 20, 6, 1), 0);
  assert_int_equal(is_inside(model, 1, 1, 36), 1); /* the ball */
  if (MSQ_WITH_JSON) check_json(context, model);
  msq_model_release(model);
  msq_structure_release(made);
  msq_shape_release(clip);
  msq_shape_release(mesh);
  msq_context_release(context);
}

static void files_are_read_by_their_paths(void** state) {
  const threemf_bytes bytes = threemf_of(THREEMF_BEAMS);
  const char* parent = getenv("TMPDIR");
  char path[512];
  msq_context* context = make_context();
  msq_beam_file* file;
  msq_shape* shape = (msq_shape*)untouched();
  FILE* stream;
  (void)state;
  snprintf(path, sizeof path, "%s/msq-beams-%d.3mf", parent && *parent ? parent : "/tmp",
           (int)getpid());
  stream = fopen(path, "wb");
  assert_non_null(stream);
  assert_int_equal(fwrite(bytes.data, 1, bytes.size, stream), bytes.size);
  assert_int_equal(fclose(stream), 0);
  assert_ok(msq_beam_file_open(context, path, NULL, &file, NULL));
  assert_int_equal(report_of(file, 1).beam_count, 2);
  msq_beam_file_release(file);
  /* As triangles alone the file would lack its beams. */
  assert_refused(msq_shape_from_file(context, path, NULL, &shape, NULL), MSQ_E_UNSUPPORTED,
                 "msq_beam_file_open");
  assert_ptr_equal(shape, untouched());
  unlink(path);
  free(bytes.data);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(lattices_are_in_millimetres),
                                     cmocka_unit_test(models_are_composed),
                                     cmocka_unit_test(files_are_read_by_their_paths)};
  return cmocka_run_group_tests_name("beam_file", tests, NULL, NULL);
}

#else

int main(void) {
  print_message("beam files: this build reads no 3MF\n");
  return 0;
}

#endif
