#include "bench/sweep_plan.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include <seam/error.hpp>

namespace seam {

namespace {

constexpr double most_samples = 1e9;

// What separators part that are in no brackets and no quotes.
std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  int depth = 0;
  char quote = 0;
  for (const char c : text) {
    if (quote != 0)
      quote = c == quote ? 0 : quote;
    else if (c == '"' || c == '\'')
      quote = c;
    else if (c == '{' || c == '[')
      ++depth;
    else if (c == '}' || c == ']')
      --depth;
    if (c == separator && depth == 0 && quote == 0)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

template <typename Number>
Number number(const std::string& text, const std::string& place, const char* what) {
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [last, status] = std::from_chars(text.data(), end, value);
  if (status != std::errc{} || last != end || !std::isfinite(static_cast<double>(value)))
    throw Error(place, "\"" + text + "\", must be " + what);
  return value;
}

std::uint64_t mixed(std::uint64_t z) {
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
  return z ^ (z >> 31U);
}

constexpr std::uint64_t golden = 0x9E3779B97F4A7C15U;

}  // namespace

Variation Variation::read(const std::string& text) {
  const std::string place = "--vary " + text;
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string::npos || equals + 1 == text.size())
    throw Error(place, "must be key=a:b:n, key=a:b or key=v1,v2,...");
  if (std::any_of(text.begin(), text.end(), [](unsigned char c) { return c < 0x20; }))
    throw Error("--vary " + text.substr(0, equals), "must be one line");
  Variation variation;
  variation.text = text;
  variation.key = text.substr(0, equals);
  variation.listed = split(text.substr(equals + 1), ',');
  variation.count = static_cast<std::int64_t>(variation.listed.size());
  for (const std::string& value : variation.listed)
    if (value.empty()) throw Error(place, "has an empty value");
  const std::vector<std::string> range = split(variation.listed.front(), ':');
  if (variation.count > 1 || range.size() == 1) return variation;

  variation.listed.clear();
  if (range.size() > 3) throw Error(place, "must be key=a:b:n or key=a:b");
  variation.from = number<double>(range[0], place, "a finite number");
  variation.to = number<double>(range[1], place, "a finite number");
  if (!std::isfinite(variation.to - variation.from)) throw Error(place, "reaches too far");
  variation.count = 0;
  if (range.size() == 3) {
    variation.count = number<std::int64_t>(range[2], place, "a whole number of values");
    if (variation.count < 1) throw Error(place, range[2] + " values, must be >= 1");
  } else if (!(variation.from < variation.to)) {
    throw Error(place, "draws from nothing, a must be < b");
  }
  return variation;
}

std::string Variation::value(std::int64_t i) const {
  if (!listed.empty()) return listed[static_cast<std::size_t>(i)];
  if (i > 0 && i == count - 1) return fmt::format("{}", to);
  const auto steps = static_cast<double>(std::max<std::int64_t>(1, count - 1));
  return fmt::format("{}", from + (to - from) * static_cast<double>(i) / steps);
}

std::string Variation::value(std::uint64_t seed, std::int64_t draw) const {
  return fmt::format("{}", from + (to - from) * chance(seed, key, draw));
}

double chance(std::uint64_t seed, const std::string& key, std::int64_t draw) {
  std::uint64_t start = mixed(seed + golden);
  for (const unsigned char c : key) start = mixed((start ^ c) + golden);
  const std::uint64_t bits = mixed(start + golden * (static_cast<std::uint64_t>(draw) + 1));
  return static_cast<double>(bits >> 11U) * 0x1p-53;
}

void SweepPlan::check() const {
  if (variations.empty())
    throw Error("--vary", "is missing: names a key of the scene and its values");
  std::set<std::string> keys;
  double samples = static_cast<double>(draws);
  for (const Variation& variation : variations) {
    const std::string place = "--vary " + variation.text;
    if (variation.key == "method") throw Error(place, "methods are chosen by --method");
    if (!keys.insert(variation.key).second)
      throw Error(place, "\"" + variation.key + "\" is varied twice");
    samples *= static_cast<double>(std::max<std::int64_t>(1, variation.count));
  }
  if (samples > most_samples)
    throw Error("--vary", fmt::format("makes {:.3g} samples, must be <= 1e9", samples));
}

std::int64_t SweepPlan::grid() const {
  std::int64_t product = 1;
  for (const Variation& variation : variations)
    if (!variation.drawn()) product *= variation.count;
  return product;
}

std::vector<std::string> SweepPlan::values(std::int64_t sample) const {
  const std::int64_t draw = sample / grid();
  std::int64_t rest = sample % grid();
  std::vector<std::string> values(variations.size());
  for (std::size_t k = variations.size(); k-- > 0;) {
    const Variation& variation = variations[k];
    if (variation.drawn()) {
      values[k] = variation.value(seed, draw);
      continue;
    }
    values[k] = variation.value(rest % variation.count);
    rest /= variation.count;
  }
  return values;
}

Shard Shard::read(const std::string& text) {
  const std::string place = "--shard " + text;
  const char* const what = "i/n with 0 <= i < n <= 1000000";
  const std::size_t slash = text.find('/');
  if (slash == std::string::npos) throw Error(place, std::string("must be ") + what);
  Shard shard;
  shard.index = number<std::int64_t>(text.substr(0, slash), place, what);
  shard.count = number<std::int64_t>(text.substr(slash + 1), place, what);
  if (shard.index < 0 || shard.index >= shard.count || shard.count > 1'000'000)
    throw Error(place, std::string("must be ") + what);
  return shard;
}

}  // namespace seam
