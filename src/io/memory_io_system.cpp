// SPDX-License-Identifier: Apache-2.0
#include "io/memory_io_system.h"

#include <algorithm>
#include <assimp/IOStream.hpp>
#include <cstring>

namespace msq {
namespace {

class MemoryStream final : public Assimp::IOStream {
 public:
  explicit MemoryStream(std::string_view content) : content_(content) {}

  size_t Read(void* buffer, size_t size, size_t count) override {
    if (!size) return 0;
    const size_t items = std::min(count, (content_.size() - position_) / size);
    if (items) std::memcpy(buffer, content_.data() + position_, items * size);
    // Like fread, but only whole items: Assimp reads bytes, or a block that may be truncated.
    position_ += items * size;
    return items;
  }
  size_t Write(const void*, size_t, size_t) override { return 0; }
  aiReturn Seek(size_t offset, aiOrigin origin) override {
    const size_t base = origin == aiOrigin_SET   ? 0
                        : origin == aiOrigin_CUR ? position_
                                                 : content_.size();
    const size_t target = origin == aiOrigin_END ? base - offset : base + offset;
    if (target > content_.size()) return aiReturn_FAILURE;
    position_ = target;
    return aiReturn_SUCCESS;
  }
  size_t Tell() const override { return position_; }
  size_t FileSize() const override { return content_.size(); }
  void Flush() override {}

 private:
  std::string_view content_;
  size_t position_ = 0;
};

}  // namespace

bool MemoryIoSystem::Exists(const char* path) const {
  return path && name_ == path;
}

Assimp::IOStream* MemoryIoSystem::Open(const char* path, const char* mode) {
  const bool reads = !mode || !std::strpbrk(mode, "wa+");
  return reads && Exists(path) ? new MemoryStream(content_) : nullptr;
}

void MemoryIoSystem::Close(Assimp::IOStream* stream) {
  delete stream;
}

bool MemoryIoSystem::ComparePaths(const char* one, const char* second) const {
  return std::strcmp(one, second) == 0;
}

}  // namespace msq
