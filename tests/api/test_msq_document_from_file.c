/* SPDX-License-Identifier: Apache-2.0
 * Documents that name files: meshes, raw images and NRRD, where they may be, limits, and how they
 * are written again. */
#define _POSIX_C_SOURCE 200809L
#include "documents.h"
#include "folder.h"
#include "stl.h"

static msq_context* context;

#define SHAPE(text) "{\"msq_model\": 1, \"scales\": [{\"shape\": " text "}]}"
#define FILE_OF(path) SHAPE("{\"file\": {\"file\": \"" path "\"}}")

static void write_text(const char* name, const char* text) {
  write_file(name, text, strlen(text));
}

static void prepare(void) {
  uint8_t cube[stl_bytes];
  uint8_t raw[4 + 16], header[256];
  assert_int_equal(make_folder(), 0);
  make_stl(cube);
  write_file("cube.stl", cube, sizeof cube);
  /* 8 big-endian numbers of 16 bits behind 4 other bytes: 0, 1000 .. 7000. */
  memset(raw, 9, 4);
  for (int i = 0; i < 8; ++i) {
    raw[4 + 2 * i] = (uint8_t)(1000 * i >> 8);
    raw[5 + 2 * i] = (uint8_t)(1000 * i);
  }
  write_file("values.raw", raw, sizeof raw);
  const int length = snprintf((char*)header, sizeof header,
                              "NRRD0004\n# by hand\ntype: uint16\ndimension: 3\nsizes: 2 2 2\n"
                              "space directions: (0.5,0,0) (0,0.5,0) (0,0,2)\n"
                              "space origin: (1,2,3)\nencoding: raw\nendian: big\n\n");
  memcpy(header + length, raw + 4, 16);
  write_file("values.nrrd", header, (size_t)length + 16);
}

static msq_status from_text(const char* text, const msq_document_def* def,
                            msq_document** document) {
  return msq_document_from_json(context, text, strlen(text), def, document, NULL);
}

static msq_document_def in_folder(void) {
  msq_document_def def;
  assert_ok(msq_document_def_init(&def, sizeof def));
  def.base_directory = folder;
  return def;
}

static void meshes_are_read_and_written_as_paths(void** state) {
  (void)state;
  msq_shape* shape;
  assert_ok(msq_shape_from_file(context, path_of("cube.stl"), NULL, &shape, NULL));
  msq_model* wanted = make_shape_model(context, shape);
  msq_model* model = model_of(read_document_in(context, FILE_OF("cube.stl"), folder));
  assert_same_model(model, wanted, "cube.stl");
  assert_round_trip(context, model, folder);
  msq_json_def def;
  assert_ok(msq_json_def_init(&def, sizeof def));
  def.base_directory = folder;
  char* text = json_of(wanted, &def);
  assert_non_null(strstr(text, "{\"file\": {\"file\": \"cube.stl\"}}"));
  free(text);
  text = json_of(wanted, NULL);
  assert_non_null(strstr(text, path_of("cube.stl")));
  free(text);
  /* The document named it without the folder. */
  text = json_of(model, NULL);
  assert_non_null(strstr(text, path_of("cube.stl")));
  free(text);
  msq_model_release(model);
  msq_model_release(wanted);
}

static void images_are_read_and_written_as_paths(void** state) {
  (void)state;
  static const uint16_t values[8] = {0, 1000, 2000, 3000, 4000, 5000, 6000, 7000};
  msq_voxels_def def;
  msq_shape* shape;
  assert_ok(msq_voxels_def_init(&def, sizeof def));
  def.image.values = values;
  def.image.value_type = MSQ_UINT16;
  for (int axis = 0; axis < 3; ++axis) {
    def.image.size[axis] = 2;
    def.image.grid.origin[axis] = axis + 1;
    def.image.grid.cell_size[axis] = axis == 2 ? 2 : 0.5;
  }
  def.threshold = 2500;
  assert_ok(msq_shape_from_voxels(context, &def, &shape));
  msq_model* wanted = make_shape_model(context, shape);
  const char* const texts[] = {
      SHAPE("{\"voxels\": {\"image\": {\"file\": \"values.nrrd\"}, \"threshold\": 2500}}"),
      SHAPE("{\"voxels\": {\"image\": {\"file\": \"values.raw\", \"value_type\": \"uint16\", "
            "\"size\": [2, 2, 2], \"skip_bytes\": 4, \"byte_order\": \"big\", \"grid\": "
            "{\"origin\": [1, 2, 3], \"cell_size\": [0.5, 0.5, 2]}}, \"threshold\": 2500}}")};
  for (int i = 0; i < 2; ++i) {
    msq_model* model = model_of(read_document_in(context, texts[i], folder));
    assert_same_model(model, wanted, texts[i]);
    assert_round_trip(context, model, folder);
    msq_json_def json;
    assert_ok(msq_json_def_init(&json, sizeof json));
    json.base_directory = folder;
    char* text = json_of(model, &json);
    assert_non_null(strstr(text, i ? "\"values.raw\"" : "\"values.nrrd\""));
    assert_null(strstr(text, "7000"));
    free(text);
    msq_model_release(model);
  }
  msq_model_release(wanted);
}

