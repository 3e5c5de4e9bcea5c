// SPDX-License-Identifier: Apache-2.0
// A folder with a file per layer, which the threads that encode write.
#pragma once

#include <atomic>

#include "atomic_folder.h"
#include "writer.h"

namespace msq_io {

class LayerFolder : public Format {
 public:
  /// Fails if a file that will be written exists and must not be replaced.
  LayerFolder(const WriterPlan& plan, const std::filesystem::path& path, std::string prefix,
              uint32_t digits, const char* extension);

  void deliver(Packet&) override {}
  void commit() override;
  uint64_t bytes() const override { return bytes_; }

 protected:
  /// Writes the file of a layer.
  void write(uint64_t number, const void* bytes, size_t size);

 private:
  std::string name_of(uint64_t number) const;

  const WriterPlan plan_;
  const std::string prefix_;
  const uint32_t digits_;
  const char* const extension_;
  AtomicFolder folder_;
  std::atomic<uint64_t> bytes_{0};
};

}  // namespace msq_io
