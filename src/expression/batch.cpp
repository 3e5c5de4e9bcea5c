// SPDX-License-Identifier: Apache-2.0
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "expression/batch.cpp"
#include <algorithm>

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "expression/batch.h"
#include "expression/elementary-inl.h"
#include "expression/load-inl.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

template <Op op, bool a_uniform, bool b_uniform, class T>
HWY_INLINE void all_lanes(const T* a, const T* b, T* to, size_t count) {
  const hn::ScalableTag<T> d;
  const Lanes<hn::ScalableTag<T>> lanes;
  for (size_t i = 0; i < count; i += hn::Lanes(d))
    hn::StoreU(result<op>(lanes, load<a_uniform>(d, a, i), load<b_uniform>(d, b, i)), d, to + i);
}

template <class T>
HWY_INLINE void run(const Program& program, const ValuesOf<T>* registers, T* const* to,
                    size_t count) {
  for (const Program::Instruction& instruction : program.code) {
    const ValuesOf<T> a = registers[instruction.a], b = registers[instruction.b];
    T* out = to[instruction.to];
    with_op(instruction.op, [&](auto which) HWY_ATTR {
      constexpr Op op = decltype(which)::value;
      if constexpr (!std::is_same_v<T, double> && !is_rational(op)) {
        return;  // does not occur in such programs
      } else if constexpr (has_one_operand(op)) {
        if (a.is_uniform)
          all_lanes<op, true, true>(a.data, a.data, out, count);
        else
          all_lanes<op, false, false>(a.data, a.data, out, count);
      } else if (a.is_uniform) {
        if (b.is_uniform)
          all_lanes<op, true, true>(a.data, b.data, out, count);
        else
          all_lanes<op, true, false>(a.data, b.data, out, count);
      } else if (b.is_uniform) {
        all_lanes<op, false, true>(a.data, b.data, out, count);
      } else {
        all_lanes<op, false, false>(a.data, b.data, out, count);
      }
    });
  }
}

void run_doubles(const Program& program, const Values* registers, double* const* to, size_t count) {
  run(program, registers, to, count);
}

void run_singles(const Program& program, const ValuesOf<float>* registers, float* const* to,
                 size_t count) {
  run(program, registers, to, count);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

HWY_EXPORT(run_doubles);
HWY_EXPORT(run_singles);

template <class T>
constexpr size_t stride = (sizeof(T) == 4 ? single_points : batch_points) + batch_padding;

template <class T>
BatchOf<T>::BatchOf(const Program& program)
    : program_(program),
      constants_(program.constants.begin(), program.constants.end()),
      temporaries_(allocate_aligned<T>(program.temporaries * stride<T>)),
      registers_(program.registers()),
      targets_(program.registers()) {
  std::fill_n(temporaries_.get(), program.temporaries * stride<T>, T{0});
  for (size_t i = 0; i < constants_.size(); ++i)
    registers_[program.inputs + i] = {&constants_[i], true};
  const size_t first = program.inputs + constants_.size();
  for (size_t i = 0; i < program.temporaries; ++i) {
    targets_[first + i] = temporaries_.get() + i * stride<T>;
    registers_[first + i] = {targets_[first + i], false};
  }
}

template <>
void BatchOf<double>::run(size_t count) {
  HWY_DYNAMIC_DISPATCH(run_doubles)(program_, registers_.data(), targets_.data(), count);
}

template <>
void BatchOf<float>::run(size_t count) {
  HWY_DYNAMIC_DISPATCH(run_singles)(program_, registers_.data(), targets_.data(), count);
}

template class BatchOf<double>;
template class BatchOf<float>;

}  // namespace msq
#endif  // HWY_ONCE
