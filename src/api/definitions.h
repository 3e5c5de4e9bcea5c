// SPDX-License-Identifier: Apache-2.0
// The definitions that objects keep: those of msq.h, and structs for functions that take arguments
// instead. defaults_of() and walk() exist for each.
#pragma once

#include <memory>

#include "api/definition_walk.h"
#include "base/described.h"
#include "msq.h"

namespace msq::api {

struct FileDef {
  const char* file;
  msq_file_def how;
};
struct BoxDef {
  double min[3], max[3];
};
struct SphereDef {
  double center[3], radius;
};
struct CylinderDef {
  double from[3], to[3], radius;
};
struct AllSpaceDef {};
struct VoxelsDef {
  msq_voxels_def def;
  ImageSource source;
};
struct PlacedDef {
  const msq_shape* original;
  double matrix[12];
};
struct BooleanDef {
  int32_t operation;
  const msq_shape* const* shapes;
  uint64_t count;
};
struct StructureBooleanDef {
  int32_t operation;
  const msq_structure* const* structures;
  uint64_t count;
};
struct StructureBlendDef {
  const msq_structure *a, *b;
  msq_param fraction;
};
struct StructureSmoothBooleanDef {
  int32_t operation;
  const msq_structure *a, *b;
  msq_param radius;
};
struct OffsetDef {
  const msq_shape* original;
  double distance;
};
struct GradientDef {
  double from[3], from_value, to[3], to_value;
};
struct MapDef {
  const msq_field* argument;
  const double* curve;
  uint64_t curve_count;
};
struct GridDef {
  msq_grid_field_def def;
  ImageSource source;
};
struct BlendDef {
  uint32_t id;
  const msq_material *a, *b;
  msq_param fraction;
};
/// Either scales or regions.
struct ModelDef {
  const msq_scale_def* scales;
  uint32_t scale_count;
  const msq_model* const* regions;
  uint64_t region_count;
};
/// Settings for pictures. Without has_direction the camera has all.
struct ViewDef {
  msq_camera camera;
  msq_render_def render;
  int32_t has_direction;
  double direction[3];
};

/// A definition with all defaults: those of msq.h, or zeros.
template <class Def>
Def defaults_of();
template <>
FileDef defaults_of();
template <>
msq_mesh_def defaults_of();
template <>
BoxDef defaults_of();
template <>
SphereDef defaults_of();
template <>
CylinderDef defaults_of();
template <>
AllSpaceDef defaults_of();
template <>
VoxelsDef defaults_of();
template <>
PlacedDef defaults_of();
template <>
BooleanDef defaults_of();
template <>
StructureBooleanDef defaults_of();
template <>
StructureBlendDef defaults_of();
template <>
StructureSmoothBooleanDef defaults_of();
template <>
OffsetDef defaults_of();
template <>
GradientDef defaults_of();
template <>
msq_radial_field_def defaults_of();
template <>
MapDef defaults_of();
template <>
GridDef defaults_of();
template <>
msq_expression_field_def defaults_of();
template <>
msq_shape_distance_field_def defaults_of();
template <>
msq_unit_cell_def defaults_of();
template <>
msq_lattice_def defaults_of();
template <>
msq_plate_lattice_def defaults_of();
template <>
msq_foam_def defaults_of();
template <>
msq_period_def defaults_of();
template <>
msq_warp_def defaults_of();
template <>
msq_functional_def defaults_of();
template <>
msq_waves_def defaults_of();
template <>
msq_beams_def defaults_of();
template <>
msq_material_def defaults_of();
template <>
BlendDef defaults_of();
template <>
ModelDef defaults_of();
template <>
msq_contours_def defaults_of();
template <>
msq_output_def defaults_of();
template <>
msq_slicer_def defaults_of();
template <>
msq_camera defaults_of();
template <>
msq_render_def defaults_of();
template <>
ViewDef defaults_of();
template <>
msq_voxels_def defaults_of();
template <>
msq_neighbourhood defaults_of();

void walk_warp(DefinitionWalk& in, msq_warp_def& def);
void walk(DefinitionWalk& in, FileDef& def);
void walk(DefinitionWalk& in, msq_mesh_def& def);
void walk(DefinitionWalk& in, BoxDef& def);
void walk(DefinitionWalk& in, SphereDef& def);
void walk(DefinitionWalk& in, CylinderDef& def);
void walk(DefinitionWalk& in, AllSpaceDef& def);
void walk(DefinitionWalk& in, VoxelsDef& def);
void walk(DefinitionWalk& in, PlacedDef& def);
void walk(DefinitionWalk& in, BooleanDef& def);
void walk(DefinitionWalk& in, StructureBooleanDef& def);
void walk(DefinitionWalk& in, StructureBlendDef& def);
void walk(DefinitionWalk& in, StructureSmoothBooleanDef& def);
void walk(DefinitionWalk& in, OffsetDef& def);
void walk(DefinitionWalk& in, GradientDef& def);
void walk(DefinitionWalk& in, msq_radial_field_def& def);
void walk(DefinitionWalk& in, MapDef& def);
void walk(DefinitionWalk& in, GridDef& def);
void walk(DefinitionWalk& in, msq_expression_field_def& def);
void walk(DefinitionWalk& in, msq_shape_distance_field_def& def);
void walk(DefinitionWalk& in, msq_lattice_def& def);
void walk(DefinitionWalk& in, msq_plate_lattice_def& def);
void walk(DefinitionWalk& in, msq_foam_def& def);
void walk(DefinitionWalk& in, msq_functional_def& def);
void walk(DefinitionWalk& in, msq_waves_def& def);
/// Tightly packed, of doubles.
void walk(DefinitionWalk& in, msq_beams_def& def);
void walk(DefinitionWalk& in, msq_material_def& def);
void walk(DefinitionWalk& in, BlendDef& def);
void walk(DefinitionWalk& in, ModelDef& def);
void walk(DefinitionWalk& in, msq_slicer_def& def);
void walk(DefinitionWalk& in, ViewDef& def);
/// A grid: origin, cell_size, rotation.
void walk(DefinitionWalk& in, msq_neighbourhood& grid);

/// The names of msq_number_type that images take, for documents.
extern const Choices image_types;

/// Keeps a copy of a definition in a new object, with what its pointers point to.
template <class Def>
void keep(Described& object, const Def& def);

/// The definition that keep() put there, or null.
template <class Def>
const Def* kept_definition(const Described& object);

}  // namespace msq::api
