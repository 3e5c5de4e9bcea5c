// SPDX-License-Identifier: Apache-2.0
#include "lib3mf_files.h"

#include <Model/COM/NMR_DLLInterfaces.h>

#include <cstdlib>
#include <cstring>
#include <vector>

using namespace NMR;

namespace {

#define TRY(call)                     \
  do {                                \
    if ((call) != 0) return __LINE__; \
  } while (0)

template <class T>
T* copy_of(const std::vector<T>& values) {
  auto* copy = static_cast<T*>(std::malloc(values.size() * sizeof(T) + 1));
  if (!values.empty()) std::memcpy(copy, values.data(), values.size() * sizeof(T));
  return copy;
}

int open_file(const char* path, PLib3MFModel** model, uint64_t* warnings) {
  PLib3MFModelReader* reader;
  TRY(lib3mf_createmodel(model));
  TRY(lib3mf_model_queryreader(*model, "3mf", &reader));
  TRY(lib3mf_reader_readfromfileutf8(reader, path));
  DWORD count;
  TRY(lib3mf_reader_getwarningcount(reader, &count));
  *warnings = count;
  lib3mf_release(reader);
  return 0;
}

/// Calls act(object) for each mesh until it returns something.
template <class Act>
int for_each_mesh(PLib3MFModel* model, const Act& act) {
  PLib3MFModelResourceIterator* iterator;
  TRY(lib3mf_model_getmeshobjects(model, &iterator));
  for (BOOL has = 0;;) {
    TRY(lib3mf_resourceiterator_movenext(iterator, &has));
    if (!has) break;
    PLib3MFModelResource* resource;
    TRY(lib3mf_resourceiterator_getcurrent(iterator, &resource));
    TRY(act(static_cast<PLib3MFModelMeshObject*>(resource)));
    lib3mf_release(resource);
  }
  lib3mf_release(iterator);
  return 0;
}

}  // namespace

int lib3mf_read_lattice(const char* path, lib3mf_lattice* lattice) {
  *lattice = {};
  PLib3MFModel* model;
  TRY(open_file(path, &model, &lattice->warnings));
  TRY(for_each_mesh(model, [&](PLib3MFModelMeshObject* mesh) -> int {
    DWORD beams, nodes, triangles;
    TRY(lib3mf_meshobject_getbeamcount(mesh, &beams));
    TRY(lib3mf_meshobject_getvertexcount(mesh, &nodes));
    TRY(lib3mf_meshobject_gettrianglecount(mesh, &triangles));
    if (beams == 0) {
      lattice->clipping_triangles = triangles;
      return 0;
    }
    std::vector<double> positions, radii;
    std::vector<uint32_t> ends;
    std::vector<uint8_t> caps;
    for (DWORD i = 0; i < nodes; ++i) {
      MODELMESHVERTEX vertex;
      TRY(lib3mf_meshobject_getvertex(mesh, i, &vertex));
      for (const FLOAT x : vertex.m_fPosition) positions.push_back(double{x});
    }
    std::vector<MODELMESHBEAM> all(beams);
    TRY(lib3mf_meshobject_getbeamindices(mesh, all.data(), beams, nullptr));
    for (const MODELMESHBEAM& beam : all)
      for (int end = 0; end < 2; ++end) {
        ends.push_back(beam.m_nIndices[end]);
        radii.push_back(beam.m_dRadius[end]);
        caps.push_back(static_cast<uint8_t>(beam.m_eCapMode[end]));
      }
    eModelBeamLatticeClipMode mode;
    DWORD clipping_id;
    TRY(lib3mf_meshobject_getbeamlattice_clipping(mesh, &mode, &clipping_id));
    lattice->clipping = static_cast<int32_t>(mode);
    lattice->node_count = nodes;
    lattice->beam_count = beams;
    lattice->nodes = copy_of(positions);
    lattice->radii = copy_of(radii);
    lattice->beams = copy_of(ends);
    lattice->caps = copy_of(caps);
    return 0;
  }));
  lib3mf_release(model);
  return lattice->beam_count ? 0 : __LINE__;
}

