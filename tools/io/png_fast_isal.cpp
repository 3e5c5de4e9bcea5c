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
/// Of rows: what is filtered, summed and made tokens of while it is near the core.
constexpr size_t part_bytes = size_t{1} << 14;
/// Runs of zeros with a code in the table. A match repeats 258 bytes at most, after one that stands
/// by itself.
constexpr uint32_t max_match = 258, max_short_run = max_match + 1;
/// A token is a run of zeros and the byte that ends it: in its high 24 bits and low 8 bits.
constexpr uint32_t max_run = 0xffffff;

/// Bits of a stream, the first one lowest, and their count, in one word.
class Code {
 public:
  Code() = default;
  /// At most 56 bits.
  Code(uint64_t bits, uint32_t count) : word_(bits | uint64_t{count} << 56) {}
  uint64_t bits() const { return word_ & ((uint64_t{1} << 56) - 1); }
  uint32_t count() const { return static_cast<uint32_t>(word_ >> 56); }
  /// The bits of this code and then those of `next`.
  Code then(Code next) const { return {bits() | next.bits() << count(), count() + next.count()}; }

 private:
  uint64_t word_;
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

/// Which bytes are not zero, of 64 of them.
uint64_t some_of(const uint8_t* bytes) {
  uint64_t mask = 0;
  for (size_t i = 0; i < 8; ++i) {
    uint64_t word;
    std::memcpy(&word, bytes + 8 * i, 8);
    constexpr uint64_t low = 0x7f7f7f7f7f7f7f7f;
    // The highest bit of each byte that is not zero; the product brings those bits side by side.
    const uint64_t some = (((word & low) + low) | word) & ~low;
    mask |= (((some >> 7) * 0x0102040810204080) >> 56) << (8 * i);
  }
  return mask;
}

/// Tokens of a block.
class Tokens {
 public:
  void clear() { count_ = 0, run_ = 0; }
  /// Differences, with zeros behind them up to a multiple of 64 bytes.
  void add(const uint8_t* bytes, size_t size) {
    make_room(size);
    uint32_t* next = tokens_.get() + count_;
    uint32_t begin = 0 - run_;  // of the zeros; before the bytes, this wraps around
    for (uint32_t at = 0; at < size; at += 64) {
      for (uint64_t some = some_of(bytes + at); some; some &= some - 1) {
        const uint32_t place = at + static_cast<uint32_t>(std::countr_zero(some));
        *next++ = (place - begin) << 8 | bytes[place];
        begin = place + 1;
      }
    }
    run_ = static_cast<uint32_t>(size) - begin;
    count_ = static_cast<size_t>(next - tokens_.get());
  }
  const uint32_t* begin() const { return tokens_.get(); }
  const uint32_t* end() const { return tokens_.get() + count_; }
  /// Zeros at the end.
  uint32_t tail() const { return run_; }

 private:
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
  const Code zero = scratch.byte_codes[0];
  scratch.run_codes[0] = {0, 0};
  for (uint32_t run = 1; run < 4; ++run)
    scratch.run_codes[run] = zero.then(scratch.run_codes[run - 1]);
  const auto entry = [](uint32_t code) { return Code{code >> 5, code & 31}; };
  const Code distance = entry(codes.dist_table[0]);
  for (uint32_t run = 4; run <= max_short_run; ++run)
    scratch.run_codes[run] = zero.then(entry(codes.len_table[run - 4])).then(distance);
}

/// Bits that the tokens take at most, with the header and the end.
uint64_t bits_of(const Scratch& scratch) {
  uint64_t bits = 8 * uint64_t{ISAL_DEF_MAX_HDR_SIZE} + 64;
  for (size_t i = 0; i < 256; ++i)
    bits += uint64_t{scratch.bytes[i]} * scratch.byte_codes[i].count();
  for (size_t i = 0; i <= max_short_run; ++i)
    bits += uint64_t{scratch.runs[i]} * scratch.run_codes[i].count();
  // Long runs: no match has more bits than that of 258, or 15 + 5 + 15.
  return bits + 35 * (2 * scratch.long_matches) + 15 * scratch.single_zeros;
}

/// Where the next bits go. Loops keep a copy, so that it stays in registers.
struct BitPlace {
  uint8_t* at = nullptr;
  uint64_t word = 0;
  uint32_t filled = 0;

