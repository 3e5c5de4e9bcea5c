/* SPDX-License-Identifier: Apache-2.0
 * What the functions of files of beams refuse. */
#define _POSIX_C_SOURCE 200809L
#include <unistd.h>

#include "threemf.h"
#include "wrong_values.h"

#if MSQ_WITH_ASSIMP

static msq_context* context;

static void wrong_file(refusals* table, msq_file_def* def) {
  wrong_sizes(table, def, sizeof *def, sizeof *def);
  wrong_enum(table, &def->format, "format", 0, 7);
  WRONG(UNSUPPORTED, "format is 1|3MF|5", def->format = MSQ_FORMAT_STL);
  WRONG(ARGUMENT, "unit_mm is 0", def->unit_mm = 0);
  WRONG(ARGUMENT, "reserved is 9", def->reserved = 9);
  WRONG(LIMIT, "max_bytes is 99", def->max_bytes = 99);
  WRONG(LIMIT, "max_triangles is 3", def->max_triangles = 3);
  WRONG(LIMIT, "6 beams and balls|max_triangles is 5", def->max_triangles = 5);
  RIGHT(def->max_triangles = 6);
}

static void opening(void** state) {
  const char* path_of_none = "/no such folder/part.3mf";
  const char* without_beams = THREEMF_HEAD "<object id=\"1\"><mesh>" THREEMF_TETRAHEDRON
                                           "</mesh></object></resources><build>"
                                           "<item objectid=\"1\"/></build></model>";
  (void)state;
  REFUSALS("msq_beam_file_open_memory") {
    const char* text = THREEMF_BEAMS;
    msq_context* in = context;
    msq_file_def* def = (msq_file_def*)definition(0);
    msq_beam_file** file = (msq_beam_file**)output(0);
    msq_job* job = NULL;
    threemf_bytes bytes;
    const void* data;
    int is_null = 0;
    assert_ok(msq_file_def_init(def, sizeof *def));
    def->format = MSQ_FORMAT_3MF;
    WRONG(ARGUMENT, "context is NULL", in = NULL);
    WRONG(ARGUMENT, "data is NULL", is_null = 1);
    WRONG(ARGUMENT, "file is NULL", file = NULL);
    WRONG(ARGUMENT, "format is automatic", def->format = MSQ_FORMAT_AUTO);
    wrong_file(table, def);
    WRONG(CANCELLED, "cancelled", job = cancelled_job());
    WRONG(MESH, "no beams", text = without_beams);
    WRONG(IO, "3MF", text = "<model");
    WRONG(ARGUMENT, "automatic", def = NULL);
    bytes = threemf_of(text);
    data = is_null ? NULL : bytes.data;
    if (TRY(msq_beam_file_open_memory(in, data, bytes.size, def, file, job)))
      msq_beam_file_release(*file);
    free(bytes.data);
  }
  REFUSALS("msq_beam_file_open") {
    const char* text = THREEMF_BEAMS;
    const char *parent = getenv("TMPDIR"), *name;
    char path[512];
    msq_context* in = context;
    msq_file_def* def = (msq_file_def*)definition(0);
    msq_beam_file** file = (msq_beam_file**)output(0);
    msq_job* job = NULL;
    threemf_bytes bytes;
    FILE* stream;
    assert_ok(msq_file_def_init(def, sizeof *def));
    name = path;
    snprintf(path, sizeof path, "%s/msq-refusals-%d.3mf", parent && *parent ? parent : "/tmp",
             (int)getpid());
    WRONG(ARGUMENT, "context is NULL", in = NULL);
    WRONG(ARGUMENT, "path is NULL", name = NULL);
    WRONG(ARGUMENT, "file is NULL", file = NULL);
    wrong_file(table, def);
    WRONG(IO, path_of_none, name = path_of_none);
    WRONG(CANCELLED, "cancelled", job = cancelled_job());
    WRONG(MESH, "no beams", text = without_beams);
    RIGHT(def = NULL);
    bytes = threemf_of(text);
    stream = fopen(path, "wb");
    assert_non_null(stream);
    assert_int_equal(fwrite(bytes.data, 1, bytes.size, stream), bytes.size);
    assert_int_equal(fclose(stream), 0);
    free(bytes.data);
    if (TRY(msq_beam_file_open(in, name, def, file, job))) msq_beam_file_release(*file);
    unlink(path);
  }
}

