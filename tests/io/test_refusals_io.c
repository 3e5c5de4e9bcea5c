/* SPDX-License-Identifier: Apache-2.0
 * What the functions of msq_io.h refuse, and struct_size of its definitions and reports. */
#define _DEFAULT_SOURCE
#include "io_test.h"

static msq_context* context;
static msq_model* model;
static msq_slicer *bits, *panel_layers, *uneven, *one_layer;
static const char part_path[] = "refused.part";

static int begin_tests(void** state) {
  (void)state;
  context = make_context();
  model = make_lattice_model(context);
  bits = make_slicer_of(model, MSQ_LAYER_BITS);
  msq_slicer_def def;
  assert_ok(msq_slicer_def_init(&def, sizeof def));
  def.layer_height = 0.5;
  assert_ok(msq_io_panel_plan(model, NULL, &def));
  assert_ok(msq_slicer_create(model, &def, &panel_layers));
  const double heights[3] = {0.5, 1, 2};
  def.layer_z = heights;
  def.layer_z_count = 3;
  def.layer_count = 0;
  def.layer_height = 0;
  assert_ok(msq_slicer_create(model, &def, &uneven));
  def.layer_z_count = 1;
  assert_ok(msq_slicer_create(model, &def, &one_layer));
  return 0;
}
static int end_tests(void** state) {
  (void)state;
  msq_slicer_release(one_layer);
  msq_slicer_release(uneven);
  msq_slicer_release(panel_layers);
  msq_slicer_release(bits);
  msq_model_release(model);
  msq_context_release(context);
  return 0;
}

#define INIT_OF(name)                                       \
  static msq_status init_##name(void* def, size_t size) {   \
    return msq_io_##name##_init((msq_io_##name*)def, size); \
  }
#define FOR_EACH_DEFINITION(DO) \
  DO(writer_def) DO(png_def) DO(panel_def) DO(sl1_def) DO(svg_def) DO(beams_def) DO(slices_def)
FOR_EACH_DEFINITION(INIT_OF)
#define ROW_OF(name) {"msq_io_" #name "_init", init_##name, sizeof(msq_io_##name)},
static const struct {
  const char* function;
  init_fn init;
  size_t known;
} definitions[] = {FOR_EACH_DEFINITION(ROW_OF)};

static void sizes(void** state) {
  (void)state;
  for (size_t k = 0; k < COUNT_OF(definitions); ++k) {
    const init_fn init = definitions[k].init;
    const size_t known = definitions[k].known;
    struct_bytes def;
    memset(&def, struct_pattern, sizeof def);
    assert_refused(init(NULL, known), MSQ_E_ARGUMENT, "def is NULL");
    assert_refused(init(&def, known - 1), MSQ_E_ARGUMENT, "struct_size");
    assert_refused(init(&def, 4097), MSQ_E_ARGUMENT, "4097");
    assert_filled(&def, sizeof def, struct_pattern);
    assert_ok(init(&def, known + struct_tail));
    assert_int_equal(def.struct_size, known + struct_tail);
    assert_filled(def.bytes + known, struct_tail, 0);
    assert_filled(def.bytes + known + struct_tail, struct_room - known - struct_tail,
                  struct_pattern);
  }
}

static void report_sizes(void** state) {
  (void)state;
  struct_bytes report;
  msq_io_writer* writer;
  assert_ok(msq_io_png_create(bits, "refused", NULL, NULL, &writer));
  memset(&report, struct_pattern, sizeof report);
  report.struct_size = sizeof(msq_io_writer_report) + struct_tail;
  assert_ok(msq_io_writer_info(writer, (msq_io_writer_report*)&report));
  assert_filled(report.bytes + sizeof(msq_io_writer_report), struct_tail, 0);
  assert_filled(report.bytes + sizeof(msq_io_writer_report) + struct_tail, 8, struct_pattern);
  REFUSALS("msq_io_writer_info") {
    const msq_io_writer* of = writer;
    msq_io_writer_report* to = (msq_io_writer_report*)definition(0);
    to->struct_size = sizeof *to;
    WRONG(ARGUMENT, "struct_size of report is 0;", to->struct_size = 0);
    WRONG(ARGUMENT, "struct_size of report is 39;", to->struct_size = sizeof *to - 1);
    WRONG(ARGUMENT, "struct_size of report is 4097;", to->struct_size = 4097);
    WRONG(ARGUMENT, "report is NULL", to = NULL);
    WRONG(ARGUMENT, "writer is NULL", of = NULL);
    (void)TRY(msq_io_writer_info(of, to));
  }
  msq_io_writer_release(writer);
}