/* Several slashes are as one, also behind the base directory. */
static void paths_below_a_directory_stay_relative(void** state) {
  static const char* const slashes[] = {"/", "//", "///"};
  (void)state;
  for (int i = 0; i < 3; ++i) {
    char path[600];
    msq_shape* shape;
    msq_json_def json;
    snprintf(path, sizeof path, "%s%scube.stl", folder, slashes[i]);
    assert_ok(msq_shape_from_file(context, path, NULL, &shape, NULL));
    msq_model* model = make_shape_model(context, shape);
    assert_ok(msq_json_def_init(&json, sizeof json));
    json.base_directory = folder;
    char* text = json_of(model, &json);
    assert_non_null(strstr(text, "\"cube.stl\""));
    free(text);
    msq_model_release(model);
  }
}

static void rows_of_files(const char* text, msq_status status, const char* words,
                          void (*change)(msq_document_def* def)) {
  msq_document_def def = in_folder();
  msq_document* document = (msq_document*)untouched();
  change(&def);
  const msq_status got = from_text(text, &def, &document);
  if (status == MSQ_OK) {
    if (got != MSQ_OK) fail_msg("%s", msq_error_message());
    msq_document_release(document);
    return;
  }
  assert_int_equal(got, status);
  assert_message_has(words);
  assert_ptr_equal(document, untouched());
}

static void nothing(msq_document_def* def) {
  (void)def;
}
static void no_files(msq_document_def* def) {
  def->files = MSQ_DOCUMENT_FILES_NONE;
}
static void any_files(msq_document_def* def) {
  def->files = MSQ_DOCUMENT_FILES_ANY;
}
static void any_files_of_no_base(msq_document_def* def) {
  def->files = MSQ_DOCUMENT_FILES_ANY;
  def->base_directory = NULL;
}
static void one_file(msq_document_def* def) {
  def->max_files = 1;
}
static void few_bytes(msq_document_def* def) {
  def->max_file_bytes = stl_bytes + 19;
}
static void few_triangles(msq_document_def* def) {
  def->max_triangles = 11;
}
static void few_values(msq_document_def* def) {
  def->max_values = 7;
}
static void little_depth(msq_document_def* def) {
  def->max_depth = 4;
}
static void small(msq_document_def* def) {
  def->max_bytes = 20;
}

static void files_and_limits(void** state) {
  (void)state;
  const char* both = SHAPE(
      "{\"boolean\": {\"operation\": \"union\", \"shapes\": [{\"file\": {\"file\": "
      "\"cube.stl\"}}, {\"voxels\": {\"image\": {\"file\": \"values.raw\", \"value_type\": "
      "\"uint8\", \"size\": [2, 2, 5]}}}]}}");
  char absolute[1200];
  rows_of_files(FILE_OF("cube.stl"), MSQ_OK, "", nothing);
  rows_of_files(FILE_OF("./cube.stl"), MSQ_OK, "", nothing);
  rows_of_files(FILE_OF("cube.stl"), MSQ_E_ARGUMENT, "may name no files", no_files);
  rows_of_files(FILE_OF("missing.stl"), MSQ_E_IO, "scales[0].shape.file: ", nothing);
  snprintf(absolute, sizeof absolute, FILE_OF("%s"), path_of("cube.stl"));
  rows_of_files(absolute, MSQ_E_ARGUMENT, "relative", nothing);
  rows_of_files(absolute, MSQ_OK, "", any_files);
  rows_of_files(absolute, MSQ_OK, "", any_files_of_no_base);
  rows_of_files(FILE_OF("x/../cube.stl"), MSQ_E_IO, "", any_files);
  rows_of_files(both, MSQ_OK, "", nothing);
  rows_of_files(both, MSQ_E_LIMIT, "max_files is 1", one_file);
  rows_of_files(both, MSQ_E_LIMIT, "20 bytes; the limit is 19", few_bytes);
  rows_of_files(both, MSQ_E_LIMIT, "max_triangles", few_triangles);
  rows_of_files(both, MSQ_E_LIMIT, "max_values", few_values);
  rows_of_files(both, MSQ_E_LIMIT, "max_depth, 4", little_depth);
  rows_of_files(both, MSQ_E_LIMIT, "max_bytes is 20", small);
  rows_of_files(SHAPE("{\"voxels\": {\"image\": {\"file\": \"values.raw\"}}}"), MSQ_E_ARGUMENT,
                "value_type and size", nothing);
  rows_of_files(
      SHAPE("{\"voxels\": {\"image\": {\"file\": \"values.nrrd\", \"size\": [2, 2, 2]}}}"),
      MSQ_E_ARGUMENT, "which the file says itself", nothing);
  rows_of_files(
      SHAPE("{\"voxels\": {\"image\": {\"file\": \"values.raw\", \"value_type\": \"uint8\", "
            "\"size\": [2, 2, 2]}}}"),
      MSQ_E_IO, "20 bytes of values; 2 x 2 x 2 values take 8", nothing);
}

