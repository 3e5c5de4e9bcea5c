/* SPDX-License-Identifier: Apache-2.0
 * What slicers and contours refuse. */
#include "layers.h"
#include "materials.h"
#include "wrong_values.h"

static msq_context* context;
static msq_model *plain, *plain_of_small, *everywhere; /* a lattice in a box; without bounds */
static msq_model *regions, *beams, *with_materials;

static msq_slicer_def* plan_of_output(int32_t kind) {
  msq_slicer_def* def = (msq_slicer_def*)definition(0);
  *def = slicer_def(kind, 32, 32, 0.25);
  return def;
}

/* Two of the same kind. */
static msq_model* make_regions_model(void) {
  const msq_model* of[2] = {plain, plain};
  msq_model* model;
  assert_ok(msq_model_regions(context, of, 2, &model));
  return model;
}

/* A structure without an onset. */
static msq_model* make_beam_model(void) {
  static const double ends[2][3] = {{1, 1, 1}, {3, 3, 3}};
  static const uint32_t pair[2] = {0, 1};
  static const double radii[2] = {0.5, 0.5};
  msq_beams_def def;
  msq_structure* beam;
  assert_ok(msq_beams_def_init(&def, sizeof def));
  def.nodes = ends;
  def.node_count = 2;
  def.beams = pair;
  def.beam_count = 1;
  def.radii = radii;
  assert_ok(msq_structure_beams(context, &def, &beam, NULL));
  return make_model(context, make_box(context), beam, NULL);
}

static msq_contours_def* contours_of(int32_t type) {
  msq_contours_def* def = (msq_contours_def*)definition(1);
  assert_ok(msq_contours_def_init(def, sizeof *def));
  def->type = type;
  def->tolerance = 0.05;
  if (type != MSQ_FLOAT64) def->units = 1e5;
  return def;
}

