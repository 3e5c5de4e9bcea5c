// SPDX-License-Identifier: Apache-2.0
// Layers on their way to a file: copied on the thread of the host, encoded by several threads at
// once, delivered in order.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "error.h"

namespace msq_io {

/// One layer on its way.
struct Packet {
  /// From 0 for the first layer of the writer.
  uint64_t number = 0;
  double z = 0;
  uint32_t width = 0, height = 0;
  /// Bits of a pixel.
  uint32_t depth = 0;
  /// What was copied of the layer, and what it was encoded to.
  std::vector<uint8_t> input, output;
  /// Contours in place of input.
  std::shared_ptr<msq_contours> contours;
  /// Of the samples: the sum of the values of pixels.
  uint64_t sum = 0;
  /// Bytes that count against the queue.
  uint64_t bytes = 0;
};

/// What a format does with layers.
class Format {
 public:
  virtual ~Format() = default;
  /// Copies what it needs of a layer, on the thread of the host.
  virtual void take(const msq_layer& layer, const msq_output& output, Packet& packet) = 0;
  /// Any thread calls it, several at once with packets of their own.
  virtual void encode(Packet& packet) = 0;
  /// Called in the order of layers, by one thread at a time.
  virtual void deliver(Packet& packet) = 0;
  /// All layers were delivered. Nothing is visible before it.
  virtual void commit() = 0;
  /// Bytes written so far. Any thread may call it.
  virtual uint64_t bytes() const = 0;
};

class Pipeline {
 public:
  /// threads: including the caller of put(). 0: one per core.
  Pipeline(Format& format, uint32_t threads, uint64_t queue_bytes);
  /// Drops what waits and joins the threads.
  ~Pipeline();
  Pipeline(const Pipeline&) = delete;
  Pipeline& operator=(const Pipeline&) = delete;

  /// A packet with the input buffer of an earlier one.
  std::unique_ptr<Packet> spare();
  /// Adds a packet. While the queue is full, the caller encodes packets itself or waits. Throws
  /// the first error of any packet.
  void put(std::unique_ptr<Packet> packet);
  /// Waits until all packets are delivered. Throws the first error.
  void drain();

  uint64_t delivered() const;
  uint64_t peak_bytes() const;

 private:
  using Lock = std::unique_lock<std::mutex>;

  void work();
  /// Encodes the oldest packet that waits, and delivers those that are next. Locked at both ends.
  void process_one(Lock& lock);
  void deliver_next(Lock& lock);
  void set_error();
  void check() const;

  Format& format_;
  const uint64_t queue_bytes_;
  mutable std::mutex mutex_;
  std::condition_variable work_comes_, work_done_;
  std::deque<std::unique_ptr<Packet>> waiting_;
  std::map<uint64_t, std::unique_ptr<Packet>> encoded_;
  /// Input buffers of packets that are encoded.
  std::vector<std::vector<uint8_t>> spare_;
  /// Packets that were put and are not delivered, and their bytes.
  uint64_t in_flight_ = 0, bytes_ = 0, peak_bytes_ = 0;
  uint64_t next_ = 0;
  bool is_delivering_ = false, is_stopping_ = false;
  std::optional<Failure> error_;
  std::vector<std::thread> threads_;
};

}  // namespace msq_io
