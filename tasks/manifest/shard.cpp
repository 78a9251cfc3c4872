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

int tasks_of(int first, int last, int step) { return step > 0 ? (last - first) / step + 1 : 0; }

/// The part of one task in an array of `count` evenly spaced tasks. `names` are the variables that describe it.
Shard part_of(std::string_view names, std::optional<int> task, std::optional<int> min, std::optional<int> last,
              std::optional<int> spacing, std::optional<int> count) {
  const int first = min.value_or(1), step = spacing.value_or(1);
  const bool whole_steps = task && step > 0 && (*task - first) % step == 0;
  const int index = whole_steps ? (*task - first) / step : -1;
  const bool gaps = last && count && tasks_of(first, *last, step) != *count;
  if (!count || *count < 1 || *count > most_shards || index < 0 || index >= *count || gaps)
    throw std::invalid_argument(
        fmt::format("{} do not describe an array of evenly spaced tasks; choose the part with --shard I/N", names));
  return {index, *count};
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
  if (const auto task = variable("SLURM_ARRAY_TASK_ID"), count = variable("SLURM_ARRAY_TASK_COUNT"); task || count)
    return part_of("SLURM_ARRAY_TASK_ID, _COUNT, _MIN, _MAX and _STEP", task, variable("SLURM_ARRAY_TASK_MIN"),
                   variable("SLURM_ARRAY_TASK_MAX"), variable("SLURM_ARRAY_TASK_STEP"), count);
  // Outside arrays, SGE sets this variable to "undefined", and LSF sets its own to 0.
  if (const char* task = std::getenv("SGE_TASK_ID"); task && std::string_view(task) != "undefined") {
    const auto first = variable("SGE_TASK_FIRST"), last = variable("SGE_TASK_LAST"),
               step = variable("SGE_TASK_STEPSIZE");
    if (first && last)
      return part_of("SGE_TASK_ID, _FIRST, _LAST and _STEPSIZE", variable("SGE_TASK_ID"), first, last, step,
                     tasks_of(*first, *last, step.value_or(1)));
  }
  for (const auto* name : {"SGE_TASK_ID", "PBS_ARRAY_INDEX", "PBS_ARRAYID", "LSB_JOBINDEX"}) {
    const char* task = std::getenv(name);
    const std::string_view none = name == std::string_view("LSB_JOBINDEX") ? "0" : "undefined";
    if (task && *task && task != none)
      throw std::invalid_argument(
          fmt::format("{}={} is the index of a task of an array, but the scheduler does not give the number of tasks; "
                      "choose the part with --shard I/N, where I runs from 1 to N",
                      name, task));
  }
  return {};
}

}  // namespace isojam
