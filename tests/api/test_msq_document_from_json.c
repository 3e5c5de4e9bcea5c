/* SPDX-License-Identifier: Apache-2.0
 * Documents: what each key builds, that a written model is read as itself, settings. */
#include "documents.h"

static msq_context* context;

#define BOX "{\"box\": {\"min\": [0, 0, 0], \"max\": [4, 4, 4]}}"
#define MODEL_OF(shape, structure) \
  "{\"msq_model\": 1, \"scales\": [{\"shape\": " shape "}, {\"structure\": " structure "}]}"
#define COORDINATE(values)                                                                         \
  "{\"grid\": {\"image\": {\"value_type\": \"float64\", \"size\": [2, 2, 2], \"values\": [" values \
  "], \"grid\": {\"cell_size\": 4}}}}"
#define MAPPED \
  "{\"lattice\": {\"radius\": 0.1, \"warp\": {\"kind\": \"sampled\", \"u\": " COORDINATE( \
      "0, 3, 0, 3, 0, 3, 0, 3") ", \"v\": " COORDINATE("0, 0.5, 3, 3, 0, 0, 3, 3.5") ", \"w\": " \
      COORDINATE("0, 0, 0, 0, 3, 3, 3, 3") "}}}"
#define IN_BOX(structure) MODEL_OF(BOX, structure)
#define GYROID "{\"functional\": {\"level\": 0.3}}"
#define OF_SHAPE(shape) MODEL_OF(shape, GYROID)
#define OF_FIELD(field) IN_BOX("{\"foam\": {\"radius\": " field "}}")

