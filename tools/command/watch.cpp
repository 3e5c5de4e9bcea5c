// SPDX-License-Identifier: Apache-2.0
#include "watch.h"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <thread>

#include "text.h"

namespace command {

namespace {

constexpr auto TICK = std::chrono::milliseconds(50);
constexpr int TICKS_A_LINE = 4;                            // progress is drawn every 200 ms
constexpr auto PATIENCE = std::chrono::milliseconds(400);  // shorter work shows no progress

// The handler may use atomics without locks.
std::atomic<int> signal_caught{0};
static_assert(std::atomic<int>::is_always_lock_free);

extern "C" void on_signal(int number) {
  int none = 0;
  if (signal_caught.compare_exchange_strong(none, number)) return;
  _exit(EXIT_SIGNALLED + number);
}

void print(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

}  // namespace

class Watcher {
 public:
  void start() {
    is_terminal_ = isatty(STDERR_FILENO) == 1;
    thread_ = std::thread([this] { run(); });
  }

  void stop() {
    {
      const std::lock_guard lock(mutex_);
      is_over_ = true;
    }
    wake_.notify_one();
    if (thread_.joinable()) thread_.join();
  }

  void be_quiet() { is_quiet_ = true; }
  bool is_quiet() const { return is_quiet_; }

  void say(const std::string& text) {
    const std::lock_guard lock(mutex_);
    erase();
    print("msq: " + one_line(text) + "\n");
  }

  void set_work(Work* work) {
    const std::lock_guard lock(mutex_);
    work_ = work;
    if (!work) erase();
  }

 private:
  void run() {
    std::unique_lock lock(mutex_);
    for (int tick = 0; !is_over_; ++tick) {
      wake_.wait_for(lock, TICK);
      if (!work_) continue;
      if (signal_caught != 0) {
        msq_job_cancel(work_->job());
      } else if (is_terminal_ && !is_quiet_ && tick % TICKS_A_LINE == 0 &&
                 std::chrono::steady_clock::now() - work_->start_ > PATIENCE) {
        print("\r" + work_->line() + "\033[K");
        is_drawn_ = true;
      }
    }
    erase();
  }

  void erase() {
    if (is_drawn_) print("\r\033[K");
    is_drawn_ = false;
  }

  std::mutex mutex_;
  std::condition_variable wake_;
  std::thread thread_;
  Work* work_ = nullptr;
  bool is_over_ = false, is_drawn_ = false, is_terminal_ = false;
  std::atomic<bool> is_quiet_{false};
};

namespace {

Watcher& watcher() {
  static Watcher the_one;
  return the_one;
}

}  // namespace

void start_watch() {
  struct sigaction action = {};
  action.sa_handler = on_signal;  // without SA_RESTART: a read that waits ends with EINTR
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction now = {};
    // What is ignored from outside, as by nohup, stays ignored.
    if (sigaction(number, nullptr, &now) == 0 && now.sa_handler != SIG_IGN) {
      sigaction(number, &action, nullptr);
    }
  }
  // A closed pipe and a file that grows past its limit become errors of write().
  action.sa_handler = SIG_IGN;
  sigaction(SIGPIPE, &action, nullptr);
  sigaction(SIGXFSZ, &action, nullptr);
  watcher().start();
}

void be_quiet() {
  watcher().be_quiet();
}
void stop_watch() {
  watcher().stop();
}
int caught_signal() {
  return signal_caught;
}

void heed_signals() {
  if (signal_caught != 0) throw Interrupted();
}

int open_file(const std::string& path, int flags) {
  while (true) {
    const int file = open(path.c_str(), flags);
    if (file >= 0 || errno != EINTR) return file;
    heed_signals();
  }
}

void say(const std::string& text) {
  watcher().say(text);
}

void warn(const std::string& text) {
  if (!watcher().is_quiet()) watcher().say("warning: " + text);
}

Work::Work(std::string doing, std::string unit)
    : doing_(std::move(doing)), unit_(std::move(unit)), start_(std::chrono::steady_clock::now()) {
  check(msq_job_create(job_.out()));
  watcher().set_work(this);
}

Work::~Work() {
  watcher().set_work(nullptr);
}

void Work::done(uint64_t count) {
  done_ = count;
  heed_signals();
}

// "slicing  34 %  1204 layers/s  0:12 left"
std::string Work::line() const {
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  double share = share_;
  if (share < 0) msq_job_progress(job(), &share);
  share = std::fmin(std::fmax(share, 0), 1);
  std::string text = doing_ + "  " + std::to_string(static_cast<int>(100 * share)) + " %";
  if (!unit_.empty()) {
    const double rate = static_cast<double>(done_.load()) / seconds;
    text += "  " + rounded(rate, rate < 1000 ? 3 : static_cast<int>(std::log10(rate)) + 1) + " " +
            unit_ + "/s";
  }
  if (share > 0.005) {
    const auto left = static_cast<uint64_t>(std::fmin(seconds * (1 - share) / share + 0.5, 1e9));
    const uint64_t minutes = left / 60 % 60, rest = left % 60;
    text += "  ";
    if (left >= 3600) text += std::to_string(left / 3600) + ":" + (minutes < 10 ? "0" : "");
    text += std::to_string(minutes) + ":" + (rest < 10 ? "0" : "") + std::to_string(rest) + " left";
  }
  return text;
}

}  // namespace command
