// SPDX-License-Identifier: Apache-2.0
// A key has the position on the curve in its high bits and the beam's number in its low bits. So a
// radix sort of single words suffices, and ties stay in the order of the numbers.
#include "structure/beams/beam_order.h"

#include <array>
#include <bit>
#include <limits>

#include "base/random.h"
#include "base/run_parts.h"
#include "structure/beams/hilbert.h"

namespace msq {

namespace {

constexpr uint64_t beams_in_block = uint64_t{1} << 15;
constexpr unsigned size_bits = 4;  // of the key, for powers of 4 of the size
/// Minimum length of runs of equal positions that are sorted again, and the maximum number of
/// passes for any coordinates.
constexpr uint64_t min_run = 32;
constexpr int max_rounds = 24;
constexpr unsigned digit_bits = 11;
constexpr size_t digits = size_t{1} << digit_bits;

/// Marks a beam that equals another; source.count is smaller.
constexpr uint32_t is_repeat = uint32_t{1} << 31;

std::array<uint64_t, 9> bits_of(const Beam& beam) {
  const auto bits = [](double value) { return std::bit_cast<uint64_t>(value); };
  return {bits(beam.a.x),
          bits(beam.a.y),
          bits(beam.a.z),
          bits(beam.b.x),
          bits(beam.b.y),
          bits(beam.b.z),
          bits(beam.radius_a),
          bits(beam.radius_b),
          uint64_t{4} * static_cast<uint64_t>(beam.cap_a) + static_cast<uint64_t>(beam.cap_b)};
}
bool is_same(const Beam& one, const Beam& other) {
  return bits_of(one) == bits_of(other);
}
uint64_t hash_of(const Beam& beam) {
  uint64_t hash = 0;
  for (const uint64_t bits : bits_of(beam)) hash = splitmix_output(hash ^ bits, 1);
  return hash;
}

uint64_t blocks_of(uint64_t count) {
  return (count + beams_in_block - 1) / beams_in_block;
}

/// An empty box.
Box3 no_box() {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
}
void join(Box3& box, const Box3& other) {
  box.min = min(box.min, other.min);
  box.max = max(box.max, other.max);
}

/// The extent of the beams of a block, or of all beams.
struct Extent {
  Box3 box = no_box();
  double longest = 0, largest = 0;  // largest: side of a beam's box
  uint64_t count = 0;

  void add(const Extent& other) {
    join(box, other.box);
    longest = std::max(longest, other.longest);
    largest = std::max(largest, other.largest);
    count += other.count;
  }
};

class Ordering {
 public:
  Ordering(const BeamSource& source, const Executor& executor, Job* job)
      : source_(source), executor_(executor), job_(job) {}

  void measure(Interval progress, BeamOrder& order) {
    const uint64_t blocks = blocks_of(source_.count);
    std::vector<Extent> extents(blocks);
    run_parts(executor_, blocks, job_, progress, [&](uint64_t n) {
      Extent extent;
      for_block(n, source_.count, [&](uint64_t i) {
        Beam beam;
        if (!source_.get(i, beam)) return;
        const Box3 box = beam.box();
        join(extent.box, box);
        extent.largest = std::max(extent.largest, max_component(box.extent()));
        extent.longest = std::max(
            {extent.longest, length(beam.b - beam.a), 2 * beam.radius_a, 2 * beam.radius_b});
        ++extent.count;
      });
      extents[n] = extent;
    });
    for (Extent& extent : extents) {
      const uint64_t before = all_.count;
      all_.add(extent);
      extent.count = before;
    }
    index_bits_ = static_cast<unsigned>(std::bit_width(source_.count));
    begins_ = std::move(extents);
    order.box = all_.box;
    order.longest = all_.longest;
  }

  void sort(Interval progress, BeamOrder& order) {
    const auto part = [&](double from, double to) {
      const double all = progress.high - progress.low;
      return Interval{progress.low + from * all, progress.low + to * all};
    };
    keys_.resize(all_.count);
    other_.resize(all_.count);
    const Curve curve(all_.box, (64 - index_bits_ - size_bits) / 3);
    run_parts(executor_, begins_.size(), job_, part(0, 0.4), [&](uint64_t n) {
      uint64_t to = begins_[n].count;
      for_block(n, source_.count, [&](uint64_t i) {
        Beam beam;
        if (!source_.get(i, beam)) return;
        const Box3 box = beam.box();
        const double ratio = all_.largest / max_component(box.extent());
        const int size = std::clamp(std::ilogb(ratio) / 2, 0, (1 << size_bits) - 1);
        const uint64_t place =
            uint64_t{static_cast<unsigned>(size)} << 3 * curve.bits | curve.at(centre(box));
        keys_[to++] = place << index_bits_ | i;
      });
    });
    sort_by_digits(0, keys_.size(), part(0.4, 0.8));
    sort_runs();
    order.numbers.resize(keys_.size());
    run_parts(executor_, blocks_of(keys_.size()), job_, part(0.8, 0.9), [&](uint64_t n) {
      for_block(n, keys_.size(), [&](uint64_t i) { order.numbers[i] = number_of(keys_[i]); });
    });
    run_parts(executor_, blocks_of(keys_.size()), job_, part(0.9, 1),
              [&](uint64_t n) { mark_repeats_in(n, order.numbers); });
    move_repeats(order);
  }