int lib3mf_write_lattice(const char* path, const lib3mf_lattice* lattice) {
  PLib3MFModel* model;
  PLib3MFModelMeshObject* mesh;
  PLib3MFModelBuildItem* item;
  PLib3MFModelWriter* writer;
  TRY(lib3mf_createmodel(&model));
  PLib3MFModelMeshObject* clip;
  TRY(lib3mf_model_addmeshobject(model, &clip));
  static const float corners[4][3] = {{-9, -9, -9}, {9, -9, -9}, {-9, 9, -9}, {-9, -9, 9}};
  static const DWORD triangles[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  for (int i = 0; i < 4; ++i) {
    MODELMESHVERTEX vertex;
    std::memcpy(vertex.m_fPosition, corners[i], sizeof corners[i]);
    TRY(lib3mf_meshobject_addvertex(clip, &vertex, nullptr));
  }
  for (int i = 0; i < 4; ++i) {
    MODELMESHTRIANGLE triangle;
    std::memcpy(triangle.m_nIndices, triangles[i], sizeof triangles[i]);
    TRY(lib3mf_meshobject_addtriangle(clip, &triangle, nullptr));
  }
  TRY(lib3mf_model_addmeshobject(model, &mesh));
  for (uint64_t i = 0; i < lattice->node_count; ++i) {
    MODELMESHVERTEX vertex;
    for (int axis = 0; axis < 3; ++axis)
      vertex.m_fPosition[axis] = static_cast<float>(lattice->nodes[3 * i + axis]);
    TRY(lib3mf_meshobject_addvertex(mesh, &vertex, nullptr));
  }
  TRY(lib3mf_meshobject_setbeamlattice_radius(mesh, 0.5));
  TRY(lib3mf_meshobject_setbeamlattice_minlength(mesh, 0.001));
  for (uint64_t i = 0; i < lattice->beam_count; ++i) {
    MODELMESHBEAM beam;
    for (uint64_t end = 0; end < 2; ++end) {
      beam.m_nIndices[end] = lattice->beams[2 * i + end];
      beam.m_dRadius[end] = lattice->radii[2 * i + end];
      beam.m_eCapMode[end] = static_cast<eModelBeamLatticeCapMode>(lattice->caps[2 * i + end]);
    }
    TRY(lib3mf_meshobject_addbeam(mesh, &beam, nullptr));
  }
  if (lattice->clipping) {
    DWORD id;
    TRY(lib3mf_resource_getresourceid(clip, &id));
    TRY(lib3mf_meshobject_setbeamlattice_clipping(
        mesh, static_cast<eModelBeamLatticeClipMode>(lattice->clipping), id));
  }
  TRY(lib3mf_model_addbuilditem(model, mesh, nullptr, &item));
  TRY(lib3mf_model_querywriter(model, "3mf", &writer));
  TRY(lib3mf_writer_writetofileutf8(writer, path));
  lib3mf_release(writer);
  lib3mf_release(item);
  lib3mf_release(mesh);
  lib3mf_release(clip);
  lib3mf_release(model);
  return 0;
}

int lib3mf_read_stack(const char* path, lib3mf_stack* stack) {
  *stack = {};
  PLib3MFModel* model;
  TRY(open_file(path, &model, &stack->warnings));
  TRY(for_each_mesh(model, [&](PLib3MFModelMeshObject* mesh) -> int {
    DWORD id, count;
    TRY(lib3mf_meshobject_getslicestackid(mesh, &id));
    PLib3MFModelResource* resource;
    TRY(lib3mf_model_getslicestackById(model, id, &resource));
    TRY(lib3mf_slicestack_getslicecount(resource, &count));
    stack->slice_count += count;
    for (DWORD i = 0; i < count; ++i) {
      PLib3MFSlice* slice;
      TRY(lib3mf_slicestack_getslice(resource, i, &slice));
      float top;
      TRY(lib3mf_slice_gettopz(slice, &top));
      stack->top = double{top};
      DWORD polygons, vertices;
      TRY(lib3mf_slice_getpolygoncount(slice, &polygons));
      TRY(lib3mf_slice_getvertexcount(slice, &vertices));
      stack->polygon_count += polygons;
      stack->vertex_count += vertices;
      std::vector<MODELSLICEVERTEX> points(vertices);
      if (vertices) TRY(lib3mf_slice_getvertices(slice, points.data(), vertices));
      for (DWORD k = 0; k < polygons; ++k) {
        DWORD corners;
        TRY(lib3mf_slice_getpolygonindexcount(slice, k, &corners));
        std::vector<DWORD> indices(corners);
        TRY(lib3mf_slice_getpolygonindices(slice, k, indices.data(), corners));
        for (DWORD c = 0; c + 1 < corners; ++c) {
          const FLOAT* a = points[indices[c]].m_fPosition;
          const FLOAT* b = points[indices[c + 1]].m_fPosition;
          stack->area += 0.5 * (double{a[0]} * double{b[1]} - double{a[1]} * double{b[0]});
        }
      }
      lib3mf_release(slice);
    }
    lib3mf_release(resource);
    return 0;
  }));
  lib3mf_release(model);
  return stack->slice_count ? 0 : __LINE__;
}