static void bad_images_are_refused(void** state) {
  (void)state;
  static const struct {
    const char* text;
    msq_status status;
    const char* words;
  } rows[] = {
      {"", MSQ_E_IO, "does not end with an empty line"},
      {"NRRX\n\n", MSQ_E_IO, "does not begin with NRRD000"},
      {"NRRD0004\ntype: uint8\n", MSQ_E_IO, "does not end with an empty line"},
      {"NRRD0004\ntype\n\n", MSQ_E_IO, "no colon: type"},
      {"NRRD0004\n\n", MSQ_E_IO, "names no dimension"},
      {"NRRD0004\ndimension: 2\n\n", MSQ_E_IO, "dimension that is not 3: 2"},
      {"NRRD0004\ntype: int64\n\n", MSQ_E_UNSUPPORTED, "the type is int64"},
      {"NRRD0004\nencoding: gzip\n\n", MSQ_E_UNSUPPORTED, "the encoding is gzip"},
      {"NRRD0004\nendian: middle\n\n", MSQ_E_IO, "endian: middle"},
      {"NRRD0004\nsizes: 2 2\n\n", MSQ_E_IO, "sizes: 2 2"},
      {"NRRD0004\nsizes: 2 2 0.5\n\n", MSQ_E_IO, "sizes"},
      {"NRRD0004\nsizes: 2 2 9999999\n\n", MSQ_E_IO, "1 to 1048576"},
      {"NRRD0004\nspacings: 1 nan 1\n\n", MSQ_E_IO, "spacings: 1 nan 1"},
      {"NRRD0004\naxis mins: 0 0 0\n\n", MSQ_E_UNSUPPORTED, "axis mins say where"},
      {"NRRD0004\ndata file: /etc/passwd\n\n", MSQ_E_UNSUPPORTED, "another file"},
      {"NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 2 2\nencoding: raw\n\n1234567", MSQ_E_IO,
       "7 bytes of values"},
      {"NRRD0004\ntype: double\ndimension: 3\nsizes: 1048576 1048576 1048576\nencoding: raw\n\n1",
       MSQ_E_LIMIT, "more than 2^63"},
      {"NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 2 2\nspacings: 1 0 1\nencoding: "
       "raw\n\n12345678",
       MSQ_E_ARGUMENT, "grid.cell_size"},
  };
  for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
    write_text("bad.nrrd", rows[i].text);
    rows_of_files(SHAPE("{\"voxels\": {\"image\": {\"file\": \"bad.nrrd\"}}}"), rows[i].status,
                  rows[i].words, nothing);
  }
}

static void documents_are_files(void** state) {
  (void)state;
  msq_document* document;
  write_text("model.json", FILE_OF("cube.stl"));
  assert_ok(msq_document_from_file(context, path_of("model.json"), NULL, &document, NULL));
  msq_document_report report = {0};
  report.struct_size = sizeof report;
  assert_ok(msq_document_info(document, &report));
  assert_int_equal(report.files, 1);
  msq_document_release(document);
  document = (msq_document*)untouched();
  write_text("model.json", "{\"msq_model\": 1,\n \"scale\": 1}");
  assert_refused(msq_document_from_file(context, path_of("model.json"), NULL, &document, NULL),
                 MSQ_E_ARGUMENT, "model.json:2:2: scale: unknown key");
  assert_refused(msq_document_from_file(context, path_of("none.json"), NULL, &document, NULL),
                 MSQ_E_IO, "none.json");
  assert_ptr_equal(document, untouched());
}

/* A document with bytes changed, left out and doubled is read or refused, whatever it has become.
 */
