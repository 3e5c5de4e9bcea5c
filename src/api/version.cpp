// SPDX-License-Identifier: Apache-2.0
#include "api/guard.h"
#include "base/digest.h"
#include "base/simd.h"
#include "io/image_file.h"
#include "io/json_text.h"
#include "io/mesh_file.h"
#include "structure/foam/paper/delaunay.h"

using namespace msq;
using namespace msq::api;

uint32_t msq_version(void) {
  return MSQ_VERSION;
}

msq_status msq_build_info(msq_build_report* report) {
  return guard([&] {
    msq_build_report known{};
    known.version = MSQ_VERSION;
    known.with_assimp = can_read_all_mesh_files();
    known.with_cgal = can_triangulate();
    known.with_xxhash = can_hash();
    known.with_json = can_read_json();
    known.with_tiff = can_read_tiff();
    // Assimp, pugixml, minizip, nlohmann-json, libtiff, oneTBB, Highway and xxHash are under
    // licences that ask for no more than Apache-2.0 does; CGAL's triangulations are under the GPL.
    known.licence = can_triangulate() ? "GPL-3.0-or-later" : "Apache-2.0";
    known.simd = simd_target_name();
    write_report(report, known, "report");
  });
}
