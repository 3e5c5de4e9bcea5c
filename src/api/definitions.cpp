// SPDX-License-Identifier: Apache-2.0
#include "api/definitions.h"

#include <algorithm>

namespace msq::api {

namespace {

constexpr Choice formats[] = {{"auto", MSQ_FORMAT_AUTO}, {"stl", MSQ_FORMAT_STL},
                              {"obj", MSQ_FORMAT_OBJ},   {"ply", MSQ_FORMAT_PLY},
                              {"off", MSQ_FORMAT_OFF},   {"3mf", MSQ_FORMAT_3MF},
                              {"amf", MSQ_FORMAT_AMF},   {"gltf", MSQ_FORMAT_GLTF}};
constexpr Choice windings[] = {{"nonzero", MSQ_WINDING_NONZERO},
                               {"even_odd", MSQ_WINDING_EVEN_ODD},
                               {"positive", MSQ_WINDING_POSITIVE},
                               {"auto", MSQ_WINDING_AUTO}};
constexpr Choice solids[] = {{"above", MSQ_SOLID_ABOVE}, {"below", MSQ_SOLID_BELOW}};
constexpr Choice operations[] = {{"union", MSQ_BOOLEAN_UNION},
                                 {"intersection", MSQ_BOOLEAN_INTERSECTION},
                                 {"difference", MSQ_BOOLEAN_DIFFERENCE}};
constexpr Choice unit_cells[] = {{"custom", MSQ_UNIT_CELL_CUSTOM},
                                 {"cubic", MSQ_UNIT_CELL_CUBIC},
                                 {"bcc", MSQ_UNIT_CELL_BCC},
                                 {"octet", MSQ_UNIT_CELL_OCTET},
                                 {"fcc", MSQ_UNIT_CELL_FCC},
                                 {"kelvin", MSQ_UNIT_CELL_KELVIN},
                                 {"diamond", MSQ_UNIT_CELL_DIAMOND},
                                 {"rhombic_dodecahedron", MSQ_UNIT_CELL_RHOMBIC_DODECAHEDRON},
                                 {"reentrant", MSQ_UNIT_CELL_REENTRANT}};
constexpr Choice plate_cells[] = {{"custom", MSQ_PLATE_CELL_CUSTOM},
                                  {"cubic", MSQ_PLATE_CELL_CUBIC},
                                  {"bcc", MSQ_PLATE_CELL_BCC},
                                  {"fcc", MSQ_PLATE_CELL_FCC},
                                  {"cubic_octet", MSQ_PLATE_CELL_CUBIC_OCTET},
                                  {"kelvin", MSQ_PLATE_CELL_KELVIN}};
constexpr Choice methods[] = {{"auto", MSQ_FOAM_AUTO},
                              {"point", MSQ_FOAM_POINT},
                              {"method_2", MSQ_FOAM_METHOD_2},
                              {"direct", MSQ_FOAM_DIRECT},
                              {"method_1", MSQ_FOAM_METHOD_1}};
constexpr Choice functions[] = {{"expression", MSQ_FUNCTION_EXPRESSION},
                                {"gyroid", MSQ_FUNCTION_GYROID},
                                {"schwarz_p", MSQ_FUNCTION_SCHWARZ_P},
                                {"diamond", MSQ_FUNCTION_DIAMOND},
                                {"i_wp", MSQ_FUNCTION_I_WP},
                                {"neovius", MSQ_FUNCTION_NEOVIUS},
                                {"f_rd", MSQ_FUNCTION_F_RD},
                                {"lidinoid", MSQ_FUNCTION_LIDINOID},
                                {"split_p", MSQ_FUNCTION_SPLIT_P},
                                {"fischer_koch_s", MSQ_FUNCTION_FISCHER_KOCH_S},
                                {"c_y", MSQ_FUNCTION_C_Y},
                                {"c_plus_minus_y", MSQ_FUNCTION_C_PLUS_MINUS_Y},
                                {"karcher_k", MSQ_FUNCTION_KARCHER_K},
                                {"g_prime", MSQ_FUNCTION_G_PRIME},
                                {"double_gyroid", MSQ_FUNCTION_DOUBLE_GYROID},
                                {"double_diamond", MSQ_FUNCTION_DOUBLE_DIAMOND},
                                {"double_p", MSQ_FUNCTION_DOUBLE_P},
                                {"honeycomb", MSQ_FUNCTION_HONEYCOMB},
                                {"rods", MSQ_FUNCTION_RODS}};
constexpr Choice kinds[] = {{"network", MSQ_FUNCTIONAL_NETWORK}, {"sheet", MSQ_FUNCTIONAL_SHEET}};
constexpr Choice warps[] = {{"cylindrical", MSQ_WARP_CYLINDRICAL},
                            {"spherical", MSQ_WARP_SPHERICAL},
                            {"sampled", MSQ_WARP_SAMPLED}};
constexpr Choice caps[] = {
    {"sphere", MSQ_CAP_SPHERE}, {"hemisphere", MSQ_CAP_HEMISPHERE}, {"butt", MSQ_CAP_BUTT}};
constexpr Choice types[] = {{"float32", MSQ_FLOAT32},
                            {"float64", MSQ_FLOAT64},
                            {"uint8", MSQ_UINT8},
                            {"int16", MSQ_INT16},
                            {"uint16", MSQ_UINT16}};

/// The grid of a definition, or of an image.
void walk_grid(DefinitionWalk& in, msq_neighbourhood& grid) {
  in.members(
      "grid", [&](DefinitionWalk& of) { walk(of, grid); },
      [](DefinitionWalk& of) {
        auto defaults = defaults_of<msq_neighbourhood>();
        walk(of, defaults);
      });
}

/// Of a named cell strut_count is the number of factors.
template <class Def>
void count_factors(DefinitionWalk& in, uint64_t count, Def& def) {
  if (!def.strut_factors) return;
  if (!def.struts) def.strut_count = count;
  in.equal_counts("strut_factors", count, "struts", def.strut_count);
}

void walk(DefinitionWalk& in, msq_unit_cell_def& def) {
  in.choice("unit_cell", def.unit_cell, unit_cells);
  in.tuples("nodes", def.nodes, def.node_count, 3);
  in.tuples("struts", def.struts, def.strut_count, 2);
  uint64_t count = def.strut_factors ? def.strut_count : 0;
  in.tuples("strut_factors", def.strut_factors, count, 1);
  count_factors(in, count, def);
}

void walk_period(DefinitionWalk& in, msq_period_def& def) {
  in.whole("axis", def.axis);
  uint64_t sizes = def.count;
  in.tuples("positions", def.positions, def.count, 1);
  in.tuples("cell_sizes", def.cell_sizes, sizes, 1);
  in.equal_counts("cell_sizes", sizes, "positions", def.count);
}

void walk_channel(DefinitionWalk& in, msq_channel& channel) {
  in.text("name", channel.name);
  in.param("value", channel.value);
}

void walk_scale(DefinitionWalk& in, msq_scale_def& scale) {
  in.object("shape", scale.shape);
  in.object("structure", scale.structure);
  in.param("skin", scale.skin);
  in.object("material", scale.material);
  in.object("skin_material", scale.skin_material);
}

}  // namespace

const Choices image_types = types;

void walk_warp(DefinitionWalk& in, msq_warp_def& def) {
  in.choice("kind", def.kind, warps);
  in.whole("count", def.count);
  in.whole("count_polar", def.count_polar);
  in.number("inner_radius", def.inner_radius);
  in.number("outer_radius", def.outer_radius);
  in.object("u", def.u);
  in.object("v", def.v);
  in.object("w", def.w);
  in.number("shear_outwards", def.shear_outwards);
  in.number("shear_along", def.shear_along);
}

#define MSQ_DEFAULTS(Def, init) \
  template <>                   \
  Def defaults_of() {           \
    Def def{};                  \
    init(&def, sizeof def);     \
    return def;                 \
  }
MSQ_DEFAULTS(msq_mesh_def, msq_mesh_def_init)
MSQ_DEFAULTS(msq_voxels_def, msq_voxels_def_init)
MSQ_DEFAULTS(msq_radial_field_def, msq_radial_field_def_init)
MSQ_DEFAULTS(msq_expression_field_def, msq_expression_field_def_init)
MSQ_DEFAULTS(msq_shape_distance_field_def, msq_shape_distance_field_def_init)
MSQ_DEFAULTS(msq_unit_cell_def, msq_unit_cell_def_init)
MSQ_DEFAULTS(msq_lattice_def, msq_lattice_def_init)
MSQ_DEFAULTS(msq_plate_lattice_def, msq_plate_lattice_def_init)
MSQ_DEFAULTS(msq_foam_def, msq_foam_def_init)
MSQ_DEFAULTS(msq_period_def, msq_period_def_init)
MSQ_DEFAULTS(msq_warp_def, msq_warp_def_init)
MSQ_DEFAULTS(msq_functional_def, msq_functional_def_init)
MSQ_DEFAULTS(msq_waves_def, msq_waves_def_init)
MSQ_DEFAULTS(msq_beams_def, msq_beams_def_init)
MSQ_DEFAULTS(msq_material_def, msq_material_def_init)
#undef MSQ_DEFAULTS
template <>
msq_neighbourhood defaults_of() {
  return defaults_of<msq_voxels_def>().image.grid;
}
template <>
FileDef defaults_of() {
  FileDef def{};
  msq_file_def_init(&def.how, sizeof def.how);
  return def;
}
template <>
VoxelsDef defaults_of() {
  return {defaults_of<msq_voxels_def>(), {}};
}
template <>
GridDef defaults_of() {
  GridDef def{};
  msq_grid_field_def_init(&def.def, sizeof def.def);
  return def;
}
#define MSQ_DEFAULTS(Def) \
  template <>             \
  Def defaults_of() {     \
    return {};            \
  }
MSQ_DEFAULTS(BoxDef)
MSQ_DEFAULTS(SphereDef)
MSQ_DEFAULTS(CylinderDef)
MSQ_DEFAULTS(AllSpaceDef)
MSQ_DEFAULTS(PlacedDef)
MSQ_DEFAULTS(BooleanDef)
MSQ_DEFAULTS(StructureBooleanDef)
MSQ_DEFAULTS(StructureBlendDef)
MSQ_DEFAULTS(StructureSmoothBooleanDef)
MSQ_DEFAULTS(OffsetDef)
MSQ_DEFAULTS(GradientDef)
MSQ_DEFAULTS(MapDef)
MSQ_DEFAULTS(BlendDef)
MSQ_DEFAULTS(ModelDef)
#undef MSQ_DEFAULTS

void walk(DefinitionWalk& in, msq_neighbourhood& grid) {
  in.numbers("origin", grid.origin);
  in.numbers("cell_size", grid.cell_size, true);
  in.numbers("rotation", grid.rotation);
}

void walk(DefinitionWalk& in, FileDef& def) {
  in.file("file", def.file);
  in.choice("format", def.how.format, formats);
  in.choice("winding_rule", def.how.winding_rule, windings);
  in.number("unit_mm", def.how.unit_mm);
}

void walk(DefinitionWalk& in, msq_mesh_def& def) {
  in.choice("winding_rule", def.winding_rule, windings);
  const auto* vertices = static_cast<const double*>(def.vertices);
  in.tuples("vertices", vertices, def.vertex_count, 3);
  def.vertices = vertices;
  in.tuples("triangles", def.triangles, def.triangle_count, 3);
}

void walk(DefinitionWalk& in, BoxDef& def) {
  in.numbers("min", def.min);
  in.numbers("max", def.max);
}

void walk(DefinitionWalk& in, SphereDef& def) {
  in.numbers("center", def.center);
  in.number("radius", def.radius);
}

void walk(DefinitionWalk& in, CylinderDef& def) {
  in.numbers("from", def.from);
  in.numbers("to", def.to);
  in.number("radius", def.radius);
}

void walk(DefinitionWalk&, AllSpaceDef&) {}

void walk(DefinitionWalk& in, VoxelsDef& def) {
  in.image("image", def.def.image, def.source);
  in.number("threshold", def.def.threshold);
  in.choice("solid", def.def.solid, solids);
}

void walk(DefinitionWalk& in, PlacedDef& def) {
  in.object("original", def.original);
  in.numbers("matrix", def.matrix);
}

void walk(DefinitionWalk& in, BooleanDef& def) {
  in.choice("operation", def.operation, operations);
  in.objects("shapes", def.shapes, def.count);
}

void walk(DefinitionWalk& in, StructureBooleanDef& def) {
  in.choice("operation", def.operation, operations);
  in.objects("structures", def.structures, def.count);
}

void walk(DefinitionWalk& in, StructureBlendDef& def) {
  in.object("a", def.a);
  in.object("b", def.b);
  in.param("fraction", def.fraction);
}

void walk(DefinitionWalk& in, StructureSmoothBooleanDef& def) {
  in.choice("operation", def.operation, operations);
  in.object("a", def.a);
  in.object("b", def.b);
  in.param("radius", def.radius);
}

void walk(DefinitionWalk& in, OffsetDef& def) {
  in.object("original", def.original);
  in.number("distance", def.distance);
}

void walk(DefinitionWalk& in, GradientDef& def) {
  in.numbers("from", def.from);
  in.number("from_value", def.from_value);
  in.numbers("to", def.to);
  in.number("to_value", def.to_value);
}

void walk(DefinitionWalk& in, msq_radial_field_def& def) {
  in.numbers("center", def.center);
  in.numbers("axis", def.axis);
  in.number("from_radius", def.from_radius);
  in.number("from_value", def.from_value);
  in.number("to_radius", def.to_radius);
  in.number("to_value", def.to_value);
}

void walk(DefinitionWalk& in, MapDef& def) {
  in.object("argument", def.argument);
  in.tuples("curve", def.curve, def.curve_count, 2);
}

void walk(DefinitionWalk& in, GridDef& def) {
  in.image("image", def.def.image, def.source);
}

void walk(DefinitionWalk& in, msq_expression_field_def& def) {
  in.text("expression", def.expression);
  in.named_values("parameters", def.parameters, def.parameter_count);
  in.number("low", def.low);
  in.number("high", def.high);
}

void walk(DefinitionWalk& in, msq_shape_distance_field_def& def) {
  in.object("shape", def.shape);
  in.tuples("curve", def.curve, def.curve_count, 2);
  in.number("step", def.step);
}

void walk(DefinitionWalk& in, msq_lattice_def& def) {
  in.choice("unit_cell", def.unit_cell, unit_cells);
  walk_grid(in, def.grid);
  in.param("radius", def.radius);
  in.tuples("nodes", def.nodes, def.node_count, 3);
  in.tuples("struts", def.struts, def.strut_count, 2);
  uint64_t count = def.strut_factors ? def.strut_count : 0;
  in.tuples("strut_factors", def.strut_factors, count, 1);
  count_factors(in, count, def);
  in.structs("cells", def.cells, def.cell_count, defaults_of<msq_unit_cell_def>(), walk);
  in.whole("clusters", def.clusters);
  in.param("cell_choice", def.cell_choice);
  in.optional("period", def.period, defaults_of<msq_period_def>(), walk_period);
  in.optional("warp", def.warp, defaults_of<msq_warp_def>(), walk_warp);
}

void walk(DefinitionWalk& in, msq_plate_lattice_def& def) {
  in.choice("plate_cell", def.plate_cell, plate_cells);
  walk_grid(in, def.grid);
  in.param("thickness", def.thickness);
  in.tuples("nodes", def.nodes, def.node_count, 3);
  in.tuples("faces", def.faces, def.face_count, 3);
  uint64_t count = def.face_factors ? def.face_count : 0;
  in.tuples("face_factors", def.face_factors, count, 1);
  if (def.face_factors) {
    if (!def.faces) def.face_count = count;
    in.equal_counts("face_factors", count, "faces", def.face_count);
  }
  in.param("radius", def.radius);
  in.choice("unit_cell", def.unit_cell, unit_cells);
  in.tuples("struts", def.struts, def.strut_count, 2);
  count = def.strut_factors ? def.strut_count : 0;
  in.tuples("strut_factors", def.strut_factors, count, 1);
  count_factors(in, count, def);
}

void walk(DefinitionWalk& in, msq_foam_def& def) {
  in.choice("method", def.method, methods);
  walk_grid(in, def.grid);
  in.param("radius", def.radius);
  in.number("jitter", def.jitter);
  in.whole("seed", def.seed);
  in.param("density", def.density);
  in.param("wall_thickness", def.wall_thickness);
  in.param("vent_radius", def.vent_radius);
  in.numbers("stretch", def.stretch);
  in.number("weight", def.weight);
  in.optional("period", def.period, defaults_of<msq_period_def>(), walk_period);
  in.optional("warp", def.warp, defaults_of<msq_warp_def>(), walk_warp);
}

void walk(DefinitionWalk& in, msq_functional_def& def) {
  in.choice("function", def.function, functions);
  in.choice("kind", def.kind, kinds);
  in.whole("clusters", def.clusters);
  walk_grid(in, def.grid);
  in.param("level", def.level);
  in.text("expression", def.expression);
  in.named_values("parameters", def.parameters, def.parameter_count);
  in.param("thickness", def.thickness);
  in.optional("period", def.period, defaults_of<msq_period_def>(), walk_period);
  in.optional("warp", def.warp, defaults_of<msq_warp_def>(), walk_warp);
}

void walk(DefinitionWalk& in, msq_waves_def& def) {
  in.choice("kind", def.kind, kinds);
  in.whole("seed", def.seed);
  in.whole("count", def.count);
  uint64_t tile[3];
  std::copy_n(def.tile, 3, tile);
  in.wholes("tile", tile, UINT32_MAX);
  for (int axis = 0; axis < 3; ++axis) def.tile[axis] = static_cast<uint32_t>(tile[axis]);
  in.numbers("cone_angles", def.cone_angles);
  walk_grid(in, def.grid);
  in.param("level", def.level);
  in.number("volume_fraction", def.volume_fraction);
}

void walk(DefinitionWalk& in, msq_beams_def& def) {
  in.choice("cap", def.cap, caps);
  const auto* nodes = static_cast<const double*>(def.nodes);
  in.tuples("nodes", nodes, def.node_count, 3);
  def.nodes = nodes;
  in.tuples("beams", def.beams, def.beam_count, 2);
  const auto* radii = static_cast<const double*>(def.radii);
  uint64_t count = radii ? def.beam_count : 0;
  in.tuples("radii", radii, count, 2);
  def.radii = radii;
  if (radii) in.equal_counts("radii", count, "beams", def.beam_count);
  count = def.caps ? def.beam_count : 0;
  in.tuples("caps", def.caps, count, 2, caps);
  if (def.caps) in.equal_counts("caps", count, "beams", def.beam_count);
  in.tuples("balls", def.balls, def.ball_count, 1);
  const auto* ball_radii = static_cast<const double*>(def.ball_radii);
  count = ball_radii ? def.ball_count : 0;
  in.tuples("ball_radii", ball_radii, count, 1);
  def.ball_radii = ball_radii;
  if (ball_radii) in.equal_counts("ball_radii", count, "balls", def.ball_count);
  in.number("radius", def.radius);
  in.number("ball_radius", def.ball_radius);
  in.number("min_length", def.min_length);
  in.number("length_scale", def.length_scale);
}

void walk(DefinitionWalk& in, msq_material_def& def) {
  in.whole("id", def.id);
  in.structs("channels", def.channels, def.channel_count, msq_channel{}, walk_channel);
}

void walk(DefinitionWalk& in, BlendDef& def) {
  in.whole("id", def.id);
  in.object("a", def.a);
  in.object("b", def.b);
  in.param("fraction", def.fraction);
}

void walk(DefinitionWalk& in, ModelDef& def) {
  in.structs("scales", def.scales, def.scale_count, msq_scale_def{}, walk_scale);
  in.objects("regions", def.regions, def.region_count);
}

}  // namespace msq::api
