/* SPDX-License-Identifier: Apache-2.0
 *
 * Fills a mesh file, or a cube, with a foam, a lattice or a minimal surface, and writes one PNG per
 * layer, a contact sheet and a shaded preview. Try: slice_stl examples/parts/bracket.stl -o out
 */
#define _POSIX_C_SOURCE 200809L
#include <errno.h>
#include <float.h>
#include <msq.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "png_image.h"
#include "preview.h"
#include "sheet.h"
#include "slice_options.h"

/* What msq holds for us. All zero at first: releasing NULL does nothing. */
typedef struct scene {
  msq_context* context;
  msq_shape* part;
  msq_field* radius;
  msq_field* density;
  msq_field* choice; /* of unit cells */
  msq_structure* filling;
  msq_model* model;
  msq_slicer* slicer; /* of the model */
  msq_slicer* coarse; /* of the part alone, by the same plan; NULL with --solid */
} scene;

static void release(scene* s) {
  msq_slicer_release(s->coarse);
  msq_slicer_release(s->slicer);
  msq_model_release(s->model);
  msq_structure_release(s->filling);
  msq_field_release(s->choice);
  msq_field_release(s->density);
  msq_field_release(s->radius);
  msq_shape_release(s->part);
  msq_context_release(s->context);
}

#define TRY(call)                          \
  do {                                     \
    const msq_status status_ = (call);     \
    if (status_ != MSQ_OK) return status_; \
  } while (0)

static msq_status read_part(scene* s, const slice_options* o, msq_shape_report* part) {
  msq_context_def context;
  TRY(msq_context_def_init(&context, sizeof context));
  context.threads = (uint32_t)o->threads;
  TRY(msq_context_create(&context, &s->context));

  if (o->block > 0) {
    const double low[3] = {0, 0, 0}, high[3] = {o->block, o->block, o->block};
    TRY(msq_shape_from_box(s->context, low, high, &s->part));
    return msq_shape_info(s->part, part);
  }
  msq_file_def file;
  TRY(msq_file_def_init(&file, sizeof file));
  file.unit_mm = o->unit;
  TRY(msq_shape_from_file(s->context, o->file, &file, &s->part, NULL));
  return msq_shape_info(s->part, part);
}

static msq_status make_lattice(scene* s, const slice_options* o, const msq_shape_report* part,
                               msq_param radius) {
  enum { MOST = sizeof o->unit_cells / sizeof o->unit_cells[0] };
  const double left[3] = {part->min[0], 0, 0}, right[3] = {part->max[0], 0, 0};
  msq_unit_cell_def cells[MOST];
  for (uint32_t i = 0; i < o->unit_cell_count; ++i) {
    TRY(msq_unit_cell_def_init(cells + i, sizeof cells[i]));
    cells[i].unit_cell = o->unit_cells[i];
  }
  /* The choice is rounded: each unit cell gets an equal part of the way. */
  TRY(msq_field_gradient(s->context, left, -0.5, right, o->unit_cell_count - 0.5, &s->choice));
  msq_lattice_def lattice;
  TRY(msq_lattice_def_init(&lattice, sizeof lattice));
  lattice.cells = cells;
  lattice.cell_count = o->unit_cell_count;
  lattice.cell_choice.field = s->choice;
  lattice.radius = radius;
  for (int a = 0; a < 3; ++a) lattice.grid.cell_size[a] = o->cell;
  return msq_structure_lattice(s->context, &lattice, &s->filling);
}

static msq_status make_surface(scene* s, const slice_options* o) {
  msq_functional_def surface;
  TRY(msq_functional_def_init(&surface, sizeof surface));
  surface.function = o->tpms;
  if (o->wall > 0) surface.kind = MSQ_FUNCTIONAL_SHEET;
  surface.thickness.value = o->wall;
  for (int a = 0; a < 3; ++a) surface.grid.cell_size[a] = o->cell;
  if (o->tpms == MSQ_FUNCTION_HONEYCOMB) surface.grid.cell_size[1] *= 1.7320508075688772;
  return msq_structure_functional(s->context, &surface, &s->filling);
}