 private:
  struct Run {
    uint64_t begin, end;
  };
  struct Curve {
    Box3 box;
    unsigned bits;
    double per_side, last;  // cells per unit of length; number of the last cell

    Curve(const Box3& box, unsigned bits) : box(box), bits(std::min(bits, 21u)) {
      last = static_cast<double>((uint64_t{1} << this->bits) - 1);
      const double side = max_component(box.extent());
      per_side = side > 0 ? (last + 1) / side : 0;
    }
    uint64_t at(Vec3 p) const {
      uint32_t cell[3];
      for (int axis = 0; axis < 3; ++axis)
        cell[axis] =
            static_cast<uint32_t>(std::clamp((p[axis] - box.min[axis]) * per_side, 0.0, last));
      return hilbert_index(cell[0], cell[1], cell[2], bits);
    }
  };

  template <class Visit>
  static void for_block(uint64_t n, uint64_t count, Visit&& visit) {
    for (uint64_t i = n * beams_in_block, end = std::min(count, i + beams_in_block); i < end; ++i)
      visit(i);
  }
  static Vec3 centre(const Box3& box) { return box.min + (box.max - box.min) * 0.5; }
  uint32_t number_of(uint64_t key) const {
    return static_cast<uint32_t>(key & ((uint64_t{1} << index_bits_) - 1));
  }

  /// Sorts keys [begin, end), which are in the order of their numbers, by their positions.
  void sort_by_digits(uint64_t begin, uint64_t end, Interval progress) {
    const uint64_t count = end - begin, blocks = blocks_of(count);
    std::vector<std::array<uint32_t, digits>> counts(blocks);
    const unsigned passes = (64 - index_bits_ + digit_bits - 1) / digit_bits;
    for (unsigned pass = 0; pass < passes; ++pass) {
      const unsigned shift = index_bits_ + pass * digit_bits;
      const auto digit = [&](uint64_t key) { return (key >> shift) & (digits - 1); };
      executor_.for_each(blocks, [&](uint64_t n) {
        check_cancelled(job_);
        counts[n].fill(0);
        for_block(n, count, [&](uint64_t i) { ++counts[n][digit(keys_[begin + i])]; });
      });
      uint32_t sum = 0;
      for (size_t d = 0; d < digits; ++d)
        for (auto& of_block : counts) {
          const uint32_t here = of_block[d];
          of_block[d] = sum;
          sum += here;
        }
      executor_.for_each(blocks, [&](uint64_t n) {
        check_cancelled(job_);
        for_block(n, count, [&](uint64_t i) {
          const uint64_t key = keys_[begin + i];
          other_[begin + counts[n][digit(key)]++] = key;
        });
      });
      if (begin == 0 && end == keys_.size())
        keys_.swap(other_);
      else
        std::copy(other_.begin() + static_cast<std::ptrdiff_t>(begin),
                  other_.begin() + static_cast<std::ptrdiff_t>(end),
                  keys_.begin() + static_cast<std::ptrdiff_t>(begin));
      if (job_)
        job_->raise_progress(progress.low + (progress.high - progress.low) * (pass + 1) / passes);
    }
  }

  /// Sorts runs of equal positions again, and the runs of equal positions within those.
  void sort_runs() {
    std::vector<Run> runs;
    add_runs({0, keys_.size()}, runs);
    for (int round = 0; round < max_rounds && !runs.empty(); ++round) {
      std::vector<std::vector<Run>> found(runs.size());
      // Long runs one by one, each with all threads.
      for (size_t n = 0; n < runs.size(); ++n)
        if (runs[n].end - runs[n].begin > beams_in_block) sort_run(runs[n], true, found[n]);
      executor_.for_each(runs.size(), [&](uint64_t n) {
        if (runs[n].end - runs[n].begin <= beams_in_block) sort_run(runs[n], false, found[n]);
      });
      runs.clear();
      for (const std::vector<Run>& some : found) runs.insert(runs.end(), some.begin(), some.end());
    }
  }

  void sort_run(const Run& run, bool is_long, std::vector<Run>& found) {
    const Executor alone(1);
    const Executor& executor = is_long ? executor_ : alone;
    const uint64_t count = run.end - run.begin, blocks = blocks_of(count);
    std::vector<Box3> boxes(blocks, no_box());
    const auto centre_of = [&](uint64_t i) {
      Beam beam;
      source_.get(number_of(keys_[run.begin + i]), beam);
      return centre(beam.box());
    };
    executor.for_each(blocks, [&](uint64_t n) {
      check_cancelled(job_);
      for_block(n, count, [&](uint64_t i) {
        const Vec3 p = centre_of(i);
        join(boxes[n], {p, p});
      });
    });
    for (const Box3& box : boxes) join(boxes[0], box);
    if (!(max_component(boxes[0].extent()) > 0)) return;  // all at one position
    const Curve curve(boxes[0], (64 - index_bits_) / 3);
    executor.for_each(blocks, [&](uint64_t n) {
      check_cancelled(job_);
      for_block(n, count, [&](uint64_t i) {
        uint64_t& key = keys_[run.begin + i];
        key = curve.at(centre_of(i)) << index_bits_ | number_of(key);
      });
    });
    if (is_long)
      sort_by_digits(run.begin, run.end, {0, 0});
    else
      std::sort(keys_.begin() + static_cast<std::ptrdiff_t>(run.begin),
                keys_.begin() + static_cast<std::ptrdiff_t>(run.end));
    add_runs(run, found);
  }

