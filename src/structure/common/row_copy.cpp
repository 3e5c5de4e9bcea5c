// SPDX-License-Identifier: Apache-2.0
#include "structure/common/row_copy.h"

namespace msq {

RowCopy::RowCopy(const RowBlock& original) : block_(original) {
  words_->resize(original.row_words() * original.rows() * original.layers());
  block_.words = words_->data();
  block_.row_stride = block_.row_words();
  block_.layer_stride = block_.row_stride * block_.rows();
  for_each_word(original, block_, [](uint64_t from, uint64_t& to) { to = from; });
}

}  // namespace msq
