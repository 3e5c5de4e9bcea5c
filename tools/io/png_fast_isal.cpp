// SPDX-License-Identifier: Apache-2.0
// PNG streams of layers. Rows are stored less the row above (filter Up), so what does not change
// from row to row is zero. Each block of rows becomes runs of zeros, matches at distance 1, and
// single bytes, with Huffman codes of its own. Codes and checksums are those of ISA-L,
// https://github.com/intel/isa-l. Layers of a foam take half the time of ISA-L's own compressor,
// which looks for all matches, and are smaller (docs/benchmarks.md). Source: P. Deutsch, "DEFLATE
// Compressed Data Format Specification", RFC 1951; W3C, "PNG", third edition, section 9.2.
#include <isa-l/crc.h>
#include <isa-l/igzip_lib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <memory>

#include "png_stream.h"

namespace msq_io {

namespace {

/// Of rows: what a block of codes is made for.
constexpr size_t block_bytes = size_t{1} << 20;
/// Runs of zeros with a code in the table. A match repeats 258 bytes at most, after one that stands
/// by itself.
constexpr uint32_t max_match = 258, max_short_run = max_match + 1;
/// A token is a run of zeros and the byte that ends it: in its high 24 bits and low 8 bits.
constexpr uint32_t max_run = 0xffffff;

struct Code {
  uint64_t bits;
  uint32_t count;
};

/// What one layer needs beside its stream.
struct Scratch {
  isal_huff_histogram histogram;
  isal_hufftables codes;
  std::array<uint32_t, max_short_run + 1> runs;
  std::array<uint32_t, 256> bytes;
  /// Matches of 258 bytes, and zeros by themselves, of runs that are longer.
  uint64_t long_matches, single_zeros;
  std::array<Code, max_short_run + 1> run_codes;
  std::array<Code, 256> byte_codes;
};

/// The symbol of the length of a match, from 3 on.
uint32_t symbol_of_length(uint32_t length) {
  if (length == max_match) return 285;
  if (length < 11) return 254 + length;
  const uint32_t from = length - 3, extra = static_cast<uint32_t>(std::bit_width(from)) - 3;
  return 257 + 4 * extra + (from >> extra);
}

/// Tokens of a block.
class Tokens {
 public:
  void clear() { count_ = 0, run_ = 0; }
  /// A row of differences, with zeros behind it up to a multiple of 8 bytes.
  void add_row(const uint8_t* row, size_t size) {
    make_room(size);
    size_t begin = 0;  // of the zeros
    for (size_t at = 0; at < size; at += 8) {
      uint64_t word;
      std::memcpy(&word, row + at, 8);
      constexpr uint64_t low = 0x7f7f7f7f7f7f7f7f;
      // The highest bit of each byte that is not zero.
      for (uint64_t some = (((word & low) + low) | word) & ~low; some; some &= some - 1) {
        const size_t place = at + static_cast<size_t>(std::countr_zero(some)) / 8;
        put(static_cast<uint32_t>(place - begin), row[place]);
        begin = place + 1;
      }
    }
    run_ += static_cast<uint32_t>(size - begin);
  }
  const uint32_t* begin() const { return tokens_.get(); }
  const uint32_t* end() const { return tokens_.get() + count_; }
  /// Zeros at the end.
  uint32_t tail() const { return run_; }

 private:
  void put(uint32_t zeros, uint8_t byte) {
    tokens_[count_++] = (run_ + zeros) << 8 | byte;
    run_ = 0;
  }
  void make_room(size_t size) {
    if (count_ + size <= room_) return;
    const size_t room = std::max(count_ + size, 2 * room_);
    auto more = std::make_unique_for_overwrite<uint32_t[]>(room);
    std::copy(begin(), end(), more.get());
    tokens_ = std::move(more);
    room_ = room;
  }

