#include "tasks/manifest/shard.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cstdlib>
#include <stdexcept>
#include <string_view>

namespace isojam {
namespace {

constexpr int most_shards = 100000;

std::optional<int> whole_number(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// Value of an environment variable; nullopt if it is not set.
std::optional<int> variable(const char* name) {
  const char* text = std::getenv(name);
  if (!text || !*text) return std::nullopt;
  const auto value = whole_number(text);
  if (!value)
    throw std::invalid_argument(fmt::format("{}={} is not an integer; choose the part with --shard I/N", name, text));
  return value;
}

}  // namespace

std::optional<Shard> parse_shard(const std::string& text) {
  const auto slash = text.find('/');
  if (slash == std::string::npos) return std::nullopt;
  const auto index = whole_number(std::string_view(text).substr(0, slash));
  const auto count = whole_number(std::string_view(text).substr(slash + 1));
  if (!index || !count || *count < 1 || *count > most_shards || *index < 1 || *index > *count) return std::nullopt;
  return Shard{*index - 1, *count};
}

Shard shard_of_environment() {
  const auto task = variable("SLURM_ARRAY_TASK_ID"), count = variable("SLURM_ARRAY_TASK_COUNT");
  if (!task && !count) return {};
  const int first = variable("SLURM_ARRAY_TASK_MIN").value_or(1), step = variable("SLURM_ARRAY_TASK_STEP").value_or(1);
  const auto last = variable("SLURM_ARRAY_TASK_MAX");
  const bool whole_steps = task && step > 0 && (*task - first) % step == 0;
  const int index = whole_steps ? (*task - first) / step : -1;
  const bool gaps = last && count && step > 0 && (*last - first) / step + 1 != *count;
  if (!count || *count < 1 || *count > most_shards || index < 0 || index >= *count || gaps)
    throw std::invalid_argument(
        "SLURM_ARRAY_TASK_ID, _COUNT, _MIN, _MAX and _STEP do not describe an array of evenly spaced tasks; choose the "
        "part with --shard I/N");
  return {index, *count};
}

}  // namespace isojam
