// SPDX-License-Identifier: Apache-2.0
#include "slice/contours_ahead.h"

#include <algorithm>

namespace msq {

namespace {

uint64_t bytes_of(const Contours& contours) {
  const uint64_t coordinate = contours.format() == ContourFormat::int32 ? 4 : 8;
  return 2 * coordinate * contours.point_count() +
         (sizeof(uint64_t) + sizeof(int64_t) + 1) * (contours.ring_count() + 1);
}

bool is_limit(const std::exception_ptr& error) {
  try {
    std::rethrow_exception(error);
  } catch (const Error& thrown) {
    return thrown.status == Status::limit;
  } catch (...) {
    return false;
  }
}

}  // namespace

ContoursAhead::ContoursAhead(const Model& model, Make make, size_t outputs, uint64_t first,
                             uint64_t last, Job* job)
    : model_(model),
      make_(std::move(make)),
      outputs_(outputs),
      last_(last),
      layers_at_once_(model.executor().threads()),
      job_(job),
      current_(outputs),
      begin_(first),
      end_(first),
      next_end_(first),
      ahead_job_(job) {
  if (outputs_ > 0) start_next();
}

ContoursAhead::~ContoursAhead() {
  ahead_job_.cancel();
}

ContoursAhead::Item ContoursAhead::make(uint64_t layer, size_t output, const Job* job) const {
  Item item;
  try {
    Job part(job);  // its progress is not that of the call
    item.contours = make_(layer, output, &part);
    item.reservation = {model_.context().budget, bytes_of(*item.contours), "contours of layers"};
  } catch (...) {
    item.contours = Ref<Contours>();
    item.error = std::current_exception();
  }
  return item;
}

void ContoursAhead::start_next() {
  const uint64_t begin = end_;
  next_end_ = std::min(last_, begin + layers_at_once_);
  if (begin == next_end_ || is_alone_) return;
  next_ = Items((next_end_ - begin) * outputs_);
  ahead_.emplace(model_.executor(), [this, begin] {
    const CurrentJob current(&ahead_job_);
    model_.executor().for_each(next_.size(), [this, begin](uint64_t n) {
      next_[n] = make(begin + n / outputs_, n % outputs_, &ahead_job_);
    });
  });
}

/// Drops what was computed ahead, whose memory the layer needs, and computes no more of it.
void ContoursAhead::go_on_alone(uint64_t layer) {
  ahead_job_.cancel();
  ahead_.reset();
  ready_.clear();
  next_.clear();
  current_ = Items(outputs_);
  is_alone_ = true;
  end_ = layer;
}

void ContoursAhead::go_to(uint64_t layer) {
  if (outputs_ == 0) return;
  current_ = Items(outputs_);
  if (!is_alone_ && layer == end_) {
    ahead_->wait();
    ahead_.reset();
    std::swap(ready_, next_);
    begin_ = end_;
    end_ = next_end_;
    start_next();
  }
  if (!is_alone_) {
    const auto of_layer = ready_.begin() + static_cast<ptrdiff_t>((layer - begin_) * outputs_);
    const bool is_over = std::any_of(of_layer, of_layer + static_cast<ptrdiff_t>(outputs_),
                                     [](const Item& i) { return i.error && is_limit(i.error); });
    if (is_over)
      go_on_alone(layer);
    else
      std::move(of_layer, of_layer + static_cast<ptrdiff_t>(outputs_), current_.begin());
  }
  for (size_t output = 0; output < outputs_; ++output) {
    if (is_alone_) current_[output] = make(layer, output, job_);
    if (current_[output].error) std::rethrow_exception(current_[output].error);
  }
}

}  // namespace msq