  std::unique_ptr<uint32_t[]> tokens_;
  size_t count_ = 0, room_ = 0;
  uint32_t run_ = 0;
};

void count_run(uint32_t run, Scratch& scratch) {
  if (run <= max_short_run) {
    ++scratch.runs[run];
    return;
  }
  const uint32_t rest = (run - 1) % max_match;
  scratch.long_matches += (run - 1) / max_match;
  ++scratch.single_zeros;
  // What the last match leaves is a run that needs no zero before it.
  if (rest < 3) {
    scratch.single_zeros += rest;
  } else {
    ++scratch.histogram.lit_len_histogram[symbol_of_length(rest)];
  }
}

/// Counts what the tokens of a block will be written as, and makes the codes.
void make_codes(const Tokens& tokens, Scratch& scratch) {
  isal_huff_histogram& histogram = scratch.histogram;
  std::fill(std::begin(histogram.lit_len_histogram), std::end(histogram.lit_len_histogram), 0);
  std::fill(std::begin(histogram.dist_histogram), std::end(histogram.dist_histogram), 0);
  scratch.runs.fill(0);
  scratch.bytes.fill(0);
  scratch.long_matches = scratch.single_zeros = 0;
  for (const uint32_t token : tokens) {
    count_run(token >> 8, scratch);
    ++scratch.bytes[token & 0xff];
  }
  count_run(tokens.tail(), scratch);
  uint64_t* symbols = histogram.lit_len_histogram;
  for (size_t i = 1; i < 256; ++i) symbols[i] = scratch.bytes[i];
  symbols[256] = 1;  // the end
  symbols[285] += scratch.long_matches;
  uint64_t zeros = scratch.bytes[0] + scratch.single_zeros;
  for (uint32_t run = 1; run <= max_short_run; ++run) {
    zeros += scratch.runs[run] * uint64_t{run < 4 ? run : 1};
    if (run >= 4) symbols[symbol_of_length(run - 1)] += scratch.runs[run];
  }
  symbols[0] = zeros;
  for (size_t i = 257; i < 286; ++i) histogram.dist_histogram[0] += symbols[i];

  isal_hufftables& codes = scratch.codes;
  if (isal_create_hufftables(&codes, &histogram) != 0) fail(MSQ_E_INTERNAL, "ISA-L makes no codes");
  for (size_t i = 0; i < 256; ++i)
    scratch.byte_codes[i] = {codes.lit_table[i], codes.lit_table_sizes[i]};
  const auto behind = [](Code a, Code b) {
    return Code{a.bits | b.bits << a.count, a.count + b.count};
  };
  const Code zero = scratch.byte_codes[0];
  scratch.run_codes[0] = {0, 0};
  for (uint32_t run = 1; run < 4; ++run)
    scratch.run_codes[run] = behind(zero, scratch.run_codes[run - 1]);
  const auto entry = [](uint32_t code) { return Code{code >> 5, code & 31}; };
  const Code distance = entry(codes.dist_table[0]);
  for (uint32_t run = 4; run <= max_short_run; ++run)
    scratch.run_codes[run] = behind(zero, behind(entry(codes.len_table[run - 4]), distance));
}

/// Bits that the tokens take at most, with the header and the end.
uint64_t bits_of(const Scratch& scratch) {
  uint64_t bits = 8 * uint64_t{ISAL_DEF_MAX_HDR_SIZE} + 64;
  for (size_t i = 0; i < 256; ++i) bits += uint64_t{scratch.bytes[i]} * scratch.byte_codes[i].count;
  for (size_t i = 0; i <= max_short_run; ++i)
    bits += uint64_t{scratch.runs[i]} * scratch.run_codes[i].count;
  // Long runs: no match has more bits than that of 258, or 15 + 5 + 15.
  return bits + 35 * (2 * scratch.long_matches) + 15 * scratch.single_zeros;
}

/// Appends bits to a stream, the lowest first.
class BitWriter {
 public:
  explicit BitWriter(std::vector<uint8_t>& stream) : stream_(stream) {}

  /// Room for so many bits, from here on.
  void make_room(uint64_t bits) {
    size_ = at_ ? size() : stream_.size();
    stream_.resize(size_ + static_cast<size_t>(bits / 8) + 16);
    at_ = stream_.data() + size_;
  }
  /// At most 56 bits.
  void put(Code code) {
    word_ |= code.bits << filled_;
    filled_ += code.count;
    std::memcpy(at_, &word_, 8);
    at_ += filled_ / 8;
    word_ >>= filled_ & ~7u;
    filled_ &= 7;
  }
  /// Fills the last byte, and cuts the stream behind it.
  void end() {
    if (filled_ > 0) ++at_;
    stream_.resize(size());
  }

