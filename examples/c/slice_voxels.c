/* SPDX-License-Identifier: Apache-2.0
 *
 * Slices a voxel image, for example a CT scan of a bone. A foam or a lattice fills it, with thicker
 * struts where the image is brighter. Try: python3 examples/parts/make_bone.py bone.nrrd &&
 * slice_voxels bone.nrrd 250 -r 0.35 -R 1.4 -o out */
#define _POSIX_C_SOURCE 200809L
#include <float.h>
#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "preview.h"
#include "sheet.h"
#include "voxel_file.h"

static const char usage[] =
    "usage: slice_voxels FILE THRESHOLD [options]\n"
    "  FILE is an NRRD of raw encoding, or with --raw a raw file; solid from THRESHOLD on\n"
    "  --raw TYPE,X,Y,Z,MM  uchar, short, ushort, float or double; values along x, y, z; spacing\n"
    "  -c MM  cell size (default 3)            -l     an octet lattice in place of a foam\n"
    "  -r MM  radius at THRESHOLD (default 0.4)  -R MM  radius at the brightest (default: -r)\n"
    "  -p MM  pixel size and layer height (default 0.25)\n"
    "  -o FOLDER  where sheet.png and preview.png go (default .)\n";

typedef struct run {
  msq_slicer *slicer, *coarse; /* of the filled part and of the part alone */
  uint8_t* layer;              /* of the part alone */
  uint64_t layer_bytes, inside;
  sheet* sheet;
  preview* preview;
} run;

static int32_t take_layer(void* user, const msq_layer* layer) {
  run* r = user;
  if (msq_slice_layer(r->coarse, layer->index, r->layer, r->layer_bytes, NULL) != MSQ_OK) return -1;
  r->inside += layer->inside_count;
  sheet_take(r->sheet, layer, r->layer);
  preview_take(r->preview, layer, r->layer);
  return 0;
}

/* Ends the program where a call of msq fails. */
static void check(msq_status status) {
  if (status == MSQ_OK) return;
  fprintf(stderr, "slice_voxels: %s\n", msq_error_message());
  exit(1);
}

int main(int argc, char** argv) {
  static const struct option longs[] = {{"raw", 1, NULL, 'w'}, {NULL, 0, NULL, 0}};
  double cell = 3, least = 0.4, most = 0, pitch = 0.25;
  int is_lattice = 0;
  const char *out = ".", *raw = NULL;
  for (int option; (option = getopt_long(argc, argv, "c:lr:R:p:o:", longs, NULL)) != -1;) {
    if (option == 'c') cell = atof(optarg);
    if (option == 'l') is_lattice = 1;
    if (option == 'r') least = atof(optarg);
    if (option == 'R') most = atof(optarg);
    if (option == 'p') pitch = atof(optarg);
    if (option == 'o') out = optarg;
    if (option == 'w') raw = optarg;
    if (option == '?') return fputs(usage, stderr), 2;
  }
  if (argc - optind != 2) return fputs(usage, stderr), 2;

  /* The image is the coarse shape, and, through a curve, the radius of the struts. */
  msq_context* context;
  msq_shape* part;
  msq_field *grey, *radius;
  voxel_file file = {0};
  msq_voxels_def voxels;
  check(msq_context_create(NULL, &context));
  check(msq_voxels_def_init(&voxels, sizeof voxels));
  file.image = voxels.image;
  if (raw && voxel_file_layout(&file, raw) != 0) return fputs(usage, stderr), 2;
  if ((raw ? voxel_file_read_raw : voxel_file_read_nrrd)(&file, argv[optind]) != 0) {
    fprintf(stderr, "slice_voxels: %s\n", file.problem);
    voxel_file_free(&file);
    return 1;
  }
  voxels.image = file.image;
  voxels.threshold = atof(argv[optind + 1]);
  check(msq_shape_from_voxels(context, &voxels, &part));
  msq_grid_field_def grid;
  check(msq_grid_field_def_init(&grid, sizeof grid));
  grid.image = file.image;
  check(msq_field_grid(context, &grid, &grey));
  voxel_file_free(&file);                        /* msq has its own */
  const double bright = voxels.threshold + 1500; /* Hounsfield units of dense bone, about */
  const double curve[] = {voxels.threshold, least, bright, most > 0 ? most : least};
  check(msq_field_map(context, grey, curve, 2, &radius));

  msq_structure* filling;
  msq_foam_def foam;
  msq_lattice_def lattice;
  check(msq_foam_def_init(&foam, sizeof foam));
  check(msq_lattice_def_init(&lattice, sizeof lattice));
  for (int a = 0; a < 3; ++a) foam.grid.cell_size[a] = lattice.grid.cell_size[a] = cell;
  foam.radius.field = lattice.radius.field = radius;
  lattice.unit_cell = MSQ_UNIT_CELL_OCTET;
  check(is_lattice ? msq_structure_lattice(context, &lattice, &filling)
                   : msq_structure_foam(context, &foam, &filling));

  const msq_scale_def scales[2] = {{.shape = part}, {.structure = filling}};
  msq_model* model;
  msq_model_def model_def;
  check(msq_model_def_init(&model_def, sizeof model_def));
  model_def.scales = scales;
  model_def.scale_count = 2;
  model_def.scale_size = sizeof scales[0];
  check(msq_model_create(context, &model_def, &model));
  run r = {0};
  msq_slicer_def plan;
  check(msq_slicer_def_init(&plan, sizeof plan));
  plan.pitch[0] = plan.pitch[1] = plan.layer_height = pitch;
  check(msq_slicer_create(model, &plan, &r.slicer));
  plan.length_scale = DBL_MAX; /* leaves the filling unresolved */
  check(msq_slicer_create(model, &plan, &r.coarse));
  msq_slicer_report report = {.struct_size = sizeof report};
  check(msq_slicer_info(r.slicer, &report));
  r.layer_bytes = report.layer_bytes;
  r.layer = malloc(report.layer_bytes);
  r.sheet = sheet_create(&report);
  r.preview = preview_create(&report, pitch);
  if (!r.layer || !r.sheet || !r.preview) return fputs("slice_voxels: out of memory\n", stderr), 1;
  check(msq_slicer_run(r.slicer, 0, UINT64_MAX, take_layer, &r, NULL));

  char sheet_path[4096], preview_path[4096];
  mkdir(out, 0777); /* may be there already */
  snprintf(sheet_path, sizeof sheet_path, "%s/sheet.png", out);
  snprintf(preview_path, sizeof preview_path, "%s/preview.png", out);
  int code = sheet_save(r.sheet, sheet_path);
  if (code == 0) code = preview_save(r.preview, preview_path);
  if (code) fprintf(stderr, "slice_voxels: pictures in %s: %s\n", out, strerror(code));
  msq_shape_report facts = {.struct_size = sizeof facts};
  check(msq_shape_info(part, &facts));
  printf("%llu layers of %u x %u pixels; %.1f %% of %.2f cm3 filled\n",
         (unsigned long long)report.layer_count, report.width, report.height,
         100 * (double)r.inside * pitch * pitch * pitch / facts.volume, facts.volume / 1000);
  free(r.layer);
  sheet_free(r.sheet);
  preview_free(r.preview);
  msq_slicer_release(r.coarse);
  msq_slicer_release(r.slicer);
  msq_model_release(model);
  msq_structure_release(filling);
  msq_field_release(radius);
  msq_field_release(grey);
  msq_shape_release(part);
  msq_context_release(context);
  return code != 0;
}
