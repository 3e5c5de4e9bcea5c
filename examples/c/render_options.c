/* SPDX-License-Identifier: Apache-2.0 */
#define _POSIX_C_SOURCE 200809L
#include "render_options.h"

#include <getopt.h>
#include <stdio.h>

static const char usage[] =
    "usage: render [PART] [options]\n"
    "PART: a mesh file, an NRRD image, or block:MM (default: the bracket of the examples)\n"
    "\n"
    "  --fill LIST           what fills it: NAME:CELL:SIZE, SIZE the radius of struts or the\n"
    "                        walls of surfaces, LOW-HIGH to grade it; with + between them one\n"
    "                        within the other; or solid (default foam:4:0.4)\n"
    "                        NAME: foam; cubic, bcc, octet, fcc, kelvin, diamond, dodeca,\n"
    "                        reentrant; gyroid, p, d, iwp, neovius, frd, lidinoid, splitp, s,\n"
    "                        cy, cpmy, k, gprime, doubleg, doubled, doublep, honeycomb, rods\n"
    "  --density MOST:EXPR   seeds in a cell of a foam, an expression in x, y, z\n"
    "  --skin MM             solid skin\n"
    "  --cut AXIS:MM         take away what lies below; -AXIS:MM: above\n"
    "  --threshold VALUE     of an NRRD image (default 250)\n"
    "  --view AZIMUTH,ELEVATION  of the eye, degrees (default 32,30)\n"
    "  --zoom F              (default 1)\n"
    "  --at X,Y,Z            middle of the picture (default: of the part)\n"
    "  --perspective DEGREES (default: orthographic)\n"
    "  --size W,H            pixels (default 1200,900)\n"
    "  --samples N           along a pixel's side (default 3)\n"
    "  --glass               the part's outline, as if of glass\n"
    "  --plain               neither shadows nor ambient occlusion nor ground\n"
    "  -o FILE               (default render.png)\n"
    "  -h, --help            this text\n";

int render_options_read(render_options* o, int argc, char** argv) {
  static const struct option longs[] = {
      {"fill", 1, NULL, 'f'},  {"density", 1, NULL, 'd'}, {"skin", 1, NULL, 'k'},
      {"cut", 1, NULL, 'c'},   {"view", 1, NULL, 'v'},    {"threshold", 1, NULL, 't'},
      {"zoom", 1, NULL, 'z'},  {"at", 1, NULL, 'a'},      {"perspective", 1, NULL, 'p'},
      {"size", 1, NULL, 's'},  {"samples", 1, NULL, 'n'}, {"glass", 0, NULL, 'g'},
      {"plain", 0, NULL, 'P'}, {"help", 0, NULL, 'h'},    {NULL, 0, NULL, 0}};
  const render_options defaults = {.part = MSQ_EXAMPLE_PART,
                                   .out = "render.png",
                                   .scene = {.fill = "foam:4:0.4"},
                                   .threshold = 250,
                                   .azimuth = 32,
                                   .elevation = 30,
                                   .zoom = 1,
                                   .width = 1200,
                                   .height = 900,
                                   .samples = 3};
  *o = defaults;
  for (int option; (option = getopt_long(argc, argv, "o:h", longs, NULL)) != -1;) {
    int good = 1;
    if (option == 'h') return fputs(usage, stdout) < 0 ? -1 : 1;
    if (option == 'f') o->scene.fill = optarg;
    if (option == 'd') o->scene.density = optarg;
    if (option == 'c') o->scene.cut = optarg;
    if (option == 'o') o->out = optarg;
    if (option == 'g') o->glass = 1;
    if (option == 'P') o->plain = 1;
    if (option == 'k') good = sscanf(optarg, "%lf", &o->scene.skin) == 1;
    if (option == 't') good = sscanf(optarg, "%lf", &o->threshold) == 1;
    if (option == 'v') good = sscanf(optarg, "%lf,%lf", &o->azimuth, &o->elevation) == 2;
    if (option == 'z') good = sscanf(optarg, "%lf", &o->zoom) == 1 && o->zoom > 0;
    if (option == 'p') good = sscanf(optarg, "%lf", &o->perspective) == 1;
    if (option == 's') good = sscanf(optarg, "%u,%u", &o->width, &o->height) == 2;
    if (option == 'n') good = sscanf(optarg, "%u", &o->samples) == 1;
    if (option == 'a')
      good = o->has_at = sscanf(optarg, "%lf,%lf,%lf", o->at, o->at + 1, o->at + 2) == 3;
    if (!good) fprintf(stderr, "render: %s: not a value for this option\n", optarg);
    if (!good || option == '?') return fputs(usage, stderr), -1;
  }
  if (optind < argc) o->part = argv[optind++];
  return optind == argc ? 0 : (fputs(usage, stderr), -1);
}