static void slicers(void** state) {
  const double pitches[] = {-0.125, NAN, INFINITY}, lengths[] = {-0.5, NAN, -INFINITY};
  const double heights[] = {0, -0.5, NAN, INFINITY};
  const char* pitch_texts[] = {"-0.125", "nan", "inf"};
  const char* length_texts[] = {"-0.5", "nan", "-inf"};
  const char* height_texts[] = {"is 0;", "-0.5", "nan", "inf"};
  (void)state;
  REFUSALS("msq_slicer_create") {
    const msq_model* model = plain;
    msq_slicer_def* def = plan_of_output(MSQ_LAYER_BITS);
    msq_slicer** slicer = (msq_slicer**)output(0);
    wrong_sizes(table, def, offsetof(msq_slicer_def, window), sizeof *def);
    WRONG(ARGUMENT, "model is NULL", model = NULL);
    WRONG(ARGUMENT, "slicer is NULL", slicer = NULL);
    wrong_enum(table, &def->output, "output", 1, 6);
    wrong_enum(table, &def->has_region, "has_region", 0, 1);
    for (int axis = 0; axis < 2; ++axis) {
      for (int i = 0; i < 3; ++i)
        WRONG(ARGUMENT, words_of("pitch|%s", pitch_texts[i]), def->pitch[axis] = pitches[i]);
      WRONG(ARGUMENT, words_of("neither pitch nor resolution|along %c", "xy"[axis]),
            def->resolution[axis] = 0);
      WRONG(ARGUMENT, "pitch|1e+18", def->has_region = 1; /* pixels would fall together */
            def->region_min[axis] = 1e18; def->region_max[axis] = 2e18;
            def->region_max[1 - axis] = def->region_max[2] = 1; def->pitch[axis] = 1e-3);
      WRONG(LIMIT, "2147483648|2147483647", def->resolution[axis] = (uint32_t)1 << 31);
      WRONG(LIMIT, "1e+12|2147483647", def->resolution[axis] = 0; def->pitch[axis] = 4e-12);
      WRONG(LIMIT, "2147483647", def->resolution[axis] = 0; def->pitch[axis] = 5e-324);
    }
    for (int i = 0; i < 4; ++i)
      WRONG(ARGUMENT, words_of("layer_height|%s", height_texts[i]), def->layer_height = heights[i]);
    for (int i = 0; i < 3; ++i)
      WRONG(ARGUMENT, words_of("length_scale is %s; it must be 0 or more", length_texts[i]),
            def->length_scale = lengths[i]);
    WRONG(LIMIT, "2147483648|2147483647", def->layer_count = (uint64_t)1 << 31);
    WRONG(LIMIT, "18446744073709551615", def->layer_count = UINT64_MAX);
    WRONG(LIMIT, "1e+12|2147483647", def->layer_height = 4e-12);
    WRONG(LIMIT, "2^63", def->resolution[0] = def->resolution[1] = INT32_MAX;
          def->layer_count = INT32_MAX; def->layer_height = 1e-8);
    WRONG(ARGUMENT, "material", def->output = MSQ_LAYER_MATERIAL);
    WRONG(ARGUMENT, "region", model = everywhere);
    WRONG(ARGUMENT, "axis 1|has_region is 0", def->region_max[1] = 2);
    WRONG(ARGUMENT, "def is NULL", def = NULL);
    if (TRY(msq_slicer_create(model, def, slicer))) msq_slicer_release(*slicer);
  }
  REFUSALS("msq_slicer_create") { /* regions */
    const msq_model* model = plain;
    msq_slicer_def* def = plan_of_output(MSQ_LAYER_BITS);
    msq_slicer** slicer = (msq_slicer**)output(0);
    def->has_region = 1;
    for (int axis = 0; axis < 3; ++axis) def->region_max[axis] = 4;
    wrong_vector(table, def->region_min, "region_min");
    wrong_vector(table, def->region_max, "region_max");
    for (int axis = 0; axis < 3; ++axis) {
      WRONG(ARGUMENT, "extent|is 0;", def->region_max[axis] = 0);
      WRONG(ARGUMENT, "extent|-1.5", def->region_max[axis] = -1.5);
    }
    RIGHT(model = everywhere);
    WRONG(LIMIT, "the region", model = everywhere; def->region_min[2] = 16777214;
          def->region_max[2] = 16777218);
    if (TRY(msq_slicer_create(model, def, slicer))) msq_slicer_release(*slicer);
  }
  REFUSALS("msq_slicer_create") { /* listed heights */
    double z[4] = {0.5, 1, 1.5, 2};
    msq_slicer_def* def = plan_of_output(MSQ_LAYER_BITS);
    msq_slicer** slicer = (msq_slicer**)output(0);
    def->layer_z = z;
    def->layer_z_count = 4;
    WRONG(ARGUMENT, "layer_z_count is 0", def->layer_z_count = 0);
    WRONG(ARGUMENT, "2147483648|2147483647", def->layer_z_count = (uint64_t)1 << 31);
    WRONG(ARGUMENT, "layer_count is 3|4", def->layer_count = 3);
    RIGHT(def->layer_count = 4);
    WRONG(ARGUMENT, "layer_z[2]|ascend", z[2] = 1);
    WRONG(ARGUMENT, "0.75", z[2] = 0.75);
    for (int which = 0; which < 3; ++which)
      WRONG(ARGUMENT, "layer_z|finite", z[2] = not_finite(which));
    WRONG(ARGUMENT, "layer_z is NULL", def->layer_z = NULL);
    if (TRY(msq_slicer_create(plain, def, slicer))) msq_slicer_release(*slicer);
  }
  REFUSALS("msq_slicer_create") { /* grey pixels */
    msq_slicer_def* def = plan_of_output(MSQ_LAYER_GREY);
    msq_slicer** slicer = (msq_slicer**)output(0);
    WRONG(ARGUMENT, "grey_samples is 3", def->grey_samples = 3);
    WRONG(ARGUMENT, "grey_samples is 0", def->grey_samples = 0);
    WRONG(ARGUMENT, "grey_gamma is 0", def->grey_gamma = 0);
    wrong_number(table, &def->grey_gamma, "grey_gamma is");
    WRONG(ARGUMENT, "grey_threshold is 256", def->grey_threshold = 256);
    WRONG(ARGUMENT, "orientation is 8", def->orientation = 8);
    WRONG(ARGUMENT, "outputs is NULL|output_count is 1", def->output_count = 1);
    WRONG(LIMIT, "the limit is 2147483647", def->pitch[0] = 1e-9;
          def->resolution[0] = INT32_MAX / 2);
    if (TRY(msq_slicer_create(plain, def, slicer))) msq_slicer_release(*slicer);
  }
  REFUSALS("msq_slicer_create") { /* several outputs */
    const msq_model* model = plain;
    msq_slicer_def* def = plan_of_output(MSQ_LAYER_BITS);
    msq_slicer** slicer = (msq_slicer**)output(0);
    msq_contours_def* rings = contours_of(MSQ_FLOAT64);
    static struct_bytes room[3];
    msq_output_def* outputs = (msq_output_def*)room; /* two and a newer one's excess */
    memset(room, 0, sizeof room);
    for (int i = 0; i < 2; ++i) assert_ok(msq_output_def_init(&outputs[i], sizeof outputs[i]));
    outputs[0].output = MSQ_LAYER_GREY;
    outputs[1].output = MSQ_LAYER_CONTOURS;
    outputs[1].contours = rings;
    def->outputs = outputs;
    def->output_count = 2;
    WRONG(ARGUMENT, "output is 2|outputs", def->output = MSQ_LAYER_BYTES);
    WRONG(ARGUMENT, "output_count is 0|64", def->output_count = 0);
    WRONG(ARGUMENT, "output_count is 65|64", def->output_count = 65);
    WRONG(ARGUMENT, "struct_size of outputs[0]", outputs[0].struct_size = 4);
    WRONG(ARGUMENT, "struct_size of outputs[1]", outputs[1].struct_size = 4);
    WRONG(ARGUMENT, "struct_size of outputs[1]|that of outputs[0]", ++outputs[1].struct_size);
    wrong_enum(table, &outputs[0].output, "output", 1, 8);
    WRONG(ARGUMENT, "grey_samples is 5", outputs[0].grey_samples = 5);
    WRONG(ARGUMENT, "grey_gamma is 11", outputs[0].grey_gamma = 11);
    WRONG(ARGUMENT, "grey_threshold is 300", outputs[0].grey_threshold = 300);
    wrong_enum(table, &outputs[0].onset_value, "onset_value", 0, 1);
    WRONG(ARGUMENT, "onset_scale is 2|1 scales", outputs[0].output = MSQ_LAYER_ONSET;
          outputs[0].onset_scale = 2);
    WRONG(ARGUMENT, "no structure is resolved", outputs[0].output = MSQ_LAYER_ONSET;
          def->length_scale = 2);
    WRONG(UNSUPPORTED, "2 regions", outputs[0].output = MSQ_LAYER_ONSET; model = regions);
    WRONG(UNSUPPORTED, "scale 1 has none", outputs[0].output = MSQ_LAYER_ONSET; model = beams);
    WRONG(ARGUMENT, "material", outputs[0].output = MSQ_LAYER_MATERIAL);
    WRONG(ARGUMENT, "material|region 0", outputs[0].output = MSQ_LAYER_MATERIAL; model = regions);
    WRONG(ARGUMENT, "output is 8|channel is NULL", outputs[0].output = MSQ_LAYER_CHANNEL);
    WRONG(ARGUMENT, "output is 3|channel is given", outputs[0].channel = "density");
    WRONG(ARGUMENT, "channel|no resolved scale has a material",
          outputs[0].output = MSQ_LAYER_CHANNEL;
          outputs[0].channel = "density");
    WRONG(ARGUMENT, "channel colour", outputs[0].output = MSQ_LAYER_CHANNEL;
          outputs[0].channel = "colour"; model = with_materials);
    WRONG(ARGUMENT, "output is 3|given", outputs[0].contours = rings);
    WRONG(ARGUMENT, "output is 7|NULL", outputs[1].contours = NULL);
    WRONG(ARGUMENT, "axis is 0", rings->axis = 0);
    WRONG(ARGUMENT, "length_scale is 1", rings->length_scale = 1);
    WRONG(ARGUMENT, "tolerance is 0", rings->tolerance = 0);
    WRONG(ARGUMENT, "type is 5", rings->type = 5);
    WRONG(ARGUMENT, "outputs is NULL", def->outputs = NULL);
    if (TRY(msq_slicer_create(model, def, slicer))) msq_slicer_release(*slicer);
  }
  REFUSALS("msq_slicer_create") { /* frames */
    static const double axes[9] = {0.6, 0.8, 0, -0.8, 0.6, 0, 0, 0, 1};
    msq_slicer_def* def = plan_of_output(MSQ_LAYER_BITS);
    msq_slicer** slicer = (msq_slicer**)output(0);
    memcpy(def->frame_axes, axes, sizeof axes);
    wrong_vector(table, def->frame_origin, "frame_origin");
    for (int i = 0; i < 9; ++i)
      for (int which = 0; which < 3; ++which)
        WRONG(ARGUMENT, "frame_axes|finite", def->frame_axes[i] = not_finite(which));
    WRONG(ARGUMENT, "rows 0 and 0 of frame_axes", def->frame_axes[0] = 0.61);
    WRONG(ARGUMENT, "rows 0 and 2 of frame_axes", def->frame_axes[6] = 1e-6);
    WRONG(ARGUMENT, "rows 2 and 2 of frame_axes", def->frame_axes[8] = 0);
    WRONG(ARGUMENT, "rows 2 and 2 of frame_axes", def->frame_axes[8] = -2);
    RIGHT(def->frame_axes[8] = -1);
    RIGHT(memset(def->frame_axes, 0, sizeof axes));
    WRONG(ARGUMENT, "extent along u", def->has_region = 1;
          def->region_max[1] = def->region_max[2] = 1);
    if (TRY(msq_slicer_create(plain, def, slicer))) msq_slicer_release(*slicer);
  }
  REFUSALS("msq_slicer_create") { /* windows; 16 layers */
    const msq_window whole = {{0, 0, 0}, {32, 32, 16}};
    msq_slicer_def* def = plan_of_output(MSQ_LAYER_BITS);
    msq_slicer** slicer = (msq_slicer**)output(0);
    def->window = whole;
    WRONG(ARGUMENT, "17|16", def->window.count[2] = 17);
    WRONG(ARGUMENT, "32", def->window.first[0] = 1);
    WRONG(ARGUMENT, "32", def->window.first[1] = 32; def->window.count[1] = 1);
    WRONG(ARGUMENT, "18446744073709551615", def->window.first[1] = UINT64_MAX;
          def->window.count[1] = 2);
    WRONG(ARGUMENT, "18446744073709551615", def->window.count[0] = UINT64_MAX);
    for (int axis = 0; axis < 3; ++axis)
      WRONG(ARGUMENT, words_of("count[%d] is 0", axis), def->window.count[axis] = 0);
    if (TRY(msq_slicer_create(plain, def, slicer))) msq_slicer_release(*slicer);
  }
}

