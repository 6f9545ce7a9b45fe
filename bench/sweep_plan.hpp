#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <seam/join.hpp>

namespace seam {

/// One key of a scene, and the values that it takes in a sweep.
struct Variation {
  std::string text;                 // as it was given
  std::string key;                  // as in --set
  std::vector<std::string> listed;  // its values, if they were given one by one
  double from = 0.0, to = 0.0;      // between which they lie otherwise
  std::int64_t count = 0;           // of the values of a grid; 0: drawn by chance

  /// `key=a:b:n`: n values evenly from a to b; `key=a:b`: drawn from [a, b); `key=v1,v2`: these, which may be any YAML
  /// (commas in brackets belong to a value).
  /// @throws Error  is none of these, or names no key
  static Variation read(const std::string& text);

  bool drawn() const { return count == 0; }
  /// One of the grid's values, 0 ≤ i < count.
  std::string value(std::int64_t i) const;
  /// The value of a draw, ≥ 0: depends on the seed, the key and the draw's number alone.
  std::string value(std::uint64_t seed, std::int64_t draw) const;
};

/// A number in [0, 1), one of 2⁵³ that are equally likely. It depends on its arguments alone and is the same on every
/// machine: the SplitMix64 generator (Steele, Lea and Flood 2014), keyed, at place `draw` of its sequence.
double chance(std::uint64_t seed, const std::string& key, std::int64_t draw);

/// Which samples a sweep has: for each draw the full product of the grids, the last key's value changing fastest. More draws leave
/// the samples of fewer as they are.
struct SweepPlan {
  std::vector<Variation> variations;
  std::int64_t draws = 1;  // 1 where nothing is drawn
  std::uint64_t seed = 1;
  std::vector<Join> methods;  // with which each sample is played

  /// @throws Error  nothing is varied, or a key twice, or more than 10⁹ samples
  void check() const;
  std::int64_t grid() const;  // samples of one draw
  std::int64_t samples() const { return draws * grid(); }
  /// Values of the varied keys.
  std::vector<std::string> values(std::int64_t sample) const;
};

/// A part of a sweep: the samples whose number, divided by `count`, leaves `index`.
struct Shard {
  std::int64_t index = 0;
  std::int64_t count = 1;

  /// @param text  `i/n`, 0 ≤ i < n. @throws Error  is not that
  static Shard read(const std::string& text);
  bool holds(std::int64_t sample) const { return sample % count == index; }
  /// How many of the samples it holds, and the number of the k-th.
  std::int64_t size(std::int64_t samples) const { return (samples - index + count - 1) / count; }
  std::int64_t sample(std::int64_t k) const { return index + k * count; }
};

}  // namespace seam
