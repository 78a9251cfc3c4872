#include "tasks/records/abridged.hpp"

#include <algorithm>
#include <charconv>
#include <functional>
#include <set>
#include <string>

#include "tasks/measure/quantity.hpp"

namespace isojam {
namespace {

/// The key of a line `  "key": value`; empty for another line.
std::string_view key_of(std::string_view line, std::size_t indent) {
  if (line.size() <= indent || line[indent] != '"') return "";
  const auto end = line.find('"', indent + 1);
  return line.substr(indent + 1, end == std::string_view::npos ? 0 : end - indent - 1);
}

/// All keys in the JSON pointers of quantities, and that of the histograms of angles.
const std::set<std::string, std::less<>>& keys_of_quantities() {
  static const auto keys = [] {
    std::set<std::string, std::less<>> set{"angle_bins"};
    for (const auto& quantity : all_quantities()) {
      for (auto rest = Json::json_pointer(quantity.pointer); !rest.empty(); rest.pop_back()) set.insert(rest.back());
    }
    return set;
  }();
  return keys;
}

/// Passes the lines of a record that are kept to a text.
class Shortener {
 public:
  explicit Shortener(const Abridgement& kept) : states_(kept.states), keys_(kept.keys) {}

  void take(std::string_view line) {
    const auto indent = std::min(line.find_first_not_of(' '), line.size());
    if (indent == 2) section_ = key_of(line, indent);
    if (indent == 2 && section_ == "nearest") return take_nearest(line);
    if (indent == 2 && line.front() == ' ' && line[indent] == ']') dropped_ = false;
    if (section_ == "path" && indent > 2) return;
    if (section_ == "states" && indent == 4) {
      if (line[indent] == '{') dropped_ = states_ == States::nearest && state_++ != nearest_;
    }
    if (dropped_ || !is_needed(line, indent)) return;
    if (is_long_list(line, indent)) {
      append(std::string(line.substr(0, line.find('[') + 1)) + ']', indent);
    } else {
      append(line, indent);
    }
  }

  std::string text() && { return std::move(text_); }

 private:
  /// Adds a line without its indent. Commas are set anew, because neighbouring lines may have been left out.
  void append(std::string_view line, std::size_t indent) {
    const bool closes = indent < line.size() && (line[indent] == '}' || line[indent] == ']');
    const char last = text_.empty() ? '{' : text_.back();
    if (closes && last == ',') text_.pop_back();
    if (!closes && last != ',' && last != '{' && last != '[') text_ += ',';
    text_.append(line.substr(indent));
  }

  /// In the measures of a state, at most the keys of quantities are needed.
  bool is_needed(std::string_view line, std::size_t indent) {
    if (unneeded_ != 0) {
      if (indent == unneeded_) unneeded_ = 0;
      return false;
    }
    constexpr std::size_t state = 6;
    const auto key = key_of(line, indent);
    if (indent == state) in_measure_ = from_string<Measure>(key).has_value();
    if (keys_ == Keys::all || section_ != "states" || indent < state || !in_measure_ || kept_ != 0) return true;
    if (indent == state ? keys_ != Keys::none : key.empty() || keys_of_quantities().contains(key)) return true;
    if (line.back() == '{' || line.back() == '[') unneeded_ = indent;
    return false;
  }

  /// With one state, the nearest is the first.
  void take_nearest(std::string_view line) {
    const auto digits = line.substr(line.find(':') + 2);
    std::from_chars(digits.data(), digits.data() + digits.size(), nearest_);
    append(states_ == States::all || digits.front() == 'n' ? line : "  \"nearest\": 0,", 2);
  }

  bool is_long_list(std::string_view line, std::size_t indent) {
    if (keys_ == Keys::quantities && line.ends_with("\"angle_bins\": {")) kept_ = indent;
    const bool kept = kept_ != 0;
    if (kept && indent == kept_ && line[indent] == '}') kept_ = 0;
    if (kept || indent < 4 || section_ == "spec" || section_ == "provenance") return false;
    return (line.ends_with("]") || line.ends_with("],")) && !key_of(line, indent).empty();
  }

  States states_;
  Keys keys_;
  std::string text_;
  std::string_view section_;  ///< key of the record's member
  std::size_t unneeded_ = 0;  ///< indent of an object inside a state that is left out
  std::size_t kept_ = 0;      ///< indent of the histogram of angles that is being read
  long nearest_ = -1, state_ = 0;
  bool dropped_ = false, in_measure_ = false;
};

}  // namespace

std::string abridged(std::string_view text, const Abridgement& kept) {
  Shortener shortener(kept);
  while (!text.empty()) {
    const auto end = std::min(text.find('\n'), text.size());
    shortener.take(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return std::move(shortener).text();
}

}  // namespace isojam
