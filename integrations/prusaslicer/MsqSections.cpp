// SPDX-License-Identifier: Apache-2.0
#include "MsqSections.hpp"

#include "../MsqHandles.hpp"
#include "Concurrency.hpp"

namespace Slic3r { namespace sla {

using namespace Msq;

static_assert(sizeof(stl_vertex) == 3 * sizeof(float) && sizeof(stl_triangle_vertex_indices) == 3 * sizeof(uint32_t),
    "msq reads meshes in place");
static_assert(sizeof(Point) == 2 * sizeof(int32_t), "msq writes the points of polygons as PrusaSlicer has them");

static Msq::Model make_part(const indexed_triangle_set &mesh, const Foam &foam)
{
    msq_mesh_def mesh_def;
    check(msq_mesh_def_init(&mesh_def, sizeof mesh_def));
    mesh_def.coordinate_type = MSQ_FLOAT32;
    mesh_def.vertices        = mesh.vertices.data();
    mesh_def.vertex_count    = mesh.vertices.size();
    mesh_def.triangles       = reinterpret_cast<const uint32_t*>(mesh.indices.data());
    mesh_def.triangle_count  = mesh.indices.size();
    msq_foam_def foam_def;
    check(msq_foam_def_init(&foam_def, sizeof foam_def));
    for (double &size : foam_def.grid.cell_size)
        size = foam.cell_size;
    foam_def.radius.value = foam.radius;
    return make_model(make<Shape>(msq_shape_from_mesh, context(), &mesh_def), make<Structure>(msq_structure_foam, context(), &foam_def), foam.skin);
}

static ExPolygons section(const msq_model *part, double height, double pixel)
{
    msq_contours_def def;
    check(msq_contours_def_init(&def, sizeof def));
    def.type      = MSQ_INT32;
    def.tolerance = pixel / 64;
    def.pitch     = pixel / 4; // gaps that become narrower than this are followed down to the tolerance
    def.units     = 1 / SCALING_FACTOR;
    const Contours contours = make<Contours>([](auto... a) { return msq_layer_contours(a..., nullptr); }, part, height, &def);
    msq_contours_report report{};
    report.struct_size = sizeof report;
    check(msq_contours_info(contours.get(), &report));

    const auto *points = static_cast<const int32_t*>(report.points);
    auto        ring   = [&](uint64_t i) {
        Polygon polygon;
        for (uint64_t j = report.starts[i]; j < report.starts[i + 1]; ++ j)
            polygon.points.emplace_back(points[2 * j], points[2 * j + 1]);
        return polygon;
    };
    ExPolygons          out;
    std::vector<size_t> place(report.ring_count); // in out, of outer rings
    for (uint64_t i = 0; i < report.ring_count; ++ i)
        if (! report.holes[i]) {
            place[i] = out.size();
            out.emplace_back(ring(i));
        }
    for (uint64_t i = 0; i < report.ring_count; ++ i)
        if (report.holes[i])
            out[place[report.parents[i]]].holes.push_back(ring(i));
    return out;
}

std::vector<ExPolygons> foam_sections(
    const indexed_triangle_set        &mesh,
    const std::vector<float>          &heights,
    const Foam                        &foam,
    double                             pixel,
    const std::function<void()>       &throw_on_cancel)
{
    const Msq::Model        part = make_part(mesh, foam);
    std::vector<ExPolygons> sections(heights.size());
    ccr::for_each(size_t(0), heights.size(), [&](size_t i) {
        throw_on_cancel();
        sections[i] = section(part.get(), heights[i], pixel);
    });
    return sections;
}

}} // namespace Slic3r::sla
