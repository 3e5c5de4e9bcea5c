// SPDX-License-Identifier: Apache-2.0
#ifndef slic3r_SLA_MsqSections_hpp_
#define slic3r_SLA_MsqSections_hpp_

#include "../ExPolygon.hpp"
#include "../TriangleMesh.hpp"

#include <functional>
#include <vector>

namespace Slic3r { namespace sla {

// A Voronoi foam of struts with one seed per cell, and the solid skin of the part around it. In mm.
struct Foam { double cell_size, radius, skin; };

// Sections at the heights of a mesh that is filled with the foam, by the library msq. They are as accurate as a raster with these pixels
// needs them to be. Layers are computed in parallel; throw_on_cancel is called before each.
std::vector<ExPolygons> foam_sections(
    const indexed_triangle_set        &mesh,
    const std::vector<float>          &heights,
    const Foam                        &foam,
    double                             pixel,
    const std::function<void()>       &throw_on_cancel);

}} // namespace Slic3r::sla

#endif // slic3r_SLA_MsqSections_hpp_