  void add_runs(const Run& within, std::vector<Run>& runs) const {
    for (uint64_t i = within.begin; i < within.end;) {
      uint64_t j = i + 1;
      while (j < within.end && keys_[j] >> index_bits_ == keys_[i] >> index_bits_) ++j;
      if (j - i >= min_run) runs.push_back({i, j});
      i = j;
    }
  }

  /// Finds equal beams. They have equal keys and lie side by side, for every curve gives equal
  /// beams equal positions. A block finds those of the groups of equal keys that begin in it.
  void mark_repeats_in(uint64_t block, std::vector<uint32_t>& numbers) {
    const auto same_place = [&](uint64_t i, uint64_t j) {
      return keys_[i] >> index_bits_ == keys_[j] >> index_bits_;
    };
    uint64_t i = block * beams_in_block;
    const uint64_t end = std::min<uint64_t>(keys_.size(), i + beams_in_block);
    while (i > 0 && i < end && same_place(i, i - 1)) ++i;
    while (i < end) {
      uint64_t next = i + 1;
      while (next < keys_.size() && same_place(i, next)) ++next;
      if (next > i + 1) mark_repeats(i, next, numbers);
      i = next;
    }
  }

  /// In place of a repeat's number, writes the position of the first beam that equals it, and
  /// is_repeat. A table of positions by hashes of beams, two to a word, is in other_.
  void mark_repeats(uint64_t begin, uint64_t end, std::vector<uint32_t>& numbers) {
    const uint64_t slots = 2 * (end - begin);
    std::fill(other_.begin() + static_cast<std::ptrdiff_t>(begin),
              other_.begin() + static_cast<std::ptrdiff_t>(end), 0);
    CancelPoll poll(job_);
    for (uint64_t i = begin; i < end; ++i) {
      poll();
      Beam beam, known;
      source_.get(numbers[i], beam);
      for (uint64_t slot = (hash_of(beam) >> 32) * slots >> 32;; slot = (slot + 1) % slots) {
        uint64_t& word = other_[begin + slot / 2];
        const unsigned shift = slot % 2 ? 32 : 0;
        const uint64_t position = word >> shift & 0xffffffffU;  // in the group, plus 1; 0: none
        if (position == 0) {
          word |= (i - begin + 1) << shift;
          break;
        }
        const uint64_t first = begin + position - 1;
        source_.get(numbers[first], known);
        if (!is_same(beam, known)) continue;
        numbers[i] = is_repeat | static_cast<uint32_t>(first);
        break;
      }
    }
  }

  /// Moves the marked beams to the list of repeats.
  void move_repeats(BeamOrder& order) {
    const auto is_marked = [](uint32_t number) { return (number & is_repeat) != 0; };
    const auto count = std::count_if(order.numbers.begin(), order.numbers.end(), is_marked);
    if (count == 0) return;
    std::vector<uint64_t>().swap(other_);  // its memory counts for the repeats
    order.repeats.reserve(static_cast<size_t>(count));
    CancelPoll poll(job_);
    uint32_t kept = 0;
    for (uint64_t i = 0; i < keys_.size(); ++i) {
      poll();
      const uint32_t number = order.numbers[i];
      if (is_marked(number)) {
        order.repeats.push_back(
            {static_cast<uint32_t>(keys_[number & ~is_repeat]), number_of(keys_[i])});
        continue;
      }
      order.numbers[kept] = number;
      keys_[i] = kept++;
    }
    order.numbers.resize(kept);
    order.numbers.shrink_to_fit();
    if (!std::is_sorted(order.repeats.begin(), order.repeats.end()))
      std::sort(order.repeats.begin(), order.repeats.end());
  }

  const BeamSource& source_;
  const Executor& executor_;
  Job* const job_;
  Extent all_;
  std::vector<Extent> begins_;  // by block; then, in place of the count, the number of
                                // keys before the block
  unsigned index_bits_ = 0;
  std::vector<uint64_t> keys_, other_;
};

}  // namespace

BeamOrder order_beams(const BeamSource& source, const Executor& executor, Job* job,
                      Interval progress) {
  const double middle = progress.low + 0.2 * (progress.high - progress.low);
  BeamOrder order;
  Ordering ordering(source, executor, job);
  ordering.measure({progress.low, middle}, order);
  ordering.sort({middle, progress.high}, order);
  return order;
}

}  // namespace msq
