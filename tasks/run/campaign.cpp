#include "tasks/run/campaign.hpp"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "tasks/io/file.hpp"
#include "tasks/measure/quantity.hpp"

namespace isojam {

static constexpr std::chrono::milliseconds pause{50};  ///< between two looks at what other processes compute

Campaign::Campaign(const Plan& plan, const Replicates& rule, const Shard& shard, const Store& store)
    : plan_(plan), rule_(rule), shard_(shard), store_(store), points_(plan.points()) {}

bool Campaign::takes(std::size_t point, int replicate) const {
  if (rule_.goal) return shard_.takes(point);
  return shard_.takes(point * static_cast<std::size_t>(plan_.replicates()) + static_cast<std::size_t>(replicate));
}

/// Reads the values of the replicates of the last round, which the stopping rule uses.
void Campaign::learn(std::size_t point) {
  auto& state = points_[point];
  const auto index = *quantity_index(rule_.goal->quantity);
  for (int replicate = state.done; replicate < state.wanted; ++replicate) {
    const auto spec = plan_.at(point, replicate);
    const bool is_taken = taken_.contains(replicate_name(spec));
    const auto summary = is_taken ? RecordSummary{} : store_.recorded(spec);
    if (!summary)
      throw FileError(store_.record_path(spec).string() +
                      ": was removed or damaged during the run; repeat the command");
    state.values.push_back(has_any(*summary, plan_.exclude()) ? std::nullopt : summary->values[index]);
  }
}

bool Campaign::open_round() {
  bool any = false;
  for (std::size_t point = 0; point < points_.size(); ++point) {
    auto& state = points_[point];
    if (rule_.goal && !takes(point, 0)) continue;
    if (rule_.goal) learn(point);
    state.done = state.wanted;
    if (rule_.goal) {
      state.wanted = std::max(state.done, advance_of(rule_, state.values).wanted);
    } else {
      state.wanted = rule_.max;
    }
    any = any || state.wanted > state.done;
  }
  at_point_ = 0;
  at_replicate_ = points_.empty() ? 0 : points_[0].done;
  return any;
}

std::optional<ReplicateSpec> Campaign::next_in_order() {
  while (at_point_ < points_.size()) {
    if (at_replicate_ >= points_[at_point_].wanted) {
      if (++at_point_ < points_.size()) at_replicate_ = points_[at_point_].done;
      continue;
    }
    const int replicate = at_replicate_++;
    if (takes(at_point_, replicate)) return plan_.at(at_point_, replicate);
  }
  return std::nullopt;
}

/// True if the replicate, whose lock this process has, must be computed. Otherwise releases the lock.
bool Campaign::is_missing(ReplicateSpec& spec) {
  if (const auto summary = store_.recorded(spec)) {
    failed_ += summary->failed;
    if (summary->failed && summary->spec_digest != spec_digest(spec)) taken_.insert(replicate_name(spec));
    store_.release(spec);
    return false;
  }
  store_.keep_measures(spec);
  return true;
}

std::optional<ReplicateSpec> Campaign::next(const std::stop_token& stop) {
  while (auto spec = next_in_order()) {
    if (!store_.take(*spec)) {
      elsewhere_.push_back(*std::move(spec));
    } else if (is_missing(*spec)) {
      return spec;
    }
  }
  while (!elsewhere_.empty() && !stop.stop_requested()) {
    for (auto spec = elsewhere_.begin(); spec != elsewhere_.end(); ++spec) {
      if (!store_.take(*spec)) continue;
      auto free = std::move(*spec);
      elsewhere_.erase(spec);
      if (is_missing(free)) return free;
      break;
    }
    if (!elsewhere_.empty()) std::this_thread::sleep_for(pause);
  }
  return std::nullopt;
}

Campaign::Size Campaign::round_size() const {
  std::vector<int> missing(points_.size(), 0);
  Size size;
  for (std::size_t point = 0; point < points_.size(); ++point) {
    for (int r = points_[point].done; r < points_[point].wanted; ++r) missing[point] += takes(point, r);
    size.replicates += static_cast<std::size_t>(missing[point]);
  }
  for (const auto& name : names_in(store_.directory() / "records")) {
    const auto place = plan_.place_of(name);
    if (!place || !plan_.requests(*place) || !takes(place->point, place->replicate)) continue;
    const auto& state = points_[place->point];
    if (place->replicate < state.done || place->replicate >= state.wanted) continue;
    ++size.recorded;
    --missing[place->point];
  }
  for (std::size_t point = 0; point < points_.size(); ++point) {
    if (missing[point] > 0) size.work += missing[point] * estimated_cost(plan_.at(point, 0), false).cpu_seconds;
  }
  return size;
}

std::vector<std::string> Campaign::without(const std::function<bool(const std::string&)>& has) const {
  std::vector<std::string> names;
  for (std::size_t point = 0; point < points_.size(); ++point) {
    for (int replicate = 0; replicate < points_[point].wanted; ++replicate) {
      if (!takes(point, replicate)) continue;
      auto name = replicate_name(plan_.at(point, replicate));
      if (!has(name) && !taken_.contains(name)) names.push_back(std::move(name));
    }
  }
  return names;
}

double Campaign::largest_memory() const {
  double largest = 0;
  for (std::size_t point = 0; point < points_.size(); ++point)
    largest = std::max(largest, estimated_cost(plan_.at(point, 0), false).memory_bytes);
  return largest;
}

}  // namespace isojam
