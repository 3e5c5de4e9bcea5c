// SPDX-License-Identifier: Apache-2.0
// 3MF files whose only part is a given text, not compressed.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace msq::fuzz {

class ZipWriter {
 public:
  /// The archive.
  static std::string of(std::string_view name, std::string_view content) {
    ZipWriter writer;
    uint32_t crc = ~0u;
    for (const char c : content) {
      crc ^= static_cast<unsigned char>(c);
      for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0);
    }
    const auto header = [&] {
      writer.put(20, 2);
      writer.put(0, 4);  // flags, method
      writer.put(0, 4);  // time, date
      writer.put(~crc, 4);
      writer.put(content.size(), 4);
      writer.put(content.size(), 4);
      writer.put(name.size(), 2);
      writer.put(0, 2);
    };
    writer.bytes_ += "PK\3\4";
    header();
    writer.bytes_ += name;
    writer.bytes_ += content;
    const size_t directory = writer.bytes_.size();
    writer.bytes_ += "PK\1\2";
    writer.put(20, 2);
    header();
    writer.put(0, 4);
    writer.put(0, 2);
    writer.put(0, 4);
    writer.put(0, 4);
    writer.bytes_ += name;
    const size_t length = writer.bytes_.size() - directory;
    writer.bytes_ += "PK\5\6";
    writer.put(0, 4);
    writer.put(1, 2);
    writer.put(1, 2);
    writer.put(length, 4);
    writer.put(directory, 4);
    writer.put(0, 2);
    return writer.bytes_;
  }

 private:
  void put(uint64_t number, int bytes) {
    for (int i = 0; i < bytes; ++i) bytes_ += static_cast<char>(number >> (8 * i) & 255);
  }
  std::string bytes_;
};

}  // namespace msq::fuzz