  void put(Code code) {
    word |= code.bits() << filled;
    filled += code.count();
    std::memcpy(at, &word, 8);
    at += filled / 8;
    word >>= filled & ~7u;
    filled &= 7;
  }
};

/// Appends bits to a stream, the lowest first.
class BitWriter {
 public:
  explicit BitWriter(std::vector<uint8_t>& stream) : stream_(stream) {}

  /// Room for so many bits, from here on.
  void make_room(uint64_t bits) {
    const size_t size = place.at ? this->size() : stream_.size();
    stream_.resize(size + static_cast<size_t>(bits / 8) + 16);
    place.at = stream_.data() + size;
  }
  /// Fills the last byte, and cuts the stream behind it.
  void end() {
    if (place.filled > 0) ++place.at;
    stream_.resize(size());
  }

  BitPlace place;

 private:
  size_t size() const { return static_cast<size_t>(place.at - stream_.data()); }

  std::vector<uint8_t>& stream_;
};

/// Begins a run that the table has no code for. Returns what is left of it for the next code.
Code begin_long_run(uint32_t run, const Scratch& scratch, BitPlace& out) {
  const Code zero = scratch.byte_codes[0];
  const auto match = [&](uint32_t length) {  // without the zero before it
    const Code code = scratch.run_codes[length + 1];
    return Code{code.bits() >> zero.count(), code.count() - zero.count()};
  };
  out.put(zero);
  uint32_t left = run - 1;
  for (; left >= max_match; left -= max_match) out.put(match(max_match));
  return left >= 3 ? match(left) : scratch.run_codes[left];
}

void write_block(const Tokens& tokens, bool is_last, Scratch& scratch, BitWriter& out) {
  make_codes(tokens, scratch);
  out.make_room(bits_of(scratch));
  BitPlace place = out.place;
  const isal_hufftables& codes = scratch.codes;
  // The header of ISA-L is that of a last block.
  for (uint32_t i = 0; i < codes.deflate_hdr_count; ++i)
    place.put({codes.deflate_hdr[i] & (i == 0 && !is_last ? 0xfeu : 0xffu), 8});
  const uint32_t extra = codes.deflate_hdr_extra_bits;
  if (extra > 0)
    place.put({codes.deflate_hdr[codes.deflate_hdr_count] & ((1u << extra) - 1), extra});
  // A zero, a length with its extra bits, a distance and a byte: at most 15 + 20 + 4 + 15 bits at
  // a time. ISA-L gives all 30 distances a code. Only the first one counts, so its code is the
  // shortest.
  const auto put = [&](uint32_t run, Code end) {
    if (run <= max_short_run) [[likely]] {
      place.put(scratch.run_codes[run].then(end));
      return;
    }
    BitPlace beyond = place;
    const Code rest = begin_long_run(run, scratch, beyond);
    place = beyond;
    place.put(rest.then(end));
  };
  for (const uint32_t token : tokens) put(token >> 8, scratch.byte_codes[token & 0xff]);
  put(tokens.tail(), {codes.lit_table[256], codes.lit_table_sizes[256]});
  out.place = place;
}

/// A row less the one above it, with its filter.
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
  const uint32_t part_rows = static_cast<uint32_t>(std::max<size_t>(part_bytes / size, 1));
  std::vector<uint8_t> part((part_rows * size + 63) / 64 * 64), none(size);
  Tokens tokens;
  const size_t chunk = begin_png(image, stream);
  stream.insert(stream.end(), {0x78, 0x01});
  BitWriter out(stream);
  uint32_t adler = 1;
  for (uint32_t first = 0; first < image.height;) {
    const uint32_t end = std::min(image.height, first + block_rows);
    tokens.clear();
    for (uint32_t y = first; y < end;) {
      size_t filled = 0;
      for (const uint32_t stop = std::min(end, y + part_rows); y < stop; ++y, filled += size) {
        const uint8_t* own = rows.data() + y * size;
        filter_row(y > 0 ? own - size : none.data(), own, size, part.data() + filled);
      }
      std::fill(part.begin() + static_cast<ptrdiff_t>(filled), part.end(), uint8_t{0});
      adler = isal_adler32(adler, part.data(), filled);
      tokens.add(part.data(), filled);
    }
    write_block(tokens, end == image.height, *scratch, out);
    first = end;
  }
  out.end();
  for (int shift = 24; shift >= 0; shift -= 8)
    stream.push_back(static_cast<uint8_t>(adler >> shift));
  end_png(chunk, crc32_gzip_refl, stream);
  return true;
}

}  // namespace msq_io
