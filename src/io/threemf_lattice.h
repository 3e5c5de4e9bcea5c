// SPDX-License-Identifier: Apache-2.0
// The element <beamlattice> of a 3MF mesh.
#pragma once

#include <cstdint>
#include <optional>
#include <pugixml.hpp>
#include <string_view>

#include "base/job.h"
#include "io/beam_lattice.h"

namespace msq {

inline constexpr const char* beam_extension =
    "http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02";
inline constexpr const char* ball_extension =
    "http://schemas.microsoft.com/3dmanufacturing/beamlattice/balls/2020/07";

/// The namespace that a qualified name of an element, or of one of its attributes, has there.
std::string_view namespace_of(pugi::xml_node element, std::string_view name);

/// The element <beamlattice> of a <mesh>; null if it has none.
pugi::xml_node lattice_of(pugi::xml_node mesh);

struct ThreemfLattice {
  BeamLattice lattice;
  /// Id of the object that clips the beams.
  std::optional<uint64_t> clipping_mesh;
};

/// The beams of a <mesh> with these vertices; nothing if it has none. Throws Error(io), Error(mesh)
/// or Error(limit) if the element is malformed, has an index out of range, or has more than
/// max_beams beams and balls.
std::optional<ThreemfLattice> read_lattice(pugi::xml_node mesh, const std::vector<Vec3>& vertices,
                                           uint64_t max_beams, const Job* job);

}  // namespace msq
