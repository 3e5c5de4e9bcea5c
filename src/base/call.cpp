// SPDX-License-Identifier: Apache-2.0
#include "base/call.h"

#include <exception>
#include <utility>

#include "base/status.h"

namespace msq {

namespace {

/// The state of the call that a thread works for.
struct ThreadCall {
  FloatState* host = nullptr;  // null outside of calls, and in callbacks
  const Job* job = nullptr;
};
constinit thread_local ThreadCall thread_call;

}  // namespace

const Job* current_job() noexcept {
  return thread_call.job;
}

CallScope::CallScope() noexcept : host_(FloatState::read()) {
  ThreadCall& call = thread_call;
  outer_host_ = std::exchange(call.host, &host_);
  outer_job_ = call.job;
  if (!outer_host_) call.job = nullptr;
  host_.enter_own();
}

CallScope::~CallScope() {
  ThreadCall& call = thread_call;
  call.host = outer_host_;
  call.job = outer_job_;
  host_.restore();
}

CurrentJob::CurrentJob(const Job* job) noexcept : outer_(std::exchange(thread_call.job, job)) {}

CurrentJob::~CurrentJob() {
  thread_call.job = outer_;
}

CallState::CallState() noexcept
    : host_(thread_call.host ? *thread_call.host : FloatState::read()),
      identity_(thread_call.host),
      job_(thread_call.job) {}

TaskScope::TaskScope(const CallState& state) noexcept
    : thread_(FloatState::read()), host_(state.host_) {
  ThreadCall& call = thread_call;
  outer_host_ = call.host;
  outer_job_ = std::exchange(call.job, state.job_);
  // On the thread that made the call, callbacks continue from the state that the last one left.
  if (!outer_host_ || outer_host_ != state.identity_) call.host = &host_;
  thread_.enter_own();
}

TaskScope::~TaskScope() {
  ThreadCall& call = thread_call;
  call.host = outer_host_;
  call.job = outer_job_;
  thread_.restore();
}

HostScope::HostScope() noexcept : host_(std::exchange(thread_call.host, nullptr)) {
  if (host_) host_->restore();
}

HostScope::~HostScope() {
  if (!host_) return;
  *host_ = FloatState::read();
  host_->enter_own();
  thread_call.host = host_;
}

void fail_thrown_by_host() {
  try {
    throw;
  } catch (const std::exception& error) {
    fail(Status::host, "an exception left a callback of the host: %s", error.what());
  } catch (...) {
    fail(Status::host, "an exception left a callback of the host");
  }
}

}  // namespace msq
