/* SPDX-License-Identifier: Apache-2.0
 * What functions of documents refuse. What is wrong in a document: test_msq_document_errors.c. */
#include "documents.h"
#include "wrong_values.h"

static msq_context* context;
static const char* const text =
    "{\"msq_model\": 1, \"scales\": [{\"shape\": {\"box\": {\"min\": [0, 0, 0], \"max\": [1, 1, "
    "1]}}}], \"slicing\": {}, \"view\": {\"direction\": [0, 0, 1], \"width\": 8, \"height\": 8}}";

static void wrong_document_def(refusals* table, msq_document_def* def) {
  wrong_sizes(table, def, sizeof *def, sizeof *def);
  wrong_enum(table, &def->files, "files", 0, 2);
  WRONG(ARGUMENT, "max_depth is 1025|at most 1024", def->max_depth = 1025);
  RIGHT(def->max_depth = 1024);
  RIGHT(def->max_bytes = 0; def->max_values = 0; def->max_depth = 0; def->max_files = 0;
        def->max_file_bytes = 0; def->max_triangles = 0);
  RIGHT(def->base_directory = "nowhere");
}

static void documents(void** state) {
  (void)state;
  REFUSALS("msq_document_from_json") {
    const char* json = text;
    uint64_t bytes = strlen(text);
    msq_context* owner = context;
    msq_job* job = NULL;
    msq_document_def* def = (msq_document_def*)definition(0);
    msq_document** document = (msq_document**)output(0);
    assert_ok(msq_document_def_init(def, sizeof *def));
    wrong_document_def(table, def);
    WRONG(ARGUMENT, "context is NULL", owner = NULL);
    WRONG(ARGUMENT, "text is NULL", json = NULL);
    WRONG(LIMIT, "max_bytes is 3", def->max_bytes = 3);
    WRONG(ARGUMENT, "1:2: ", bytes = 1);
    WRONG(CANCELLED, "cancelled", job = cancelled_job());
    RIGHT(def = NULL);
    WRONG(ARGUMENT, "document is NULL", document = NULL);
    if (TRY(msq_document_from_json(owner, json, bytes, def, document, job)))
      msq_document_release(*document);
  }
  REFUSALS("msq_document_from_file") {
    const char* path = MSQ_SOURCE_DIR "/examples/models/scales.json";
    msq_context* owner = context;
    msq_job* job = NULL;
    msq_document_def* def = (msq_document_def*)definition(0);
    msq_document** document = (msq_document**)output(0);
    assert_ok(msq_document_def_init(def, sizeof *def));
    wrong_document_def(table, def);
    WRONG(ARGUMENT, "context is NULL", owner = NULL);
    WRONG(ARGUMENT, "path is NULL", path = NULL);
    WRONG(IO, "nowhere.json", path = "nowhere.json");
    WRONG(LIMIT, "max_bytes is 3", def->max_bytes = 3);
    WRONG(CANCELLED, "cancelled", job = cancelled_job());
    RIGHT(def = NULL);
    WRONG(ARGUMENT, "document is NULL", document = NULL);
    if (TRY(msq_document_from_file(owner, path, def, document, job)))
      msq_document_release(*document);
  }
}

static void parts_of_documents(void** state) {
  (void)state;
  msq_document* known = read_document(context, text);
  REFUSALS("msq_document_info") {
    msq_document* document = known;
    msq_document_report* report = (msq_document_report*)output(0);
    report->struct_size = sizeof *report;
    WRONG(ARGUMENT, "document is NULL", document = NULL);
    WRONG(ARGUMENT, "struct_size of report is 4", report->struct_size = 4);
    WRONG(ARGUMENT, "report is NULL", report = NULL);
    TRY(msq_document_info(document, report));
  }
  REFUSALS("msq_document_model") {
    msq_document* document = known;
    msq_model** model = (msq_model**)output(0);
    WRONG(ARGUMENT, "document is NULL", document = NULL);
    WRONG(ARGUMENT, "model is NULL", model = NULL);
    if (TRY(msq_document_model(document, model))) msq_model_release(*model);
  }
  REFUSALS("msq_document_slicing") {
    msq_document* document = known;
    msq_slicer_def* def = (msq_slicer_def*)output(0);
    def->struct_size = sizeof *def;
    WRONG(ARGUMENT, "document is NULL", document = NULL);
    WRONG(ARGUMENT, "struct_size of def is 4", def->struct_size = 4);
    WRONG(ARGUMENT, "def is NULL", def = NULL);
    TRY(msq_document_slicing(document, def));
  }
  REFUSALS("msq_document_view") {
    msq_document* document = known;
    msq_camera* camera = (msq_camera*)output(0);
    msq_render_def* render = (msq_render_def*)output(1);
    camera->struct_size = sizeof *camera;
    render->struct_size = sizeof *render;
    WRONG(ARGUMENT, "document is NULL", document = NULL);
    WRONG(ARGUMENT, "struct_size of camera is 4", camera->struct_size = 4);
    WRONG(ARGUMENT, "struct_size of render is 4", render->struct_size = 4);
    WRONG(ARGUMENT, "camera is NULL", camera = NULL);
    WRONG(ARGUMENT, "render is NULL", render = NULL);
    TRY(msq_document_view(document, camera, render));
  }
  msq_document_release(known);
}

static int32_t no_values(void* user, const double* points, uint64_t count, double* values) {
  (void)user;
  (void)points;
  memset(values, 0, count * sizeof *values);
  return 0;
}

