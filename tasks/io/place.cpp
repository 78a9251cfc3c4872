#include "tasks/io/place.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace isojam {
namespace {

/// Number of insertions, deletions, replacements and swaps of neighbouring letters that change a into b. Case is
/// ignored.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  const auto same = [](char x, char y) {
    return std::tolower(static_cast<unsigned char>(x)) == std::tolower(static_cast<unsigned char>(y));
  };
  std::vector<std::size_t> before, row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::vector<std::size_t> next{i + 1};
    for (std::size_t j = 0; j < b.size(); ++j) {
      auto least = std::min({row[j] + !same(a[i], b[j]), row[j + 1] + 1, next[j] + 1});
      if (i > 0 && j > 0 && same(a[i], b[j - 1]) && same(a[i - 1], b[j])) least = std::min(least, before[j - 1] + 1);
      next.push_back(least);
    }
    before = std::exchange(row, std::move(next));
  }
  return row.back();
}

constexpr std::size_t longest_shown = 40;

/// Text of a value for a message: a scalar as in the file, but only the type of a list or an object.
std::string shown(const Json& value) {
  if (value.is_object()) return "an object";
  if (value.is_array()) return "a list";
  // An argument of the command line may contain bytes that are not allowed in JSON.
  const auto text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
  return text.size() <= longest_shown ? text : fmt::format("a {}", value.type_name());
}

using Order = std::map<std::string, std::size_t>;

/// Numbers all places of a document in the order of the text.
void number_places(const Json& value, const std::string& pointer, Order& order) {
  order.emplace(pointer, order.size());
  if (value.is_primitive()) return;
  for (const auto& item : value.items()) number_places(item.value(), pointer + pointer_step(item.key()), order);
}

/// Further errors are counted but not listed.
constexpr std::size_t most_reported = 100;

}  // namespace

void Problems::note(const InputError& error) {
  for (const auto& details : error.all()) {
    if (settled_.insert(details.pointer).second) found_.push_back(details);
  }
}

bool Problems::concern(std::string_view pointer) const {
  const auto contains = [](std::string_view outer, std::string_view inner) {
    return inner.starts_with(outer) && (inner.size() == outer.size() || inner[outer.size()] == '/');
  };
  return std::any_of(settled_.begin(), settled_.end(),
                     [&](const std::string& wrong) { return contains(wrong, pointer) || contains(pointer, wrong); });
}

void Problems::refuse_any(const Json& document) const {
  if (found_.empty()) return;
  Order order;
  number_places(document, "", order);
  const auto place = [&](const InputError::Details& details) {
    const auto found = order.find(details.pointer);
    return found != order.end() ? found->second : order.at(details.pointer.substr(0, details.pointer.rfind('/')));
  };
  auto all = found_;
  std::stable_sort(all.begin(), all.end(), [&](const auto& a, const auto& b) { return place(a) < place(b); });
  if (all.size() > most_reported) {
    const auto more = fmt::format("{} more errors", all.size() - most_reported);
    all.resize(most_reported);
    all.push_back({all.front().file, "", more, "", ""});
  }
  throw InputError(std::move(all));
}

std::string number_in(const Range& range) {
  if (range.high == std::numeric_limits<double>::max())
    return range.low == -range.high ? "a number"
                                    : fmt::format("a number {} {}", range.low_excluded ? ">" : "≥", range.low);
  return fmt::format("a number in {}{}, {}{}", range.low_excluded ? '(' : '[', range.low, range.high,
                     range.high_excluded ? ')' : ']');
}

std::string integer_in(const Range& range) {
  return fmt::format("an integer from {:.0f} to {:.0f}", range.low, range.high);
}

std::string quoted_list(std::span<const std::string_view> names) {
  std::string text;
  for (const auto name : names) text += fmt::format("{}\"{}\"", text.empty() ? "" : ", ", name);
  return text;
}

std::string one_of(std::span<const std::string_view> names) {
  return (names.size() == 1 ? "" : "one of ") + quoted_list(names);
}

std::string nearest_name(std::string_view word, std::span<const std::string_view> candidates) {
  std::string_view best;
  std::size_t least = std::max<std::size_t>(1, word.size() / 3) + 1;
  for (const auto candidate : candidates) {
    const auto distance = edit_distance(word, candidate);
    if (distance < least) {
      least = distance;
      best = candidate;
    }
  }
  constexpr std::size_t least_beginning = 3;
  if (!best.empty() || word.size() < least_beginning) return std::string(best);
  const auto begins = [&](std::string_view candidate) { return candidate.starts_with(word); };
  const auto only = std::find_if(candidates.begin(), candidates.end(), begins);
  if (only == candidates.end() || std::count_if(only, candidates.end(), begins) > 1) return "";
  return std::string(*only);
}

