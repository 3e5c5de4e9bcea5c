// SPDX-License-Identifier: Apache-2.0
#include "layer_folder.h"

#include "names.h"

namespace msq_io {

LayerFolder::LayerFolder(const WriterPlan& plan, const std::filesystem::path& path,
                         std::string prefix, uint32_t digits, const char* extension)
    : plan_(plan),
      prefix_(std::move(prefix)),
      digits_(digits),
      extension_(extension),
      folder_(path, plan.replace) {
  for (uint64_t i = 0; i < plan_.layer_count; ++i) folder_.check_free(name_of(i));
}

std::string LayerFolder::name_of(uint64_t number) const {
  return numbered_name(prefix_, plan_.first_layer + number, digits_, extension_);
}

void LayerFolder::write(uint64_t number, const void* bytes, size_t size) {
  folder_.write(name_of(number), bytes, size);
  bytes_ += size;
}

void LayerFolder::commit() {
  std::vector<std::string> names;
  for (uint64_t i = 0; i < plan_.layer_count; ++i) names.push_back(name_of(i));
  folder_.commit(names);
}

}  // namespace msq_io
