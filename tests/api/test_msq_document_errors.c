/* SPDX-License-Identifier: Apache-2.0
 * What is wrong with a document: the status, line and column, path and reason of the message. */
#include "documents.h"

static msq_context* context;

/* A document whose second line is a shape, a structure or a field. */
#define BOX "{\"box\": {\"min\": [0, 0, 0], \"max\": [4, 4, 4]}}"
#define SHAPE(text) "{\"msq_model\": 1, \"scales\": [{\"shape\":\n" text "\n}]}"
#define STRUCTURE(text)                                                          \
  "{\"msq_model\": 1, \"scales\": [{\"shape\": " BOX "}, {\"structure\":\n" text \
  "\n"                                                                           \
  "}]}"
#define FIELD(text) STRUCTURE("{\"foam\": {\"radius\":\n" text "\n}}")
#define TOP(text) "{\"msq_model\": 1, \"scales\": [{\"shape\": " BOX "}],\n" text "}"

static const struct {
  const char* text;
  msq_status status;
  const char* words; /* separated by '|'; the first begins the message */
} rows[] = {
    /* JSON itself */
    {"", MSQ_E_ARGUMENT, "1:1: |unexpected end of input"},
    {"{", MSQ_E_ARGUMENT, "1:2: |unexpected end of input"},
    {"{\"msq_model\": 1,}", MSQ_E_ARGUMENT, "1:17: |unexpected '}'"},
    {"{\"msq_model\": 1\n \"title\": 2}", MSQ_E_ARGUMENT, "2:8: |unexpected string literal"},
    {"{'a': 1}", MSQ_E_ARGUMENT, "1:2: |invalid literal"},
    {"{\"a\": 1} // comment", MSQ_E_ARGUMENT, "1:10: |invalid literal"},
    {"{\"a\": 1} {}", MSQ_E_ARGUMENT, "1:10: |expected end of input"},
    {"{\"a\": NaN}", MSQ_E_ARGUMENT, "1:7: |invalid literal"},
    {"{\"a\": 01}", MSQ_E_ARGUMENT, "1:8: |unexpected number"},
    {"{\"a\": 1e999}", MSQ_E_ARGUMENT, "1:|number overflow"},
    {"{\"a\": \"\\u0000\"}", MSQ_E_ARGUMENT, "1:7: |character 0"},
    {"{\"a\": \"\xff\"}", MSQ_E_ARGUMENT, "1:|ill-formed UTF-8"},
    {"{\"a\": 1,\n  \"b\": 2,\n  \"a\": 3}", MSQ_E_ARGUMENT, "3:3: |\"a\"|twice|1:2"},
    /* The document */
    {"[]", MSQ_E_ARGUMENT, "1:1: the document: |is a list; it must be an object"},
    {"{}", MSQ_E_ARGUMENT, "1:1: the document: |no key msq_model"},
    {"{\"msq_model\": 2}", MSQ_E_UNSUPPORTED, "1:2: msq_model: |is 2; this msq reads version 1"},
    {"{\"msq_model\": \"1\"}", MSQ_E_UNSUPPORTED, "1:2: msq_model: |is a text; |version 1"},
    {"{\"msq_model\": 1.5}", MSQ_E_UNSUPPORTED, "1:2: msq_model: |is 1.5; |version 1"},
    {"{\"msq_model\": 1}", MSQ_E_ARGUMENT, "1:1: the document: |neither scales nor regions"},
    {TOP("\"regions\": []"), MSQ_E_ARGUMENT, "1:1: the document: |both scales and regions"},
    {TOP("\"colour\": 1"), MSQ_E_ARGUMENT, "2:1: colour: |unknown key; the keys here are scales"},
    {TOP("\"title\": 1"), MSQ_E_ARGUMENT, "2:1: title: |a whole number; it must be a text"},
    {TOP("\"shapes\": 1"), MSQ_E_ARGUMENT, "2:1: shapes: |must be an object"},
    {TOP("\"shapes\": {\"a\": \"b\"}"), MSQ_E_ARGUMENT, "2:12: shapes.a: |must be an object"},
    {TOP("\"shapes\": {\"a\": {\"cube\": {}}}"), MSQ_E_ARGUMENT,
     "2:18: shapes.a.cube: |unknown kind|file, mesh, box"},
    {TOP("\"fields\": {\"a\": {\"map\": {\"argument\": \"a\", \"curve\": [[0, 1]]}}}"),
     MSQ_E_ARGUMENT, "2:26: fields.a.map.argument: |contain itself"},
    {TOP("\"fields\": {\"a\": {\"map\": {\"argument\": \"b\"}}, \"b\": {\"map\": {\"argument\": "
         "\"a\"}}}"),
     MSQ_E_ARGUMENT, "2:59: fields.b.map.argument: |contain itself"},
    {"{\"msq_model\": 1, \"scales\": []}", MSQ_E_ARGUMENT, "1:|scale_count is 0"},
    {"{\"msq_model\": 1, \"scales\": [{}]}", MSQ_E_ARGUMENT, "1:|scale 0 must have a shape"},
    {"{\"msq_model\": 1, \"scales\": {}}", MSQ_E_ARGUMENT, "1:18: scales: |an object; |a list"},
    {"{\"msq_model\": 1, \"scales\": [7]}", MSQ_E_ARGUMENT,
     "1:29: scales[0]: |it must be an object"},
    {"{\"msq_model\": 1, \"scales\": [{\"shape\": " BOX ", \"skn\": 1}]}", MSQ_E_ARGUMENT,
     "1:86: scales[0].skn: |unknown key|shape, structure, skin, material, skin_material"},
    {"{\"msq_model\": 1, \"regions\": []}", MSQ_E_ARGUMENT, "1:1: the document: |count is 0"},
    {"{\"msq_model\": 1, \"regions\": [{}]}", MSQ_E_ARGUMENT,
     "1:30: regions[0]: |neither scales nor regions"},
    /* Shapes */
    {SHAPE("\"part\""), MSQ_E_ARGUMENT, "1:30: scales[0].shape: |\"part\", which is not in shapes"},
    {SHAPE("3"), MSQ_E_ARGUMENT, "1:30: scales[0].shape: |name of a definition"},
    {SHAPE("{}"), MSQ_E_ARGUMENT, "1:30: scales[0].shape: |one key"},
    {SHAPE("{\"box\": {}, \"sphere\": {}}"), MSQ_E_ARGUMENT, "1:30: scales[0].shape: |one key"},
    {SHAPE("{\"ball\": {}}"), MSQ_E_ARGUMENT, "2:2: scales[0].shape.ball: |unknown kind"},
    {SHAPE("{\"box\": 1}"), MSQ_E_ARGUMENT, "2:2: scales[0].shape.box: |must be an object"},
    {SHAPE("{\"box\": {}}"), MSQ_E_ARGUMENT, "2:2: scales[0].shape.box: |min"},
    {SHAPE("{\"box\": {\"min\": [0, 0, 0],\n \"max\": [1, 1]}}"), MSQ_E_ARGUMENT,
     "3:2: scales[0].shape.box.max: |2 elements; it must have 3"},
    {SHAPE("{\"box\": {\"min\": [0, 0, 0],\n \"max\": [1, \"1\", 1]}}"), MSQ_E_ARGUMENT,
     "3:13: scales[0].shape.box.max[1]: |is a text; it must be a number"},
    {SHAPE("{\"sphere\": {\"radius\": -1}}"), MSQ_E_ARGUMENT,
     "2:13: scales[0].shape.sphere.radius: |radius is -1"},
    {SHAPE("{\"sphere\": {\"radius\": null}}"), MSQ_E_ARGUMENT,
     "2:13: scales[0].shape.sphere.radius: |is null; it must be a number"},
    {SHAPE("{\"sphere\": {\"raduis\": 1}}"), MSQ_E_ARGUMENT,
     "2:13: scales[0].shape.sphere.raduis: |unknown key|center, radius"},
    {SHAPE("{\"all_space\": {\"a\": 1}}"), MSQ_E_ARGUMENT,
     "2:16: scales[0].shape.all_space.a: |unknown key; there must be none"},
    {SHAPE("{\"file\": {}}"), MSQ_E_ARGUMENT, "2:2: scales[0].shape.file: |no key file"},
    {SHAPE("{\"file\": {\"file\": 1}}"), MSQ_E_ARGUMENT,
     "2:11: scales[0].shape.file.file: |a text"},
    {SHAPE("{\"file\": {\"file\": \"\"}}"), MSQ_E_ARGUMENT, "2:11: |an empty path"},
    {SHAPE("{\"file\": {\"file\": \"/etc/passwd\"}}"), MSQ_E_ARGUMENT,
     "2:11: |\"/etc/passwd\"|relative"},
    {SHAPE("{\"file\": {\"file\": \"a/../../b.stl\"}}"), MSQ_E_ARGUMENT, "2:11: |must not have"},
    {SHAPE("{\"file\": {\"file\": \"..\"}}"), MSQ_E_ARGUMENT, "2:11: |must not have"},
    {SHAPE("{\"file\": {\"file\": \"..\\\\b.stl\"}}"), MSQ_E_ARGUMENT, "2:11: |relative"},
    {SHAPE("{\"file\": {\"file\": \"C:/b.stl\"}}"), MSQ_E_ARGUMENT, "2:11: |relative"},
    {SHAPE("{\"file\": {\"file\": \"b.stl\"}}"), MSQ_E_ARGUMENT, "2:11: |no base_directory"},
    {SHAPE("{\"file\": {\"file\": \"b.stl\", \"format\": \"step\"}}"), MSQ_E_ARGUMENT,
     "2:11: |base"},
    {SHAPE("{\"mesh\": {\"vertices\": [[0, 0]]}}"), MSQ_E_ARGUMENT,
     "2:24: scales[0].shape.mesh.vertices[0]: |2 elements; it must have 3"},
    {SHAPE("{\"mesh\": {\"vertices\": [[0, 0, 0]], \"triangles\": [[0, 0, -1]]}}"), MSQ_E_ARGUMENT,
     "2:57: scales[0].shape.mesh.triangles[0][2]: |is -1|from 0 to 4294967295"},
    {SHAPE("{\"mesh\": {\"vertices\": [[0, 0, 0]], \"triangles\": [[0, 0, 5]]}}"), MSQ_E_MESH,
     "2:2: scales[0].shape.mesh: |5"},
    {SHAPE("{\"voxels\": {}}"), MSQ_E_ARGUMENT, "2:2: scales[0].shape.voxels: |no key image"},
    {SHAPE("{\"voxels\": {\"image\": {}}}"), MSQ_E_ARGUMENT,
     "2:13: scales[0].shape.voxels.image: |neither file nor values"},
    {SHAPE("{\"voxels\": {\"image\": {\"values\": [1]}}}"), MSQ_E_ARGUMENT,
     "2:13: |no key value_type"},
    {SHAPE("{\"voxels\": {\"image\": {\"values\": [1], \"value_type\": \"uint8\", \"size\": [1, 1, "
           "2]}}}"),
     MSQ_E_ARGUMENT, "2:23: scales[0].shape.voxels.image.values: |1 elements; the size asks for 2"},
    {SHAPE(
         "{\"voxels\": {\"image\": {\"values\": [1, 2.5], \"value_type\": \"uint8\", \"size\": [1, "
         "1, 2]}}}"),
     MSQ_E_ARGUMENT, "2:37: scales[0].shape.voxels.image.values[1]: |whole number from 0 to 255"},
    {SHAPE(
         "{\"voxels\": {\"image\": {\"values\": [1, 2], \"value_type\": \"int8\", \"size\": [1, 1, "
         "2]}}}"),
     MSQ_E_ARGUMENT, "2:41: |\"int8\"; it must be one of float32"},
    {SHAPE("{\"voxels\": {\"image\": {\"values\": [1, 2], \"value_type\": \"uint8\", \"size\": [1, "
           "1, "
           "2]}}}"),
     MSQ_E_ARGUMENT, "2:73: |voxels.image.size|image.size[0] is 1; it must be from 2"},
    {SHAPE("{\"placed\": {\"original\": " BOX ", \"matrix\": [0]}}"), MSQ_E_ARGUMENT,
     "2:72: scales[0].shape.placed.matrix: |1 element; it must have 12"},
    {SHAPE("{\"placed\": {\"original\": " BOX "}}"), MSQ_E_ARGUMENT,
     "2:2: scales[0].shape.placed: |"},
    {SHAPE("{\"placed\": {\"matrix\": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0]}}"), MSQ_E_ARGUMENT,
     "2:2: scales[0].shape.placed: |original is NULL"},
    {SHAPE("{\"boolean\": {\"operation\": \"xor\"}}"), MSQ_E_ARGUMENT,
     "2:14: scales[0].shape.boolean.operation: |\"xor\"; it must be one of union"},
    {SHAPE("{\"offset\": {\"original\": " BOX ", \"distance\": 0}}"), MSQ_E_ARGUMENT,
     "2:72: scales[0].shape.offset.distance: |distance is 0"},
    /* Structures */
    {STRUCTURE("{\"foam\": {}}"), MSQ_E_ARGUMENT, "2:2: scales[1].structure.foam: |radius is 0"},
    {STRUCTURE("{\"foam\": {\n\"radius\": -0.5}}"), MSQ_E_ARGUMENT,
     "3:1: scales[1].structure.foam.radius: |radius|-0.5"},
    {STRUCTURE("{\"foam\": {\"radius\": 0.1, \"seed\": -1}}"), MSQ_E_ARGUMENT,
     "2:26: |seed: |is -1"},
    {STRUCTURE("{\"foam\": {\"radius\": 0.1, \"seed\": 1.5}}"), MSQ_E_ARGUMENT,
     "2:26: |seed: |1.5"},
    {STRUCTURE("{\"foam\": {\"radius\": 0.1, \"seed\": 18446744073709551616}}"), MSQ_E_ARGUMENT,
     "2:26: |seed: |is 1.844674407e+19|to 18446744073709551615"},
    {STRUCTURE("{\"foam\": {\"radius\": 0.1, \"seed\": -1.0}}"), MSQ_E_ARGUMENT,
     "2:26: |seed: |is -1;"},
    {STRUCTURE("{\"foam\": {\"radius\": 0.1, \"grid\": {\"cell_size\": [1, 0, 1]}}}"),
     MSQ_E_ARGUMENT, "2:35: scales[1].structure.foam.grid.cell_size: |grid.cell_size is 0"},
    {STRUCTURE("{\"foam\": {\"radius\": 0.1, \"grid\": {\"cell_size\": [1, 1e-80, 1]}}}"),
     MSQ_E_ARGUMENT, "2:52: scales[1].structure.foam.grid.cell_size[1]: |1e-80"},
    {STRUCTURE("{\"foam\": {\"radius\": 0.1, \"grid\": {\"size\": 1}}}"), MSQ_E_ARGUMENT,
     "2:35: scales[1].structure.foam.grid.size: |unknown key|origin, cell_size, rotation"},
    {STRUCTURE("{\"foam\": {\"radius\": 0.1, \"density\": 1e9}}"), MSQ_E_LIMIT, "2:26: |density"},
    {STRUCTURE("{\"foam\": {\"radius\": 0.1, \"method\": \"fast\"}}"), MSQ_E_ARGUMENT,
     "2:26: |method: |auto, point, method_2, direct, method_1"},
    {STRUCTURE("{\"functional\": {\"function\": \"gyroidd\"}}"), MSQ_E_ARGUMENT,
     "2:17: scales[1].structure.functional.function: |gyroid, schwarz_p"},
    {STRUCTURE("{\"functional\": {\"function\": \"expression\",\n\"expression\": \"sin(\"}}"),
     MSQ_E_ARGUMENT, "|"},
    {STRUCTURE("{\"functional\": {\"function\": \"expression\", \"expression\": \"k\", "
               "\"parameters\": {\"k\": \"1\"}}}"),
     MSQ_E_ARGUMENT, "2:77: scales[1].structure.functional.parameters.k: |must be a number"},
    {STRUCTURE("{\"functional\": {\"period\": {\"positions\": [0, 1], \"cell_sizes\": [1]}}}"),
     MSQ_E_ARGUMENT,
     "2:49: scales[1].structure.functional.period.cell_sizes: |1 element, but positions"},
    {STRUCTURE("{\"lattice\": {\"radius\": 0.1, \"cells\": [{\"unit\": 1}]}}"), MSQ_E_ARGUMENT,
     "2:40: scales[1].structure.lattice.cells[0].unit: |unknown key"},
    {STRUCTURE("{\"beams\": {\"nodes\": [[0, 0, 0]], \"beams\": [[0, 0]], \"radii\": []}}"),
     MSQ_E_ARGUMENT, "2:53: scales[1].structure.beams.radii: |0 elements, but beams has 1"},
    {STRUCTURE("{\"host\": {}}"), MSQ_E_ARGUMENT, "2:2: scales[1].structure.host: |unknown kind"},
    /* Fields */
    {FIELD("true"), MSQ_E_ARGUMENT, "2:11: scales[1].structure.foam.radius: |must be a number"},
    {FIELD("\"r\""), MSQ_E_ARGUMENT, "2:11: |\"r\", which is not in fields"},
    {FIELD("{\"radial\": {\"to_radius\": -1}}"), MSQ_E_ARGUMENT, "3:2: |radius.radial: |ascend"},
    {FIELD("{\"map\": {\"argument\": {\"radial\": {}}, \"curve\": [[0, 1], [1, 2], [1, 3]]}}"),
     MSQ_E_ARGUMENT, "3:64: scales[1].structure.foam.radius.map.curve[2]: |pair 2 of curve"},
    {FIELD("{\"expression\": {\"expression\": \"x\", \"low\": 2, \"high\": 1}}"), MSQ_E_ARGUMENT,
     "3:36: scales[1].structure.foam.radius.expression.low: |low is 2"},
    /* Materials */
    {TOP("\"materials\": {\"a\": {\"plain\": {}}}"), MSQ_E_ARGUMENT,
     "2:21: materials.a.plain: |id is 0"},
    {TOP("\"materials\": {\"a\": {\"plain\": {\"id\": 4294967296}}}"), MSQ_E_ARGUMENT,
     "2:31: materials.a.plain.id: |4294967296|to 4294967295"},
    /* Settings */
    {TOP("\"slicing\": {\"pitch\": [1]}"), MSQ_E_ARGUMENT, "2:13: slicing.pitch: |1 element"},
    {TOP("\"slicing\": {\"dpi\": 1}"), MSQ_E_ARGUMENT, "2:13: slicing.dpi: |unknown key"},
    {TOP("\"slicing\": {\"orientation\": [\"mirror_x\", \"mirror_x\"]}"), MSQ_E_ARGUMENT,
     "2:41: slicing.orientation[1]: |twice"},
    {TOP("\"slicing\": {\"outputs\": [{\"output\": \"png\"}]}"), MSQ_E_ARGUMENT,
     "2:26: slicing.outputs[0].output: |\"png\""},
    {TOP("\"view\": {}"), MSQ_E_ARGUMENT, "2:1: view: |neither camera nor direction"},
    {TOP("\"view\": {\"direction\": [0, 0, 1]}"), MSQ_E_ARGUMENT, "2:1: view: |width"},
    {TOP("\"view\": {\"direction\": [0, 0, 0], \"width\": 9, \"height\": 9}"), MSQ_E_ARGUMENT,
     "2:10: view.direction: |direction"},
    {TOP("\"view\": {\"direction\": [0, 0, 1], \"camera\": {\"eye\": [0, 0, 0]}}"), MSQ_E_ARGUMENT,
     "2:45: view.camera.eye: |direction fits it"},
    {TOP("\"view\": {\"camera\": {\"height\": -1}, \"width\": 9, \"height\": 9}"), MSQ_E_ARGUMENT,
     "2:|view.camera"},
};

