// SPDX-License-Identifier: Apache-2.0
// Points from CSV and NPY files, some at a time.
#ifndef MSQ_COMMAND_POINT_READER_H
#define MSQ_COMMAND_POINT_READER_H

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace command {

class PointReader {
 public:
  virtual ~PointReader() = default;
  // Replaces points by the next ones, at most `most` triples. None at the end.
  virtual void next(std::vector<double>& points, size_t most) = 0;
  // Share of the file that was read, 0 to 1; negative: unknown.
  virtual double share() const = 0;
};

// By the ending of the name: .csv or .npy; "-" is CSV from standard input.
std::unique_ptr<PointReader> open_points(const std::string& path);

}  // namespace command

#endif
