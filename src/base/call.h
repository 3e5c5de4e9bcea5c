// SPDX-License-Identifier: Apache-2.0
// The call of the host that a thread works for. Every part of a call may need the host's
// floating-point state, in which its callbacks run, and the job, which long loops poll. Both are
// found through the thread; they are not passed as arguments.
//
//   CallScope   is opened by each entry of the C ABI
//   CurrentJob  is opened at the start of a call under a job
//   TaskScope   is opened on another thread that does part of the call's work
//   HostScope   is open while a callback of the host runs
//
// Compilers do not know that arithmetic depends on the floating-point state, and may move it past a
// change of that state. So work in a CallScope or HostScope stands behind a call that is not
// inlined.
#pragma once

#include <type_traits>

#include "base/attributes.h"
#include "base/float_state.h"

namespace msq {

class Job;

/// The job of the call that the calling thread works for, or null.
const Job* current_job() noexcept;

/// A call of the C ABI. It computes in msq's floating-point state and restores the host's at the
/// end. It has no job at first, also within a callback of a call that has one. A call that msq
/// makes itself, from within another one, goes on with the other one's.
class CallScope {
 public:
  CallScope() noexcept;
  ~CallScope();
  CallScope(const CallScope&) = delete;
  CallScope& operator=(const CallScope&) = delete;

 private:
  FloatState host_;  // as the last callback left it
  // Of the outer call of this thread.
  FloatState* outer_host_;
  const Job* outer_job_;
};

/// Makes a job the job of the call. The job may be null and must outlive this.
class CurrentJob {
 public:
  explicit CurrentJob(const Job* job) noexcept;
  ~CurrentJob();
  CurrentJob(const CurrentJob&) = delete;
  CurrentJob& operator=(const CurrentJob&) = delete;

 private:
  const Job* outer_;
};

/// The call that the calling thread works for, to carry to other threads while it lasts.
class CallState {
 public:
  CallState() noexcept;

 private:
  friend class TaskScope;
  FloatState host_;
  const FloatState* identity_;
  const Job* job_;
};

/// Part of a call on a thread that may do work of other calls before and after.
class TaskScope {
 public:
  explicit TaskScope(const CallState& call) noexcept;
  ~TaskScope();
  TaskScope(const TaskScope&) = delete;
  TaskScope& operator=(const TaskScope&) = delete;

 private:
  FloatState thread_, host_;
  FloatState* outer_host_;
  const Job* outer_job_;
};

/// A callback of the host: sets the host's floating-point state until its end. Changes that the
/// callback makes stay the host's state from then on; on threads other than the call's own, until
/// the task ends. Outside of calls it does nothing.
class HostScope {
 public:
  HostScope() noexcept;
  ~HostScope();
  HostScope(const HostScope&) = delete;
  HostScope& operator=(const HostScope&) = delete;

 private:
  FloatState* host_;
};

/// In a handler: throws Error(host) for the exception that left a callback in spite of the rules.
[[noreturn]] void fail_thrown_by_host();

/// Calls a function of the host. What functions without a result throw is dropped: nobody can be
/// told.
template <class Function, class... Arguments>
MSQ_NOINLINE auto call_host(Function* function, Arguments... arguments) {
  const HostScope scope;
  try {
    return function(arguments...);
  } catch (...) {
    if constexpr (!std::is_void_v<decltype(function(arguments...))>) fail_thrown_by_host();
  }
}

}  // namespace msq