static void models(void** state) {
  (void)state;
  msq_host_field_def host;
  msq_field* field;
  msq_foam_def foam;
  msq_structure* structure;
  assert_ok(msq_host_field_def_init(&host, sizeof host));
  host.evaluate = no_values;
  host.low = 0;
  host.high = 0.25;
  assert_ok(msq_field_host(context, &host, &field));
  assert_ok(msq_foam_def_init(&foam, sizeof foam));
  foam.radius.field = field;
  assert_ok(msq_structure_foam(context, &foam, &structure));
  msq_field_release(field);
  msq_model* of_host = make_model(context, make_box(context), structure, NULL);
  /* A pyramid, of 4 * 3 numbers. */
  static const double corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  static const uint32_t triangles[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  msq_mesh_def mesh;
  assert_ok(msq_mesh_def_init(&mesh, sizeof mesh));
  mesh.vertices = corners;
  mesh.vertex_count = 4;
  mesh.triangles = &triangles[0][0];
  mesh.triangle_count = 4;
  msq_model* of_mesh = make_shape_model(context, make_mesh(context, &mesh));
  REFUSALS("msq_model_to_json") {
    static char room_of_text[output_bytes];
    msq_model* model = of_mesh;
    char* json = room_of_text;
    uint64_t room = sizeof room_of_text;
    uint64_t* bytes = (uint64_t*)output(0);
    msq_slicer_def slicing;
    msq_camera camera;
    msq_render_def render;
    msq_contours_def contours;
    msq_output_def outputs[2];
    msq_json_def* def = (msq_json_def*)definition(0);
    assert_ok(msq_json_def_init(def, sizeof *def));
    assert_ok(msq_slicer_def_init(&slicing, sizeof slicing));
    assert_ok(msq_camera_init(&camera, sizeof camera));
    assert_ok(msq_render_def_init(&render, sizeof render));
    assert_ok(msq_contours_def_init(&contours, sizeof contours));
    for (int i = 0; i < 2; ++i) assert_ok(msq_output_def_init(&outputs[i], sizeof outputs[i]));
    outputs[1].output = MSQ_LAYER_CONTOURS;
    outputs[1].contours = &contours;
    slicing.outputs = outputs;
    slicing.output_count = 2;
    wrong_sizes(table, def, sizeof *def, sizeof *def);
    WRONG(ARGUMENT, "model is NULL", model = NULL);
    WRONG(ARGUMENT, "reserved is 1", def->reserved = 1);
    WRONG(ARGUMENT, "text is NULL", json = NULL);
    WRONG(ARGUMENT, "room is 10|the text has", room = 10);
    RIGHT(room = 0; json = NULL);
    WRONG(UNSUPPORTED, "scales[1].structure.foam.radius: a field is computed by the host",
          model = of_host);
    WRONG(UNSUPPORTED, "title: |not UTF-8", def->title = "\xff");
    WRONG(LIMIT, "scales[0].shape.mesh.vertices would be 12 numbers|max_numbers is 11",
          def->max_numbers = 11);
    RIGHT(def->max_numbers = 12);
    RIGHT(def->camera = &camera; def->render = &render; def->slicing = &slicing);
    WRONG(ARGUMENT, "render is NULL", def->camera = &camera);
    WRONG(ARGUMENT, "camera is NULL", def->render = &render);
    WRONG(ARGUMENT, "struct_size of slicing is 4", def->slicing = &slicing;
          slicing.struct_size = 4);
    WRONG(ARGUMENT, "slicing.output is 99", def->slicing = &slicing; slicing.output = 99);
    WRONG(ARGUMENT, "slicing.orientation is 9", def->slicing = &slicing; slicing.orientation = 9);
    WRONG(ARGUMENT, "slicing.layer_height is nan|finite", def->slicing = &slicing;
          slicing.layer_height = NAN);
    WRONG(ARGUMENT, "view.camera.eye is [inf, 0, 0]|finite", def->camera = &camera;
          def->render = &render; camera.eye[0] = INFINITY);
    WRONG(ARGUMENT, "slicing.outputs[1].contours.tolerance is nan|finite", def->slicing = &slicing;
          contours.tolerance = NAN);
    WRONG(ARGUMENT, "slicing.outputs[0].output is 77", def->slicing = &slicing;
          outputs[0].output = 77);
    RIGHT(def = NULL);
    WRONG(ARGUMENT, "bytes is NULL", bytes = NULL);
    TRY(msq_model_to_json(model, def, json, room, bytes));
  }
  msq_model_release(of_mesh);
  msq_model_release(of_host);
}

static void builds_without_json_say_so(void** state) {
  (void)state;
  msq_document* document = (msq_document*)untouched();
  assert_refused(msq_document_from_json(context, text, strlen(text), NULL, &document, NULL),
                 MSQ_E_UNSUPPORTED, "MSQ_WITH_JSON");
  assert_refused(msq_document_from_file(context, "m.json", NULL, &document, NULL),
                 MSQ_E_UNSUPPORTED, "MSQ_WITH_JSON");
  assert_ptr_equal(document, untouched());
  msq_model* model = make_box_model(context);
  uint64_t bytes = 7;
  assert_refused(msq_model_to_json(model, NULL, NULL, 0, &bytes), MSQ_E_UNSUPPORTED,
                 "MSQ_WITH_JSON");
  assert_int_equal(bytes, 7);
  msq_model_release(model);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(documents),
      cmocka_unit_test(parts_of_documents),
      cmocka_unit_test(models),
  };
  const struct CMUnitTest without[] = {
      cmocka_unit_test(builds_without_json_say_so),
  };
  context = make_context();
  const int failed = MSQ_WITH_JSON ? cmocka_run_group_tests(tests, NULL, NULL)
                                   : cmocka_run_group_tests(without, NULL, NULL);
  msq_context_release(context);
  return failed;
}
