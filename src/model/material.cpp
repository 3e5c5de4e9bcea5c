// SPDX-License-Identifier: Apache-2.0
#include "model/material.h"

namespace msq {

std::optional<size_t> Material::find(std::string_view name) const {
  for (size_t i = 0; i < channels_.size(); ++i)
    if (channels_[i] == name) return i;
  return std::nullopt;
}

bool PlainMaterial::is_concurrent() const {
  for (const Parameter& p : parameters_)
    if (!p.is_concurrent()) return false;
  return true;
}

MaterialBlend::MaterialBlend(uint32_t id, Ref<const Material> a, Ref<const Material> b,
                             Parameter fraction)
    : Material(id, a->channels()),
      a_(std::move(a)),
      b_(std::move(b)),
      fraction_(std::move(fraction)),
      is_concurrent_(fraction_.is_concurrent() && a_->is_concurrent() && b_->is_concurrent()),
      depth_(1 + std::max(a_->depth(), b_->depth())),
      terms_(a_->terms() + b_->terms()) {}

void MaterialBlend::values(size_t channel, const Vec3* points, size_t count, double* values) const {
  std::vector<double> of_b(count), fraction(count);
  a_->values(channel, points, count, values);
  b_->values(*b_->find(channels()[channel]), points, count, of_b.data());
  fraction_.values(points, count, fraction.data());
  for (size_t i = 0; i < count; ++i)
    values[i] = (1 - fraction[i]) * values[i] + fraction[i] * of_b[i];
}

void Material::describe_channels(HashInput& input) const {
  input.integer(id_);
  input.integer(channels_.size());
  for (const std::string& channel : channels_) input.text(channel);
}

void PlainMaterial::describe(HashInput& input) const {
  input.kind("material");
  describe_channels(input);
  for (const Parameter& parameter : parameters_) parameter.describe(input);
}

void MaterialBlend::describe(HashInput& input) const {
  input.kind("material: blend");
  describe_channels(input);
  input.object(*a_);
  input.object(*b_);
  fraction_.describe(input);
}

}  // namespace msq
