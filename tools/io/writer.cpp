// SPDX-License-Identifier: Apache-2.0
#include "writer.h"

#include <algorithm>

#include "defs.h"

using namespace msq_io;

namespace {

using ull = unsigned long long;

msq_io_writer_def writer_defaults() {
  msq_io_writer_def def{};
  def.queue_bytes = uint64_t{16} << 20;
  def.layer_count = UINT64_MAX;
  return def;
}

}  // namespace

namespace msq_io {

WriterPlan read_plan(const msq_slicer* slicer, const msq_io_writer_def* host_def) {
  require(slicer, "slicer");
  const msq_io_writer_def def = read_def(host_def, writer_defaults(), "writer_def");
  msq_slicer_report report{};
  report.struct_size = sizeof report;
  check_msq(msq_slicer_info(slicer, &report));
  if (def.first_layer >= report.layer_count)
    fail(MSQ_E_ARGUMENT, "first_layer is %llu; the slicer has %llu layers", ull{def.first_layer},
         ull{report.layer_count});
  const uint64_t left = report.layer_count - def.first_layer;
  if (def.layer_count == 0 || (def.layer_count != UINT64_MAX && def.layer_count > left))
    fail(MSQ_E_ARGUMENT,
         "layer_count is %llu from layer %llu on; the slicer has %llu layers, and one at least "
         "must be written",
         ull{def.layer_count}, ull{def.first_layer}, ull{report.layer_count});
  WriterPlan plan{};
  plan.first_layer = def.first_layer;
  plan.layer_count = std::min(def.layer_count, left);
  plan.stack_layers = report.layer_count;
  plan.width = report.width;
  plan.height = report.height;
  plan.output = def.output;
  plan.threads = require_range<uint32_t>(def.threads, 0, 256, "threads");
  plan.replace = require_range(def.replace, 0, 1, "replace") != 0;
  plan.queue_bytes = def.queue_bytes;
  return plan;
}

std::unique_ptr<msq_io_writer> make_writer(const WriterPlan& plan, std::unique_ptr<Format> format) {
  return std::make_unique<msq_io_writer>(plan, std::move(format));
}

}  // namespace msq_io

msq_io_writer::msq_io_writer(const WriterPlan& plan, std::unique_ptr<Format> format)
    : plan_(plan),
      format_(std::move(format)),
      pipeline_(std::make_unique<Pipeline>(*format_, plan.threads, plan.queue_bytes)) {}

void msq_io_writer::step(const std::function<void()>& body) {
  if (error_) raise(*error_);
  try {
    body();
  } catch (...) {
    error_ = current_failure();
    // Nothing is left, and no thread.
    delivered_ = pipeline_->delivered();
    peak_bytes_ = pipeline_->peak_bytes();
    pipeline_.reset();
    bytes_ = format_->bytes();
    format_.reset();
    raise(*error_);
  }
}

void msq_io_writer::take(const msq_layer& layer) {
  if (is_finished_) fail(MSQ_E_ARGUMENT, "a layer comes after msq_io_writer_finish");
  step([&] {
    const uint64_t expected = plan_.first_layer + received_;
    if (received_ == plan_.layer_count)
      fail(MSQ_E_ARGUMENT, "layer %llu comes, and all %llu layers have come", ull{layer.index},
           ull{plan_.layer_count});
    if (layer.index != expected)
      fail(MSQ_E_ARGUMENT, "layer %llu comes in place of layer %llu", ull{layer.index},
           ull{expected});
    if (layer.width != plan_.width || layer.height != plan_.height)
      fail(MSQ_E_ARGUMENT, "a layer has %u x %u pixels; those of the slicer have %u x %u",
           layer.width, layer.height, plan_.width, plan_.height);
    if (plan_.output >= layer.output_count)
      fail(MSQ_E_ARGUMENT, "output is %u; the layers have %llu outputs", plan_.output,
           ull{layer.output_count});
    std::unique_ptr<Packet> packet = pipeline_->spare();
    packet->number = received_;
    packet->z = layer.z;
    packet->width = layer.width;
    packet->height = layer.height;
    format_->take(layer, *layer.outputs[plan_.output], *packet);
    pipeline_->put(std::move(packet));
    ++received_;
  });
}

void msq_io_writer::finish() {
  if (is_finished_) return;
  step([&] {
    if (received_ != plan_.layer_count)
      fail(MSQ_E_ARGUMENT, "%llu layers came; %llu from layer %llu on were expected",
           ull{received_}, ull{plan_.layer_count}, ull{plan_.first_layer});
    pipeline_->drain();
    format_->commit();
  });
  is_finished_ = true;
  delivered_ = pipeline_->delivered();
  peak_bytes_ = pipeline_->peak_bytes();
  pipeline_.reset();
  bytes_ = format_->bytes();
  format_.reset();
}

msq_io_writer_report msq_io_writer::report() const {
  msq_io_writer_report report{};
  report.layer_count = received_;
  report.written_count = pipeline_ ? pipeline_->delivered() : delivered_;
  report.bytes = format_ ? format_->bytes() : bytes_;
  report.peak_queue_bytes = pipeline_ ? pipeline_->peak_bytes() : peak_bytes_;
  return report;
}

msq_status msq_io_writer_def_init(msq_io_writer_def* def, size_t size) {
  return guard([&] { set_defaults(def, size, writer_defaults(), "msq_io_writer_def"); });
}

int32_t msq_io_writer_layer(void* user, const msq_layer* layer) {
  return guard([&] {
    auto& writer = require(static_cast<msq_io_writer*>(user), "user");
    writer.take(require(layer, "layer"));
  });
}

msq_status msq_io_writer_finish(msq_io_writer* writer) {
  return guard([&] { require(writer, "writer").finish(); });
}

msq_status msq_io_writer_info(const msq_io_writer* writer, msq_io_writer_report* report) {
  return guard([&] { write_report(report, require(writer, "writer").report(), "report"); });
}

void msq_io_writer_release(msq_io_writer* writer) {
  delete writer;
}