/* Every kind and every key, at least once with a value that is not the default. */
static const char* const documents[] = {
    "{\"msq_model\": 1, \"$schema\": \"model.schema.json\", \"title\": \"a box\", \"scales\": "
    "[{\"shape\": " BOX "}]}",
    OF_SHAPE("{\"sphere\": {\"center\": [1, 2, 3], \"radius\": 2.5}}"),
    OF_SHAPE("{\"cylinder\": {\"from\": [0, 0, 0], \"to\": [1, 2, 0.1], \"radius\": 1}}"),
    OF_SHAPE("{\"all_space\": {}}"),
    OF_SHAPE("{\"mesh\": {\"vertices\": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], "
             "\"triangles\": [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]], \"winding_rule\": "
             "\"positive\"}}"),
    OF_SHAPE(
        "{\"voxels\": {\"image\": {\"value_type\": \"uint8\", \"size\": [2, 2, 3], \"values\": "
        "[0, 1, 2, 3, 4, 5, 250, 251, 252, 253, 254, 255], \"grid\": {\"origin\": [1, 0, 0], "
        "\"cell_size\": 0.5, \"rotation\": [0, -1, 0, 1, 0, 0, 0, 0, 1]}}, \"threshold\": 9.5, "
        "\"solid\": \"below\"}}"),
    OF_SHAPE("{\"voxels\": {\"image\": {\"value_type\": \"float32\", \"size\": [2, 2, 2], "
             "\"values\": [0, 0.1, 0.2, 0.3, 0.4, 1e-3, 6, 7]}, \"threshold\": 0.15}}"),
    OF_SHAPE("{\"voxels\": {\"image\": {\"value_type\": \"int16\", \"size\": [2, 2, 2], "
             "\"values\": [-32768, 1, 2, 3, 4, 5, 6, 32767]}}}"),
    OF_SHAPE("{\"placed\": {\"original\": " BOX
             ", \"matrix\": [0, -2, 0, 1, 2, 0, 0, 0.25, 0, 0, 2, 0]}}"),
    OF_SHAPE("{\"boolean\": {\"operation\": \"difference\", \"shapes\": [" BOX
             ", {\"sphere\": {\"center\": [0, 0, 0], \"radius\": 1}}]}}"),
    OF_SHAPE("{\"offset\": {\"original\": " BOX ", \"distance\": -0.5}}"),
    OF_FIELD("{\"gradient\": {\"from\": [0, 0, 0], \"from_value\": 0.1, \"to\": [0, 0, 4], "
             "\"to_value\": 0.3}}"),
    OF_FIELD("{\"radial\": {\"center\": [1, 1, 1], \"axis\": [0, 0, 1], \"from_radius\": 0.5, "
             "\"from_value\": 0.3, \"to_radius\": 2, \"to_value\": 0.1}}"),
    OF_FIELD(
        "{\"map\": {\"argument\": {\"radial\": {\"to_value\": 1}}, \"curve\": [[0, 0.1], [0.5, "
        "0.2], [1, 0.15]]}}"),
    OF_FIELD(
        "{\"grid\": {\"image\": {\"value_type\": \"float64\", \"size\": [2, 1, 1], \"values\": "
        "[0.1, 0.3]}}}"),
    OF_FIELD("{\"expression\": {\"expression\": \"a + b * x\", \"parameters\": {\"a\": 0.1, \"b\": "
             "0.05}, \"low\": 0.1, \"high\": 0.3}}"),
    OF_FIELD("{\"shape_distance\": {\"shape\": " BOX ", \"curve\": [[-2, 0.1], [0, 0.3]]}}"),
    OF_FIELD("{\"shape_distance\": {\"shape\": " BOX
             ", \"curve\": [[-2, 0.1], [0, 0.3]], \"step\": 0.5}}"),
    IN_BOX("{\"lattice\": {\"unit_cell\": \"octet\", \"radius\": 0.1, \"clusters\": 2, \"grid\": "
           "{\"origin\": [0.5, 0, 0], \"cell_size\": [1, 2, 3]}}}"),
    IN_BOX("{\"lattice\": {\"unit_cell\": \"custom\", \"radius\": 0.1, \"nodes\": [[0, 0, 0], [1, "
           "1, 1], [1, 0, 0]], \"struts\": [[0, 1], [0, 2]], \"strut_factors\": [1, 0.5]}}"),
    IN_BOX("{\"lattice\": {\"unit_cell\": \"cubic\", \"radius\": 0.1, \"strut_factors\": [1, 0.5, "
           "2, 1, 1, 1, 1, 1, 1, 1, 1, 1]}}"),
    IN_BOX(
        "{\"lattice\": {\"radius\": 0.1, \"cells\": [{\"unit_cell\": \"cubic\"}, {\"unit_cell\": "
        "\"custom\", \"nodes\": [[0, 0, 0], [1, 1, 1]], \"struts\": [[0, 1]]}, {}], "
        "\"cell_choice\": {\"gradient\": {\"from\": [0, 0, 0], \"from_value\": 0, \"to\": [4, 0, "
        "0], \"to_value\": 2}}}}"),
    IN_BOX("{\"plate_lattice\": {\"plate_cell\": \"cubic_octet\", \"thickness\": 0.1, "
           "\"face_factors\": [2, 2, 2, 2, 2, 2, 1, 1, 1, 1, 1, 1, 1, 1], \"radius\": {\"radial\": "
           "{\"from_value\": 0.1, \"to_value\": 0.2}}, \"unit_cell\": \"bcc\", \"strut_factors\": "
           "[1, 1, 1, 1, 1, 1, 1, 0.5]}}"),
    IN_BOX(
        "{\"plate_lattice\": {\"plate_cell\": \"custom\", \"grid\": {\"cell_size\": [1, 2, 3]}, "
        "\"thickness\": {\"radial\": {\"from_value\": 0.1, \"to_value\": 0.2}}, \"nodes\": [[0, 0, "
        "0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], \"faces\": [[0, 1, 2], [1, 2, 3]], \"radius\": 0.1, "
        "\"unit_cell\": \"custom\", \"struts\": [[0, 3], [1, 3]]}}"),
    IN_BOX(
        "{\"foam\": {\"method\": \"direct\", \"radius\": 0.1, \"jitter\": 0.5, \"seed\": "
        "18446744073709551615, \"density\": 4, \"wall_thickness\": 0.05, \"vent_radius\": 0.2}}"),
    IN_BOX("{\"foam\": {\"radius\": 0.1, \"wall_thickness\": 0.05, \"stretch\": [1, 0.5, 2.25]}}"),
    IN_BOX("{\"foam\": {\"radius\": 0.1, \"wall_thickness\": 0.05, \"weight\": 0.75}}"),
    IN_BOX("{\"foam\": {\"radius\": 0.1, \"period\": {\"axis\": 0, \"positions\": [0, 2], "
           "\"cell_sizes\": [1, 0.5]}}}"),
    IN_BOX("{\"foam\": {\"radius\": 0.1, \"warp\": {\"count\": 12, \"inner_radius\": 1, "
           "\"outer_radius\": 2}}}"),
    IN_BOX("{\"foam\": {\"radius\": 0, \"wall_thickness\": {\"radial\": {\"from_value\": 0.1, "
           "\"to_value\": 0.2}}}}"),
    IN_BOX("{\"functional\": {\"function\": \"split_p\", \"kind\": \"sheet\", \"clusters\": 4, "
           "\"level\": 0.2}}"),
    IN_BOX("{\"functional\": {\"kind\": \"sheet\", \"thickness\": 0.1, \"period\": {\"axis\": 1, "
           "\"positions\": [0, 2], \"cell_sizes\": [1, 2]}}}"),
    IN_BOX("{\"functional\": {\"level\": 0.1, \"warp\": {\"count\": 12, \"inner_radius\": 1, "
           "\"outer_radius\": 3}}}"),
    IN_BOX("{\"functional\": {\"warp\": {\"kind\": \"spherical\", \"count\": 12, \"count_polar\": "
           "6}}}"),
    IN_BOX("{\"functional\": {\"function\": \"expression\", \"expression\": \"sin(x) + k\", "
           "\"parameters\": {\"k\": 0.25}}}"),
    IN_BOX("{\"waves\": {\"kind\": \"sheet\", \"seed\": 18446744073709551615, \"count\": 30, "
           "\"tile\": [4, 0, 2], \"cone_angles\": [0, 20, 30.5], \"volume_fraction\": 0.25}}"),
    IN_BOX("{\"waves\": {\"count\": 20, \"grid\": {\"cell_size\": [1, 2, 3]}, \"level\": "
           "{\"radial\": {\"from_value\": 0.1, \"to_value\": 0.2}}}}"),
    IN_BOX(
        "{\"beams\": {\"nodes\": [[0, 0, 0], [4, 4, 4], [4, 0, 0]], \"beams\": [[0, 1], [1, 2]], "
        "\"radii\": [[0.1, 0.2], [0.2, 0.1]], \"caps\": [[\"sphere\", \"butt\"], [\"hemisphere\", "
        "\"butt\"]], \"balls\": [2, 0], \"ball_radii\": [0.3, 0.4], \"min_length\": 0.1, "
        "\"length_scale\": 3}}"),
    IN_BOX("{\"beams\": {\"nodes\": [[0, 0, 0], [4, 4, 4]], \"beams\": [[0, 1]], \"radius\": 0.2, "
           "\"cap\": \"butt\", \"balls\": [1], \"ball_radius\": 0.4}}"),
    IN_BOX("{\"blend\": {\"a\": " GYROID
           ", \"b\": {\"foam\": {\"radius\": 0.1}}, \"fraction\": {\"gradient\": {\"from\": [0, 0, "
           "0], \"from_value\": 0.1, \"to\": [4, 0, 0], \"to_value\": 0.75}}}}"),
    IN_BOX("{\"boolean\": {\"operation\": \"difference\", \"structures\": [" GYROID
           ", {\"lattice\": {\"radius\": 0.1}}, {\"boolean\": {\"operation\": \"union\", "
           "\"structures\": [{\"foam\": {\"radius\": 0.1}}]}}]}}"),
    IN_BOX("{\"lattice\": {\"radius\": 0.1, \"period\": {\"positions\": [0, 2], \"cell_sizes\": "
           "[1, 0.5]}}}"),
    IN_BOX("{\"lattice\": {\"radius\": 0.1, \"warp\": {\"count\": 9, \"inner_radius\": 1}}}"),
    IN_BOX(MAPPED),
    "{\"msq_model\": 1, \"materials\": {\"b\": {\"plain\": {\"id\": 2, \"channels\": [{\"name\": "
    "\"E\", \"value\": 2}]}}}, \"scales\": [{\"shape\": " BOX
    ", \"material\": {\"plain\": {\"id\": 7}}}, {\"structure\": " GYROID
    ", \"skin\": {\"radial\": {\"from_value\": 0.1, \"to_value\": 0.4}}, \"material\": {\"blend\": "
    "{\"id\": 3, \"a\": {\"plain\": {\"id\": 1, \"channels\": [{\"name\": \"E\", \"value\": 1}]}}, "
    "\"b\": \"b\", \"fraction\": 0.25}}, \"skin_material\": \"b\"}]}",
    "{\"msq_model\": 1, \"shapes\": {\"part\": " BOX "}, \"structures\": {\"s\": " GYROID
    "}, \"regions\": [{\"scales\": [{\"shape\": {\"placed\": {\"original\": \"part\", \"matrix\": "
    "[1, 0, 0, 9, 0, 1, 0, 0, 0, 0, 1, 0]}}}, {\"structure\": \"s\"}]}, {\"regions\": "
    "[{\"scales\": "
    "[{\"shape\": \"part\"}, {\"structure\": \"s\", \"skin\": 0.5}]}]}]}",
};

