// SPDX-License-Identifier: Apache-2.0
//
// A plug-in of a slicer. RAII wrappers hold the handles, and statuses become exceptions. A class
// takes the slicer's mesh and returns each layer as spans of rows.
#include <msq.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <span>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace {

class Error : public std::runtime_error {
 public:
  explicit Error(msq_status status)
      : std::runtime_error(std::string(msq_status_name(status)) + ": " + msq_error_message()) {}
};

void check(msq_status status) {
  if (status != MSQ_OK) throw Error(status);
}

// A definition with its defaults.
template <class Def>
Def defaults(msq_status (*init)(Def*, size_t)) {
  Def def;
  check(init(&def, sizeof def));
  return def;
}

// One reference to an object of msq: copying adds one, destroying drops one.
template <class T, void (*Retain)(T*), void (*Release)(T*)>
class Handle {
 public:
  Handle() = default;
  Handle(const Handle& other) : object_(other.object_) {
    if (object_) Retain(object_);
  }
  Handle(Handle&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  Handle& operator=(Handle other) noexcept {
    std::swap(object_, other.object_);
    return *this;
  }
  ~Handle() { Release(object_); }

  // Makes the object: create(arguments..., &handle).
  template <class Create, class... Arguments>
  static Handle make(Create create, Arguments... arguments) {
    Handle handle;
    check(create(arguments..., &handle.object_));
    return handle;
  }
  T* get() const { return object_; }

 private:
  T* object_ = nullptr;
};

using Context = Handle<msq_context, msq_context_retain, msq_context_release>;
using Shape = Handle<msq_shape, msq_shape_retain, msq_shape_release>;
using Structure = Handle<msq_structure, msq_structure_retain, msq_structure_release>;
using Model = Handle<msq_model, msq_model_retain, msq_model_release>;
using Slicer = Handle<msq_slicer, msq_slicer_retain, msq_slicer_release>;

// A stretch of material along x, in millimetres.
struct Span {
  double y, x0, x1;
  bool operator==(const Span&) const = default;
};

// Infill of one part, layer by layer. Any number of threads may ask one provider at once.
class InfillProvider {
 public:
  struct Settings {
    double cell = 5, radius = 0.6, pitch = 0.05, layer_height = 0.1;  // mm
  };

  InfillProvider(std::span<const float> vertices, std::span<const uint32_t> triangles,
                 const Settings& settings) {
    // The context is held by what is made with it, so it need not be kept.
    const auto context = Context::make(msq_context_create, nullptr);

    auto mesh = defaults(msq_mesh_def_init);
    mesh.coordinate_type = MSQ_FLOAT32;
    mesh.vertices = vertices.data();
    mesh.vertex_count = vertices.size() / 3;
    mesh.triangles = triangles.data();
    mesh.triangle_count = triangles.size() / 3;
    const auto part = Shape::make(msq_shape_from_mesh, context.get(), &mesh);

    auto lattice = defaults(msq_lattice_def_init);
    lattice.unit_cell = MSQ_UNIT_CELL_BCC;
    for (double& size : lattice.grid.cell_size) size = settings.cell;
    lattice.radius.value = settings.radius;
    const auto filling = Structure::make(msq_structure_lattice, context.get(), &lattice);

    std::array<msq_scale_def, 2> scales = {};
    scales[0].shape = part.get();
    scales[1].structure = filling.get();
    auto definition = defaults(msq_model_def_init);
    definition.scales = scales.data();
    definition.scale_count = static_cast<uint32_t>(scales.size());
    definition.scale_size = sizeof scales[0];
    const auto model = Model::make(msq_model_create, context.get(), &definition);

    auto plan = defaults(msq_slicer_def_init);
    plan.output = MSQ_LAYER_BYTES;
    plan.pitch[0] = plan.pitch[1] = settings.pitch;
    plan.layer_height = settings.layer_height;
    slicer_ = Slicer::make(msq_slicer_create, model.get(), &plan);
    plan_.struct_size = sizeof plan_;
    check(msq_slicer_info(slicer_.get(), &plan_));
  }

  uint64_t layer_count() const { return plan_.layer_count; }

  double height(uint64_t index) const {
    double z;
    check(msq_slicer_layer_z(slicer_.get(), index, &z));
    return z;
  }

  // The layer's material, row by row in ascending y, each row in ascending x.
  std::vector<Span> layer(uint64_t index) const {
    std::vector<uint8_t> pixels(plan_.layer_bytes);
    check(msq_slice_layer(slicer_.get(), index, pixels.data(), pixels.size(), nullptr));
    std::vector<Span> spans;
    for (uint32_t j = 0; j < plan_.height; ++j) {
      const uint8_t* row = pixels.data() + j * plan_.stride;
      for (uint32_t i = 0; i < plan_.width;) {
        if (!row[i]) {
          ++i;
          continue;
        }
        const uint32_t first = i;
        while (i < plan_.width && row[i]) ++i;
        // Samples are at the centres of pixels; a span runs from edge to edge.
        spans.push_back({plan_.origin[1] + j * plan_.pitch[1],
                         plan_.origin[0] + (first - 0.5) * plan_.pitch[0],
                         plan_.origin[0] + (i - 0.5) * plan_.pitch[0]});
      }
    }
    return spans;
  }

  double row_distance() const { return plan_.pitch[1]; }

 private:
  Slicer slicer_;
  msq_slicer_report plan_{};
};

}  // namespace

int main() try {
  // A cube of 20 mm, as a slicer holds its parts: vertices, and triangles of their indices.
  const float s = 20;
  const std::vector<float> vertices = {0, 0, 0, s, 0, 0, s, s, 0, 0, s, 0,
                                       0, 0, s, s, 0, s, s, s, s, 0, s, s};
  const std::vector<uint32_t> triangles = {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
                                           1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7};
  const InfillProvider::Settings settings;
  const InfillProvider infill(vertices, triangles, settings);

  // A quarter of a cell up, each of the 4 x 4 cells has four struts, cut on the slant: ellipses.
  const uint64_t index = 12;
  const std::vector<Span> spans = infill.layer(index);
  double area = 0;
  for (const Span& span : spans) area += (span.x1 - span.x0) * infill.row_distance();
  const double expected =
      16 * 4 * std::numbers::pi * settings.radius * settings.radius * std::sqrt(3.0);
  std::printf("layer %d of %d at z = %.2f mm: %zu spans, %.2f mm2 (expected %.2f)\n",
              static_cast<int>(index), static_cast<int>(infill.layer_count()), infill.height(index),
              spans.size(), area, expected);

  // Another thread gets the same layer from the same provider.
  std::vector<Span> again;
  std::thread([&] { again = infill.layer(index); }).join();
  if (again != spans) return std::puts("two threads got different layers"), 1;

  // Statuses come out as exceptions.
  try {
    infill.height(infill.layer_count());
    return std::puts("a layer past the last was not refused"), 1;
  } catch (const Error& error) {
    std::printf("refused as it should be: %s\n", error.what());
  }
  return std::abs(area - expected) < 0.01 * expected ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "infill_plugin: %s\n", error.what());
  return 1;
}
