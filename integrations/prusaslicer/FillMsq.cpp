// SPDX-License-Identifier: Apache-2.0
#include "FillMsq.hpp"

#include "../ClipperUtils.hpp"
#include "../MsqHandles.hpp"
#include "../ShortestPath.hpp"

#include <array>
#include <map>
#include <mutex>
#include <string>

namespace Slic3r {
namespace {

using Msq::check;
using Msq::context;
using Msq::make;
using Msq::Contours;
using Msq::Field;
using Msq::Lines;
using Msq::Model;
using Msq::Shape;
using Msq::Structure;

// What a pattern depends on. Lengths in mm.
struct Key
{
    FillMsq::Pattern      pattern;
    double                density, spacing;
    // Of a foam that is graded: the density and the distance from the axis at the rim, and the axis.
    double                rim_density, rim;
    std::array<double, 2> axis;

    auto tie() const { return std::tie(pattern, density, spacing, rim_density, rim, axis); }
    bool operator<(const Key &other) const { return this->tie() < other.tie(); }
};

// Lines of this width cover the density where the cells have this size.
std::array<double, 3> cell_size(const msq_structure *structure, double spacing, double density)
{
    std::array<double, 3> size;
    check(msq_fill_calibrate(context(), structure, spacing, density, size.data(), nullptr));
    return size;
}

static_assert(sizeof(Point) == 2 * sizeof(int32_t), "msq reads the points of polygons in place");

// Walls as lines. Some of a foam's are two lines side by side: else the nozzle stops at every other junction. A foam's corners are round: else
// the nozzle brakes at each.
Polylines wall_lines(
    const msq_structure *structure, FillMsq::Pattern pattern, const ExPolygon &expolygon, double z, double spacing, double resolution)
{
    std::vector<msq_ring> rings;
    for (size_t i = 0; i < expolygon.num_contours(); ++ i)
        rings.push_back({ expolygon.contour_or_hole(i).points.data(), expolygon.contour_or_hole(i).points.size() });
    msq_fill_def def;
    check(msq_fill_def_init(&def, sizeof def));
    def.coordinate_type = MSQ_INT32;
    def.rings           = rings.data();
    def.ring_count      = rings.size();
    def.scale           = SCALING_FACTOR;
    def.z               = z;
    def.tolerance       = resolution;
    def.min_length      = 0.8 * spacing;
    def.pair_distance   = pattern == FillMsq::Pattern::Foam ? spacing : 0;
    def.corner_distance = def.pair_distance;
    const Lines lines = make<Lines>([](auto... a) { return msq_fill_lines(a..., nullptr); }, context(), structure, &def);
    msq_fill_report report{};
    report.struct_size = sizeof report;
    check(msq_fill_info(lines.get(), &report));

    const auto *points = static_cast<const int32_t*>(report.points);
    Polylines   out(report.path_count);
    for (size_t i = 0; i < out.size(); ++ i) {
        for (uint64_t j = report.path_starts[i]; j < report.path_starts[i + 1]; ++ j)
            out[i].points.emplace_back(points[2 * j], points[2 * j + 1]);
        if (report.closed[i])
            out[i].points.emplace_back(out[i].points.front());
    }
    return out;
}

// A foam whose lines have the density if none is printed twice and there is one seed per cell.
Structure make_foam(double spacing, double density, const msq_param &seeds)
{
    msq_foam_def def;
    check(msq_foam_def_init(&def, sizeof def));
    def.radius.value = 0.1; // of the edges, which lines do not depend on
    const auto size = cell_size(make<Structure>(msq_structure_foam, context(), &def).get(), spacing, density);
    std::copy(size.begin(), size.end(), def.grid.cell_size);
    def.radius.value *= size[0];
    def.density = seeds;
    return make<Structure>(msq_structure_foam, context(), &def);
}

// The density of lines with this number of seeds per cell, measured in a square at 8 heights. Short walls are left out, and others are
// printed twice: how many depends on the cells' size.
double measured_density(double spacing, double density, double seeds)
{
    msq_param param{};
    param.value = seeds;
    const Structure foam = make_foam(spacing, density, param);
    const double    side = 24 * 2.27 * spacing / density / std::cbrt(seeds); // 24 x 24 seeds
    ExPolygon       square;
    for (const Vec2d &corner : { Vec2d(0, 0), Vec2d(side, 0), Vec2d(side, side), Vec2d(0, side) })
        square.contour.points.emplace_back(scaled<coord_t>(corner));
    double length = 0;
    for (int i = 0; i < 8; ++ i) {
        for (const Polyline &line : wall_lines(foam.get(), FillMsq::Pattern::Foam, square, 0.37 * i * side, spacing, 0.0125))
            length += unscaled(line.length());
    }
    return length * spacing / (8 * side * side);
}

// From the density of lines to the number of seeds per cell: about its third power, times what is measured at a few densities.
std::vector<double> seeds_by_density(double spacing, double density, double low, double high)
{
    std::vector<std::pair<double, double>> measured; // density, seeds over its third power
    for (int i = 0; i <= 6; ++ i) {
        const double seeds = std::pow(high / low, 0.5 * i), found = measured_density(spacing, density, seeds);
        measured.emplace_back(found, seeds / (found * found * found));
    }
    std::vector<double> curve;
    for (int i = 0; i <= 64; ++ i) {
        const double wanted = low + (high - low) * i / 64;
        size_t       k      = 1;
        while (k + 1 < measured.size() && measured[k].first < wanted)
            ++ k;
        const auto  &[p, a] = measured[k - 1];
        const auto  &[q, b] = measured[k];
        curve.insert(curve.end(), { wanted, std::max(1., wanted * wanted * wanted * (a + (b - a) * (wanted - p) / (q - p))) });
    }
    return curve;
}

// Cells are largest where the foam is least dense: there it has one seed per cell.
Structure make_foam(const Key &key)
{
    const bool   is_graded = key.rim_density > 0;
    const double low       = is_graded ? std::min(key.density, key.rim_density) : key.density;
    const double density   = low * low / measured_density(key.spacing, low, 1);
    msq_param    seeds{};
    seeds.value = 1;
    if (! is_graded)
        return make_foam(key.spacing, density, seeds);
    msq_radial_field_def def;
    check(msq_radial_field_def_init(&def, sizeof def));
    std::copy(key.axis.begin(), key.axis.end(), def.center);
    def.axis[2]    = 1;
    def.from_value = key.density;
    def.to_radius  = key.rim;
    def.to_value   = key.rim_density;
    const Field wanted = make<Field>(msq_field_radial, context(), &def);
    const auto  curve  = seeds_by_density(key.spacing, density, low, std::max(key.density, key.rim_density));
    const Field field  = make<Field>(msq_field_map, context(), wanted.get(), curve.data(), uint64_t(curve.size() / 2));
    seeds.field = field.get();
    return make_foam(key.spacing, density, seeds);
}

Structure make_gyroid(const Key &key)
{
    msq_functional_def def;
    check(msq_functional_def_init(&def, sizeof def));
    def.kind        = MSQ_FUNCTIONAL_SHEET;
    def.level.value = 0.1; // the walls' thickness, which lines do not depend on
    const auto size = cell_size(make<Structure>(msq_structure_functional, context(), &def).get(), key.spacing, key.density);
    std::copy(size.begin(), size.end(), def.grid.cell_size);
    return make<Structure>(msq_structure_functional, context(), &def);
}

// Struts of two lines' width. The cells are as large as the share of the volume asks for.
Structure make_struts(const Key &key)
{
    msq_lattice_def def;
    check(msq_lattice_def_init(&def, sizeof def));
    def.unit_cell    = MSQ_UNIT_CELL_BCC;
    def.radius.value = 0.1;
    const Structure unit = make<Structure>(msq_structure_lattice, context(), &def);
    msq_calibration_report report{};
    report.struct_size = sizeof report;
    check(msq_structure_calibrate(context(), unit.get(), nullptr, key.density, nullptr, nullptr, 0, &report, nullptr));
    def.radius.value = key.spacing;
    for (double &size : def.grid.cell_size)
        size = key.spacing / report.parameter;
    return make<Structure>(msq_structure_lattice, context(), &def);
}

// A structure that fills all space, and the model of it.
struct Made
{
    Structure structure;
    Model     model;
};

Made make_pattern(const Key &key)
{
    Made made;
    made.structure = key.pattern == FillMsq::Pattern::Foam   ? make_foam(key) :
                     key.pattern == FillMsq::Pattern::Gyroid ? make_gyroid(key) : make_struts(key);
    made.model     = Msq::make_model(make<Shape>(msq_shape_all_space, context()), made.structure);
    return made;
}

// Layers share patterns: what one thread makes, the others wait for.
std::shared_ptr<const Made> pattern(const Key &key)
{
    static std::mutex                                 mutex;
    static std::map<Key, std::shared_ptr<const Made>> patterns;
    std::lock_guard<std::mutex> lock(mutex);
    auto found = patterns.find(key);
    if (found == patterns.end()) {
        if (patterns.size() >= 16)
            patterns.clear(); // of jobs that are over
        found = patterns.emplace(key, std::make_shared<const Made>(make_pattern(key))).first;
    }
    return found->second;
}

// Loops that fill the sections of struts from their outlines to their middles.
Polylines strut_loops(const msq_model *model, const ExPolygon &expolygon, double z, double spacing, double resolution)
{
    const BoundingBox box = get_extents(expolygon).inflated(scaled(2 * spacing)); // sections are closed outside of the polygon
    msq_contours_def def;
    check(msq_contours_def_init(&def, sizeof def));
    def.type       = MSQ_INT32;
    def.has_window = 1;
    for (int i = 0; i < 2; ++ i) {
        def.window_min[i] = unscaled(box.min[i]);
        def.window_max[i] = unscaled(box.max[i]);
    }
    def.tolerance = resolution;
    def.pitch     = 0.5 * spacing;
    def.units     = 1 / SCALING_FACTOR;
    const Contours contours = make<Contours>([](auto... a) { return msq_layer_contours(a..., nullptr); }, model, z, &def);
    msq_contours_report report{};
    report.struct_size = sizeof report;
    check(msq_contours_info(contours.get(), &report));

    const auto *points = static_cast<const int32_t*>(report.points);
    Polygons    sections(report.ring_count);
    for (size_t i = 0; i < sections.size(); ++ i)
        for (uint64_t j = report.starts[i]; j < report.starts[i + 1]; ++ j)
            sections[i].points.emplace_back(points[2 * j], points[2 * j + 1]);
    Polylines out;
    for (Polygons loops = offset(sections, - scaled<float>(0.5 * spacing)); ! loops.empty(); loops = offset(loops, - scaled<float>(spacing)))
        append(out, intersection_pl(to_polylines(loops), expolygon));
    return out;
}

} // namespace

void FillMsq::_fill_surface_single(
    const FillParams                &params,
    unsigned int                     thickness_layers,
    const std::pair<float, Point>   & /* direction */,
    ExPolygon                        expolygon,
    Polylines                       &polylines_out)
{
    Key key{ m_pattern, params.density, this->spacing, 0, 0, {} };
    if (m_pattern == Pattern::Foam && params.density_rim > 0 && params.density_rim != params.density && this->bounding_box.defined) {
        const Point size = this->bounding_box.size(), axis = this->bounding_box.center();
        key.rim_density  = params.density_rim;
        key.rim          = 0.5 * unscaled(std::min(size.x(), size.y()));
        key.axis         = { unscaled(axis.x()), unscaled(axis.y()) };
    }
    const std::shared_ptr<const Made> made = pattern(key);
    const double z          = this->z - 0.5 * params.layer_height * thickness_layers;
    const double resolution = std::max(params.resolution, 0.005);

    // A foam is the same in all directions.
    const float angle = m_pattern == Pattern::Foam ? 0.f : this->angle;
    expolygon.rotate(- angle);
    Polylines lines = m_pattern == Pattern::Struts ?
        strut_loops(made->model.get(), expolygon, z, this->spacing, resolution) :
        wall_lines(made->structure.get(), m_pattern, expolygon, z, this->spacing, resolution);
    if (m_pattern != Pattern::Struts && ! params.dont_connect() && ! lines.empty()) {
        Polylines connected;
        connect_infill(std::move(lines), expolygon, connected, this->spacing, params);
        lines = std::move(connected);
    }
    for (Polyline &line : lines) {
        line.rotate(angle);
        polylines_out.emplace_back(std::move(line));
    }
}

} // namespace Slic3r
