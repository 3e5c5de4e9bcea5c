// SPDX-License-Identifier: Apache-2.0
// The file system that Assimp sees: one file, in memory. No other path exists, so no file can make
// Assimp open another one.
#pragma once

#include <assimp/IOSystem.hpp>
#include <string>
#include <string_view>

namespace msq {

class MemoryIoSystem final : public Assimp::IOSystem {
 public:
  /// The content must outlive this.
  MemoryIoSystem(std::string name, std::string_view content)
      : name_(std::move(name)), content_(content) {}

  bool Exists(const char* path) const override;
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* path, const char* mode) override;
  void Close(Assimp::IOStream* stream) override;
  bool ComparePaths(const char* one, const char* second) const override;

  // The base class's versions access the disk.
  bool CreateDirectory(const std::string&) override { return false; }
  bool ChangeDirectory(const std::string&) override { return false; }
  bool DeleteFile(const std::string&) override { return false; }

 private:
  std::string name_;
  std::string_view content_;
};

}  // namespace msq