static void models_are_read_as_they_are_written(void** state) {
  (void)state;
  for (size_t i = 0; i < sizeof documents / sizeof documents[0]; ++i) {
    msq_model* model = model_of(read_document(context, documents[i]));
    assert_round_trip(context, model, NULL);
    msq_model_release(model);
  }
}

/* Takes over shape and structure. */
static void assert_is(const char* text, msq_shape* shape, msq_structure* structure) {
  msq_model* wanted = make_model(context, shape, structure, NULL);
  msq_model* model = model_of(read_document(context, text));
  assert_same_model(model, wanted, text);
  assert_round_trip(context, wanted, NULL);
  msq_model_release(model);
  msq_model_release(wanted);
}

static void keys_are_fields_of_definitions(void** state) {
  (void)state;
  msq_structure* structure;
  msq_foam_def foam;
  assert_ok(msq_foam_def_init(&foam, sizeof foam));
  set_cell(&foam.grid, 2);
  foam.grid.origin[1] = 0.5;
  foam.radius.value = 0.25;
  foam.seed = 7;
  foam.jitter = 0.75;
  foam.density.value = 2;
  foam.wall_thickness.value = 0.125;
  foam.vent_radius.value = 0.25;
  foam.stretch[0] = foam.stretch[1] = foam.stretch[2] = 2;
  assert_ok(msq_structure_foam(context, &foam, &structure));
  assert_is(
      IN_BOX("{\"foam\": {\"grid\": {\"origin\": [0, 0.5, 0], \"cell_size\": 2}, \"radius\": "
             "0.25, \"seed\": 7, \"jitter\": 0.75, \"density\": 2, \"wall_thickness\": 0.125, "
             "\"vent_radius\": 0.25, \"stretch\": [2, 2, 2]}}"),
      make_box(context), structure);

  msq_functional_def functional;
  const msq_named_value parameter = {"k", 0.5};
  assert_ok(msq_functional_def_init(&functional, sizeof functional));
  functional.function = MSQ_FUNCTION_EXPRESSION;
  functional.kind = MSQ_FUNCTIONAL_SHEET;
  functional.expression = "cos(x) - k";
  functional.parameters = &parameter;
  functional.parameter_count = 1;
  functional.level.value = 0.25;
  assert_ok(msq_structure_functional(context, &functional, &structure));
  assert_is(IN_BOX("{\"functional\": {\"function\": \"expression\", \"kind\": \"sheet\", "
                   "\"expression\": \"cos(x) - k\", \"parameters\": {\"k\": 0.5}, \"level\": "
                   "0.25}}"),
            make_box(context), structure);

  msq_period_def period;
  const double positions[2] = {1, 3}, sizes[2] = {1, 2};
  assert_ok(msq_functional_def_init(&functional, sizeof functional));
  assert_ok(msq_period_def_init(&period, sizeof period));
  functional.function = MSQ_FUNCTION_DIAMOND;
  functional.period = &period;
  period.axis = 0;
  period.positions = positions;
  period.cell_sizes = sizes;
  period.count = 2;
  assert_ok(msq_structure_functional(context, &functional, &structure));
  assert_is(IN_BOX("{\"functional\": {\"function\": \"diamond\", \"period\": {\"axis\": 0, "
                   "\"positions\": [1, 3], \"cell_sizes\": [1, 2]}}}"),
            make_box(context), structure);

  msq_warp_def warp;
  assert_ok(msq_functional_def_init(&functional, sizeof functional));
  assert_ok(msq_warp_def_init(&warp, sizeof warp));
  functional.warp = &warp;
  warp.kind = MSQ_WARP_SPHERICAL;
  warp.count = 12;
  warp.count_polar = 5;
  warp.outer_radius = 4;
  assert_ok(msq_structure_functional(context, &functional, &structure));
  assert_is(IN_BOX("{\"functional\": {\"warp\": {\"kind\": \"spherical\", \"count\": 12, "
                   "\"count_polar\": 5, \"outer_radius\": 4}}}"),
            make_box(context), structure);

  msq_lattice_def lattice;
  assert_ok(msq_lattice_def_init(&lattice, sizeof lattice));
  lattice.unit_cell = MSQ_UNIT_CELL_KELVIN;
  lattice.radius.value = 0.125;
  assert_ok(msq_structure_lattice(context, &lattice, &structure));
  assert_is(IN_BOX("{\"lattice\": {\"unit_cell\": \"kelvin\", \"radius\": 0.125}}"),
            make_box(context), structure);

  lattice.period = &period;
  assert_ok(msq_structure_lattice(context, &lattice, &structure));
  assert_is(
      IN_BOX(
          "{\"lattice\": {\"unit_cell\": \"kelvin\", \"radius\": 0.125, \"period\": {\"axis\": 0, "
          "\"positions\": [1, 3], \"cell_sizes\": [1, 2]}}}"),
      make_box(context), structure);

  assert_ok(msq_warp_def_init(&warp, sizeof warp));
  warp.kind = MSQ_WARP_SPHERICAL;
  warp.count = 12;
  warp.count_polar = 6;
  warp.inner_radius = 2;
  warp.outer_radius = 8.5;
  lattice.period = NULL;
  lattice.warp = &warp;
  assert_ok(msq_structure_lattice(context, &lattice, &structure));
  assert_is(
      IN_BOX("{\"lattice\": {\"unit_cell\": \"kelvin\", \"radius\": 0.125, \"warp\": {\"kind\": "
             "\"spherical\", \"count\": 12, \"count_polar\": 6, \"inner_radius\": 2, "
             "\"outer_radius\": 8.5}}}"),
      make_box(context), structure);
}