static msq_status make_filling(scene* s, const slice_options* o, const msq_shape_report* part) {
  if (o->tpms) return make_surface(s, o);
  if (o->graded) {
    const double bottom[3] = {0, 0, part->min[2]}, top[3] = {0, 0, part->max[2]};
    TRY(msq_field_gradient(s->context, bottom, o->radius, top, o->radius_top, &s->radius));
  }
  const msq_param radius = {o->radius, s->radius}; /* the number counts where the field is NULL */
  if (o->unit_cell_count) return make_lattice(s, o, part, radius);
  msq_foam_def foam;
  TRY(msq_foam_def_init(&foam, sizeof foam));
  foam.radius = radius;
  foam.seed = o->seed;
  foam.wall_thickness.value = o->wall;
  if (o->density != 1) {
    const double left[3] = {part->min[0], 0, 0}, right[3] = {part->max[0], 0, 0};
    TRY(msq_field_gradient(s->context, left, 1, right, o->density, &s->density));
    foam.density.field = s->density;
  }
  for (int a = 0; a < 3; ++a) foam.grid.cell_size[a] = o->foam;
  return msq_structure_foam(s->context, &foam, &s->filling);
}

static msq_status plan_layers(scene* s, const slice_options* o) {
  const msq_scale_def scales[2] = {{.shape = s->part},
                                   {.structure = s->filling, .skin.value = o->skin}};
  msq_model_def model;
  TRY(msq_model_def_init(&model, sizeof model));
  model.scales = scales;
  model.scale_count = o->solid ? 1 : 2;
  model.scale_size = sizeof scales[0];
  TRY(msq_model_create(s->context, &model, &s->model));

  msq_slicer_def slicer;
  TRY(msq_slicer_def_init(&slicer, sizeof slicer));
  slicer.layer_height = o->layer;
  slicer.pitch[0] = slicer.pitch[1] = o->pitch;
  TRY(msq_slicer_create(s->model, &slicer, &s->slicer));
  if (o->solid) return MSQ_OK;
  slicer.length_scale = DBL_MAX; /* leaves the structure, whose cells are smaller, unresolved */
  return msq_slicer_create(s->model, &slicer, &s->coarse);
}

/* State of the run, for the callback. */
typedef struct run {
  const slice_options* options;
  const scene* scene;
  msq_slicer_report plan;
  preview* preview;
  sheet* sheet;
  uint8_t* coarse; /* a layer of the part alone */
  uint64_t inside, coarse_inside;
  double own_seconds; /* spent on pictures, not in msq */
  int terminal;
  char problem[640]; /* why the callback gave up */
} run;

