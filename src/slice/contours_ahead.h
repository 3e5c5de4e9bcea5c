// SPDX-License-Identifier: Apache-2.0
// Contours of layers in ascending order. While the caller uses some, workers compute the next ones,
// as many layers at once as there are threads.
#pragma once

#include <cstdint>
#include <exception>
#include <functional>
#include <optional>
#include <vector>

#include "base/job.h"
#include "base/memory.h"
#include "model/model.h"
#include "slice/contours.h"

namespace msq {

class ContoursAhead {
 public:
  /// Computes the contours of a layer: those of one of the outputs.
  using Make = std::function<Ref<Contours>(uint64_t layer, size_t output, Job* job)>;

  /// Of layers [first, last) and `outputs` outputs, of which there may be none. What waits for the
  /// caller is taken from the model's budget. Where that does not hold what is computed ahead, the
  /// rest is computed layer by layer, so a limit that holds one layer holds all.
  ContoursAhead(const Model& model, Make make, size_t outputs, uint64_t first, uint64_t last,
                Job* job);
  /// Stops what is computed ahead.
  ~ContoursAhead();

  /// Makes a layer current: the first one, then each next one. Throws what computing it threw.
  void go_to(uint64_t layer);
  /// Of the current layer. Valid until go_to().
  const Ref<Contours>& contours(size_t output) const { return current_[output].contours; }

 private:
  struct Item {
    Ref<Contours> contours{};
    Reservation reservation{};
    std::exception_ptr error{};
  };
  using Items = std::vector<Item>;  ///< layer by layer, in the order of outputs

  Item make(uint64_t layer, size_t output, const Job* job) const;
  void start_next();
  void go_on_alone(uint64_t layer);

  const Model& model_;
  const Make make_;
  const size_t outputs_;
  const uint64_t last_, layers_at_once_;
  Job* const job_;
  Items ready_, next_;
  Items current_;
  uint64_t begin_, end_;  // of ready_
  uint64_t next_end_;
  bool is_alone_ = false;
  Job ahead_job_;
  std::optional<Executor::Task> ahead_;
};

}  // namespace msq
