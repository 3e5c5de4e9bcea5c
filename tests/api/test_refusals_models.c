/* SPDX-License-Identifier: Apache-2.0
 * What functions of models refuse. */
#include "materials.h"
#include "wrong_values.h"

static msq_context* context;

static void models(void** state) {
  /* A scale after the first would not be aligned. */
  const uint32_t sizes[] = {
      1,   2 * sizeof(void*) - 1, UINT32_MAX, sizeof(msq_scale_def) + 1, sizeof(msq_scale_def) + 4,
      4097};
  msq_shape* box = make_box(context);
  msq_structure* lattice = make_lattice(context);
  msq_structure* fine = make_lattice_of(context, MSQ_UNIT_CELL_BCC, 0x1p-22, 0x1p-25);
  msq_structure* coarser = make_lattice_of(context, MSQ_UNIT_CELL_BCC, 0x1p-21, 0x1p-24);
  msq_field* skin = ramp_of(context, -0.25, 1);
  msq_material* steel = make_material(context, 1, 7.8, 0);
  (void)state;
  REFUSALS("msq_model_create") {
    msq_context* in = context;
    msq_scale_def scales[65];
    msq_model_def* def = (msq_model_def*)definition(0);
    msq_model** model = (msq_model**)output(0);
    memset(scales, 0, sizeof scales);
    scales[0].shape = box;
    for (int i = 1; i < 65; ++i) scales[i].structure = lattice;
    assert_ok(msq_model_def_init(def, sizeof *def));
    def->scales = scales;
    def->scale_count = 2;
    def->scale_size = sizeof scales[0];
    wrong_sizes(table, def, sizeof *def, sizeof *def);
    WRONG(ARGUMENT, "context is NULL", in = NULL);
    WRONG(ARGUMENT, "model is NULL", model = NULL);
    WRONG(ARGUMENT, "scales is NULL", def->scales = NULL);
    RIGHT(def->scale_count = 64);
    WRONG(ARGUMENT, "scale_count is 65|64", def->scale_count = 65);
    WRONG(ARGUMENT, "scale_count is 0", def->scale_count = 0);
    for (size_t i = 0; i < COUNT_OF(sizes); ++i)
      WRONG(ARGUMENT, words_of("scale_size|%" PRIu32, sizes[i]), def->scale_size = sizes[i]);
    WRONG(ARGUMENT, "reserved is 5", def->reserved = 5);
    WRONG(ARGUMENT, "scale 0 must have a shape", scales[0].shape = NULL);
    WRONG(ARGUMENT, "scale 0 must have a shape", scales[0].structure = lattice);
    WRONG(ARGUMENT, "scale 0 must have a shape", scales[0].shape = NULL;
          scales[0].structure = lattice);
    WRONG(ARGUMENT, "scale 1 must have a structure", scales[1].structure = NULL);
    WRONG(ARGUMENT, "scale 1 must have a structure", scales[1].shape = box);
    WRONG(ARGUMENT, "scale 1 must have a structure", scales[1].shape = box;
          scales[1].structure = NULL);
    /* 4 / 2^-22 cells are 2^24, one too many; 4 / 2^-21 are few enough. */
    WRONG(LIMIT, "scale 1|1.67772e+07", scales[1].structure = fine);
    RIGHT(scales[1].structure = coarser);
    WRONG(ARGUMENT, "the skin of scale 1 is -0.5", scales[1].skin.value = -0.5);
    wrong_number(table, &scales[1].skin.value, "skin");
    WRONG(ARGUMENT, "-0.25 somewhere", scales[1].skin.field = skin);
    WRONG(ARGUMENT, "scale 0", scales[0].skin.value = 1);
    WRONG(ARGUMENT, "scale 0 has a skin_material", scales[0].skin_material = steel);
    WRONG(ARGUMENT, "def is NULL", def = NULL);
    if (TRY(msq_model_create(in, def, model))) msq_model_release(*model);
  }
  msq_material_release(steel);
  msq_field_release(skin);
  msq_structure_release(coarser);
  msq_structure_release(fine);
  msq_structure_release(lattice);
  msq_shape_release(box);
}