static double seconds(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static uint64_t count_bits(const uint8_t* bytes, uint64_t count) {
  uint64_t bits = 0;
  for (uint64_t i = 0; i < count; ++i) {
    for (unsigned byte = bytes[i]; byte; byte &= byte - 1) ++bits;
  }
  return bits;
}

static void show_progress(uint64_t done, uint64_t count) {
  enum { BAR = 40 };
  static const char full[] = "########################################";
  const int filled = (int)(done * BAR / count);
  if (done < count && done * 1000 / count == (done - 1) * 1000 / count) return;
  fprintf(stderr, "\r[%-*.*s] %5.1f %%%s", BAR, filled, full, 100.0 * (double)done / (double)count,
          done == count ? "\r\033[K" : "");
}

/* Returns 0 for code 0; else says what went wrong with a file, and returns -1. */
static int explain(run* r, const char* path, int code) {
  if (code == 0) return 0;
  snprintf(r->problem, sizeof r->problem, "%.500s: %s", path, strerror(code));
  return -1;
}

/* Called by msq_slicer_run on our own thread, layer after layer, while workers compute the next. */
static int32_t take_layer(void* user, const msq_layer* layer) {
  run* r = user;
  const uint8_t* coarse = layer->data;
  if (r->scene->coarse) {
    if (msq_slice_layer(r->scene->coarse, layer->index, r->coarse, r->plan.layer_bytes, NULL)) {
      snprintf(r->problem, sizeof r->problem, "%s", msq_error_message());
      return -1;
    }
    coarse = r->coarse;
  }
  const double start = seconds();
  r->inside += layer->inside_count;
  r->coarse_inside += count_bits(coarse, r->plan.layer_bytes);
  preview_take(r->preview, layer, coarse);
  sheet_take(r->sheet, layer, coarse);
  if (r->options->every && layer->index % r->options->every == 0) {
    char path[4096];
    snprintf(path, sizeof path, "%s/layer_%05llu.png", r->options->out,
             (unsigned long long)layer->index);
    const picture image = {PICTURE_BITS, layer->width,  layer->height,
                           layer->data,  layer->stride, 1};
    if (explain(r, path, png_image_save(path, &image)) != 0) return -1;
  }
  if (r->terminal) show_progress(layer->index + 1, r->plan.layer_count);
  r->own_seconds += seconds() - start;
  return 0;
}

static void describe_part(const slice_options* o, const msq_shape_report* part) {
  if (!part->is_mesh) {
    printf("a cube of %.4g mm\n", o->block);
    return;
  }
  printf("%s: %llu triangles, ", o->file, (unsigned long long)part->triangles);
  if (part->closed) {
    printf("closed");
  } else {
    printf("not closed: %llu open edges, %llu flipped", (unsigned long long)part->open_edges,
           (unsigned long long)part->flipped_edges);
  }
  if (part->non_manifold_edges) {
    printf(", %llu non-manifold edges", (unsigned long long)part->non_manifold_edges);
  }
  printf("; %.4g x %.4g x %.4g mm\n", part->max[0] - part->min[0], part->max[1] - part->min[1],
         part->max[2] - part->min[2]);
}

/* Makes a folder and those above it. Returns 0 or an errno value. */
static int make_folders(const char* path) {
  char part[4096];
  if (*path == '\0') return ENOENT;
  if (strlen(path) >= sizeof part) return ENAMETOOLONG;
  strcpy(part, path);
  for (char* at = part + 1;; ++at) {
    const char here = *at;
    if (here != '/' && here != '\0') continue;
    *at = '\0';
    if (mkdir(part, 0777) != 0 && errno != EEXIST) return errno;
    if (here == '\0') break;
    *at = here;
  }
  struct stat status;
  if (stat(path, &status) != 0) return errno;
  return S_ISDIR(status.st_mode) ? 0 : ENOTDIR;
}

/* Slices and saves all pictures. Returns 0, or -1 with r->problem set. */
static int slice(run* r) {
  const slice_options* o = r->options;
  char path[4096];
  int code = make_folders(o->out);
  if (code) return explain(r, o->out, code);
  r->preview = preview_create(&r->plan, o->layer);
  r->sheet = sheet_create(&r->plan);
  r->coarse = malloc(r->plan.layer_bytes);
  if (!r->preview || !r->sheet || !r->coarse) return explain(r, "pictures", ENOMEM);

  const double start = seconds();
  const msq_status status = msq_slicer_run(r->scene->slicer, 0, UINT64_MAX, take_layer, r, NULL);
  if (status == MSQ_E_HOST) return -1; /* take_layer has said why */
  if (status != MSQ_OK) {
    snprintf(r->problem, sizeof r->problem, "%s", msq_error_message());
    return -1;
  }
  const double sliced = seconds();
  snprintf(path, sizeof path, "%s/sheet.png", o->out);
  if (explain(r, path, sheet_save(r->sheet, path)) != 0) return -1;
  snprintf(path, sizeof path, "%s/preview.png", o->out);
  if (explain(r, path, preview_save(r->preview, path)) != 0) return -1;
  r->own_seconds += seconds() - sliced;

  const double msq_seconds = seconds() - start - r->own_seconds;
  printf(
      "%llu layers of %u x %u pixels sliced in %.2f s, %.2f ms a layer; pictures took %.2f s; "
      "%.1f %% of the part is filled\n",
      (unsigned long long)r->plan.layer_count, r->plan.width, r->plan.height, msq_seconds,
      1e3 * msq_seconds / (double)r->plan.layer_count, r->own_seconds,
      r->coarse_inside ? 100.0 * (double)r->inside / (double)r->coarse_inside : 0.0);
  return 0;
}

int main(int argc, char** argv) {
  slice_options o;
  const int parsed = slice_options_read(&o, argc, argv);
  if (parsed != 0) return parsed < 0 ? 2 : 0;

  scene s = {0};
  run r = {.options = &o, .scene = &s, .terminal = isatty(STDERR_FILENO)};
  r.plan.struct_size = sizeof r.plan;
  msq_shape_report part = {.struct_size = sizeof part};
  msq_status status = read_part(&s, &o, &part);
  if (status == MSQ_OK) describe_part(&o, &part);
  if (status == MSQ_OK && !o.solid) status = make_filling(&s, &o, &part);
  if (status == MSQ_OK) status = plan_layers(&s, &o);
  if (status == MSQ_OK) status = msq_slicer_info(s.slicer, &r.plan);
  if (status != MSQ_OK) snprintf(r.problem, sizeof r.problem, "%s", msq_error_message());

  const int failed = status != MSQ_OK || slice(&r) != 0;
  if (failed) fprintf(stderr, "%sslice_stl: %s\n", r.terminal ? "\r\033[K" : "", r.problem);
  preview_free(r.preview);
  sheet_free(r.sheet);
  free(r.coarse);
  release(&s);
  return failed;
}
