// SPDX-License-Identifier: Apache-2.0
#include "api/image.h"

#include "api/guard.h"
#include "api/neighbourhood.h"

namespace msq::api {

namespace {

Image::Type read_type(int32_t type) {
  switch (type) {
    case MSQ_UINT8:
      return Image::Type::uint8;
    case MSQ_INT16:
      return Image::Type::int16;
    case MSQ_UINT16:
      return Image::Type::uint16;
    case MSQ_FLOAT32:
      return Image::Type::float32;
    case MSQ_FLOAT64:
      return Image::Type::float64;
    default:
      fail(Status::argument,
           "image.value_type is %d; it must be MSQ_FLOAT32 (%d), MSQ_FLOAT64 (%d), MSQ_UINT8 (%d), "
           "MSQ_INT16 (%d) or MSQ_UINT16 (%d)",
           type, MSQ_FLOAT32, MSQ_FLOAT64, MSQ_UINT8, MSQ_INT16, MSQ_UINT16);
  }
}

/// 0 stands for `packed`.
uint64_t read_stride(uint64_t stride, uint64_t packed, const char* name) {
  if (stride != 0 && stride < packed)
    fail(Status::argument, "%s is %llu bytes; there are %llu", name,
         static_cast<unsigned long long>(stride), static_cast<unsigned long long>(packed));
  return stride ? stride : packed;
}

}  // namespace

msq_image image_defaults() {
  msq_image image{};
  image.grid = neighbourhood_defaults();
  return image;
}

Image read_image(const msq_image& image, uint64_t min_size,
                 const std::shared_ptr<MemoryBudget>& budget) {
  require_reserved(image.reserved, "image.reserved");
  Image::Source source;
  source.type = read_type(image.value_type);
  if (!image.values) fail(Status::argument, "image.values is NULL");
  source.values = image.values;
  for (int axis = 0; axis < 3; ++axis) {
    source.size[axis] = image.size[axis];
    if (image.size[axis] < min_size || image.size[axis] > Image::max_size)
      fail(Status::argument, "image.size[%d] is %llu; it must be from %llu to %llu", axis,
           static_cast<unsigned long long>(image.size[axis]),
           static_cast<unsigned long long>(min_size),
           static_cast<unsigned long long>(Image::max_size));
  }
  source.row_stride = read_stride(image.row_stride, source.size[0] * Image::bytes_of(source.type),
                                  "image.row_stride");
  source.layer_stride = read_stride(
      image.layer_stride, checked_product(source.size[1], source.row_stride, "image.row_stride"),
      "image.layer_stride");
  checked_product(source.size[2], source.layer_stride, "image.layer_stride");
  const Neighbourhood grid = read_neighbourhood(image.grid);
  return Image(source, {grid.origin, grid.cell_size, grid.rotation}, budget);
}

}  // namespace msq::api
