// SPDX-License-Identifier: Apache-2.0
// A file that appears under its name when it is whole, or not at all.
#ifndef MSQ_COMMAND_OUTPUT_FILE_H
#define MSQ_COMMAND_OUTPUT_FILE_H

#include <cstdint>
#include <string>
#include <string_view>

namespace command {

// Bytes go to a temporary file beside the final one, which commit() renames. Without commit() the
// temporary file is removed. "-" is standard output. What is no regular file, such as a pipe or
// /dev/null, is written in place.
class OutputFile {
 public:
  explicit OutputFile(const std::string& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(const void* bytes, size_t count);
  void write(std::string_view text) { write(text.data(), text.size()); }
  // Writes at a place from the start of the file; not to standard output, nor to pipes. Writes at
  // the end go on where they were.
  void write_at(uint64_t offset, const void* bytes, size_t count);
  void commit();

 private:
  void flush();
  [[noreturn]] void fail(int code) const;

  std::string path_;   // as the user gave it
  std::string final_;  // what the temporary file becomes; "": written in place
  std::string temporary_;
  std::string buffer_;
  int file_ = -1;
};

}  // namespace command

#endif
