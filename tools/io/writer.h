// SPDX-License-Identifier: Apache-2.0
// What stands behind msq_io_writer.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "pipeline.h"

namespace msq_io {

/// The layers that will come, and how they are taken. They are part of a stack of stack_layers.
struct WriterPlan {
  uint64_t first_layer, layer_count, stack_layers;
  uint32_t width, height, output, threads;
  bool replace;
  uint64_t queue_bytes;
};

/// Reads the definition of the host for a slicer.
WriterPlan read_plan(const msq_slicer* slicer, const msq_io_writer_def* def);

/// Makes the object of the C ABI.
std::unique_ptr<msq_io_writer> make_writer(const WriterPlan& plan, std::unique_ptr<Format> format);

}  // namespace msq_io

struct msq_io_writer {
 public:
  msq_io_writer(const msq_io::WriterPlan& plan, std::unique_ptr<msq_io::Format> format);

  void take(const msq_layer& layer);
  void finish();
  msq_io_writer_report report() const;

 private:
  /// Runs a step. A failure is kept; later steps fail alike.
  void step(const std::function<void()>& body);

  const msq_io::WriterPlan plan_;
  /// Outlives the pipeline.
  std::unique_ptr<msq_io::Format> format_;
  std::unique_ptr<msq_io::Pipeline> pipeline_;
  uint64_t received_ = 0, delivered_ = 0, peak_bytes_ = 0, bytes_ = 0;
  bool is_finished_ = false;
  std::optional<msq_io::Failure> error_;
};
