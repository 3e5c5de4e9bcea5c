// SPDX-License-Identifier: Apache-2.0
// Assimp 5.2.5 trusts its input: its readers access memory outside their buffers and leak on
// malformed files. Hence callers pass only data that they have checked and written anew, only one
// importer is registered, and MemoryIoSystem keeps it off the disk.
#include "io/assimp_import.h"

#include <assimp/BaseImporter.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <cstdlib>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include "base/status.h"
#include "io/memory_io_system.h"
#include "io/mesh_file.h"

namespace msq {
namespace {

/// Whether a list of extensions, separated by spaces, contains this one.
bool lists_extension(std::string_view list, std::string_view extension) {
  while (!list.empty()) {
    const size_t n = std::min(list.find(' '), list.size());
    if (list.substr(0, n) == extension) return true;
    list.remove_prefix(std::min(n + 1, list.size()));
  }
  return false;
}

/// Removes all importers except one, so that Assimp cannot choose another one by a file's first
/// bytes.
void keep_only(Assimp::Importer& importer, std::string_view extension) {
  std::vector<Assimp::BaseImporter*> others;
  for (size_t i = 0; i < importer.GetImporterCount(); ++i)
    if (!lists_extension(importer.GetImporterInfo(i)->mFileExtensions, extension))
      others.push_back(importer.GetImporter(i));
  for (Assimp::BaseImporter* other : others) {
    importer.UnregisterLoader(other);
    delete other;  // once unregistered, it belongs to the caller
  }
  if (importer.GetImporterCount() != 1)
    fail(Status::unsupported, "this build of Assimp has %zu readers of %s files, not one",
         importer.GetImporterCount(), std::string(extension).c_str());
}

/// Throws if there is not enough memory for Assimp to read a file. If an allocation fails within
/// Assimp 5.2.5, it frees uninitialised pointers, ends the process, or leaks memory.
void require_room(size_t file_bytes) {
  const size_t bytes = (size_t{2} << 20) + 6 * file_bytes;
  void* volatile room = std::malloc(bytes);  // volatile, otherwise compilers remove both calls
  if (!room) throw std::bad_alloc();
  std::free(room);
}

Transform transform_of(const aiMatrix4x4& m) {
  return {{m.a1, m.b1, m.c1}, {m.a2, m.b2, m.c2}, {m.a3, m.b3, m.c3}, {m.a4, m.b4, m.c4}};
}

TriangleSoup triangles_of(const aiMesh& mesh, uint64_t max_triangles) {
  SoupBuilder soup(max_triangles);
  soup.reserve_vertices(mesh.mNumVertices);
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    const aiVector3D& p = mesh.mVertices[i];
    soup.add_vertex({p.x, p.y, p.z});
  }
  std::vector<int64_t> polygon;
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    const aiFace& face = mesh.mFaces[i];
    polygon.assign(face.mIndices, face.mIndices + face.mNumIndices);
    soup.add_polygon(polygon);
  }
  return soup.take();
}

void add_node(const aiScene& scene, const aiNode& node, const Transform& parent,
              SoupBuilder& soup) {
  const Transform transform = parent.after(transform_of(node.mTransformation));
  for (unsigned i = 0; i < node.mNumMeshes; ++i)
    soup.add_instance(triangles_of(*scene.mMeshes[node.mMeshes[i]], soup.max_triangles()),
                      transform);
  for (unsigned i = 0; i < node.mNumChildren; ++i)
    add_node(scene, *node.mChildren[i], transform, soup);
}

}  // namespace

bool can_read_all_mesh_files() {
  return true;
}

void import_with_assimp(std::string_view file, const char* extension, SoupBuilder& soup) {
  require_room(file.size());
  const std::string name = std::string("mesh.") + extension;
  Assimp::Importer importer;
  keep_only(importer, extension);
  importer.SetIOHandler(new MemoryIoSystem(name, file));
  const aiScene* scene = importer.ReadFile(name, 0);
  if (!scene) {
    try {
      if (const std::exception_ptr& cause = importer.GetException()) std::rethrow_exception(cause);
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception&) {
      // Its text is the error string.
    }
    fail(Status::io, "Assimp: %s", importer.GetErrorString());
  }
  if (!scene->mRootNode) fail(Status::io, "Assimp: the %s file has no contents", extension);
  add_node(*scene, *scene->mRootNode, {}, soup);
}

}  // namespace msq
