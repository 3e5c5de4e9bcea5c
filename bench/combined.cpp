// SPDX-License-Identifier: Apache-2.0
// Layers of structures made of structures, 32^3 cells at 2048 x 2048, on one thread: processor
// time, beside the sum of that of their members.
//
// usage: combined [results.json]
#include <ctime>
#include <string>

#include "setup.h"

namespace {

constexpr double cells = 32;
constexpr uint32_t pixels = 2048;

/// Processor time of some layers in the middle, as a median of three runs. Takes over the
/// structure.
double processor_time(msq_context* context, msq_structure* structure, uint64_t layers) {
  msq_model* model = bench::make_model(context, bench::make_cube(context, cells), structure);
  msq_slicer* slicer = bench::make_slicer(model, bench::slices_of(pixels, cells));
  std::vector<double> times;
  for (int run = 0; run < 3; ++run) {
    bench::Reader reader;
    const std::clock_t begin = std::clock();
    bench::check(msq_slicer_run(slicer, pixels / 4, layers, bench::Reader::take, &reader, nullptr));
    times.push_back(double(std::clock() - begin) / CLOCKS_PER_SEC);
  }
  msq_slicer_release(slicer);
  msq_model_release(model);
  std::sort(times.begin(), times.end());
  return times[1];
}

msq_structure* kept(msq_structure* structure) {
  msq_structure_retain(structure);
  return structure;
}

}  // namespace

int main(int argc, char** argv) {
  msq_context* context = bench::make_context(1);
  msq_lattice_def lattice_def;
  bench::check(msq_lattice_def_init(&lattice_def, sizeof lattice_def));
  lattice_def.radius.value = 0.1;
  msq_functional_def gyroid_def;
  bench::check(msq_functional_def_init(&gyroid_def, sizeof gyroid_def));
  gyroid_def.kind = MSQ_FUNCTIONAL_SHEET;
  gyroid_def.level.value = 0.2;
  msq_foam_def foam_def;
  bench::check(msq_foam_def_init(&foam_def, sizeof foam_def));
  foam_def.radius.value = 0.1;
  msq_structure *bcc, *gyroid, *foam;
  bench::check(msq_structure_lattice(context, &lattice_def, &bcc));
  bench::check(msq_structure_functional(context, &gyroid_def, &gyroid));
  bench::check(msq_structure_foam(context, &foam_def, &foam));

  bench::Report report("Structures made of structures, 32^3 cells, 2048 x 2048 pixels, one thread");
  constexpr uint64_t layers = 128, blend_layers = 4;
  const double samples = double(pixels) * pixels;
  const auto measure = [&](const char* name, msq_structure* structure, uint64_t count) {
    const double seconds = processor_time(context, structure, count);
    report.add(name, seconds, samples * double(count), "sample");
    return seconds;
  };
  const double of_bcc = measure("BCC", kept(bcc), layers);
  const double of_gyroid = measure("gyroid", kept(gyroid), layers);
  const double of_foam = measure("foam", kept(foam), layers);
  const auto boolean = [&](const char* name, int32_t operation, const msq_structure* a,
                           double sum) {
    const msq_structure* const both[2] = {a, gyroid};
    msq_structure* made;
    bench::check(msq_structure_boolean(operation, both, 2, &made));
    report.note("over the sum of both", measure(name, made, layers) / sum, "");
  };
  boolean("BCC or gyroid", MSQ_BOOLEAN_UNION, bcc, of_bcc + of_gyroid);
  boolean("BCC and gyroid", MSQ_BOOLEAN_INTERSECTION, bcc, of_bcc + of_gyroid);
  boolean("BCC without gyroid", MSQ_BOOLEAN_DIFFERENCE, bcc, of_bcc + of_gyroid);
  boolean("foam or gyroid", MSQ_BOOLEAN_UNION, foam, of_foam + of_gyroid);

  // Blended everywhere.
  const double from[3] = {0, 0, 0}, to[3] = {cells, 0, 0};
  msq_field* field;
  bench::check(msq_field_gradient(context, from, 0, to, 1, &field));
  const msq_param fraction = {0, field};
  const auto blend = [&](const char* name, const msq_structure* a, const msq_structure* b) {
    msq_structure* made;
    bench::check(msq_structure_blend(a, b, &fraction, &made));
    measure(name, made, blend_layers);
  };
  blend("BCC to gyroid", bcc, gyroid);
  blend("foam to BCC", foam, bcc);
  blend("foam to gyroid", foam, gyroid);
  const msq_param radius = {0.2, nullptr};
  const auto smooth = [&](const char* name, int32_t operation, const msq_structure* a,
                          const msq_structure* b) {
    msq_structure* made;
    bench::check(msq_structure_smooth_boolean(operation, a, b, &radius, &made));
    measure(name, made, blend_layers);
  };
  smooth("BCC or gyroid, fillets", MSQ_BOOLEAN_UNION, bcc, gyroid);
  smooth("BCC without gyroid, fillets", MSQ_BOOLEAN_DIFFERENCE, bcc, gyroid);
  smooth("foam or gyroid, fillets", MSQ_BOOLEAN_UNION, foam, gyroid);
  msq_field_release(field);
  msq_structure_release(foam);
  msq_structure_release(gyroid);
  msq_structure_release(bcc);
  msq_context_release(context);
  report.write(argc, argv);
  return 0;
}