static void changed_documents_do_no_harm(void** state) {
  (void)state;
  const char* texts[] = {
      "{\"msq_model\": 1, \"shapes\": {\"p\": {\"file\": {\"file\": \"cube.stl\"}}}, \"fields\": "
      "{\"f\": {\"map\": {\"argument\": {\"radial\": {}}, \"curve\": [[0, 1e-1], [1, 0.2]]}}}, "
      "\"scales\": [{\"shape\": \"p\"}, {\"structure\": {\"lattice\": {\"radius\": \"f\", "
      "\"cells\": [{}, {\"unit_cell\": \"fcc\"}]}}, \"skin\": 0.1}], \"slicing\": {\"pitch\": 0.1, "
      "\"outputs\": [{}]}, \"view\": {\"direction\": [0, 0, 1], \"width\": 8, \"height\": 8}}",
      SHAPE(
          "{\"voxels\": {\"image\": {\"file\": \"values.raw\", \"value_type\": \"uint16\", "
          "\"size\": [2, 2, 2], \"skip_bytes\": 4, \"byte_order\": \"big\"}, \"threshold\": 9}}")};
  static const char bytes[] = "{}[],:\"\\0-9.eEtfn \n\x80\xff";
  uint64_t seed = 17;
  int read = 0;
  for (int round = 0; round < 3000; ++round) {
    const char* text = texts[round & 1];
    char changed[1024];
    size_t length = strlen(text);
    memcpy(changed, text, length);
    for (int change = 0; change < 1 + round % 3; ++change) {
      const size_t at = (size_t)random_between(&seed, 0, (double)length);
      const int kind = (int)random_between(&seed, 0, 3);
      if (kind == 0) {
        changed[at] = bytes[(size_t)random_between(&seed, 0, sizeof bytes - 1)];
      } else if (kind == 1) {
        memmove(changed + at, changed + at + 1, length - at - 1);
        --length;
      } else {
        memmove(changed + at + 1, changed + at, length - at);
        ++length;
      }
    }
    msq_document_def def = in_folder();
    msq_document* document = (msq_document*)untouched();
    def.max_triangles = 1000;
    const msq_status status =
        msq_document_from_json(context, changed, length, &def, &document, NULL);
    if (status == MSQ_OK) {
      ++read;
      msq_document_release(document);
      continue;
    }
    assert_true(status != MSQ_E_INTERNAL);
    assert_ptr_equal(document, untouched());
    assert_true(msq_error_message()[0] >= '1' && msq_error_message()[0] <= '9');
  }
  assert_true(read > 0 && read < 2500);
}

/* Deep and wide documents end at their limits, quickly. */
static void hostile_documents_end_at_limits(void** state) {
  (void)state;
  const size_t bytes = 1000000;
  char* text = (char*)malloc(bytes);
  msq_document* document = (msq_document*)untouched();
  assert_non_null(text);
  memset(text, '[', bytes);
  assert_refused(msq_document_from_json(context, text, bytes, NULL, &document, NULL), MSQ_E_LIMIT,
                 "1:65: ");
  for (size_t i = 0; i < bytes; ++i) text[i] = i == 0 ? '[' : i % 2 ? '0' : ',';
  msq_document_def def;
  assert_ok(msq_document_def_init(&def, sizeof def));
  def.max_values = 1000;
  assert_refused(msq_document_from_json(context, text, bytes, &def, &document, NULL), MSQ_E_LIMIT,
                 "1000 values");
  free(text);
  /* A chain of names, each of which needs the next. */
  char* chain = (char*)malloc(64 * 2000 + 200);
  assert_non_null(chain);
  int length = sprintf(chain, "{\"msq_model\": 1, \"fields\": {");
  for (int i = 0; i < 2000; ++i)
    length += sprintf(chain + length, "%s\"%d\": {\"map\": {\"argument\": \"%d\"}}", i ? ", " : "",
                      i, i + 1);
  length += sprintf(chain + length, "}}");
  assert_refused(msq_document_from_json(context, chain, (uint64_t)length, NULL, &document, NULL),
                 MSQ_E_LIMIT, "within 64 other definitions");
  free(chain);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(meshes_are_read_and_written_as_paths),
      cmocka_unit_test(images_are_read_and_written_as_paths),
      cmocka_unit_test(paths_below_a_directory_stay_relative),
      cmocka_unit_test(files_and_limits),
      cmocka_unit_test(bad_images_are_refused),
      cmocka_unit_test(documents_are_files),
      cmocka_unit_test(changed_documents_do_no_harm),
      cmocka_unit_test(hostile_documents_end_at_limits),
  };
  if (!MSQ_WITH_JSON) return 0;   /* test_refusals_documents.c */
  if (!MSQ_WITH_ASSIMP) return 0; /* it reads binary STL */
  context = make_context();
  prepare();
  const int failed = cmocka_run_group_tests(tests, NULL, NULL);
  static const char* const names[] = {"cube.stl", "values.raw", "values.nrrd", "bad.nrrd",
                                      "model.json"};
  for (size_t i = 0; i < sizeof names / sizeof names[0]; ++i) remove(path_of(names[i]));
  rmdir(folder);
  msq_context_release(context);
  return failed;
}