static void files(void** state) {
  (void)state;
  REFUSALS("msq_io_file_create") {
    const char* path = part_path;
    int32_t replace = 0;
    msq_io_file** file = (msq_io_file**)output(0);
    wrong_enum(table, &replace, "replace", 0, 1);
    WRONG(ARGUMENT, "path is NULL", path = NULL);
    WRONG(ARGUMENT, "path is empty", path = "");
    WRONG(IO, "cannot create the file|No such file|none/none", path = "none/none");
    WRONG(IO, "not a plain file|/dev/full", path = "/dev/full"; replace = 1);
    WRONG(ARGUMENT, "file is NULL", file = NULL);
    if (TRY(msq_io_file_create(path, replace, file))) msq_io_file_release(*file);
  }
  msq_io_file* file;
  assert_ok(msq_io_file_create(part_path, 0, &file));
  REFUSALS("msq_io_file_write") {
    msq_io_file* to = file;
    const void* bytes = "some";
    WRONG(ARGUMENT, "file is NULL", to = NULL);
    WRONG(ARGUMENT, "bytes is NULL", bytes = NULL);
    (void)TRY(msq_io_file_write(to, bytes, 4));
  }
  REFUSALS("msq_io_file_part") {
    msq_file_part part = {.struct_size = sizeof part, .size = 4, .bytes = (const uint8_t*)"some"};
    msq_file_part* of = &part;
    msq_io_file* to = file;
    WRONG(ARGUMENT, "user is NULL", to = NULL);
    WRONG(ARGUMENT, "part is NULL", of = NULL);
    (void)TRY(msq_io_file_part(to, of));
  }
  msq_io_file_release(file);
  REFUSALS("msq_io_file_finish") {
    msq_io_file *made, *to;
    assert_ok(msq_io_file_create(part_path, 1, &made));
    to = made;
    WRONG(ARGUMENT, "file is NULL", to = NULL);
    (void)TRY(msq_io_file_finish(to));
    msq_io_file_release(made);
  }
  remove(part_path);
  REFUSALS("msq_io_surface_save") {
    const msq_model* of = model;
    const char* path = part_path;
    int32_t format = MSQ_SURFACE_STL, replace = 1;
    msq_surface_def def;
    assert_ok(msq_surface_def_init(&def, sizeof def));
    def.pitch = 1;
    wrong_enum(table, &replace, "replace", 0, 1);
    WRONG(ARGUMENT, "path is NULL", path = NULL);
    WRONG(IO, "No such file", path = "none/none");
    WRONG(ARGUMENT, "pitch is -1", def.pitch = -1);
    WRONG(ARGUMENT, "format is 3", format = 3);
    WRONG(ARGUMENT, "model is NULL", of = NULL);
    (void)TRY(msq_io_surface_save(of, &def, format, path, replace, NULL));
  }
  remove(part_path);
  REFUSALS("msq_io_picture_save") {
    static const uint8_t pixels[64];
    const uint8_t* at = pixels;
    const char* path = part_path;
    uint32_t width = 2, height = 2, channels = 3;
    uint64_t stride = 0;
    int32_t replace = 1;
    wrong_enum(table, &replace, "replace", 0, 1);
    WRONG(ARGUMENT, "path is NULL", path = NULL);
    WRONG(ARGUMENT, "0 x 2", width = 0);
    WRONG(ARGUMENT, "2 x 0", height = 0);
    WRONG(ARGUMENT, "channels is 2", channels = 2);
    WRONG(ARGUMENT, "stride is 5 bytes; a row has 6", stride = 5);
    WRONG(LIMIT, "40000 x 40000|has 4800040000 bytes|the limit is 2147483647",
          width = height = 40000);
    WRONG(LIMIT, "has 1.8446744075857e+19 bytes", width = height = 2147483648u; channels = 4);
    WRONG(LIMIT, "2147483648", width = 2147483648u);
    WRONG(ARGUMENT, "pixels is NULL", at = NULL);
    (void)TRY(msq_io_picture_save(path, width, height, channels, at, stride, replace));
  }
  remove(part_path);
}

