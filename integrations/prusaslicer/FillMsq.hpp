// SPDX-License-Identifier: Apache-2.0
#ifndef slic3r_FillMsq_hpp_
#define slic3r_FillMsq_hpp_

#include "FillBase.hpp"

namespace Slic3r {

// Sparse infill whose patterns the library msq computes, each layer on its own.
class FillMsq : public Fill
{
public:
    // Foam: the walls of a Voronoi foam, as dense at the rim as the density_rim of FillParams.
    // Gyroid: the walls of a gyroid. Struts: a lattice whose struts are two lines wide.
    enum class Pattern { Foam, Gyroid, Struts };

    explicit FillMsq(Pattern pattern) : m_pattern(pattern) {}
    Fill* clone() const override { return new FillMsq(*this); }

protected:
    void _fill_surface_single(
        const FillParams                &params,
        unsigned int                     thickness_layers,
        const std::pair<float, Point>   &direction,
        ExPolygon                        expolygon,
        Polylines                       &polylines_out) override;
    float _layer_angle(size_t) const override { return 0; }

private:
    Pattern m_pattern;
};

} // namespace Slic3r

#endif // slic3r_FillMsq_hpp_
