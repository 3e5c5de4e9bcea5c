// SPDX-License-Identifier: Apache-2.0
// Packets are delivered in order, however long each takes to encode; the queue holds what it may.
#include <algorithm>
#include <condition_variable>
#include <mutex>

#include "msq_test.h"
#include "pipeline.h"

namespace {

using msq_io::Error;
using msq_io::Packet;
using msq_io::Pipeline;

constexpr uint64_t count = 40, fails_at_none = UINT64_MAX;

/// Even packets wait until the odd one after them is encoded.
class Pairs : public msq_io::Format {
 public:
  uint64_t fails_at = fails_at_none;
  std::vector<uint64_t> delivered;

  void take(const msq_layer&, const msq_output&, Packet&) override {}
  void encode(Packet& packet) override {
    std::unique_lock<std::mutex> lock(mutex_);
    if (packet.number == fails_at) throw Error(MSQ_E_IO, "encode");
    ++encoded_;
    last_ = std::max(last_, packet.number);
    changed_.notify_all();
    if (packet.number % 2 == 0 && packet.number + 1 < count && fails_at == fails_at_none)
      changed_.wait(lock, [&] { return last_ > packet.number; });
    packet.output.assign(10, 0);
  }
  void deliver(Packet& packet) override { delivered.push_back(packet.number); }
  void commit() override {}
  uint64_t bytes() const override { return 0; }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  uint64_t encoded_ = 0, last_ = 0;
};

void put(Pipeline& pipeline, uint64_t number) {
  auto packet = pipeline.spare();
  packet->number = number;
  packet->input.resize(100);
  packet->bytes = 100;
  pipeline.put(std::move(packet));
}

void in_order(void**) {
  Pairs format;
  Pipeline pipeline(format, 3, 1000);
  for (uint64_t i = 0; i < count; ++i) put(pipeline, i);
  pipeline.drain();
  assert_int_equal(format.delivered.size(), count);
  for (uint64_t i = 0; i < count; ++i) assert_int_equal(format.delivered[i], i);
  assert_int_equal(pipeline.delivered(), count);
  assert_in_range(pipeline.peak_bytes(), 200, 1000);
}

/// One error ends it: nothing after the packet that failed is delivered.
void fails(void**) {
  for (const uint32_t threads : {1u, 3u}) {
    Pairs format;
    format.fails_at = 7;
    Pipeline pipeline(format, threads, 500);
    uint64_t errors = 0;
    for (uint64_t i = 0; i < count; ++i) try {
        put(pipeline, i);
      } catch (const Error& error) {
        assert_int_equal(error.status, MSQ_E_IO);
        ++errors;
      }
    try {
      pipeline.drain();
    } catch (const Error&) {
      ++errors;
    }
    assert_in_range(errors, 1, count);
    assert_in_range(format.delivered.size(), 0, 7);
    for (uint64_t i = 0; i < format.delivered.size(); ++i) assert_int_equal(format.delivered[i], i);
  }
}

/// It may end at any time.
void abandoned(void**) {
  for (uint64_t n = 0; n < count; n += 3) {
    Pairs format;
    format.fails_at = count;
    Pipeline pipeline(format, 4, 10000);
    for (uint64_t i = 0; i < n; ++i) put(pipeline, i);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(in_order), cmocka_unit_test(fails),
                              cmocka_unit_test(abandoned)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