static void wrong_writer(refusals* table, msq_io_writer_def* def) {
  wrong_sizes(table, def, sizeof *def, sizeof *def);
  WRONG(ARGUMENT, "threads is 257;|from 0 to 256", def->threads = 257);
  wrong_enum(table, &def->replace, "replace", 0, 1);
}

static msq_io_writer_def* any_writer_def(void) {
  msq_io_writer_def* def = (msq_io_writer_def*)definition(1);
  assert_ok(msq_io_writer_def_init(def, sizeof *def));
  return def;
}

static void wrong_name(refusals* table, const char** name, const char* what) {
  static const char* const names[] = {"", "a/b", "a\\b", ".a", "a\n", "a:"};
  static char many[66];
  memset(many, 'a', 65);
  for (size_t i = 0; i < COUNT_OF(names); ++i)
    WRONG(ARGUMENT, words_of("%s", what), *name = names[i]);
  WRONG(ARGUMENT, words_of("%s has 65 bytes", what), *name = many);
  RIGHT(*name = many + 1);
}

static void writers(void** state) {
  (void)state;
  REFUSALS("msq_io_png_create") {
    const msq_slicer* slicer = bits;
    const char* path = part_path;
    msq_io_writer_def* writer_def = any_writer_def();
    msq_io_png_def* def = (msq_io_png_def*)definition(0);
    msq_io_writer** writer = (msq_io_writer**)output(0);
    assert_ok(msq_io_png_def_init(def, sizeof *def));
    wrong_writer(table, writer_def);
    WRONG(ARGUMENT, "first_layer is 12; the slicer has 12", writer_def->first_layer = 12);
    WRONG(ARGUMENT, "layer_count is 0", writer_def->layer_count = 0);
    WRONG(ARGUMENT, "layer_count is 13", writer_def->layer_count = 13);
    WRONG(ARGUMENT, "layer_count is 11 from layer 2", writer_def->layer_count = 11;
          writer_def->first_layer = 2);
    RIGHT(writer_def->layer_count = 10; writer_def->first_layer = 2);
    wrong_sizes(table, def, sizeof *def, sizeof *def);
    wrong_enum(table, &def->level, "level", 0, 9);
    WRONG(ARGUMENT, "digits is 0;|1 to 20", def->digits = 0);
    WRONG(ARGUMENT, "digits is 21;", def->digits = 21);
    wrong_name(table, &def->prefix, "prefix");
    WRONG(ARGUMENT, "path is NULL", path = NULL);
    WRONG(ARGUMENT, "path is empty", path = "");
    WRONG(IO, "cannot create the folder|No such file", path = "none/none");
    WRONG(IO, ": no?e/\xc3\xa9?", path = "no\ne/\xc3\xa9\xff");
    WRONG(IO, "not that of a folder", path = "/dev/null");
    RIGHT(writer_def = NULL);
    RIGHT(def = NULL);
    WRONG(ARGUMENT, "slicer is NULL", slicer = NULL);
    WRONG(ARGUMENT, "writer is NULL", writer = NULL);
    if (TRY(msq_io_png_create(slicer, path, writer_def, def, writer)))
      msq_io_writer_release(*writer);
  }
  REFUSALS("msq_io_svg_create") {
    const msq_slicer* slicer = bits;
    const char* path = part_path;
    msq_io_writer_def* writer_def = any_writer_def();
    msq_io_svg_def* def = (msq_io_svg_def*)definition(0);
    msq_io_writer** writer = (msq_io_writer**)output(0);
    assert_ok(msq_io_svg_def_init(def, sizeof *def));
    wrong_writer(table, writer_def);
    wrong_sizes(table, def, sizeof *def, sizeof *def);
    wrong_enum(table, &def->layout, "layout", 1, 2);
    wrong_number(table, &def->units, "units");
    WRONG(ARGUMENT, "units is 0;", def->units = 0);
    WRONG(ARGUMENT, "decimals is 13;", def->decimals = 13);
    WRONG(ARGUMENT, "digits is 0;", def->digits = 0);
    wrong_name(table, &def->prefix, "prefix");
    WRONG(ARGUMENT, "path is NULL", path = NULL);
    WRONG(IO, "No such file", path = "none/none");
    RIGHT(def = NULL);
    WRONG(ARGUMENT, "slicer is NULL", slicer = NULL);
    WRONG(ARGUMENT, "writer is NULL", writer = NULL);
    if (TRY(msq_io_svg_create(slicer, path, writer_def, def, writer)))
      msq_io_writer_release(*writer);
  }
}