/* Beams as no document writes them: strides and 32 bits. */
/* Its sign counts in an expression. */
static void minus_0_is_kept(void** state) {
  const msq_named_value divisor = {"a", -0.0};
  const double point[3] = {1, 1, 1};
  msq_expression_field_def of_radius;
  msq_lattice_def def;
  msq_field* radius;
  msq_structure* lattice;
  double value = 0;
  (void)state;
  assert_ok(msq_expression_field_def_init(&of_radius, sizeof of_radius));
  of_radius.expression = "1/a + 0*x";
  of_radius.parameters = &divisor;
  of_radius.parameter_count = 1;
  of_radius.low = 0.1;
  of_radius.high = 0.3;
  assert_ok(msq_field_expression(context, &of_radius, &radius));
  msq_points_def points;
  assert_ok(msq_points_def_init(&points, sizeof points));
  points.kind = MSQ_POINTS_ARRAY;
  points.coordinates = point;
  points.count = 1;
  assert_ok(msq_field_evaluate(context, radius, &points, &value, 1, NULL));
  assert_true(value == 0.1);
  assert_ok(msq_lattice_def_init(&def, sizeof def));
  def.radius.field = radius;
  assert_ok(msq_structure_lattice(context, &def, &lattice));
  msq_model* model = make_model(context, make_box(context), lattice, NULL);
  assert_round_trip(context, model, NULL);
  msq_model_release(model);
  msq_field_release(radius);
}

