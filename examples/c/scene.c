/* SPDX-License-Identifier: Apache-2.0 */
#include "scene.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "voxel_file.h"

enum { MOST_SCALES = 8 };

/* Both return -1, for calls of msq and for words that make no sense. */
static int fail(scene* s) {
  snprintf(s->problem, sizeof s->problem, "%s", msq_error_message());
  return -1;
}
static int refuse(scene* s, const char* text, const char* why) {
  snprintf(s->problem, sizeof s->problem, "%.300s: %s", text, why);
  return -1;
}

#define TRY(call)                         \
  do {                                    \
    if ((call) != MSQ_OK) return fail(s); \
  } while (0)

static int open_voxels(scene* s, const char* path) {
  msq_voxels_def voxels;
  msq_grid_field_def grid;
  voxel_file file = {0};
  TRY(msq_voxels_def_init(&voxels, sizeof voxels));
  TRY(msq_grid_field_def_init(&grid, sizeof grid));
  file.image = voxels.image;
  if (voxel_file_read_nrrd(&file, path) != 0) {
    snprintf(s->problem, sizeof s->problem, "%s", file.problem);
    voxel_file_free(&file);
    return -1;
  }
  voxels.image = grid.image = file.image;
  voxels.threshold = s->threshold;
  msq_status status = msq_shape_from_voxels(s->context, &voxels, &s->part);
  if (status == MSQ_OK) status = msq_field_grid(s->context, &grid, &s->grey);
  voxel_file_free(&file); /* msq has its own */
  return status == MSQ_OK ? 0 : fail(s);
}

int scene_open(scene* s, const char* part, double threshold) {
  const struct scene none = {0};
  *s = none;
  s->threshold = threshold;
  TRY(msq_context_create(NULL, &s->context));
  const char* dot = strrchr(part, '.');
  if (strncmp(part, "block:", 6) == 0) {
    const double half = 0.5 * atof(part + 6);
    const double low[3] = {-half, -half, -half}, high[3] = {half, half, half};
    TRY(msq_shape_from_box(s->context, low, high, &s->part));
  } else if (dot && (strcmp(dot, ".nrrd") == 0 || strcmp(dot, ".nhdr") == 0)) {
    if (open_voxels(s, part) != 0) return -1;
  } else {
    TRY(msq_shape_from_file(s->context, part, NULL, &s->part, NULL));
  }
  msq_shape_report report = {.struct_size = sizeof report};
  TRY(msq_shape_info(s->part, &report));
  memcpy(s->min, report.min, sizeof s->min);
  memcpy(s->max, report.max, sizeof s->max);
  return 0;
}

void scene_close(scene* s) {
  msq_field_release(s->grey);
  msq_shape_release(s->part);
  msq_context_release(s->context);
}

/* Numbers a term: NAME:CELL[:SIZE[-SIZE]]. */
typedef struct term {
  char name[16];
  double cell, low, high; /* low 0: no size; high 0: the size is low everywhere */
} term;

static int read_term(const char* text, size_t length, term* t) {
  char copy[96], rest;
  const term none = {"", 0, 0, 0};
  *t = none;
  if (length >= sizeof copy) return -1;
  memcpy(copy, text, length);
  copy[length] = '\0';
  const int got =
      sscanf(copy, "%15[a-z]:%lf:%lf-%lf%c", t->name, &t->cell, &t->low, &t->high, &rest);
  return got >= 2 && got <= 4 && t->cell > 0 && t->low >= 0 && t->high >= 0 ? 0 : -1;
}

/* The size of a term as a parameter; *field is to be released. */
static int make_size(scene* s, const term* t, msq_param* size, msq_field** field) {
  size->value = t->low;
  if (t->high > 0 && s->grey) {
    /* Spongy bone has lattices, dense bone is solid: in Hounsfield units, about. */
    const double from = s->threshold,
                 curve[6] = {from, t->low, from + 450, t->high, from + 700, 0.6 * t->cell};
    TRY(msq_field_map(s->context, s->grey, curve, 3, field));
  } else if (t->high > 0) {
    const double bottom[3] = {0, 0, s->min[2]}, top[3] = {0, 0, s->max[2]};
    TRY(msq_field_gradient(s->context, bottom, t->low, top, t->high, field));
  }
  size->field = *field;
  return 0;
}

static int make_foam(scene* s, const term* t, msq_param size, const char* density,
                     msq_structure** structure) {
  msq_foam_def foam;
  TRY(msq_foam_def_init(&foam, sizeof foam));
  for (int a = 0; a < 3; ++a) foam.grid.cell_size[a] = t->cell;
  foam.radius = size;
  msq_field* seeds = NULL;
  if (density) {
    const char* colon = strchr(density, ':');
    if (!colon) return refuse(s, density, "a density is MOST:EXPRESSION");
    msq_expression_field_def def;
    TRY(msq_expression_field_def_init(&def, sizeof def));
    def.expression = colon + 1;
    def.low = 1;
    def.high = atof(density);
    TRY(msq_field_expression(s->context, &def, &seeds));
    foam.density.field = seeds;
  }
  const msq_status status = msq_structure_foam(s->context, &foam, structure);
  msq_field_release(seeds); /* the foam keeps it */
  return status == MSQ_OK ? 0 : fail(s);
}

