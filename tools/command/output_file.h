// SPDX-License-Identifier: Apache-2.0
// A file that appears under its name when it is whole, or not at all.
#ifndef MSQ_COMMAND_OUTPUT_FILE_H
#define MSQ_COMMAND_OUTPUT_FILE_H

#include <msq_io.h>

#include <cstdint>
#include <string>
#include <string_view>

#include "failure.h"

namespace command {

// Throws what a status of msq_io stands for. MSQ_OK: nothing.
void check_io(msq_status status);

// A file of msq_io, which replaces an existing one in commit(). Without commit() nothing is left.
// "-" and /dev/stdout are standard output. It and what is no regular file, such as a pipe or
// /dev/null, are written in place.
class OutputFile {
 public:
  explicit OutputFile(const std::string& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(const void* bytes, size_t count);
  void write(std::string_view text) { write(text.data(), text.size()); }
  // Writes at a place from the start of the file; not to standard output, nor to pipes.
  void write_at(uint64_t offset, const void* bytes, size_t count);
  void commit();

 private:
  void put(const char* bytes, size_t count);
  void flush();
  [[noreturn]] void fail(int code) const;

  std::string path_;  // as the user gave it
  std::string buffer_;
  Handle<msq_io_file, msq_io_file_release> file_;
  int descriptor_ = -1;  // of what is written in place
};

}  // namespace command

#endif
