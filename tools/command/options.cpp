// SPDX-License-Identifier: Apache-2.0
#include "options.h"

namespace command {

namespace {

constexpr char MODEL_HELP[] =
    "a model file (.json), which has structures of its own, a mesh file (STL, OBJ, PLY, OFF, 3MF, "
    "AMF, glTF), or box:X,Y,Z, a box of that size with a corner at the origin";

constexpr Option MAIN[] = {
    {"help", 'h', "", Value::NONE, "", "print this text and exit; after a command: its options"},
    {"version", 'V', "", Value::NONE, "", "print the version and exit"},
    {"man", 0, "", Value::NONE, "", "print the manual page, for man -l, and exit"},
    {"completion", 0, "SHELL", Value::WORDS, "bash zsh",
     "print the completion for a shell and exit"},
};

constexpr Option RUNNING[] = {
    {"threads", 't', "N", Value::TEXT, "", "threads; 0: one for each core (default 0)"},
    {"memory", 0, "SIZE", Value::TEXT, "",
     "maximum memory of meshes, images, cells and layers, such as 512M or 4G (default: no limit)"},
    {"quiet", 'q', "", Value::NONE, "", "print neither warnings nor progress"},
    {"help", 'h', "", Value::NONE, "", "print this text and exit"},
};

constexpr Option PART[] = {
    {"unit", 0, "UNIT", Value::TEXT, "",
     "unit of a mesh file that does not name one: um, mm, cm, m, in, ft, or its length in mm "
     "(default mm)"},
    {"up", 0, "AXIS", Value::WORDS, "x -x y -y z -z",
     "axis of a mesh file that points upwards; the part is turned so that it becomes z (default "
     "z)"},
    {"any-files", 0, "", Value::NONE, "",
     "a model file may name files anywhere, not only below its own folder"},
};

// Of msq model, which writes what others read.
constexpr Option NAMED_PART[] = {
    PART[0],
    PART[1],
    {"any-files", 0, "", Value::NONE, "",
     "the model file may name a mesh file anywhere, by its whole path, and one with a colon or a "
     "backslash in its name; it is then read with --any-files"},
};

constexpr Option STRUCTURE[] = {
    {"foam", 0, "CELL", Value::TEXT, "",
     "a Voronoi foam with one seed in each cell of this size, in mm; CELL or X,Y,Z"},
    {"lattice", 0, "NAME", Value::WORDS,
     "cubic bcc octet fcc kelvin diamond dodecahedron reentrant",
     "a lattice of struts; needs --cell and --radius"},
    {"function", 0, "NAME", Value::WORDS,
     "gyroid schwarz-p diamond i-wp neovius f-rd lidinoid split-p fischer-koch-s c-y "
     "c-plus-minus-y karcher-k g-prime double-gyroid double-diamond double-p honeycomb rods",
     "a periodic surface; needs --cell"},
    {"expression", 0, "TEXT", Value::TEXT, "",
     "a surface by a function of the angles x, y, z, 0 to 2 pi in a cell; needs --cell"},
    {"waves", 0, "LENGTH", Value::TEXT, "",
     "a spinodal structure: a sum of random waves of this length, in mm; LENGTH or X,Y,Z"},
    {"cell", 0, "SIZE", Value::TEXT, "", "size of the cells in mm; SIZE or X,Y,Z"},
    {"radius", 'r', "MM", Value::TEXT, "", "radius of the struts of a foam or a lattice"},
    {"radius-top", 0, "MM", Value::TEXT, "",
     "radius at the top of the part; from the bottom on it is linear"},
    {"thickness", 0, "MM", Value::TEXT, "", "thickness of the walls of a foam or a surface"},
    {"level", 0, "L", Value::TEXT, "", "value of the function up to which it is solid (default 0)"},
    {"sheet", 0, "", Value::NONE, "", "with --level: solid where the magnitude is up to the level"},
    {"volume-fraction", 0, "F", Value::TEXT, "", "of waves, in place of --level"},
    {"count", 0, "N", Value::TEXT, "", "number of waves (default 256)"},
    {"cones", 0, "A,B,C", Value::TEXT, "",
     "half-angles, in degrees, of the cones about the three axes; wave vectors lie in these cones; "
     "0: no cone (default 90,0,0: all directions)"},
    {"density", 0, "N", Value::TEXT, "", "seeds in a cell of a foam, from 1 to 32768 (default 1)"},
    {"jitter", 0, "J", Value::TEXT, "",
     "displacement of the seeds of a foam, from 0 (centres of cells) to 1 (default 1)"},
    {"seed", 0, "N", Value::TEXT, "", "selects the foam or the waves (default 0)"},
    {"vent", 0, "MM", Value::TEXT, "", "radius of a hole in each wall of a foam (default: none)"},
    {"stretch", 0, "X,Y,Z", Value::TEXT, "",
     "how much longer the cells of a foam are along each axis (default 1,1,1)"},
    {"weight", 0, "MM", Value::TEXT, "",
     "maximum weight of a foam's seeds, as the radius of a sphere: cells differ more in size "
     "(default 0)"},
    {"skin", 0, "MM", Value::TEXT, "", "solid skin under the surface of the part (default 0)"},
};

constexpr Option CHOICE[] = {
    {"scale", 0, "N", Value::TEXT, "",
     "scale of a model file that has the structure, from 1 (default: the only one)"},
    {"region", 0, "N", Value::TEXT, "", "region of the scale, from 0 (default 0 with --scale)"},
};

// What a command needs to read a model file and nothing else.
constexpr Option MODEL_FILES[] = {
    {"any-files", 0, "", Value::NONE, "", "the model file may name files outside its own folder"},
};

constexpr Option RESOLVED[] = {
    {"length-scale", 0, "MM", Value::TEXT, "",
     "treat structures with smaller cells as solid (default 0)"},
};

constexpr Option BOX[] = {
    {"box", 0, "X,Y,Z,X,Y,Z", Value::TEXT, "",
     "lowest and highest corner of the region (default: the part's bounding box)"},
};

constexpr Option JSON[] = {
    {"json", 0, "", Value::NONE, "", "print JSON in place of text"},
    {"output", 'o', "FILE", Value::FILE, "", "write there (default: standard output)"},
};

constexpr Option INFO[] = {
    {"self-intersections", 0, "", Value::NONE, "",
     "count the pairs of triangles that intersect (slow)"},
};

constexpr Option SLICE[] = {
    {"output", 'o', "PATH", Value::FILE, "",
     "a folder, for one file per layer, or a file that ends in .sl1, .sl1s, .svg or .3mf; "
     "required"},
    {"format", 0, "NAME", Value::WORDS, "png svg", "format of the files in a folder (default png)"},
    {"pitch", 'p', "MM", Value::TEXT, "",
     "size of a pixel, or of a square of the grid that contours start from; P or X,Y; required, "
     "except for .sl1"},
    {"layer-height", 'l', "MM", Value::TEXT, "", "height of a layer; required"},
    {"layers", 0, "FIRST:END", Value::TEXT, "",
     "compute layers FIRST to END - 1 only; without END, to the last one; the files have the names "
     "and bytes that they have in a whole run; .sl1: a print of these layers alone"},
    {"grey", 'g', "N", Value::TEXT, "",
     "grey pixels: coverage by N x N samples, N = 2, 4, 8 or 16 (default: black and white; .sl1: "
     "4)"},
    {"mirror", 0, "AXES", Value::WORDS, "none x y xy",
     "mirror pixels (default none, with y upwards; .sl1: x)"},
    {"tolerance", 0, "MM", Value::TEXT, "",
     "tolerance of contours in SVG and 3MF (default: a tenth of the pitch)"},
};

constexpr Option PRINTER[] = {
    {"panel", 0, "W,H", Value::TEXT, "", "pixels of the panel along x and y (default 2560,1440)"},
    {"panel-size", 0, "W,H", Value::TEXT, "",
     "size of the panel in mm along x and y (default 120.96,68.04)"},
    {"landscape", 0, "", Value::NONE, "", "do not turn pictures (default: x runs along columns)"},
    {"exposure", 0, "S", Value::TEXT, "", "exposure time in seconds (default 8)"},
    {"first-exposure", 0, "S", Value::TEXT, "", "exposure time of the first layer (default 35)"},
    {"fade", 0, "N", Value::TEXT, "",
     "number of layers over which the exposure time falls from that of the first layer (default "
     "10)"},
    {"material", 0, "NAME", Value::TEXT, "", "name of the resin's settings"},
    {"no-thumbnails", 0, "", Value::NONE, "", "leave out the thumbnails"},
};

constexpr Option MODEL_FILE[] = {
    {"output", 'o', "FILE", Value::FILE, "",
     "a file that ends in .json (default: standard output)"},
    {"title", 0, "TEXT", Value::TEXT, "", "title of the model"},
};

constexpr Option MESH[] = {
    {"output", 'o', "FILE", Value::FILE, "", "a file that ends in .stl or .ply; required"},
    {"pitch", 'p', "MM", Value::TEXT, "",
     "distance between the nodes at which the model is sampled; required"},
};

constexpr Option QUERY[] = {
    {"output", 'o', "FILE", Value::FILE, "",
     "a file that ends in .csv or .npy (default: CSV to standard output)"},
    {"what", 'w', "LIST", Value::TEXT, "",
     "values to write, separated by commas: membership, distance, material, region (default "
     "membership)"},
    {"channels", 0, "LIST", Value::TEXT, "",
     "names of the material channels to write, separated by commas"},
};

constexpr Option RENDER[] = {
    {"output", 'o', "FILE", Value::FILE, "", "a file that ends in .png; required"},
    {"size", 's', "W,H", Value::TEXT, "", "pixels of the picture (default 800,600)"},
    {"view", 0, "AZIMUTH,ELEVATION", Value::TEXT, "",
     "direction of the eye in degrees: 0,0 is in front, 90,0 to the right, 0,90 above (default "
     "32,30)"},
    {"zoom", 0, "F", Value::TEXT, "", "enlarge by this factor (default 1)"},
    {"at", 0, "X,Y,Z", Value::TEXT, "", "centre of the picture (default: the part's centre)"},
    {"perspective", 0, "DEGREES", Value::TEXT, "",
     "vertical angle of view (default: parallel rays)"},
    {"samples", 0, "N", Value::TEXT, "", "rays along each side of a pixel (default 2)"},
    {"glass", 0, "", Value::NONE, "", "show the part's outline as glass"},
    {"plain", 0, "", Value::NONE, "",
     "draw neither shadows nor ground; the background is transparent"},
};

constexpr Option STATS[] = {
    {"samples", 'n', "N", Value::TEXT, "", "number of sample points (default 1000000)"},
    {"sample-seed", 0, "N", Value::TEXT, "", "selects the sample points (default 0)"},
    {"phase", 0, "NAME", Value::WORDS, "solid void", "what is measured (default solid)"},
    {"two-point", 0, "LENGTHS", Value::TEXT, "",
     "two-point correlation at lengths in mm: A,B,... or FIRST:LAST:COUNT"},
    {"lineal-path", 0, "LENGTHS", Value::TEXT, "",
     "lineal-path function at lengths in mm, written in the same way"},
    {"direction", 0, "X,Y,Z", Value::TEXT, "",
     "direction of the segments of both functions (default: all directions)"},
    {"surface", 0, "MM", Value::TEXT, "",
     "also compute area and volume, from a mesh with this pitch"},
};

constexpr Option STRUTS[] = {
    {"output", 'o', "FILE", Value::FILE, "",
     "a file that ends in .csv, .jsonl or .3mf (default: CSV to standard output)"},
    {"whole", 0, "", Value::NONE, "", "do not cut the struts to the part"},
};

constexpr Option CALIBRATE[] = {
    {"fraction", 'f', "F", Value::TEXT, "", "target volume fraction, 0 to 1; required"},
    {"curve", 0, "N", Value::TEXT, "",
     "print N pairs of parameter and volume fraction too (default 0)"},
};

const Group RUNNING_GROUP = {"Running", RUNNING};
const Group PART_GROUP = {"Part", PART};
const Group STRUCTURE_GROUP = {"Structure", STRUCTURE};
const Group RESOLVED_GROUP = {"Resolution", RESOLVED};
const Group CHOICE_GROUP = {"Structure of a model file", CHOICE};
const Group BOX_GROUP = {"Region", BOX};
const Group REPORT_GROUP = {"Report", JSON};

const Operand MODEL = {"MODEL", true, MODEL_HELP};

const std::vector<Command>& table() {
  static const std::vector<Command> commands = {
      {"slice",
       "write layers as PNG, SVG, SL1 or 3MF",
       "Computes layers from the bottom to the top and writes each while the next ones are "
       "computed. A folder receives layer00000.png, or .svg, and so on. An .svg file holds all "
       "layers. A .3mf file holds all layers as slices. An .sl1 archive is for resin printers. "
       "Options override the slice settings of a model file.",
       {MODEL},
       {{"Layers", SLICE},
        {"Printer (.sl1)", PRINTER},
        PART_GROUP,
        STRUCTURE_GROUP,
        BOX_GROUP,
        RESOLVED_GROUP,
        RUNNING_GROUP},
       {"msq slice bracket.stl --foam 4 --radius 0.4 --pitch 0.5 --layer-height 0.5 -o layers/",
        "msq slice bracket.stl --lattice octet --cell 8 --radius 0.8 --layer-height 2 --panel "
        "640,360 --no-thumbnails -o bracket.sl1"},
       run_slice},
      {"mesh",
       "write a preview mesh as STL or PLY",
       "Computes a triangle mesh of the model's boundary, for programs that need a mesh. The mesh "
       "is closed and a manifold. Walls and struts narrower than 1.7 times the pitch may break.",
       {MODEL},
       {{"Mesh", MESH}, PART_GROUP, STRUCTURE_GROUP, BOX_GROUP, RESOLVED_GROUP, RUNNING_GROUP},
       {"msq mesh bracket.stl --lattice octet --cell 8 --radius 0.8 --pitch 1 -o bracket.ply"},
       run_mesh},
      {"render",
       "draw a picture by casting rays",
       "Draws the model without a mesh. Options override the view settings of a model file.",
       {MODEL},
       {{"Picture", RENDER}, PART_GROUP, STRUCTURE_GROUP, RUNNING_GROUP},
       {"msq render bracket.stl --foam 4 --radius 0.4 --samples 1 --size 160,120 -o bracket.png"},
       run_render},
      {"model",
       "write a model file",
       "Writes the model that the options describe as a model file in JSON. The file can be "
       "edited, and used in place of the options. A mesh file must be in the folder of the model "
       "file or below it, and is named from there.",
       {{"MODEL", true, "a mesh file or a box, as for other commands"}},
       {{"Model file", MODEL_FILE}, {"Part", NAMED_PART}, STRUCTURE_GROUP, RUNNING_GROUP},
       {"msq model bracket.stl --foam 4 --radius 0.4 -o bracket.json"},
       run_model},
      {"info",
       "describe a part, a model or this program",
       "Prints bounds, volume, the diagnosis of a mesh, the scales, hashes and the build of msq. "
       "Without MODEL, it prints only the build.",
       {{"MODEL", false, MODEL_HELP}},
       {{"Diagnosis", INFO}, REPORT_GROUP, PART_GROUP, STRUCTURE_GROUP, RUNNING_GROUP},
       {"msq info bracket.stl --foam 4 --radius 0.4 --self-intersections --json", "msq info"},
       run_info},
      {"stats",
       "measure volume fraction, correlations and surface",
       "Measures in a box by stratified random points. The volume fraction and both functions of "
       "lengths have standard errors. Outside the part everything is void. The relative density is "
       "the share of the part that is solid.",
       {MODEL},
       {{"Statistics", STATS},
        REPORT_GROUP,
        PART_GROUP,
        STRUCTURE_GROUP,
        BOX_GROUP,
        RESOLVED_GROUP,
        RUNNING_GROUP},
       {"msq stats bracket.stl --foam 4 --radius 0.4 --samples 50000",
        "msq stats box:10,10,10 --function gyroid --cell 5 --thickness 0.5 --samples 20000 "
        "--two-point 0:4:9 --surface 0.5 --json"},
       run_stats},
      {"query",
       "evaluate the model at points",
       "Reads points x, y, z and writes values at each point, in the same order. The points are "
       "rows of a CSV file, whose first row may be a heading, or a NumPy array of shape (n, 3) "
       "with float32 or float64. CSV output has the points and a column for each value. NPY output "
       "is one array, of records if there are several values. membership is 0 or 1. distance is "
       "signed and negative inside. material is an id, 0 outside. region is an index, -1 outside.",
       {MODEL,
        {"POINTS", true, "a file that ends in .csv or .npy, or - for CSV from standard input"}},
       {{"Values", QUERY}, PART_GROUP, STRUCTURE_GROUP, RESOLVED_GROUP, RUNNING_GROUP},
       {"echo 10,10,5 | msq query bracket.stl - --foam 4 --radius 0.4 --what membership,distance"},
       run_query},
      {"struts",
       "write struts as a graph",
       "Writes the struts of a lattice or a foam as nodes and struts between them, for "
       "finite-element programs. CSV has a row for each strut: the numbers of its nodes, their "
       "positions, the radii there, 1 for an end where the strut leaves the part, and the cell. "
       "JSON lines have the nodes first, then the struts. With a model file, the struts are those "
       "of one structure; finer and coarser structures do not cut them.",
       {MODEL},
       {{"Graph", STRUTS}, PART_GROUP, STRUCTURE_GROUP, CHOICE_GROUP, BOX_GROUP, RUNNING_GROUP},
       {"msq struts bracket.stl --foam 4 --radius 0.4 -o struts.csv"},
       run_struts},
      {"calibrate",
       "find the radius, thickness or level of a volume fraction",
       "Finds the constant parameter at which a structure has a volume fraction: the radius of "
       "struts, the thickness of the walls of a foam without struts, the level of a surface or of "
       "waves. It measures the structure alone, in whole cells. What the structure has for this "
       "parameter is ignored, also a field in a model file. So --radius, --thickness, --level and "
       "--volume-fraction may be left out, but --thickness selects the walls of a foam or the "
       "sheet of a surface, as --sheet does. A value that is given must be one that a structure "
       "can have. Foams with both struts and walls have no curve, and are refused.",
       {{"MODEL", false, "a model file (.json), in place of options"}},
       {{"Calibration", CALIBRATE},
        REPORT_GROUP,
        STRUCTURE_GROUP,
        CHOICE_GROUP,
        {"Files", MODEL_FILES},
        RUNNING_GROUP},
       {"msq calibrate --lattice bcc --cell 4 --fraction 0.2",
        "msq calibrate --function gyroid --sheet --cell 4 --fraction 0.2"},
       run_calibrate},
  };
  return commands;
}

constexpr ExitCode EXIT_CODES[] = {
    {"0", "the work is complete"},
    {"1", "the work failed; one line on standard error says why"},
    {"2", "the command line is wrong; one line on standard error says why"},
    {"129, 130, 143", "a signal (hang-up, Ctrl-C, termination) ended the work"},
};

}  // namespace

std::span<const Command> commands() {
  return table();
}
std::span<const Option> main_options() {
  return MAIN;
}
std::span<const ExitCode> exit_codes() {
  return EXIT_CODES;
}

const Command* find_command(std::string_view name) {
  for (const Command& command : table()) {
    if (command.name == name) return &command;
  }
  return nullptr;
}

const Option* find_option(const Command& command, std::string_view name) {
  for (const Group& group : command.groups) {
    for (const Option& option : group.options) {
      if (option.name == name) return &option;
    }
  }
  return nullptr;
}

}  // namespace command