static void layers(void** state) {
  const uint64_t first[] = {17, 0, 16, 1, 8, UINT64_MAX, 17};
  const uint64_t count[] = {0, 17, 1, 16, UINT64_MAX - 1, 1, UINT64_MAX};
  const msq_slicer_def def = slicer_def(MSQ_LAYER_BITS, 20, 10, 0.25);
  msq_slicer* known = make_slicer(plain, &def);
  (void)state;
  REFUSALS("msq_slicer_info") {
    const msq_slicer* slicer = known;
    msq_slicer_report* report = (msq_slicer_report*)output(0);
    report->struct_size = sizeof *report;
    WRONG(ARGUMENT, "slicer is NULL", slicer = NULL);
    WRONG(ARGUMENT, "report is NULL", report = NULL);
    TRY(msq_slicer_info(slicer, report));
  }
  REFUSALS("msq_slicer_layer_z") {
    const msq_slicer* slicer = known;
    uint64_t index = 15;
    double* z = (double*)output(0);
    WRONG(ARGUMENT, "slicer is NULL", slicer = NULL);
    WRONG(ARGUMENT, "z is NULL", z = NULL);
    WRONG(ARGUMENT, "layer 16|16 layers", index = 16);
    WRONG(ARGUMENT, "18446744073709551615|16 layers", index = UINT64_MAX);
    TRY(msq_slicer_layer_z(slicer, index, z));
  }
  REFUSALS("msq_slice_layer") {
    const msq_slicer* slicer = known;
    uint64_t index = 15, bytes = 80;
    uint8_t* layer = (uint8_t*)output(0);
    msq_job* job = NULL;
    WRONG(ARGUMENT, "slicer is NULL", slicer = NULL);
    WRONG(ARGUMENT, "buffer is NULL", layer = NULL);
    WRONG(ARGUMENT, "layer 16|16 layers", index = 16);
    WRONG(ARGUMENT, "18446744073709551615|16 layers", index = UINT64_MAX);
    WRONG(ARGUMENT, "buffer_bytes|0|80", bytes = 0);
    WRONG(ARGUMENT, "buffer_bytes|79|80", bytes = 79);
    WRONG(CANCELLED, "cancelled", job = cancelled_job());
    TRY(msq_slice_layer(slicer, index, layer, bytes, job));
  }
  REFUSALS("msq_slice_layer") { /* contours have no bytes */
    msq_slicer_def several = def;
    msq_output_def outputs[2];
    uint8_t* layer = (uint8_t*)output(0);
    for (int i = 0; i < 2; ++i) assert_ok(msq_output_def_init(&outputs[i], sizeof outputs[i]));
    several.outputs = outputs;
    several.output_count = 2;
    outputs[1].contours = contours_of(MSQ_FLOAT64);
    outputs[1].output = MSQ_LAYER_CONTOURS;
    WRONG(ARGUMENT, "output 0 is contours", outputs[0] = outputs[1]);
    msq_slicer* slicer = make_slicer(plain, &several);
    TRY(msq_slice_layer(slicer, 3, layer, 80, NULL));
    msq_slicer_release(slicer);
  }
  REFUSALS("msq_slicer_run") { /* what contours refuse is refused at their layer */
    msq_slicer_def several = def;
    msq_output_def rings;
    layer_stack stack;
    assert_ok(msq_output_def_init(&rings, sizeof rings));
    several.outputs = &rings;
    several.output_count = 1;
    rings.contours = contours_of(MSQ_INT32);
    rings.output = MSQ_LAYER_CONTOURS;
    WRONG(LIMIT, "the limit is 2147483647", contours_of(MSQ_INT32)->units = 1e10);
    WRONG(ARGUMENT, "at least 64", contours_of(MSQ_INT32)->units = 100);
    msq_slicer* slicer = make_slicer(plain, &several);
    memset(&stack, 0, sizeof stack);
    stack.wrong = "first";
    stack.plan = plan_of(slicer);
    TRY(msq_slicer_run(slicer, 2, 3, take_layer, &stack, NULL));
    msq_slicer_release(slicer);
  }
  REFUSALS("msq_slicer_run") {
    const msq_slicer* slicer = known;
    uint64_t from = 0, layers = 2;
    msq_layer_fn fn = take_layer;
    layer_stack stack = make_stack(known, MSQ_LAYER_BITS, 0, 0);
    msq_job* job = NULL;
    WRONG(ARGUMENT, "slicer is NULL", slicer = NULL);
    WRONG(ARGUMENT, "fn is NULL", fn = NULL);
    for (int i = 0; i < 7; ++i)
      WRONG(ARGUMENT, words_of("16 layers|%" PRIu64 "|%" PRIu64, first[i], count[i]),
            from = first[i];
            layers = count[i]);
    WRONG(HOST, "-7", stack.stop_code = -7; stack.stop_at = 1);
    WRONG(CANCELLED, "cancelled", job = cancelled_job());
    const int ran = TRY(msq_slicer_run(slicer, from, layers, fn, &stack, job));
    assert_int_equal(stack.taken, ran || stack.stop_code ? 2 : 0);
    free_stack(&stack);
  }
  msq_slicer_release(known);
}