static void documents_are_refused(void** state) {
  (void)state;
  int failures = 0;
  const int count = (int)(sizeof rows / sizeof rows[0]);
  for (int i = 0; i < count; ++i) {
    msq_document* document = (msq_document*)untouched();
    const msq_status status =
        msq_document_from_json(context, rows[i].text, strlen(rows[i].text), NULL, &document, NULL);
    const char* message = msq_error_message();
    int is_wrong = status != rows[i].status || document != (msq_document*)untouched();
    char words[256];
    snprintf(words, sizeof words, "%s", rows[i].words);
    if (!is_wrong && words[0] != '|') is_wrong = strncmp(message, words, strcspn(words, "|")) != 0;
    for (char* word = strtok(words, "|"); word && !is_wrong; word = strtok(NULL, "|"))
      is_wrong = !strstr(message, word);
    if (!is_wrong) continue;
    ++failures;
    print_error("%s\n  %s \"%s\"\n  not \"%s\"\n", rows[i].text, msq_status_name(status), message,
                rows[i].words);
  }
  if (failures) fail_msg("%d of %d rows failed", failures, count);
  print_message("%d rows\n", count);
}

/* A parser may take the character 0 for the end of the text. */
static void nothing_follows_the_character_0(void** state) {
  static const char text[] = TOP("\"title\": \"a\"") "\0 ]]";
  msq_document* document = (msq_document*)untouched();
  (void)state;
  assert_status(msq_document_from_json(context, text, sizeof text - 1, NULL, &document, NULL),
                MSQ_E_ARGUMENT);
  assert_message_has("2:14: the text has the character 0");
  assert_ptr_equal(document, untouched());
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(documents_are_refused),
      cmocka_unit_test(nothing_follows_the_character_0),
  };
  if (!MSQ_WITH_JSON) return 0; /* test_refusals_documents.c */
  context = make_context();
  const int failed = cmocka_run_group_tests(tests, NULL, NULL);
  msq_context_release(context);
  return failed;
}
