// SPDX-License-Identifier: Apache-2.0
#ifndef slic3r_MsqHandles_hpp_
#define slic3r_MsqHandles_hpp_

#include "Exception.hpp"

#include <msq.h>

#include <memory>
#include <string>

// Handles of the library msq that release themselves, and errors of msq as exceptions.
namespace Slic3r { namespace Msq {

inline void check(msq_status status)
{
    if (status != MSQ_OK)
        throw Slic3r::SlicingError(std::string("msq: ") + msq_error_message());
}

template<class T, void (*Release)(T*)> struct Releaser { void operator()(T *t) const { Release(t); } };
using Context   = std::unique_ptr<msq_context, Releaser<msq_context, msq_context_release>>;
using Shape     = std::unique_ptr<msq_shape, Releaser<msq_shape, msq_shape_release>>;
using Field     = std::unique_ptr<msq_field, Releaser<msq_field, msq_field_release>>;
using Structure = std::unique_ptr<msq_structure, Releaser<msq_structure, msq_structure_release>>;
using Model     = std::unique_ptr<msq_model, Releaser<msq_model, msq_model_release>>;
using Lines     = std::unique_ptr<msq_fill, Releaser<msq_fill, msq_fill_release>>;
using Contours  = std::unique_ptr<msq_contours, Releaser<msq_contours, msq_contours_release>>;

// Calls a function of msq that creates an object and returns it by its last argument.
template<class Handle, class Create, class... A> Handle make(Create create, A... a)
{
    typename Handle::pointer made = nullptr;
    check(create(a..., &made));
    return Handle(made);
}

// A thread of the slicer computes a layer: msq starts no threads of its own.
inline msq_context* context()
{
    static const Context context = [] {
        msq_context_def def;
        check(msq_context_def_init(&def, sizeof def));
        def.threads = 1;
        return make<Context>(msq_context_create, &def);
    }();
    return context.get();
}

// The shape filled with the structure, below a solid skin of this thickness in mm.
inline Model make_model(const Shape &shape, const Structure &structure, double skin = 0)
{
    msq_scale_def scales[2] = {};
    scales[0].shape         = shape.get();
    scales[1].structure     = structure.get();
    scales[1].skin.value    = skin;
    msq_model_def def;
    check(msq_model_def_init(&def, sizeof def));
    def.scales      = scales;
    def.scale_count = 2;
    def.scale_size  = sizeof scales[0];
    return make<Model>(msq_model_create, context(), &def);
}

}} // namespace Slic3r::Msq

#endif // slic3r_MsqHandles_hpp_