 private:
  size_t size() const { return static_cast<size_t>(at_ - stream_.data()); }

  std::vector<uint8_t>& stream_;
  uint8_t* at_ = nullptr;
  size_t size_ = 0;
  uint64_t word_ = 0;
  uint32_t filled_ = 0;
};

void write_run(uint32_t run, const Scratch& scratch, BitWriter& out) {
  if (run <= max_short_run) [[likely]] {
    out.put(scratch.run_codes[run]);
    return;
  }
  const Code zero = scratch.byte_codes[0];
  const auto match = [&](uint32_t length) {  // without the zero before it
    const Code code = scratch.run_codes[length + 1];
    out.put({code.bits >> zero.count, code.count - zero.count});
  };
  out.put(zero);
  uint32_t left = run - 1;
  for (; left >= max_match; left -= max_match) match(max_match);
  if (left >= 3) {
    match(left);
  } else {
    for (; left > 0; --left) out.put(zero);
  }
}

void write_block(const Tokens& tokens, bool is_last, Scratch& scratch, BitWriter& out) {
  make_codes(tokens, scratch);
  out.make_room(bits_of(scratch));
  const isal_hufftables& codes = scratch.codes;
  // The header of ISA-L is that of a last block.
  for (uint32_t i = 0; i < codes.deflate_hdr_count; ++i)
    out.put({codes.deflate_hdr[i] & (i == 0 && !is_last ? 0xfeu : 0xffu), 8});
  const uint32_t extra = codes.deflate_hdr_extra_bits;
  if (extra > 0) out.put({codes.deflate_hdr[codes.deflate_hdr_count] & ((1u << extra) - 1), extra});
  for (const uint32_t token : tokens) {
    write_run(token >> 8, scratch, out);
    out.put(scratch.byte_codes[token & 0xff]);
  }
  write_run(tokens.tail(), scratch, out);
  out.put({codes.lit_table[256], codes.lit_table_sizes[256]});
}

/// A row less the one above it, with its filter, and zeros up to a multiple of 8 bytes.
void filter_row(const uint8_t* above, const uint8_t* row, size_t size, uint8_t* to) {
  constexpr uint8_t up = 2;
  to[0] = up;
  for (size_t i = 1; i < size; ++i) to[i] = static_cast<uint8_t>(row[i] - above[i]);
}

}  // namespace

bool encode_fast(const PngRows& image, const std::vector<uint8_t>& rows,
                 std::vector<uint8_t>& stream) {
  if constexpr (std::endian::native != std::endian::little) return false;
  const size_t size = image.row_bytes();
  // Runs of a block do not reach beyond it, and fit into a token.
  static_assert(block_bytes < max_run);
  const uint32_t block_rows = static_cast<uint32_t>(std::max<size_t>(block_bytes / size, 1));
  if (size >= max_run) return false;
  const auto scratch = std::make_unique_for_overwrite<Scratch>();
  std::vector<uint8_t> row((size + 7) / 8 * 8), none(size);
  Tokens tokens;
  const size_t chunk = begin_png(image, stream);
  stream.insert(stream.end(), {0x78, 0x01});
  BitWriter out(stream);
  uint32_t adler = 1;
  for (uint32_t y = 0; y < image.height; ++y) {
    const uint8_t* own = rows.data() + y * size;
    filter_row(y > 0 ? own - size : none.data(), own, size, row.data());
    adler = isal_adler32(adler, row.data(), size);
    tokens.add_row(row.data(), size);
    const bool is_last = y + 1 == image.height;
    if (!is_last && (y + 1) % block_rows != 0) continue;
    write_block(tokens, is_last, *scratch, out);
    tokens.clear();
  }
  out.end();
  for (int shift = 24; shift >= 0; shift -= 8)
    stream.push_back(static_cast<uint8_t>(adler >> shift));
  end_png(chunk, crc32_gzip_refl, stream);
  return true;
}

}  // namespace msq_io