static msq_beam_file* open_beams(const char* text) {
  const threemf_bytes bytes = threemf_of(text);
  msq_file_def def;
  msq_beam_file* file;
  assert_ok(msq_file_def_init(&def, sizeof def));
  def.format = MSQ_FORMAT_3MF;
  assert_ok(msq_beam_file_open_memory(context, bytes.data, bytes.size, &def, &file, NULL));
  free(bytes.data);
  return file;
}

static void reading(void** state) {
  msq_beam_file* opened = open_beams(THREEMF_BEAMS);
  msq_beam_file* bare =
      open_beams(THREEMF_HEAD
                 "<object id=\"3\"><mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/>"
                 "<vertex x=\"1\" y=\"0\" z=\"0\"/></vertices><b:beamlattice minlength=\"0.1\" "
                 "radius=\"1\"><b:beams><b:beam v1=\"0\" v2=\"1\"/></b:beams></b:beamlattice>"
                 "</mesh></object></resources><build><item objectid=\"3\"/></build></model>");
  (void)state;
  REFUSALS("msq_beam_file_info") {
    const msq_beam_file* file = opened;
    uint64_t lattice = 1;
    msq_beam_file_report* report = (msq_beam_file_report*)output(0);
    report->struct_size = sizeof *report;
    WRONG(ARGUMENT, "file is NULL", file = NULL);
    WRONG(ARGUMENT, "lattice is 2|2", lattice = 2);
    WRONG(ARGUMENT, "lattice is 18446744073709551615", lattice = UINT64_MAX);
    WRONG(ARGUMENT, "struct_size", report->struct_size = 4);
    WRONG(ARGUMENT, "report is NULL", report = NULL);
    TRY(msq_beam_file_info(file, lattice, report));
  }
  REFUSALS("msq_beam_file_beams") {
    const msq_beam_file* file = opened;
    uint64_t lattice = 1;
    msq_beams_def* def = (msq_beams_def*)output(0);
    def->struct_size = sizeof *def;
    WRONG(ARGUMENT, "file is NULL", file = NULL);
    WRONG(ARGUMENT, "lattice is 2|2", lattice = 2);
    WRONG(ARGUMENT, "struct_size", def->struct_size = 4);
    WRONG(ARGUMENT, "def is NULL", def = NULL);
    TRY(msq_beam_file_beams(file, lattice, def));
  }
  REFUSALS("msq_beam_file_shape") {
    msq_context* in = context;
    const msq_beam_file* file = opened;
    uint64_t lattice = 0;
    int32_t mesh = MSQ_BEAM_FILE_SOLID, rule = MSQ_WINDING_AUTO;
    msq_shape** shape = (msq_shape**)output(0);
    WRONG(ARGUMENT, "context is NULL", in = NULL);
    WRONG(ARGUMENT, "file is NULL", file = NULL);
    WRONG(ARGUMENT, "lattice is 2", lattice = 2);
    WRONG(ARGUMENT, "lattice is 1|needs 0", lattice = 1);
    RIGHT(mesh = MSQ_BEAM_FILE_CLIPPING);
    WRONG(MESH, "no mesh clips", lattice = 1; mesh = MSQ_BEAM_FILE_CLIPPING);
    WRONG(MESH, "no mesh besides", file = bare);
    wrong_enum(table, &mesh, "mesh", 0, 1);
    wrong_enum(table, &rule, "winding_rule", 0, 3);
    WRONG(ARGUMENT, "shape is NULL", shape = NULL);
    if (TRY(msq_beam_file_shape(in, file, lattice, mesh, rule, shape))) msq_shape_release(*shape);
  }
  msq_beam_file_release(bare);
  msq_beam_file_release(opened);
}

static int make_all(void** state) {
  (void)state;
  context = make_context();
  return 0;
}

static int release_all(void** state) {
  (void)state;
  msq_job_release(cancelled_job());
  msq_context_release(context);
  return 0;
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(opening), cmocka_unit_test(reading)};
  return cmocka_run_group_tests_name("refusals_beam_files", tests, make_all, release_all);
}

#else

int main(void) {
  print_message("beam files: this build reads no 3MF\n");
  return 0;
}

#endif