std::string unknown_name(std::string_view kind, std::string_view name, std::span<const std::string_view> names,
                         std::string_view besides) {
  const auto nearest = nearest_name(name, names);
  return fmt::format("unknown {} \"{}\"; {}", kind, name,
                     nearest.empty() ? fmt::format("expected {}{}", besides, one_of(names))
                                     : fmt::format("did you mean \"{}\"?", nearest));
}

JsonPlace JsonPlace::at(std::string_view key) const {
  if (!value_.is_object()) not_accepted(fmt::format("an object with the key \"{}\"", key));
  const auto found = value_.find(key);
  auto pointer = pointer_ + pointer_step(key);
  if (found == value_.end())
    throw InputError(
        {*file_, pointer, "the required key is missing", "", "", problems_ && problems_->of_user() ? "add it" : ""});
  return {*found, file_, std::move(pointer), problems_};
}

JsonPlace JsonPlace::at(std::size_t index) const {
  return {value_.at(index), file_, fmt::format("{}/{}", pointer_, index), problems_};
}

void JsonPlace::refuse(std::string problem, std::string allowed, std::string suggestion) const {
  throw InputError({*file_, pointer_, std::move(problem), std::move(allowed), std::move(suggestion)});
}

void JsonPlace::refuse_with_remedy(std::string problem, std::string remedy) const {
  throw InputError({*file_, pointer_, std::move(problem), "", "", std::move(remedy)});
}

void JsonPlace::not_accepted(std::string_view allowed) const {
  refuse(fmt::format("{} is not accepted", shown(value_)), std::string(allowed));
}

void JsonPlace::expect_object(std::string_view allowed) const {
  if (!value_.is_object()) not_accepted(allowed);
}

std::size_t JsonPlace::expect_list(std::string_view allowed) const {
  if (!value_.is_array()) not_accepted(allowed);
  return value_.size();
}

void JsonPlace::expect_length(std::size_t length, std::string_view allowed) const {
  if (expect_list(allowed) != length) refuse("the list has the wrong length", std::string(allowed));
}

std::size_t JsonPlace::expect_entries(std::size_t most, std::string_view allowed) const {
  const auto size = expect_list(allowed);
  if (size < 1 || size > most) refuse("the list has the wrong length", std::string(allowed));
  return size;
}

void JsonPlace::expect_keys(std::span<const std::string_view> names,
                            const std::function<std::string(std::string_view)>& elsewhere) const {
  if (!value_.is_object()) not_accepted(fmt::format("an object with the keys {}", quoted_list(names)));
  for (const auto& item : value_.items()) {
    const std::string_view key = item.key();
    if (std::find(names.begin(), names.end(), key) != names.end()) continue;
    auto suggestion = elsewhere ? elsewhere(key) : std::string();
    if (suggestion.empty()) suggestion = nearest_name(key, names);
    const auto pointer = pointer_ + pointer_step(item.key());
    attempt([&] { throw InputError({*file_, pointer, "unknown key", one_of(names), suggestion}); });
    // The missing key is only a consequence of the misspelt key, so it is not reported separately.
    if (problems_ && !suggestion.empty() && !has(suggestion)) problems_->settle(pointer_ + pointer_step(suggestion));
  }
}

double JsonPlace::number(const Range& range) const {
  const auto x = accepted_number(value_, range);
  if (!x) not_accepted(number_in(range));
  return *x;
}

std::int64_t JsonPlace::integer(const Range& range) const {
  const auto n = accepted_integer(value_, range);
  if (!n) not_accepted(integer_in(range));
  return *n;
}

bool JsonPlace::boolean() const {
  if (!value_.is_boolean()) not_accepted("true or false");
  return value_.get<bool>();
}

std::string JsonPlace::text(std::string_view allowed) const {
  if (!value_.is_string()) not_accepted(allowed);
  return value_.get<std::string>();
}

std::size_t JsonPlace::choice(std::span<const std::string_view> names) const {
  const auto name = text(one_of(names));
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    // If only one value is accepted, the message names it anyway, so it is not suggested.
    const auto suggestion = names.size() == 1 ? "" : nearest_name(name, names);
    refuse(fmt::format("unknown value {}", shown(value_)), one_of(names), suggestion);
  }
  return static_cast<std::size_t>(found - names.begin());
}

}  // namespace isojam