static void parts_of_models(void** state) {
  static const msq_model* many[4097];
  msq_model *part = make_box_model(context), *most, *everywhere;
  msq_shape* space;
  (void)state;
  for (int i = 0; i < 4097; ++i) many[i] = part;
  assert_ok(msq_model_regions(context, many, 4096, &most));
  assert_ok(msq_shape_all_space(context, &space));
  everywhere = make_model(context, space, make_lattice(context), NULL);
  REFUSALS("msq_model_regions") {
    msq_context* in = context;
    const msq_model* list[2] = {part, part};
    const msq_model* const* regions = list;
    uint64_t count = 2;
    msq_model** model = (msq_model**)output(0);
    WRONG(ARGUMENT, "context is NULL", in = NULL);
    WRONG(ARGUMENT, "regions is NULL", regions = NULL);
    WRONG(ARGUMENT, "model is NULL", model = NULL);
    WRONG(ARGUMENT, "count is 0", count = 0);
    WRONG(ARGUMENT, "4097|4096", regions = many; count = 4097);
    WRONG(ARGUMENT, "regions[0] is NULL", list[0] = NULL);
    WRONG(ARGUMENT, "regions[1] is NULL", list[1] = NULL);
    RIGHT(regions = many; count = 4096);
    WRONG(LIMIT, "4097", list[0] = most);
    WRONG(UNSUPPORTED, "regions[1]|bounds", list[1] = everywhere);
    if (TRY(msq_model_regions(in, regions, count, model))) msq_model_release(*model);
  }
  msq_model_release(everywhere);
  msq_model_release(most);
  REFUSALS("msq_model_bounds") {
    const msq_model* model = part;
    double *min = (double*)output(0), *max = (double*)output(1);
    WRONG(ARGUMENT, "model is NULL", model = NULL);
    WRONG(ARGUMENT, "min is NULL", min = NULL);
    WRONG(ARGUMENT, "max is NULL", max = NULL);
    TRY(msq_model_bounds(model, min, max));
  }
  msq_model_release(part);
  msq_model* three = make_model(context, make_box(context), make_lattice(context),
                                make_foam(context, MSQ_FOAM_AUTO));
  REFUSALS("msq_model_scale_length") {
    const msq_model* model = three;
    uint32_t scale = 2;
    double* length = (double*)output(0);
    WRONG(ARGUMENT, "model is NULL", model = NULL);
    WRONG(ARGUMENT, "length is NULL", length = NULL);
    WRONG(ARGUMENT, "model has 3|3", scale = 3);
    WRONG(ARGUMENT, "model has 3|4294967295", scale = UINT32_MAX);
    TRY(msq_model_scale_length(model, scale, length));
  }
  REFUSALS("msq_model_scale") {
    const msq_model* model = three;
    uint32_t region = 0, scale = 2;
    msq_shape** shape = (msq_shape**)output(0);
    msq_structure** structure = (msq_structure**)output(1);
    RIGHT(shape = NULL);
    WRONG(ARGUMENT, "model is NULL", model = NULL);
    WRONG(ARGUMENT, "region is 1|1", region = 1);
    WRONG(ARGUMENT, "scale is 3|region 0 has 3", scale = 3);
    WRONG(ARGUMENT, "scale is 4294967295", scale = UINT32_MAX);
    if (TRY(msq_model_scale(model, region, scale, shape, structure)))
      msq_structure_release(*structure);
  }
  msq_model_release(three);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(models),
      cmocka_unit_test(parts_of_models),
  };
  context = make_context();
  const int failed = cmocka_run_group_tests(tests, NULL, NULL);
  msq_context_release(context);
  return failed;
}