static void beams_are_written_packed(void** state) {
  (void)state;
  static const float nodes[3][4] = {{0, 0, 0, 9}, {1, 0.1f, 0, 9}, {1, 1, 1, 9}};
  static const uint32_t beams[2][2] = {{0, 1}, {1, 2}};
  static const float radii[2][2] = {{0.1f, 0.2f}, {0.3f, 0.1f}};
  msq_beams_def def;
  msq_structure* structure;
  assert_ok(msq_beams_def_init(&def, sizeof def));
  def.coordinate_type = MSQ_FLOAT32;
  def.nodes = nodes;
  def.node_count = 3;
  def.node_stride = sizeof nodes[0];
  def.beams = &beams[0][0];
  def.beam_count = 2;
  def.radii = radii;
  assert_ok(msq_structure_beams(context, &def, &structure, NULL));
  msq_model* model = make_model(context, make_box(context), structure, NULL);
  assert_round_trip(context, model, NULL);
  msq_model_release(model);
}

static void shared_objects_are_written_once(void** state) {
  (void)state;
  const char* text =
      "{\"msq_model\": 1, \"fields\": {\"f\": {\"radial\": {\"from_value\": 0.1, \"to_value\": "
      "0.2}}}, \"scales\": [{\"shape\": " BOX
      "}, {\"structure\": {\"foam\": {\"radius\": \"f\", \"density\": 1}}, \"skin\": \"f\"}]}";
  msq_model* model = model_of(read_document(context, text));
  char* written = json_of(model, NULL);
  const char* first = strstr(written, "radial");
  assert_non_null(first);
  assert_null(strstr(first + 1, "radial"));
  assert_non_null(strstr(written, "\"field_1\""));
  assert_round_trip(context, model, NULL);
  msq_model_release(model);
  free(written);
}

