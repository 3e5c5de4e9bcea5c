/* SPDX-License-Identifier: Apache-2.0 */
#define _POSIX_C_SOURCE 200809L
#include "slice_options.h"

#include <errno.h>
#include <float.h>
#include <getopt.h>
#include <msq.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char usage[] =
    "usage: slice_stl FILE [options]\n"
    "       slice_stl --block MM [options]\n"
    "Slices FILE (STL, OBJ, PLY, OFF, 3MF, AMF or glTF), filled with a foam or a lattice.\n"
    "\n"
    "  --block MM         a cube with sides of this length instead of a file\n"
    "  --foam MM          Voronoi foam with cells of this size (default: --foam 4)\n"
    "  --lattice NAME     strut lattice instead: cubic, bcc, octet, fcc, kelvin, diamond, dodeca\n"
    "                     (rhombic dodecahedron) or reentrant; several, as bcc,octet: one after\n"
    "                     the other from left to right\n"
    "  --cell MM          its cell size (default 4)\n"
    "  --tpms NAME        function instead: gyroid, p, d, iwp, neovius, frd, lidinoid, splitp, s,\n"
    "                     cy, cpmy, k, gprime, doubleg, doubled, doublep, honeycomb or rods, in\n"
    "                     cells of --cell; the space on one side of it\n"
    "  --wall MM          its sheet instead, with walls of this mean thickness; of a foam, walls\n"
    "                     of this thickness that close its cells\n"
    "  --solid            the part alone, unfilled by any structure\n"
    "  --radius MM        radius of the struts (default 0.4; with the walls of a foam, none)\n"
    "  --radius-top MM    radius at the top of the part, from --radius at its bottom\n"
    "  --skin MM          solid skin under the surface (default: none)\n"
    "  --density N        foam graded along x, from one seed in a cell's volume to N\n"
    "  --seed N           picks another foam (default 0)\n"
    "  --layer MM         layer height (default 0.1)\n"
    "  --pitch MM         pixel size (default 0.1)\n"
    "  --unit MM          length of the file's unit, for formats that name none (default 1)\n"
    "  --every N          write a PNG for every Nth layer only, 0: none (default 1)\n"
    "  --threads N        threads to use, 0: all (default 0)\n"
    "  -o, --out FOLDER   where the pictures go; made if missing (default out)\n"
    "  -h, --help         this text\n"
    "\n"
    "Writes FOLDER/layer_00000.png and so on: 1 bit a pixel, white inside, y upwards; and\n"
    "FOLDER/sheet.png and FOLDER/preview.png.\n";

/* Says on stderr what is wrong with what. */
static int refuse(const char* what, const char* why) {
  fprintf(stderr, "slice_stl: %s%s\nTry slice_stl --help\n", what, why);
  return -1;
}

/* A length: positive, and finite. Returns 0 or -1. */
static int read_length(const char* text, double* value) {
  char* end;
  *value = strtod(text, &end);
  return end != text && *end == '\0' && *value > 0 && *value <= DBL_MAX ? 0 : -1;
}

static int read_count(const char* text, uint64_t most, uint64_t* value) {
  char* end;
  errno = 0;
  *value = strtoull(text, &end, 10);
  return *text >= '0' && *text <= '9' && *end == '\0' && errno == 0 && *value <= most ? 0 : -1;
}

/* Names with commas between them. */
static int read_unit_cells(const char* text, slice_options* o) {
  enum { MOST = sizeof o->unit_cells / sizeof o->unit_cells[0] };
  static const struct {
    const char* name;
    int32_t cell;
  } known[] = {{"cubic", MSQ_UNIT_CELL_CUBIC},
               {"bcc", MSQ_UNIT_CELL_BCC},
               {"octet", MSQ_UNIT_CELL_OCTET},
               {"fcc", MSQ_UNIT_CELL_FCC},
               {"kelvin", MSQ_UNIT_CELL_KELVIN},
               {"diamond", MSQ_UNIT_CELL_DIAMOND},
               {"dodeca", MSQ_UNIT_CELL_RHOMBIC_DODECAHEDRON},
               {"reentrant", MSQ_UNIT_CELL_REENTRANT}};
  for (o->unit_cell_count = 0; o->unit_cell_count < MOST;) {
    const size_t length = strcspn(text, ",");
    size_t i = 0;
    while (i < sizeof known / sizeof known[0] &&
           (strlen(known[i].name) != length || strncmp(text, known[i].name, length) != 0)) {
      ++i;
    }
    if (i == sizeof known / sizeof known[0]) return -1;
    o->unit_cells[o->unit_cell_count++] = known[i].cell;
    text += length;
    if (*text++ == '\0') return 0;
  }
  return -1; /* too many */
}