static int32_t refuse_findings(void* user, const msq_finding* findings, uint64_t count) {
  (void)user, (void)findings, (void)count;
  return -9;
}

static void printability(void** state) {
  const msq_slicer_def plan = slicer_def(MSQ_LAYER_BITS, 70, 45, 0.5);
  const msq_slicer_def large = slicer_def(MSQ_LAYER_BITS, 300, 300, 0.5);
  msq_slicer *known = make_slicer(plain, &plan), *of_small = make_slicer(plain_of_small, &large);
  (void)state;
  REFUSALS("msq_printability") {
    const msq_slicer* slicer = known;
    msq_printability_def* def = (msq_printability_def*)definition(0);
    msq_findings_fn fn = NULL;
    msq_printability_report* report = (msq_printability_report*)output(0);
    msq_job* job = NULL;
    assert_ok(msq_printability_def_init(def, sizeof *def));
    report->struct_size = sizeof *report;
    wrong_sizes(table, def, offsetof(msq_printability_def, overhang), sizeof *def);
    WRONG(ARGUMENT, "slicer is NULL", slicer = NULL);
    WRONG(ARGUMENT, "report is NULL", report = NULL);
    WRONG(ARGUMENT, "struct_size of report is 4", report->struct_size = 4);
    WRONG(ARGUMENT, "kinds is 0", def->kinds = 0);
    WRONG(ARGUMENT, "kinds is 64", def->kinds = 64);
    WRONG(ARGUMENT, "kinds is 4294967295", def->kinds = UINT32_MAX);
    wrong_enum(table, &def->has_plate, "has_plate", 0, 1);
    WRONG(ARGUMENT, "reserved is 3", def->reserved = 3);
    WRONG(ARGUMENT, "width is -1", def->width = -1);
    wrong_number(table, &def->width, "width is ");
    WRONG(ARGUMENT, "width is 0.5, and kinds", def->width = 0.5);
    WRONG(ARGUMENT, "width is 0, 0 pixels along x|2 to 32", def->kinds = MSQ_FINDING_THIN);
    WRONG(ARGUMENT, "width is 0.11, 1.925 pixels along x", def->kinds = 15; def->width = 0.11);
    WRONG(ARGUMENT, "width is 0.17, 1.9125 pixels along y", def->kinds = 15; def->width = 0.17);
    WRONG(ARGUMENT, "width is 1.9, 33.25 pixels along x", def->kinds = 15; def->width = 1.9);
    RIGHT(def->kinds = 15; def->width = 1.85);
    WRONG(ARGUMENT, "min_volume is -1", def->min_volume = -1);
    wrong_number(table, &def->min_volume, "min_volume is ");
    WRONG(LIMIT, "memory_limit", slicer = of_small);
    wrong_number(table, &def->overhang, "overhang is ");
    WRONG(ARGUMENT, "overhang is 0.5|MSQ_FINDING_OVERHANG", def->overhang = 0.5);
    WRONG(ARGUMENT, "overhang|-1", def->kinds = MSQ_FINDING_OVERHANG; def->overhang = -1);
    WRONG(ARGUMENT, "overhang is 1000|at most 31", def->kinds = MSQ_FINDING_OVERHANG;
          def->overhang = 1000);
    WRONG(HOST, "-9", fn = refuse_findings; def->kinds = MSQ_FINDING_THIN; def->width = 0.5);
    WRONG(CANCELLED, "cancelled", job = cancelled_job());
    RIGHT(def = NULL);
    TRY(msq_printability(slicer, def, fn, NULL, report, job));
  }
  msq_slicer_release(of_small);
  msq_slicer_release(known);
}