static void settings_are_read(void** state) {
  (void)state;
  const char* text =
      "{\"msq_model\": 1, \"title\": \"caf\\u00e9\", \"scales\": [{\"shape\": " BOX
      "}], \"slicing\": {\"pitch\": 0.05, \"layer_height\": 0.025, \"region\": {\"min\": [0, 0, "
      "0], "
      "\"max\": [4, 4, 2]}, \"length_scale\": 0.5, \"window\": {\"first\": [1, 2, 3], \"count\": "
      "[4, "
      "5, 6]}, \"orientation\": [\"mirror_x\", \"transpose\"], \"slab_layers\": 8, \"outputs\": "
      "[{\"output\": \"grey\", \"grey_samples\": 8, \"grey_threshold\": 3, \"grey_gamma\": 2}, "
      "{\"output\": \"contours\", \"contours\": {\"tolerance\": 0.01, \"type\": \"int32\", "
      "\"units\": "
      "100000, \"window\": {\"min\": [0, 0], \"max\": [1, 1]}}}, {\"output\": \"channel\", "
      "\"channel\": \"density\"}], \"frame\": {\"origin\": [1, 0, "
      "0], "
      "\"axes\": [0, 1, 0, 0, 0, 1, 1, 0, 0]}}, \"view\": {\"direction\": [-1, 1, -0.5], "
      "\"width\": "
      "64, \"height\": 48, \"samples\": 2, \"colour_by\": \"normal\", \"colours\": [[1, 0, 0], [0, "
      "1, "
      "0]], \"background\": [1, 1, 1, 1], \"shadows\": true, \"camera\": {\"projection\": "
      "\"perspective\", \"field_of_view\": 30}}}";
  msq_document* document = read_document(context, text);
  msq_document_report report = {0};
  report.struct_size = sizeof report;
  assert_ok(msq_document_info(document, &report));
  assert_int_equal(report.version, 1);
  assert_int_equal(report.has_slicing, 1);
  assert_int_equal(report.has_view, 1);
  assert_int_equal(report.files, 0);
  assert_string_equal(report.title, "caf\xc3\xa9");

  msq_slicer_def slicing;
  slicing.struct_size = sizeof slicing;
  assert_ok(msq_document_slicing(document, &slicing));
  assert_true(slicing.pitch[0] == 0.05 && slicing.pitch[1] == 0.05);
  assert_true(slicing.layer_height == 0.025 && slicing.length_scale == 0.5);
  assert_int_equal(slicing.has_region, 1);
  assert_true(slicing.region_max[2] == 2);
  assert_int_equal(slicing.window.first[2], 3);
  assert_int_equal(slicing.window.count[0], 4);
  assert_int_equal(slicing.orientation, MSQ_LAYER_MIRROR_X | MSQ_LAYER_TRANSPOSE);
  assert_int_equal(slicing.slab_layers, 8);
  assert_int_equal(slicing.output_count, 3);
  assert_int_equal(slicing.outputs[0].output, MSQ_LAYER_GREY);
  assert_int_equal(slicing.outputs[0].grey_samples, 8);
  assert_true(slicing.outputs[0].grey_gamma == 2);
  assert_int_equal(slicing.outputs[1].output, MSQ_LAYER_CONTOURS);
  assert_int_equal(slicing.outputs[1].contours->type, MSQ_INT32);
  assert_int_equal(slicing.outputs[1].contours->has_window, 1);
  assert_null(slicing.outputs[1].channel);
  assert_int_equal(slicing.outputs[2].output, MSQ_LAYER_CHANNEL);
  assert_string_equal(slicing.outputs[2].channel, "density");
  assert_true(slicing.frame_axes[1] == 1 && slicing.frame_origin[0] == 1);

  msq_camera camera, fitted;
  msq_render_def render;
  camera.struct_size = sizeof camera;
  render.struct_size = sizeof render;
  assert_ok(msq_document_view(document, &camera, &render));
  assert_int_equal(render.width, 64);
  assert_int_equal(render.samples, 2);
  assert_int_equal(render.colour_by, MSQ_COLOUR_NORMAL);
  assert_int_equal(render.colour_count, 2);
  assert_int_equal(render.shadows, 1);
  msq_model* model;
  const double direction[3] = {-1, 1, -0.5};
  assert_ok(msq_document_model(document, &model));
  assert_ok(msq_camera_init(&fitted, sizeof fitted));
  fitted.projection = MSQ_CAMERA_PERSPECTIVE;
  fitted.field_of_view = 30;
  assert_ok(msq_camera_fit(model, direction, NULL, 64, 48, &fitted));
  assert_memory_equal(&camera, &fitted, sizeof camera);

  /* Written and read once more, all of it is the same. */
  msq_json_def json;
  assert_ok(msq_json_def_init(&json, sizeof json));
  json.title = report.title;
  json.slicing = &slicing;
  json.camera = &camera;
  json.render = &render;
  char* written = json_of(model, &json);
  msq_document* again = read_document(context, written);
  msq_slicer_def slicing_again;
  slicing_again.struct_size = sizeof slicing_again;
  assert_ok(msq_document_slicing(again, &slicing_again));
  assert_int_equal(slicing_again.outputs[1].contours->window_max[1], 1);
  slicing_again.outputs = slicing.outputs;
  assert_memory_equal(&slicing, &slicing_again, sizeof slicing);
  msq_camera camera_again;
  msq_render_def render_again;
  camera_again.struct_size = sizeof camera_again;
  render_again.struct_size = sizeof render_again;
  assert_ok(msq_document_view(again, &camera_again, &render_again));
  assert_memory_equal(&camera, &camera_again, sizeof camera);
  json.slicing = &slicing;
  free(written);
  msq_document_retain(again);
  msq_document_release(again);
  msq_document_release(again);
  msq_model_release(model);
  msq_document_release(document);
}

