// SPDX-License-Identifier: Apache-2.0
#include "fuzz.h"

#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <limits>

#ifdef MSQ_FUZZ_BOUNDS_TIME
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#endif

namespace msq::fuzz {

void wrong(const char* format, ...) {
  std::va_list arguments;
  va_start(arguments, format);
  std::fputs("msq fuzz: ", stderr);
  std::vfprintf(stderr, format, arguments);
  std::fputc('\n', stderr);
  va_end(arguments);
  std::abort();
}

uint64_t Input::word(int bytes) {
  uint64_t word = 0;
  for (int i = 0; i < bytes; ++i) word |= static_cast<uint64_t>(byte()) << (8 * i);
  return word;
}

double Input::number(double low, double high) {
  static constexpr double specials[] = {0,
                                        -0.0,
                                        1,
                                        -1,
                                        0.5,
                                        2,
                                        3,
                                        1e-3,
                                        1e-9,
                                        1e-75,
                                        1e75,
                                        1e76,
                                        1e100,
                                        1e154,
                                        1e300,
                                        1e-300,
                                        1e-308,
                                        5e-324,
                                        0x1p24,
                                        0x1p31,
                                        0x1p53,
                                        1e-76,
                                        4.0 / 3,
                                        1024,
                                        -1e75,
                                        -1e300,
                                        std::numeric_limits<double>::infinity(),
                                        -std::numeric_limits<double>::infinity(),
                                        std::numeric_limits<double>::quiet_NaN(),
                                        std::numeric_limits<double>::max()};
  const uint8_t kind = byte();
  if (kind < 216) return between(low, high);
  if (kind < 224) return low;
  if (kind < 232) return high;
  if (kind < 248) return specials[below(std::size(specials))];
  const uint64_t bits = word(8);
  double value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

std::string_view Input::rest() {
  const std::string_view rest(reinterpret_cast<const char*>(at_), static_cast<size_t>(end_ - at_));
  at_ = end_;
  return rest;
}

uint64_t Random::word() {
  uint64_t z = state_ += 0x9e3779b97f4a7c15;
  z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9;
  z = (z ^ z >> 27) * 0x94d049bb133111eb;
  return z ^ z >> 31;
}

Owner<msq_context> make_context(uint32_t threads) {
  msq_context_def def = make_def(msq_context_def_init);
  def.threads = threads;
  def.cache_bytes = uint64_t{16} << 20;
  def.memory_limit = uint64_t{128} << 20;
  msq_context* context;
  if (msq_context_create(&def, &context) != MSQ_OK) wrong("no context: %s", msq_error_message());
  return Owner<msq_context>(context);
}

namespace {

double processor_seconds() {
#ifdef MSQ_FUZZ_BOUNDS_TIME
  std::timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
#else
  return 0;
#endif
}

}  // namespace

Call::Call(const char* name, double bound)
    : name_(name), bound_(bound), begin_(processor_seconds()) {}

bool Call::returned(msq_status status) const {
  const double seconds = processor_seconds() - begin_;
  if (seconds > bound_)
    wrong("%s took %.1f s of processor time; the bound is %g s", name_, seconds, bound_);
  if (status == MSQ_OK) return true;
  if (!std::strcmp(msq_status_name(status), "MSQ_E_UNKNOWN"))
    wrong("%s returned %d", name_, static_cast<int>(status));
  const char* message = msq_error_message();
  if (status == MSQ_E_INTERNAL) wrong("%s: %s", name_, message);
  if (!*message) wrong("%s failed without a message", name_);
  for (const char* c = message; *c; ++c)
    if (static_cast<unsigned char>(*c) < ' ') wrong("%s: a message with byte %d", name_, *c);
  return false;
}

#ifdef MSQ_FUZZ_BOUNDS_TIME

namespace {

/// Cancels the job that is set when its time is over. One thread for the process: inputs come by
/// thousands a second.
class Watch {
 public:
  static Watch& instance() {
    static Watch* const watch = new Watch;  // the thread uses it as long as there is one
    return *watch;
  }
  void begin(msq_job* job) {
    const std::lock_guard lock(mutex_);
    job_ = job;
    has_cancelled_ = false;
    end_ = std::chrono::steady_clock::now() + std::chrono::milliseconds(1500);
    changed_.notify_one();
  }
  void end() {
    const std::lock_guard lock(mutex_);
    job_ = nullptr;
  }
  bool has_cancelled() {
    const std::lock_guard lock(mutex_);
    return has_cancelled_;
  }

 private:
  Watch() {
    std::thread([this] { watch(); }).detach();
  }
  void watch() {
    std::unique_lock lock(mutex_);
    for (;;) {
      changed_.wait(lock, [this] { return job_ != nullptr; });
      const auto end = end_;
      lock.unlock();
      std::this_thread::sleep_until(end);
      lock.lock();
      if (job_ && end_ <= std::chrono::steady_clock::now()) {
        msq_job_cancel(job_);
        has_cancelled_ = true;
        job_ = nullptr;
      }
    }
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  msq_job* job_ = nullptr;
  bool has_cancelled_ = false;
  std::chrono::steady_clock::time_point end_;
};

}  // namespace

#endif

Job::Job() {
  if (msq_job_create(&job_) != MSQ_OK) wrong("no job: %s", msq_error_message());
#ifdef MSQ_FUZZ_BOUNDS_TIME
  Watch::instance().begin(job_);
#endif
}

Job::~Job() {
#ifdef MSQ_FUZZ_BOUNDS_TIME
  Watch::instance().end();
#endif
  msq_job_release(job_);
}

bool Job::is_cancelled() const {
#ifdef MSQ_FUZZ_BOUNDS_TIME
  return Watch::instance().has_cancelled();
#else
  return false;
#endif
}

}  // namespace msq::fuzz