static int make_structure(scene* s, const term* t, msq_param size, const char* density,
                          msq_structure** structure) {
  static const char* const cells[] = {"cubic",  "bcc",     "octet",  "fcc",
                                      "kelvin", "diamond", "dodeca", "reentrant"};
  static const char* const surfaces[] = {
      "gyroid", "p",    "d", "iwp",    "neovius", "frd",     "lidinoid", "splitp",    "s",
      "cy",     "cpmy", "k", "gprime", "doubleg", "doubled", "doublep",  "honeycomb", "rods"};
  if (strcmp(t->name, "foam") == 0) return make_foam(s, t, size, density, structure);
  for (int i = 0; i < 8; ++i) {
    if (strcmp(t->name, cells[i]) == 0) {
      msq_lattice_def lattice;
      TRY(msq_lattice_def_init(&lattice, sizeof lattice));
      lattice.unit_cell = MSQ_UNIT_CELL_CUBIC + i;
      for (int a = 0; a < 3; ++a) lattice.grid.cell_size[a] = t->cell;
      lattice.radius = size;
      TRY(msq_structure_lattice(s->context, &lattice, structure));
      return 0;
    }
  }
  for (int i = 0; i < MSQ_FUNCTION_RODS; ++i) {
    if (strcmp(t->name, surfaces[i]) == 0) {
      msq_functional_def surface;
      TRY(msq_functional_def_init(&surface, sizeof surface));
      surface.function = MSQ_FUNCTION_GYROID + i;
      for (int a = 0; a < 3; ++a) surface.grid.cell_size[a] = t->cell;
      if (surface.function == MSQ_FUNCTION_HONEYCOMB)
        surface.grid.cell_size[1] *= 1.7320508075688772;
      if (t->low > 0) {
        surface.kind = MSQ_FUNCTIONAL_SHEET;
        surface.thickness = size;
      }
      TRY(msq_structure_functional(s->context, &surface, structure));
      return 0;
    }
  }
  return refuse(s, t->name, "no structure; render --help lists them");
}

/* Half of space: a function of one coordinate, of which a single period holds the part. */
static int make_cut(scene* s, const char* text, msq_structure** half) {
  const int is_above = *text == '-';
  double at;
  char axis, rest;
  if (sscanf(text + is_above, "%c:%lf%c", &axis, &at, &rest) != 2 || axis < 'x' || axis > 'z')
    return refuse(s, text, "a cut is x:MM, -x:MM, or the same of y and z");
  char expression[16];
  snprintf(expression, sizeof expression, is_above ? "%c-pi" : "pi-%c", axis);
  msq_functional_def plane;
  TRY(msq_functional_def_init(&plane, sizeof plane));
  plane.function = MSQ_FUNCTION_EXPRESSION;
  plane.expression = expression;
  for (int a = 0; a < 3; ++a) {
    const double middle = a == axis - 'x' ? at : 0.5 * (s->min[a] + s->max[a]);
    double reach = 0;
    for (int b = 0; b < 3; ++b) reach += s->max[b] - s->min[b];
    plane.grid.cell_size[a] = 8 * reach;
    plane.grid.origin[a] = middle - 4 * reach;
  }
  TRY(msq_structure_functional(s->context, &plane, half));
  return 0;
}

/* Fills in the scales behind the part; what they hold is to be released. */
static int make_scales(scene* s, const scene_def* def, msq_scale_def* scales, uint32_t* count,
                       msq_structure** structures) {
  if (def->cut) {
    if (make_cut(s, def->cut, structures + *count) != 0) return -1;
    scales[*count].structure = structures[*count];
    ++*count;
  }
  if (strcmp(def->fill, "solid") == 0) return 0;
  for (const char* at = def->fill;; ++at) {
    const size_t length = strcspn(at, "+");
    term t;
    if (*count == MOST_SCALES) return refuse(s, def->fill, "too many terms");
    if (read_term(at, length, &t) != 0)
      return refuse(s, at, "a term is NAME:CELL or NAME:CELL:SIZE, as in foam:4:0.4");
    msq_param size;
    msq_field* field = NULL;
    int failed = make_size(s, &t, &size, &field);
    if (!failed) failed = make_structure(s, &t, size, def->density, structures + *count);
    msq_field_release(field); /* the structure keeps it */
    if (failed) return -1;
    scales[*count].structure = structures[*count];
    scales[*count].skin.value = def->skin;
    ++*count;
    at += length;
    if (*at == '\0') return 0;
  }
}

int scene_model(scene* s, const scene_def* def, msq_model** model) {
  msq_scale_def scales[MOST_SCALES] = {{.shape = s->part}};
  msq_structure* structures[MOST_SCALES] = {NULL};
  uint32_t count = 1;
  int failed = make_scales(s, def, scales, &count, structures);
  msq_model_def model_def;
  if (!failed && msq_model_def_init(&model_def, sizeof model_def) == MSQ_OK) {
    model_def.scales = scales;
    model_def.scale_count = count;
    model_def.scale_size = sizeof scales[0];
    if (msq_model_create(s->context, &model_def, model) != MSQ_OK) failed = fail(s);
  }
  for (int i = 0; i < MOST_SCALES; ++i) msq_structure_release(structures[i]);
  return failed;
}
