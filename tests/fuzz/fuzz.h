// SPDX-License-Identifier: Apache-2.0
// What fuzzers share: numbers from the bytes of an input, handles that release themselves, and the
// oracles that hold for every call. A fuzzer sees msq as a host does, through msq.h alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "msq.h"

namespace msq::fuzz {

/// A fuzzer takes any bytes. What it finds wrong it reports by wrong().
using Run = void (*)(const uint8_t* data, size_t size);

void run_beam_file(const uint8_t* data, size_t size);
void run_calls(const uint8_t* data, size_t size);
void run_contours(const uint8_t* data, size_t size);
void run_definitions(const uint8_t* data, size_t size);
void run_document(const uint8_t* data, size_t size);
void run_expression(const uint8_t* data, size_t size);
void run_foam(const uint8_t* data, size_t size);
void run_image_file(const uint8_t* data, size_t size);
void run_mesh(const uint8_t* data, size_t size);

/// Prints what is wrong and aborts, which libFuzzer and AFL++ take for a crash.
[[noreturn]] void wrong(const char* format, ...) __attribute__((format(printf, 1, 2)));

/// Numbers from bytes, taken from the front; zeros when the bytes are used up.
class Input {
 public:
  Input(const uint8_t* data, size_t size) : at_(data), end_(data + size) {}

  bool is_empty() const { return at_ == end_; }
  uint8_t byte() { return is_empty() ? uint8_t{0} : *at_++; }
  /// 0 to count - 1; count is at most 256.
  uint32_t below(uint32_t count) { return byte() % count; }
  /// True for about `part` of 256 bytes. Zeros, which all inputs end with, are false.
  bool chance(uint32_t part) { return byte() > 255 - part; }
  uint64_t word(int bytes);
  /// In 65536 steps.
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(word(2)) / 65535);
  }
  /// As between(), but sometimes a special number, or any number at all.
  double number(double low, double high);
  /// All bytes that are left.
  std::string_view rest();

 private:
  const uint8_t* at_;
  const uint8_t* end_;
};

/// Random numbers that do not use up the input. SplitMix64.
class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed) {}
  uint64_t word();
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(word() >> 11) * 0x1p-53);
  }

 private:
  uint64_t state_;
};

struct Release {
  void operator()(msq_context* handle) const { msq_context_release(handle); }
  void operator()(msq_shape* handle) const { msq_shape_release(handle); }
  void operator()(msq_field* handle) const { msq_field_release(handle); }
  void operator()(msq_structure* handle) const { msq_structure_release(handle); }
  void operator()(msq_material* handle) const { msq_material_release(handle); }
  void operator()(msq_model* handle) const { msq_model_release(handle); }
  void operator()(msq_slicer* handle) const { msq_slicer_release(handle); }
  void operator()(msq_contours* handle) const { msq_contours_release(handle); }
  void operator()(msq_document* handle) const { msq_document_release(handle); }
  void operator()(msq_beam_file* handle) const { msq_beam_file_release(handle); }
  void operator()(msq_strut_graph* handle) const { msq_strut_graph_release(handle); }
  void operator()(msq_fill* handle) const { msq_fill_release(handle); }
};
template <class Handle>
using Owner = std::unique_ptr<Handle, Release>;

/// With the defaults of msq.h.
template <class Def>
Def make_def(msq_status (*init)(Def*, size_t)) {
  Def def;
  if (init(&def, sizeof def) != MSQ_OK) wrong("a definition was not initialised");
  return def;
}

/// One thread and little memory, so that an input cannot take much.
Owner<msq_context> make_context(uint32_t threads = 1);

/// Watches one call. A call must return a status that msq.h knows, with a message if it is an
/// error, never that of a defect in msq, within `bound` seconds of processor time. Builds that do
/// not fuzz do not look at the time.
class Call {
 public:
  explicit Call(const char* name, double bound = 20);
  /// True if it succeeded.
  bool returned(msq_status status) const;

 private:
  const char* name_;
  double bound_, begin_;
};
/// Makes a call under these oracles. True if it succeeded.
#define MSQ_FUZZ(function, ...) ::msq::fuzz::Call(#function).returned(function(__VA_ARGS__))

/// The same for a constructor. NULL if it was refused; then the handle must be untouched.
template <class Handle, class Construct>
Owner<Handle> make(const char* name, const Construct& construct) {
  Handle* const untouched = reinterpret_cast<Handle*>(alignof(std::max_align_t));
  Handle* handle = untouched;
  const Call call(name);
  if (call.returned(construct(&handle))) {
    if (!handle || handle == untouched) wrong("%s succeeded without a handle", name);
    return Owner<Handle>(handle);
  }
  if (handle != untouched) wrong("%s failed and wrote its handle", name);
  return nullptr;
}

/// A job for the calls of one input. It is cancelled when the input has taken long; the call must
/// then return soon.
class Job {
 public:
  Job();
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;
  ~Job();
  operator msq_job*() const { return job_; }  // NOLINT: it stands for the job
  /// What follows would take long too.
  bool is_cancelled() const;

 private:
  msq_job* job_;
};

}  // namespace msq::fuzz
