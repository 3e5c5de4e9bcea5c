/* SPDX-License-Identifier: Apache-2.0
 * Is it printable? A block with a closed-cell foam, once without and once with holes in its walls:
 * islands, loose parts, voids and cups that trap resin, thin places.
 *
 * usage: printability [PITCH] */
#include <msq.h>
#include <stdio.h>
#include <stdlib.h>

static void check(msq_status status) {
  if (status == MSQ_OK) return;
  fprintf(stderr, "printability: %s: %s\n", msq_status_name(status), msq_error_message());
  exit(1);
}

static void warn(void* user, int32_t code, const char* message) {
  (void)user;
  fprintf(stderr, "printability: warning %d: %s\n", (int)code, message);
}

/* 12 x 12 x 12 mm, cells of 3 mm. */
static msq_model* make_block(msq_context* context, double vent_radius) {
  const double min[3] = {0, 0, 0}, max[3] = {12, 12, 12};
  msq_shape* box;
  check(msq_shape_from_box(context, min, max, &box));

  msq_foam_def foam_def;
  check(msq_foam_def_init(&foam_def, sizeof foam_def));
  for (int axis = 0; axis < 3; ++axis) foam_def.grid.cell_size[axis] = 3;
  foam_def.wall_thickness.value = 0.4;
  foam_def.vent_radius.value = vent_radius;
  msq_structure* foam;
  check(msq_structure_foam(context, &foam_def, &foam));

  const msq_scale_def scales[2] = {{.shape = box}, {.structure = foam}};
  msq_model_def model_def;
  check(msq_model_def_init(&model_def, sizeof model_def));
  model_def.scales = scales;
  model_def.scale_count = 2;
  model_def.scale_size = sizeof scales[0];
  msq_model* model;
  check(msq_model_create(context, &model_def, &model));
  msq_structure_release(foam);
  msq_shape_release(box);
  return model;
}

static const char* name_of(int32_t kind) {
  switch (kind) {
    case MSQ_FINDING_ISLAND:
      return "island";
    case MSQ_FINDING_LOOSE:
      return "loose part";
    case MSQ_FINDING_VOID:
      return "void";
    case MSQ_FINDING_CUP:
      return "cup";
    case MSQ_FINDING_OVERHANG:
      return "overhang";
    default:
      return "thin place";
  }
}

static int32_t show(void* user, const msq_finding* findings, uint64_t count) {
  uint64_t* shown = (uint64_t*)user;
  for (uint64_t i = 0; i < count; ++i) {
    const msq_finding* found = &findings[i];
    if (++*shown > 5) continue;
    printf("  %-10s %8.3f mm3 at %5.2f %5.2f %5.2f, layers %llu to %llu\n", name_of(found->kind),
           found->volume, found->point[0], found->point[1], found->point[2],
           (unsigned long long)found->first_layer, (unsigned long long)found->last_layer);
  }
  return 0;
}

static msq_printability_report inspect(const msq_model* model, double pitch) {
  msq_slicer_def plan;
  check(msq_slicer_def_init(&plan, sizeof plan));
  plan.pitch[0] = plan.pitch[1] = plan.layer_height = pitch;
  msq_slicer* slicer;
  check(msq_slicer_create(model, &plan, &slicer));

  msq_printability_def def;
  check(msq_printability_def_init(&def, sizeof def));
  def.kinds |= MSQ_FINDING_THIN | MSQ_FINDING_CUP;
  def.width = 3 * pitch;
  def.min_volume = 10 * pitch * pitch * pitch;
  msq_printability_report report = {.struct_size = sizeof report};
  uint64_t shown = 0;
  check(msq_printability(slicer, &def, show, &shown, &report, NULL));
  printf(
      "%llu layers: %llu islands, %llu loose parts, %llu voids of %.1f mm3, %llu cups, "
      "%llu thin places\n",
      (unsigned long long)report.layer_count, (unsigned long long)report.island_count,
      (unsigned long long)report.loose_count, (unsigned long long)report.void_count,
      report.void_volume, (unsigned long long)report.cup_count,
      (unsigned long long)report.thin_count);
  msq_slicer_release(slicer);
  return report;
}

int main(int argc, char** argv) {
  const double pitch = argc > 1 ? atof(argv[1]) : 0.1;
  msq_context_def def;
  check(msq_context_def_init(&def, sizeof def));
  def.warning = warn;
  msq_context* context;
  check(msq_context_create(&def, &context));

  msq_model* closed = make_block(context, 0);
  printf("closed cells:\n");
  const msq_printability_report trapped = inspect(closed, pitch);
  msq_model* vented = make_block(context, 0.5);
  printf("with holes of 1 mm:\n");
  const msq_printability_report drained = inspect(vented, pitch);

  msq_model_release(vented);
  msq_model_release(closed);
  msq_context_release(context);
  return trapped.void_count == 0 || drained.void_count >= trapped.void_count;
}