static void contours(void** state) {
  const msq_slicer_def plan = slicer_def(MSQ_LAYER_BITS, 70, 45, 0.25);
  msq_slicer* known = make_slicer(plain, &plan);
  msq_contours* made;
  (void)state;
  REFUSALS("msq_layer_contours") {
    const msq_model* model = plain;
    double height = 1;
    msq_contours_def* def = contours_of(MSQ_FLOAT64);
    msq_contours** contours = (msq_contours**)output(0);
    msq_job* job = NULL;
    wrong_sizes(table, def, offsetof(msq_contours_def, topology_samples), sizeof *def);
    WRONG(ARGUMENT, "model is NULL", model = NULL);
    WRONG(ARGUMENT, "contours is NULL", contours = NULL);
    wrong_number(table, &height, "height is ");
    WRONG(ARGUMENT, "type is 4", def->type = 4);
    WRONG(ARGUMENT, "type is -1", def->type = -1);
    WRONG(ARGUMENT, "topology_samples is 3; it must be 0, 2, 4, 8 or 16",
          def->topology_samples = 3);
    WRONG(ARGUMENT, "topology_samples is 1;", def->topology_samples = 1);
    WRONG(ARGUMENT, "topology_samples is 32;", def->topology_samples = 32);
    RIGHT(def->topology_samples = 16);
    wrong_enum(table, &def->axis, "axis", 0, 2);
    wrong_enum(table, &def->has_window, "has_window", 0, 1);
    WRONG(ARGUMENT, "has_window is 0", def->window_max[1] = 2);
    WRONG(ARGUMENT, "not empty", def->has_window = 1);
    RIGHT(def->has_window = 1; def->window_max[0] = def->window_max[1] = 2);
    for (int i = 0; i < 2; ++i)
      for (int which = 0; which < 3; ++which) {
        WRONG(ARGUMENT, "window", def->has_window = 1; def->window_max[0] = def->window_max[1] = 2;
              def->window_min[i] = not_finite(which));
        WRONG(ARGUMENT, "window", def->has_window = 1; def->window_max[0] = def->window_max[1] = 2;
              def->window_max[i] = not_finite(which));
      }
    WRONG(ARGUMENT, "tolerance is 0", def->tolerance = 0);
    wrong_number(table, &def->tolerance, "tolerance is ");
    WRONG(ARGUMENT, "pitch is -1", def->pitch = -1);
    wrong_number(table, &def->pitch, "pitch is ");
    WRONG(ARGUMENT, "units is 0", def->units = 0);
    WRONG(ARGUMENT, "length_scale is -2; it must be 0 or more", def->length_scale = -2);
    WRONG(LIMIT, "the limit is 2147483392", def->tolerance = 1e-9);
    WRONG(LIMIT, "memory_limit", model = plain_of_small);
    WRONG(ARGUMENT, "has_window is 0", model = everywhere);
    WRONG(LIMIT, "the window reaches|the limit is", model = everywhere; def->has_window = 1;
          def->window_min[0] = def->window_min[1] = 2e7;
          def->window_max[0] = def->window_max[1] = 2e7 + 4);
    WRONG(CANCELLED, "cancelled", job = cancelled_job());
    WRONG(ARGUMENT, "def is NULL", def = NULL);
    if (TRY(msq_layer_contours(model, height, def, contours, job))) msq_contours_release(*contours);
  }
  REFUSALS("msq_layer_contours") { /* whole numbers: too few digits, or too many */
    msq_contours_def* def = contours_of(MSQ_INT32);
    msq_contours** contours = (msq_contours**)output(0);
    def->units = 1000;
    def->pitch = 0.2;
    WRONG(ARGUMENT, "at least 64", def->pitch = 0; def->tolerance = 0.03);
    WRONG(ARGUMENT, "at least 4", def->tolerance = 0.003);
    WRONG(LIMIT, "the limit is 2147483647", def->units = 1e10);
    WRONG(LIMIT, "the limit is 1.7976931348623157e+308", def->type = MSQ_FLOAT64;
          def->units = 1e308);
    WRONG(LIMIT, "the limit is 9007199254740992", def->type = MSQ_INT64; def->units = 1e16);
    wrong_number(table, &def->units, "units is ");
    if (TRY(msq_layer_contours(plain, 1, def, contours, NULL))) msq_contours_release(*contours);
  }
  REFUSALS("msq_slicer_contours") {
    const msq_slicer* slicer = known;
    uint64_t index = 2;
    msq_contours_def* def = contours_of(MSQ_INT64);
    msq_contours** contours = (msq_contours**)output(0);
    msq_job* job = NULL;
    wrong_sizes(table, def, offsetof(msq_contours_def, topology_samples), sizeof *def);
    WRONG(ARGUMENT, "slicer is NULL", slicer = NULL);
    WRONG(ARGUMENT, "contours is NULL", contours = NULL);
    WRONG(ARGUMENT, "layer 16", index = 16);
    WRONG(ARGUMENT, "layer 18446744073709551615", index = UINT64_MAX);
    WRONG(ARGUMENT, "axis is 1", def->axis = 1);
    WRONG(ARGUMENT, "length_scale is 3", def->length_scale = 3);
    WRONG(ARGUMENT, "window", def->has_window = 1);
    WRONG(ARGUMENT, "tolerance is 0", def->tolerance = 0);
    WRONG(ARGUMENT, "units is 0", def->units = 0);
    WRONG(CANCELLED, "cancelled", job = cancelled_job());
    WRONG(ARGUMENT, "def is NULL", def = NULL);
    if (TRY(msq_slicer_contours(slicer, index, def, contours, job)))
      msq_contours_release(*contours);
  }
  assert_ok(msq_layer_contours(plain, 1, contours_of(MSQ_FLOAT64), &made, NULL));
  REFUSALS("msq_contours_info") {
    const msq_contours* contours = made;
    msq_contours_report* report = (msq_contours_report*)output(0);
    report->struct_size = sizeof *report;
    WRONG(ARGUMENT, "contours is NULL", contours = NULL);
    WRONG(ARGUMENT, "report is NULL", report = NULL);
    TRY(msq_contours_info(contours, report));
  }
  msq_contours_release(made);
  msq_slicer_release(known);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(slicers),
      cmocka_unit_test(layers),
      cmocka_unit_test(printability),
      cmocka_unit_test(contours),
  };
  msq_shape* all;
  msq_context* small = make_context_of(1, 0, 20000);
  context = make_context();
  plain = make_lattice_model(context);
  plain_of_small = make_lattice_model(small);
  assert_ok(msq_shape_all_space(context, &all));
  regions = make_regions_model();
  beams = make_beam_model();
  with_materials = make_material_model(context, 1, 1, 1);
  everywhere = make_model(context, all, make_lattice(context), NULL);
  const int failed = cmocka_run_group_tests(tests, NULL, NULL);
  msq_job_release(cancelled_job());
  msq_model_release(with_materials);
  msq_model_release(beams);
  msq_model_release(regions);
  msq_model_release(everywhere);
  msq_model_release(plain_of_small);
  msq_model_release(plain);
  msq_context_release(small);
  msq_context_release(context);
  return failed;
}