static int read_tpms(const char* text, int32_t* function) {
  static const char* const names[] = {
      "gyroid", "p",    "d", "iwp",    "neovius", "frd",     "lidinoid", "splitp",    "s",
      "cy",     "cpmy", "k", "gprime", "doubleg", "doubled", "doublep",  "honeycomb", "rods"};
  for (int32_t i = 0; i < MSQ_FUNCTION_RODS; ++i) {
    if (strcmp(text, names[i]) != 0) continue;
    *function = MSQ_FUNCTION_GYROID + i;
    return 0;
  }
  return -1;
}

int slice_options_read(slice_options* o, int argc, char** argv) {
  static const struct option longs[] = {
      {"foam", 1, NULL, 'f'},  {"lattice", 1, NULL, 'l'}, {"cell", 1, NULL, 'c'},
      {"solid", 0, NULL, 's'}, {"radius", 1, NULL, 'r'},  {"radius-top", 1, NULL, 'R'},
      {"seed", 1, NULL, 'S'},  {"layer", 1, NULL, 'z'},   {"pitch", 1, NULL, 'p'},
      {"unit", 1, NULL, 'u'},  {"every", 1, NULL, 'e'},   {"threads", 1, NULL, 't'},
      {"out", 1, NULL, 'o'},   {"help", 0, NULL, 'h'},    {"density", 1, NULL, 'd'},
      {"block", 1, NULL, 'b'}, {"skin", 1, NULL, 'k'},    {"tpms", 1, NULL, 'm'},
      {"wall", 1, NULL, 'w'},  {NULL, 0, NULL, 0}};
  const slice_options defaults = {.out = "out",
                                  .foam = 4,
                                  .cell = 4,
                                  .density = 1,
                                  .layer = 0.1,
                                  .pitch = 0.1,
                                  .unit = 1,
                                  .every = 1};
  *o = defaults;
  const struct {
    int option;
    double* value;
  } lengths[] = {{'f', &o->foam},  {'c', &o->cell},  {'r', &o->radius}, {'R', &o->radius_top},
                 {'z', &o->layer}, {'p', &o->pitch}, {'u', &o->unit},   {'d', &o->density},
                 {'b', &o->block}, {'k', &o->skin},  {'w', &o->wall}};
  for (int option; (option = getopt_long(argc, argv, "o:h", longs, NULL)) != -1;) {
    int bad = 0;
    for (size_t i = 0; i < sizeof lengths / sizeof lengths[0]; ++i) {
      if (lengths[i].option == option) bad = read_length(optarg, lengths[i].value);
    }
    if (option == '?') return -1; /* getopt has said what is wrong */
    if (option == 'h') return fputs(usage, stdout) < 0 ? -1 : 1;
    if (option == 'o') o->out = optarg;
    if (option == 's') o->solid = 1;
    if (option == 'f') o->unit_cell_count = 0;
    if (option == 'R') o->graded = 1;
    if (option == 'l') bad = read_unit_cells(optarg, o);
    if (option == 'm') bad = read_tpms(optarg, &o->tpms);
    if (option == 'S') bad = read_count(optarg, UINT64_MAX, &o->seed);
    if (option == 'e') bad = read_count(optarg, UINT64_MAX, &o->every);
    if (option == 't') bad = read_count(optarg, UINT32_MAX, &o->threads);
    if (bad) return refuse(optarg, ": not a value for this option");
  }
  if (o->radius == 0 && (o->wall == 0 || o->graded || o->unit_cell_count)) o->radius = 0.4;
  if (o->block > 0) return optind == argc ? 0 : refuse(argv[optind], ": a file besides --block");
  if (optind == argc) return refuse("no file to slice", "");
  if (optind < argc - 1) return refuse(argv[optind + 1], ": one file at a time, please");
  o->file = argv[optind];
  return 0;
}
