// SPDX-License-Identifier: Apache-2.0
// Signals, progress and what is said on standard error.
#ifndef MSQ_COMMAND_WATCH_H
#define MSQ_COMMAND_WATCH_H

#include <msq.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>

#include "failure.h"

namespace command {

// Begins to catch signals, and starts the thread that heeds them and draws progress. The first
// signal cancels the work; a second one ends the command at once, which may leave a temporary file.
void start_watch();

// After this, neither warnings nor progress are shown.
void be_quiet();

// Ends the thread and erases what it has drawn.
void stop_watch();

// The signal that asked the command to end; 0: none.
int caught_signal();

// Throws Interrupted if there is one.
void heed_signals();

// Opens a file, with flags as of open(2). A signal ends the wait for the other end of a FIFO:
// throws Interrupted. Returns -1, with errno, if the file does not open.
int open_file(const std::string& path, int flags);

// Prints "msq: text" as a line of its own on standard error.
void say(const std::string& text);

// Prints "msq: warning: text", unless be_quiet() was called.
void warn(const std::string& text);

// One long call, or several under one heading. On a terminal its progress is shown, with the rate
// and the time left. A signal cancels job(). One at a time.
class Work {
 public:
  // doing: "slicing". unit: of what done() counts, "layers"; "": nothing is counted.
  explicit Work(std::string doing, std::string unit = "");
  ~Work();
  Work(const Work&) = delete;
  Work& operator=(const Work&) = delete;

  msq_job* job() const { return job_.get(); }
  // How many units are done. Throws Interrupted if a signal requests it.
  void done(uint64_t count);
  // Share that is done, 0 to 1, where the job does not know it.
  void set_share(double share) { share_ = share; }

 private:
  friend class Watcher;
  std::string line() const;

  Handle<msq_job, msq_job_release> job_;
  const std::string doing_, unit_;
  const std::chrono::steady_clock::time_point start_;
  std::atomic<uint64_t> done_{0};
  std::atomic<double> share_{-1};
};

}  // namespace command

#endif
