// SPDX-License-Identifier: Apache-2.0
// Replaces Assimp, pugixml and minizip in builds without them: formats that need them are refused.
#include "base/status.h"
#include "io/assimp_import.h"
#include "io/mesh_file.h"
#include "io/readers.h"

namespace msq {
namespace {

[[noreturn]] void refuse(const char* what) {
  fail(Status::unsupported, "this build of msq does not read %s files (MSQ_WITH_ASSIMP is off)",
       what);
}

}  // namespace

bool can_read_all_mesh_files() {
  return false;
}

void import_with_assimp(std::string_view, const char*, SoupBuilder&) {
  refuse("binary STL");
}

double read_threemf(std::string_view, UnpackLimit, SoupBuilder&) {
  refuse("3MF");
}

double read_threemf_beams(std::string_view, UnpackLimit, SoupBuilder&, std::vector<BeamLattice>&) {
  refuse("3MF");
}

double read_amf(std::string_view, UnpackLimit, SoupBuilder&) {
  refuse("AMF");
}

}  // namespace msq