static void wrong_panel(refusals* table, msq_io_panel_def* panel) {
  wrong_sizes(table, panel, sizeof *panel, sizeof *panel);
  wrong_enum(table, &panel->portrait, "portrait", 0, 1);
  for (int axis = 0; axis < 2; ++axis) {
    WRONG(ARGUMENT, "pixels of the panel is 0", panel->pixels[axis] = 0);
    WRONG(ARGUMENT, "size of the panel is 0", panel->size[axis] = 0);
    wrong_number(table, &panel->size[axis], "size of the panel");
    wrong_enum(table, &panel->mirror[axis], "mirror of the panel", 0, 1);
  }
}

static void archives(void** state) {
  (void)state;
  REFUSALS("msq_io_panel_plan") {
    const msq_model* of = model;
    static const double heights[2] = {0.5, 1};
    msq_io_panel_def* panel = (msq_io_panel_def*)definition(0);
    msq_slicer_def* plan = (msq_slicer_def*)output(0);
    assert_ok(msq_io_panel_def_init(panel, sizeof *panel));
    assert_ok(msq_slicer_def_init(plan, sizeof *plan));
    plan->layer_height = 0.5;
    wrong_panel(table, panel);
    WRONG(ARGUMENT, "layer_height of plan is 0", plan->layer_height = 0);
    RIGHT(plan->layer_height = 0; plan->layer_z = heights; plan->layer_z_count = 2);
    WRONG(ARGUMENT, "struct_size of plan is 8", plan->struct_size = 8);
    WRONG(ARGUMENT, "4 mm wide along x; the panel has 3.9 mm", panel->size[0] = 3.9);
    WRONG(ARGUMENT, "4 mm wide along y; the panel has 3.5 mm", panel->size[1] = 3.5);
    WRONG(LIMIT, "layers; the limit", plan->layer_height = 1e-12);
    RIGHT(panel = NULL);
    WRONG(ARGUMENT, "model is NULL", of = NULL);
    WRONG(ARGUMENT, "plan is NULL", plan = NULL);
    (void)TRY(msq_io_panel_plan(of, panel, plan));
  }
  REFUSALS("msq_io_sl1_create") {
    const msq_slicer* slicer = panel_layers;
    const char* path = part_path;
    msq_io_writer_def* writer_def = any_writer_def();
    msq_io_sl1_def* def = (msq_io_sl1_def*)definition(0);
    msq_io_panel_def* panel = (msq_io_panel_def*)definition(2);
    msq_io_writer** writer = (msq_io_writer**)output(0);
    assert_ok(msq_io_sl1_def_init(def, sizeof *def));
    assert_ok(msq_io_panel_def_init(panel, sizeof *panel));
    def->panel = panel;
    wrong_writer(table, writer_def);
    wrong_sizes(table, def, sizeof *def, sizeof *def);
    wrong_panel(table, panel);
    wrong_enum(table, &def->level, "level", 0, 9);
    WRONG(ARGUMENT, "faded_layers is 1000001", def->faded_layers = 1000001);
    wrong_number(table, &def->exposure_time, "exposure_time");
    wrong_number(table, &def->initial_exposure_time, "initial_exposure_time");
    wrong_number(table, &def->fast_tilt_time, "fast_tilt_time");
    wrong_number(table, &def->slow_tilt_time, "slow_tilt_time");
    wrong_number(table, &def->area_fill, "area_fill");
    wrong_number(table, &def->layer_height, "layer_height");
    WRONG(ARGUMENT, "exposure_time is -1;", def->exposure_time = -1);
    WRONG(ARGUMENT, "layer_height is 0.6; the layers are 0.5 apart", def->layer_height = 0.6);
    RIGHT(def->layer_height = 0.5);
    WRONG(ARGUMENT, "layer_height is 0; with one layer", slicer = one_layer);
    RIGHT(slicer = one_layer; def->layer_height = 0.5);
    RIGHT(writer_def->layer_count = 1);
    WRONG(ARGUMENT, "is 0.6|0.5 apart", writer_def->layer_count = 1; def->layer_height = 0.6);
    wrong_name(table, &def->job, "job");
    WRONG(ARGUMENT, "printer_model has a control character", def->printer_model = "a\nb = c");
    WRONG(ARGUMENT, "printer_variant has a control", def->printer_variant = "a\n");
    WRONG(ARGUMENT, "material has a control", def->material = "a\r");
    WRONG(ARGUMENT, "settings: \"key=value\"", def->settings = "key=value\n");
    WRONG(ARGUMENT, "settings: \"key = value\"", def->settings = "key = value");
    WRONG(ARGUMENT, "the key exposure_time", def->settings = "exposure_time = 3\n");
    WRONG(ARGUMENT, "the key twice", def->settings = "twice = 3\ntwice = 4\n");
    RIGHT(def->settings = "gamma_correction = 1\nnotes = \n");
    WRONG(ARGUMENT, "created is 1;", def->created = 1);
    WRONG(ARGUMENT, "created is -1;", def->created = -1);
    RIGHT(def->created = 1766000000);
    WRONG(ARGUMENT, "layers have 1440 x 2560 pixels;|2560 x 1440", panel->portrait = 0);
    WRONG(ARGUMENT, "layers have 53 x 41 pixels;|1440 x 2560", slicer = bits);
    WRONG(ARGUMENT, "layer 1 is at z = 1;|0.75 apart with this one at 1.25", slicer = uneven);
    WRONG(ARGUMENT, "layer 1 is at z = 1;", slicer = uneven; writer_def->layer_count = 2);
    WRONG(ARGUMENT, "path is NULL", path = NULL);
    WRONG(IO, "No such file", path = "none/none");
    RIGHT(def = NULL);
    WRONG(ARGUMENT, "slicer is NULL", slicer = NULL);
    WRONG(ARGUMENT, "writer is NULL", writer = NULL);
    if (TRY(msq_io_sl1_create(slicer, path, writer_def, def, writer, NULL)))
      msq_io_writer_release(*writer);
  }
  assert_int_equal(access(part_path, F_OK), -1);
}

