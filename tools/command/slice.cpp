// SPDX-License-Identifier: Apache-2.0
// msq slice: writes layers for printers and other programs.
#include <sys/stat.h>

#include <algorithm>
#include <cmath>

#include "output_file.h"
#include "scene.h"
#include "text.h"
#include "watch.h"

namespace command {

namespace {

using Writer = Handle<msq_io_writer, msq_io_writer_release>;

enum class Format { PNG, SVG_STACK, SVG_FILES, SL1, THREEMF };

bool takes_contours(Format format) {
  return format != Format::PNG && format != Format::SL1;
}

constexpr double TOLERANCE_OF_PITCH = 0.1;

// By the name: a folder, or a file with an ending that is known.
Format format_of(const Arguments& arguments) {
  const std::string& path = arguments.text("output");
  if (path == "-") arguments.refuse("output", "layers do not go to standard output, '-'");
  const std::string end = ending(path);
  struct stat status = {};
  const bool is_folder = path.ends_with('/') || end.empty() ||
                         (stat(path.c_str(), &status) == 0 && S_ISDIR(status.st_mode));
  if (is_folder) return arguments.text("format") == "svg" ? Format::SVG_FILES : Format::PNG;
  if (arguments.has("format")) arguments.refuse("format", "is for a folder");
  if (end == ".svg") return Format::SVG_STACK;
  if (end == ".sl1" || end == ".sl1s") return Format::SL1;
  if (end == ".3mf") return Format::THREEMF;
  arguments.refuse("output",
                   "'" + path + "' is no folder, and ends in none of .sl1, .sl1s, .svg, .3mf");
}

// Options that only some formats take.
void refuse_others(const Arguments& arguments, Format format) {
  const bool is_sl1 = format == Format::SL1;
  const bool are_contours = takes_contours(format);
  for (const char* option : {"panel", "panel-size", "landscape", "exposure", "first-exposure",
                             "fade", "material", "no-thumbnails"}) {
    if (arguments.has(option) && !is_sl1) arguments.refuse(option, "is for .sl1 files");
  }
  for (const char* option : {"pitch", "box"}) {
    if (arguments.has(option) && is_sl1) arguments.refuse(option, "follows from the panel");
  }
  if (arguments.has("tolerance") && !are_contours)
    arguments.refuse("tolerance", "is for SVG and 3MF files");
  if (arguments.has("grey") && are_contours) arguments.refuse("grey", "is for pixels");
  if (arguments.has("mirror") && are_contours) arguments.refuse("mirror", "is for pixels");
}

bool mirrors(const Arguments& arguments, char axis) {
  return arguments.text("mirror").find(axis) != std::string::npos;
}

msq_io_panel_def read_panel(const Arguments& arguments) {
  auto panel = defaults(msq_io_panel_def_init);
  if (arguments.has("panel")) {
    const std::vector<double> pixels = arguments.numbers("panel", {2});
    for (size_t i = 0; i < 2; ++i) {
      if (!(pixels[i] >= 1) || !(pixels[i] <= 1e6) || pixels[i] != std::floor(pixels[i])) {
        arguments.refuse("panel", "a side of '" + arguments.text("panel") +
                                      "' is no whole number from 1 to 1000000");
      }
      panel.pixels[i] = static_cast<uint32_t>(pixels[i]);
    }
  }
  if (arguments.has("panel-size")) {
    const std::vector<double> size = arguments.numbers("panel-size", {2});
    std::copy(size.begin(), size.end(), panel.size);
  }
  panel.portrait = !arguments.has("landscape");
  if (arguments.has("mirror")) {
    panel.mirror[0] = mirrors(arguments, 'x');
    panel.mirror[1] = mirrors(arguments, 'y');
  }
  return panel;
}

void read_grey(const Arguments& arguments, msq_slicer_def& plan) {
  if (!arguments.has("grey")) return;
  const uint64_t samples = arguments.count("grey", 0);
  if (samples != 2 && samples != 4 && samples != 8 && samples != 16) {
    arguments.refuse("grey", arguments.text("grey") + " is none of 2, 4, 8, 16");
  }
  plan.output = MSQ_LAYER_GREY;
  plan.grey_samples = static_cast<uint32_t>(samples);
}

// With y upwards in a picture, unless the model file has an orientation and no option mirrors.
void read_mirror(const Arguments& arguments, msq_slicer_def& plan) {
  constexpr uint32_t both = MSQ_LAYER_MIRROR_X | MSQ_LAYER_MIRROR_Y;
  if (arguments.has("mirror")) {
    plan.orientation &= ~both;
    if (mirrors(arguments, 'x')) plan.orientation |= MSQ_LAYER_MIRROR_X;
    if (!mirrors(arguments, 'y')) plan.orientation |= MSQ_LAYER_MIRROR_Y;
  } else if (plan.orientation == 0) {
    plan.orientation = MSQ_LAYER_MIRROR_Y;
  }
}

// Pixels and region of all formats but SL1, whose panel decides them.
void read_pixels(const Arguments& arguments, const Scene& scene, msq_slicer_def& plan) {
  if (arguments.has("pitch")) {
    const std::vector<double> pitch = arguments.numbers("pitch", {1, 2});
    if (!(pitch.front() > 0) || !(pitch.back() > 0)) {
      arguments.refuse("pitch", "'" + arguments.text("pitch") + "' is not above 0");
    }
    plan.pitch[0] = pitch.front();
    plan.pitch[1] = pitch.back();
    plan.resolution[0] = plan.resolution[1] = 0;
  }
  if (arguments.has("box") || (!plan.has_region && !has_bounds(scene.model.get()))) {
    plan.has_region = 1;
    take_box(arguments, scene.model.get(), plan.region_min, plan.region_max);
  }
  if (arguments.has("box")) {
    // What a model file counts of another region.
    if (plan.pitch[0] > 0) plan.resolution[0] = plan.resolution[1] = 0;
    if (plan.layer_z == nullptr) plan.layer_count = 0;
    plan.window = {};
  }
  read_mirror(arguments, plan);
}

bool is_pixels(int32_t output) {
  return output == MSQ_LAYER_BITS || output == MSQ_LAYER_BYTES || output == MSQ_LAYER_GREY;
}

// What a model file says of slices. Of its outputs the first that the format can hold is taken:
// pixels into the plan, contours into *contours.
void read_document(const Scene& scene, msq_slicer_def& plan, msq_contours_def& contours) {
  if (!scene.has_slicing) return;
  check(msq_document_slicing(scene.document.get(), &plan));
  const auto* outputs = reinterpret_cast<const char*>(plan.outputs);
  bool has_pixels = false, has_contours = false;
  for (uint32_t i = 0; i < plan.output_count; ++i) {
    const auto* output = reinterpret_cast<const msq_output_def*>(outputs);
    outputs += output->struct_size;
    if (output->contours && !std::exchange(has_contours, true)) contours = *output->contours;
    if (is_pixels(output->output) && !std::exchange(has_pixels, true)) {
      plan.output = output->output;
      plan.grey_samples = output->grey_samples;
      plan.grey_threshold = output->grey_threshold;
      plan.grey_gamma = output->grey_gamma;
    }
  }
  plan.outputs = nullptr;
  plan.output_count = 0;
  if (!is_pixels(plan.output)) plan.output = MSQ_LAYER_BITS;
}

// A:B, layers A to B - 1; either may be left out. B is cut to the last layer, so that equal ranges
// may cover a stack of any number.
void read_layers(const Arguments& arguments, uint64_t all, uint64_t& first, uint64_t& count) {
  first = 0;
  count = all;
  if (!arguments.has("layers")) return;
  const std::string& text = arguments.text("layers");
  const std::vector<std::string_view> ends = split(text, ':');
  std::optional<uint64_t> begin, end;
  if (ends.size() == 2) {
    begin = ends[0].empty() ? 0 : to_count(ends[0]);
    end = ends[1].empty() ? all : to_count(ends[1]);
  }
  if (!begin || !end) arguments.refuse("layers", "'" + text + "' is not FIRST:END");
  if (*begin >= *end || *begin >= all) {
    throw Failure("--layers: " + text + " is no window of the " + std::to_string(all) +
                  " layers 0:" + std::to_string(all));
  }
  first = *begin;
  count = std::min(*end, all) - *begin;
}

msq_io_writer_def make_writer_def(const Arguments& arguments, uint64_t first, uint64_t count) {
  auto def = defaults(msq_io_writer_def_init);
  def.threads = static_cast<uint32_t>(std::min<uint64_t>(arguments.count("threads", 0), 256));
  def.replace = 1;
  def.first_layer = first;
  def.layer_count = count;
  if (const uint64_t memory = arguments.bytes("memory")) {
    def.queue_bytes = std::clamp<uint64_t>(memory / 8, 1 << 20, def.queue_bytes);
  }
  return def;
}

void create_sl1(const Arguments& arguments, const Scene& scene, const msq_slicer* slicer,
                const std::string& path, const msq_io_writer_def& writer_def,
                const msq_io_panel_def& panel, double layer_height, Writer& writer) {
  auto def = defaults(msq_io_sl1_def_init);
  def.panel = &panel;
  def.layer_height = layer_height;
  def.exposure_time = arguments.number("exposure", def.exposure_time);
  def.initial_exposure_time = arguments.number("first-exposure", def.initial_exposure_time);
  def.faded_layers = static_cast<uint32_t>(arguments.count("fade", def.faded_layers, UINT32_MAX));
  if (arguments.has("material")) def.material = arguments.text("material").c_str();
  if (!arguments.has("no-thumbnails")) def.thumbnail_model = scene.model.get();
  Work work("drawing thumbnails");
  check_io(msq_io_sl1_create(slicer, path.c_str(), &writer_def, &def, writer.out(), work.job()));
}

void remove_window(msq_contours_def& contours) {
  contours.has_window = 0;
  for (size_t i = 0; i < 2; ++i) contours.window_min[i] = contours.window_max[i] = 0;
}

// The smallest distance of layers. Listed heights count before a layer_height beside them.
double closest_layers(const msq_slicer_def& plan) {
  if (plan.layer_z == nullptr || plan.layer_z_count < 2) return plan.layer_height;
  double closest = INFINITY;
  for (uint64_t i = 1; i < plan.layer_z_count; ++i) {
    closest = std::fmin(closest, plan.layer_z[i] - plan.layer_z[i - 1]);
  }
  return closest;
}

// What a writer must be told of the height of layers: nothing where several are listed.
double told_height(const msq_slicer_def& plan) {
  return plan.layer_z != nullptr && plan.layer_z_count > 1 ? 0 : plan.layer_height;
}

// Digits after the point that are finer than contours and layers. 4 are enough for most.
uint32_t decimals_of(const msq_contours_def& contours, double layer_height) {
  const double finest =
      layer_height > 0 ? std::fmin(contours.tolerance, layer_height) : contours.tolerance;
  return static_cast<uint32_t>(std::fmin(std::fmax(std::ceil(-std::log10(finest)) + 1, 4), 12));
}

void create_svg(const msq_slicer* slicer, const std::string& path,
                const msq_io_writer_def& writer_def, const msq_contours_def& contours,
                double layer_height, Format format, Writer& writer) {
  auto def = defaults(msq_io_svg_def_init);
  def.units = contours.units;
  def.decimals = decimals_of(contours, layer_height);
  def.layout = format == Format::SVG_FILES ? MSQ_IO_SVG_FILES : MSQ_IO_SVG_STACK;
  check_io(msq_io_svg_create(slicer, path.c_str(), &writer_def, &def, writer.out()));
}

void create_threemf(const msq_slicer* slicer, const std::string& path,
                    const msq_io_writer_def& writer_def, const msq_contours_def& contours,
                    double layer_height, Writer& writer) {
  auto def = defaults(msq_io_slices_def_init);
  def.units = contours.units;
  def.layer_height = layer_height;
  check_io(msq_io_slices_create(slicer, path.c_str(), &writer_def, &def, writer.out()));
}

msq_slicer_report make_slicer(const Scene& scene, const msq_slicer_def& plan, Slicer& slicer) {
  check(msq_slicer_create(scene.model.get(), &plan, slicer.out()));
  msq_slicer_report report = {};
  report.struct_size = sizeof report;
  check(msq_slicer_info(slicer.get(), &report));
  return report;
}

// Distance of samples along the side where they are closer.
double pitch_of(const Scene& scene, const msq_slicer_def& plan) {
  const auto smallest = [](const double(&pitch)[2]) { return std::fmin(pitch[0], pitch[1]); };
  if (smallest(plan.pitch) > 0) return smallest(plan.pitch);
  Slicer slicer;
  return smallest(make_slicer(scene, plan, slicer).pitch);
}

struct Run {
  msq_io_writer* writer;
  uint64_t first;
  Work work;
  Carried carried;
};

int32_t take_layer(void* user, const msq_layer* layer) {
  auto* run = static_cast<Run*>(user);
  return run->carried.run([&] {
    check_io(msq_io_writer_layer(run->writer, layer));
    run->work.done(layer->index - run->first + 1);
  });
}

}  // namespace

void run_slice(const Arguments& arguments) {
  arguments.require("output");
  const Format format = format_of(arguments);
  refuse_others(arguments, format);
  const msq_io_panel_def panel = read_panel(arguments);
  const Scene scene = open_scene(arguments);

  auto plan = defaults(msq_slicer_def_init);
  auto contours = defaults(msq_contours_def_init);
  read_document(scene, plan, contours);
  if (!plan.layer_z && plan.layer_height == 0) arguments.require("layer-height");
  if (arguments.has("layer-height")) {
    plan.layer_height = arguments.number("layer-height", 0);
    plan.layer_z = nullptr;
    plan.layer_z_count = plan.layer_count = 0;
  }
  const bool needs_height = format == Format::SL1 || format == Format::THREEMF;
  if (needs_height && plan.layer_z_count == 1 && !(plan.layer_height > 0)) {
    throw Failure(arguments.operand(0) + ": slicing.layer_z lists one layer; " +
                  ending(arguments.text("output")) + " needs its height, layer_height, too");
  }
  plan.length_scale = arguments.number("length-scale", plan.length_scale);
  read_grey(arguments, plan);
  if (format == Format::SL1) {
    if (!has_bounds(scene.model.get())) {
      throw UsageError(
          arguments.operand(0) +
          " fills all space; an SL1 archive needs a part with bounds: another shape in "
          "the first of its scales");
    }
    check_io(msq_io_panel_plan(scene.model.get(), &panel, &plan));
  } else {
    if (plan.pitch[0] == 0 && plan.resolution[0] == 0) arguments.require("pitch");
    read_pixels(arguments, scene, plan);
  }
  auto output = defaults(msq_output_def_init);
  if (takes_contours(format)) {
    if (contours.pitch == 0 || arguments.has("pitch")) contours.pitch = pitch_of(scene, plan);
    if (arguments.has("box")) remove_window(contours);
    if (contours.tolerance == 0) contours.tolerance = TOLERANCE_OF_PITCH * contours.pitch;
    contours.tolerance = arguments.number("tolerance", contours.tolerance);
    output.output = MSQ_LAYER_CONTOURS;
    output.contours = &contours;
    plan.output = MSQ_LAYER_BITS;
    plan.outputs = &output;
    plan.output_count = 1;
  }
  Slicer slicer;
  const msq_slicer_report report = make_slicer(scene, plan, slicer);
  uint64_t first = 0, count = 0;
  read_layers(arguments, report.layer_count, first, count);

  std::string path = arguments.text("output");
  while (path.size() > 1 && path.ends_with('/')) path.pop_back();
  const msq_io_writer_def writer_def = make_writer_def(arguments, first, count);
  Writer writer;
  if (format == Format::SL1) {
    create_sl1(arguments, scene, slicer.get(), path, writer_def, panel, told_height(plan), writer);
  } else if (format == Format::THREEMF) {
    create_threemf(slicer.get(), path, writer_def, contours, told_height(plan), writer);
  } else if (takes_contours(format)) {
    create_svg(slicer.get(), path, writer_def, contours, closest_layers(plan), format, writer);
  } else {
    check_io(msq_io_png_create(slicer.get(), path.c_str(), &writer_def, nullptr, writer.out()));
  }
  {
    Run run{writer.get(), first, Work("slicing", "layers"), {}};
    run.carried.check(msq_slicer_run(slicer.get(), first, count, take_layer, &run, run.work.job()));
  }
  heed_signals();
  check_io(msq_io_writer_finish(writer.get()));
}

}  // namespace command