static void a_document_may_have_no_settings(void** state) {
  (void)state;
  msq_document* document = read_document(context, documents[0]);
  msq_slicer_def slicing;
  msq_camera camera;
  msq_render_def render;
  assert_ok(msq_slicer_def_init(&slicing, sizeof slicing));
  assert_ok(msq_camera_init(&camera, sizeof camera));
  assert_ok(msq_render_def_init(&render, sizeof render));
  assert_refused(msq_document_slicing(document, &slicing), MSQ_E_ARGUMENT, "no slicing");
  assert_refused(msq_document_view(document, &camera, &render), MSQ_E_ARGUMENT, "no view");
  msq_document_release(document);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(models_are_read_as_they_are_written),
      cmocka_unit_test(keys_are_fields_of_definitions),
      cmocka_unit_test(minus_0_is_kept),
      cmocka_unit_test(beams_are_written_packed),
      cmocka_unit_test(shared_objects_are_written_once),
      cmocka_unit_test(settings_are_read),
      cmocka_unit_test(a_document_may_have_no_settings),
  };
  if (!MSQ_WITH_JSON) return 0; /* test_refusals_documents.c */
  context = make_context();
  const int failed = cmocka_run_group_tests(tests, NULL, NULL);
  msq_context_release(context);
  return failed;
}