static void layers(void** state) {
  (void)state;
  msq_io_writer* writer;
  assert_ok(msq_io_png_create(bits, "refused", NULL, NULL, &writer));
  assert_refused(msq_io_writer_layer(writer, NULL), MSQ_E_ARGUMENT, "layer is NULL");
  assert_refused(msq_io_writer_layer(NULL, NULL), MSQ_E_ARGUMENT, "user is NULL");
  REFUSALS("msq_io_writer_finish") {
    msq_io_writer *made, *to;
    assert_ok(msq_io_png_create(bits, "refused", NULL, NULL, &made));
    assert_ok(msq_slicer_run(bits, 0, UINT64_MAX, msq_io_writer_layer, made, NULL));
    to = made;
    WRONG(ARGUMENT, "writer is NULL", to = NULL);
    if (TRY(msq_io_writer_finish(to))) remove_folder("refused");
    msq_io_writer_release(made);
  }
  msq_io_writer_release(writer);
  msq_io_writer_release(NULL);
  msq_io_file_release(NULL);
  assert_int_equal(msq_io_version(), MSQ_VERSION);
}

static void threemf(void** state) {
  static const double vertices[4][3] = {{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {0, 0, 3}};
  msq_structure* lattice = make_lattice(context);
  msq_strut_graph *struts, *none;
  msq_struts_def box;
  (void)state;
  assert_ok(msq_struts_def_init(&box, sizeof box));
  for (int axis = 0; axis < 3; ++axis) box.max[axis] = 2;
  assert_ok(msq_structure_strut_graph(context, lattice, &box, &struts, NULL));
  for (int axis = 0; axis < 3; ++axis) box.max[axis] = 0;
  assert_ok(msq_structure_strut_graph(context, lattice, &box, &none, NULL));
  REFUSALS("msq_io_beams_save") {
    uint32_t triangles[6] = {0, 2, 1, 0, 1, 3};
    double corners[4][3];
    const msq_strut_graph* graph = struts;
    msq_io_beams_def* def = (msq_io_beams_def*)definition(0);
    msq_mesh_def mesh;
    const char* path = part_path;
    int32_t replace = 1;
    memcpy(corners, vertices, sizeof corners);
    assert_ok(msq_mesh_def_init(&mesh, sizeof mesh));
    mesh.vertices = corners;
    mesh.vertex_count = 4;
    mesh.triangles = triangles;
    mesh.triangle_count = 2;
    assert_ok(msq_io_beams_def_init(def, sizeof *def));
    def->mesh = &mesh;
    wrong_enum(table, &replace, "replace", 0, 1);
    wrong_enum(table, &def->clipping, "clipping", 0, 2);
    WRONG(ARGUMENT, "struct_size of def is 4", def->struct_size = 4);
    WRONG(ARGUMENT, "mesh is NULL", def->clipping = 1; def->mesh = NULL);
    WRONG(ARGUMENT, "struct_size of mesh is 4", mesh.struct_size = 4);
    WRONG(ARGUMENT, "vertices is NULL", mesh.vertices = NULL);
    WRONG(ARGUMENT, "triangles is NULL", mesh.triangles = NULL);
    WRONG(ARGUMENT, "vertex_stride is 8|24", mesh.vertex_stride = 8);
    WRONG(ARGUMENT, "coordinate_type", mesh.coordinate_type = 7);
    WRONG(MESH, "no triangles", mesh.triangle_count = 0);
    WRONG(MESH, "triangle 1|index 4|4 vertices", triangles[5] = 4);
    WRONG(MESH, "vertex 2|not finite", corners[2][1] = NAN);
    WRONG(LIMIT, "4294967296", mesh.vertex_count = (uint64_t)1 << 32);
    RIGHT(def = NULL);
    WRONG(ARGUMENT, "no struts", graph = none);
    WRONG(ARGUMENT, "graph is NULL", graph = NULL);
    WRONG(ARGUMENT, "path is NULL", path = NULL);
    WRONG(IO, "none/none", path = "none/none");
    (void)TRY(msq_io_beams_save(graph, def, path, replace));
    remove(part_path);
  }
  REFUSALS("msq_io_slices_create") {
    const msq_slicer* slicer = bits;
    const char* path = part_path;
    msq_io_writer_def* writer_def = (msq_io_writer_def*)definition(0);
    msq_io_slices_def* def = (msq_io_slices_def*)definition(1);
    msq_io_writer** writer = (msq_io_writer**)output(0);
    assert_ok(msq_io_writer_def_init(writer_def, sizeof *writer_def));
    assert_ok(msq_io_slices_def_init(def, sizeof *def));
    WRONG(ARGUMENT, "struct_size of def is 4", def->struct_size = 4);
    WRONG(ARGUMENT, "reserved is 1", def->reserved = 1);
    WRONG(ARGUMENT, "units is 0", def->units = 0);
    WRONG(ARGUMENT, "layer_height is -1", def->layer_height = -1);
    WRONG(ARGUMENT, "layer_height is 0|one layer", slicer = one_layer);
    RIGHT(slicer = one_layer; def->layer_height = 0.5);
    RIGHT(writer_def->layer_count = 1);
    WRONG(ARGUMENT, "first_layer is 12", writer_def->first_layer = 12);
    RIGHT(def = NULL; writer_def = NULL);
    WRONG(ARGUMENT, "slicer is NULL", slicer = NULL);
    WRONG(ARGUMENT, "path is NULL", path = NULL);
    WRONG(IO, "none/none", path = "none/none");
    WRONG(ARGUMENT, "writer is NULL", writer = NULL);
    if (TRY(msq_io_slices_create(slicer, path, writer_def, def, writer)))
      msq_io_writer_release(*writer);
  }
  msq_strut_graph_release(none);
  msq_strut_graph_release(struts);
  msq_structure_release(lattice);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(sizes),   cmocka_unit_test(report_sizes),
                                     cmocka_unit_test(files),   cmocka_unit_test(threemf),
                                     cmocka_unit_test(writers), cmocka_unit_test(archives),
                                     cmocka_unit_test(layers)};
  return cmocka_run_group_tests(tests, begin_tests, end_tests);
}
