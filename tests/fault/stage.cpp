// SPDX-License-Identifier: Apache-2.0
#include "stage.h"

#include <cstring>

namespace msq::test {

namespace {

constexpr unsigned char pattern = 0xa5;

}  // namespace

void require(bool holds, const std::string& what) {
  if (!holds) throw Failure(what);
}

void require_ok(msq_status status) {
  if (status == MSQ_OK) return;
  throw Failure(std::string("a call around it is ") + msq_status_name(status) + ": " +
                msq_error_message());
}

void Stage::set_reference() {
  is_reference_ = true;
}

void Stage::set_failing(uint64_t k, Failing failing) {
  is_reference_ = false;
  k_ = k;
  failing_ = failing;
}

void Stage::begin() {
  outputs_.clear();
}

void Stage::add(void* data, size_t bytes, bool is_untouched, bool is_compared) {
  outputs_.push_back({static_cast<unsigned char*>(data), bytes, is_untouched, is_compared});
}

void Stage::fill() const {
  for (const Output& output : outputs_) std::memset(output.data, pattern, output.bytes);
}

void Stage::check_untouched() const {
  for (const Output& output : outputs_)
    for (size_t i = 0; output.is_untouched && i < output.bytes; ++i)
      require(output.data[i] == pattern, "the call failed and wrote an output");
}

void Stage::store() {
  reference_.clear();
  for (const Output& output : outputs_)
    if (output.is_compared)
      reference_.insert(reference_.end(), output.data, output.data + output.bytes);
}

void Stage::compare(const char* when) const {
  size_t at = 0;
  for (const Output& output : outputs_) {
    if (!output.is_compared) continue;
    require(std::memcmp(reference_.data() + at, output.data, output.bytes) == 0,
            std::string("other outputs ") + when);
    at += output.bytes;
  }
}

void Stage::call(const std::function<msq_status()>& call, const std::function<void()>& finish) {
  fill();
  arm(is_reference_ ? 0 : k_, failing_);
  const msq_status status = call();
  const uint64_t count = disarm();
  if (is_reference_) {
    allocations_ = count;
    require_ok(status);
    if (finish) finish();
    return store();
  }
  if (status == MSQ_OK) {
    if (finish) finish();
    compare("though the call succeeded");
  } else {
    require(count >= k_, std::string("without an allocation that failed it is ") +
                             msq_status_name(status) + ": " + msq_error_message());
    require(status == MSQ_E_MEMORY || (allows_io && status == MSQ_E_IO),
            std::string("the status is ") + msq_status_name(status) + ": " + msq_error_message());
    require(msq_error_message()[0] != 0, "there is no message");
    check_untouched();
  }
  fill();
  const msq_status next = call();
  require(next == MSQ_OK,
          std::string("the next call is ") + msq_status_name(next) + ": " + msq_error_message());
  if (finish) finish();
  compare("in the next call");
}

}  // namespace msq::test
