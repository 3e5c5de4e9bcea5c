/* SPDX-License-Identifier: Apache-2.0 */
#include "scene.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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

/* The part of a model file, whose model is fill SCENE_OWN. */
static int open_model(scene* s, const char* path) {
  msq_document* document;
  TRY(msq_document_from_file(s->context, path, NULL, &document, NULL));
  const msq_status status = msq_document_model(document, &s->model);
  msq_document_release(document);
  if (status != MSQ_OK) return fail(s);
  TRY(msq_model_scale(s->model, 0, 0, &s->part, NULL));
  TRY(msq_model_bounds(s->model, s->min, s->max));
  return 0;
}

int scene_open(scene* s, const char* part) {
  const struct scene none = {0};
  *s = none;
  TRY(msq_context_create(NULL, &s->context));
  const char* dot = strrchr(part, '.');
  if (dot && strcmp(dot, ".json") == 0) return open_model(s, part);
  if (strncmp(part, "block:", 6) == 0) {
    const double half = 0.5 * atof(part + 6);
    const double low[3] = {-half, -half, -half}, high[3] = {half, half, half};
    TRY(msq_shape_from_box(s->context, low, high, &s->part));
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
  msq_model_release(s->model);
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
  if (t->high > 0) {
    const double bottom[3] = {0, 0, s->min[2]}, top[3] = {0, 0, s->max[2]};
    TRY(msq_field_gradient(s->context, bottom, t->low, top, t->high, field));
  }
  size->field = *field;
  return 0;
}

static int make_foam(scene* s, const term* t, msq_param size, msq_structure** structure) {
  msq_foam_def foam;
  TRY(msq_foam_def_init(&foam, sizeof foam));
  for (int a = 0; a < 3; ++a) foam.grid.cell_size[a] = t->cell;
  foam.radius = size;
  TRY(msq_structure_foam(s->context, &foam, structure));
  return 0;
}

static int make_structure(scene* s, const term* t, msq_param size, msq_structure** structure) {
  static const char* const cells[] = {"cubic",  "bcc",     "octet",  "fcc",
                                      "kelvin", "diamond", "dodeca", "reentrant"};
  static const char* const surfaces[] = {
      "gyroid", "p",    "d", "iwp",    "neovius", "frd",     "lidinoid", "splitp",    "s",
      "cy",     "cpmy", "k", "gprime", "doubleg", "doubled", "doublep",  "honeycomb", "rods"};
  if (strcmp(t->name, "foam") == 0) return make_foam(s, t, size, structure);
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
  return refuse(s, t->name, "no structure that scene.c names");
}

/* Fills in the scales behind the part; what they hold is to be released. */
static int make_scales(scene* s, const scene_def* def, msq_scale_def* scales, uint32_t* count,
                       msq_structure** structures) {
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
    if (!failed) failed = make_structure(s, &t, size, structures + *count);
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
  if (s->model && strcmp(def->fill, SCENE_OWN) == 0) {
    msq_model_retain(s->model);
    *model = s->model;
    return 0;
  }
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
