// SPDX-License-Identifier: Apache-2.0
#include "pipeline.h"

#include <algorithm>

namespace msq_io {

namespace {

/// Buffers that are kept beside those of layers that wait.
constexpr size_t max_spare = 4;

}  // namespace

Pipeline::Pipeline(Format& format, uint32_t threads, uint64_t queue_bytes)
    : format_(format), queue_bytes_(queue_bytes) {
  if (threads == 0) threads = std::max(1u, std::thread::hardware_concurrency());
  spare_.reserve(max_spare);
  threads_.reserve(threads - 1);
  try {
    for (uint32_t i = 1; i < threads; ++i) threads_.emplace_back([this] { work(); });
  } catch (...) {
    // No memory, or too many threads. The threads that there are will do.
  }
}

Pipeline::~Pipeline() {
  {
    const Lock lock(mutex_);
    is_stopping_ = true;
    waiting_.clear();
  }
  work_comes_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void Pipeline::check() const {
  if (error_) raise(*error_);
}

void Pipeline::set_error() {
  if (!error_) error_ = current_failure();
  waiting_.clear();
}

std::unique_ptr<Packet> Pipeline::spare() {
  auto packet = std::make_unique<Packet>();
  const Lock lock(mutex_);
  if (!spare_.empty()) {
    packet->input = std::move(spare_.back());
    spare_.pop_back();
  }
  return packet;
}

void Pipeline::put(std::unique_ptr<Packet> packet) {
  Lock lock(mutex_);
  check();
  while (in_flight_ > 0 && bytes_ + packet->bytes > queue_bytes_) {
    if (!waiting_.empty())
      process_one(lock);
    else
      work_done_.wait(lock);
    check();
  }
  bytes_ += packet->bytes;
  peak_bytes_ = std::max(peak_bytes_, bytes_);
  ++in_flight_;
  waiting_.push_back(std::move(packet));
  if (threads_.empty()) {
    process_one(lock);
    check();
    return;
  }
  lock.unlock();
  work_comes_.notify_one();
}

void Pipeline::drain() {
  Lock lock(mutex_);
  for (;;) {
    check();
    if (in_flight_ == 0) return;
    if (!waiting_.empty())
      process_one(lock);
    else
      work_done_.wait(lock);
  }
}

void Pipeline::work() {
  Lock lock(mutex_);
  for (;;) {
    work_comes_.wait(lock, [this] { return is_stopping_ || !waiting_.empty(); });
    if (is_stopping_) return;
    process_one(lock);
  }
}

void Pipeline::process_one(Lock& lock) {
  std::unique_ptr<Packet> packet = std::move(waiting_.front());
  waiting_.pop_front();
  lock.unlock();
  bool is_encoded = false;
  std::optional<Failure> error;
  try {
    format_.encode(*packet);
    is_encoded = true;
  } catch (...) {
    error = current_failure();
  }
  lock.lock();
  if (!is_encoded) {
    if (!error_) error_ = error;
    waiting_.clear();
  } else if (!error_) {
    // The encoded bytes wait in place of the layer's own.
    packet->contours.reset();
    if (spare_.size() < max_spare) spare_.push_back(std::move(packet->input));
    packet->input = {};
    const uint64_t bytes = packet->output.size();
    bytes_ += bytes - packet->bytes;
    packet->bytes = bytes;
    peak_bytes_ = std::max(peak_bytes_, bytes_);
    try {
      encoded_.emplace(packet->number, std::move(packet));
    } catch (...) {
      set_error();
    }
    if (!is_delivering_) deliver_next(lock);
  }
  work_done_.notify_all();
}

void Pipeline::deliver_next(Lock& lock) {
  is_delivering_ = true;
  while (!error_ && !encoded_.empty() && encoded_.begin()->first == next_) {
    std::unique_ptr<Packet> packet = std::move(encoded_.begin()->second);
    encoded_.erase(encoded_.begin());
    lock.unlock();
    std::optional<Failure> error;
    try {
      format_.deliver(*packet);
    } catch (...) {
      error = current_failure();
    }
    lock.lock();
    if (error && !error_) error_ = error;
    if (error_) {
      waiting_.clear();
      break;
    }
    bytes_ -= packet->bytes;
    --in_flight_;
    ++next_;
    work_done_.notify_all();
  }
  is_delivering_ = false;
}

uint64_t Pipeline::delivered() const {
  const Lock lock(mutex_);
  return next_;
}

uint64_t Pipeline::peak_bytes() const {
  const Lock lock(mutex_);
  return peak_bytes_;
}

}  // namespace msq_io
