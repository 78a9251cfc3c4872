#include "tasks/records/abridged.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <system_error>
#include <utility>

#include "tasks/measure/trough_parts.hpp"
#include "tasks/records/record.hpp"

namespace isojam {
namespace {

constexpr std::string_view angles_key = angle_bins_pointer.substr(angle_bins_pointer.rfind('/') + 1);

/// Part of a value that is kept.
enum class Keep : std::uint8_t { short_lists, all };

/// Largest number of nested objects and lists.
constexpr int deepest = 30;

/// One step of hash_of().
std::uint64_t hashed(std::uint64_t hash, char c) { return (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U; }

/// Reads the text from the beginning to the end. The functions that read return false if the text is not as expected.
class Reader {
 public:
  Reader(std::string_view text, States states) : text_(text), states_(states) {}

  std::optional<Abridged> result() {
    Abridged found{Json::object(), ""};
    if (!record(found.record) || fmt::format("{:016x}", seal_) != checksum_) return std::nullopt;
    found.result_digest = fmt::format("{:016x}", digest_);
    return found;
  }

 private:
  /// The next character, or 0 at the end.
  char here() const { return at_ < text_.size() ? text_[at_] : '\0'; }

  /// Adds the next characters to the checksum, and also to the digest of the result if this part belongs to it.
  void take(std::size_t count) {
    auto seal = seal_, digest = digest_;
    for (const char c : text_.substr(at_, count)) {
      seal = hashed(seal, c);
      digest = hashed(digest, c);
    }
    seal_ = seal;
    if (digested_) digest_ = digest;
    at_ += count;
  }
  bool take_if(char expected) {
    if (here() != expected) return false;
    take(1);
    return true;
  }
  /// Whitespace between tokens does not belong to the result.
  void skip_space() {
    auto seal = seal_;
    for (; here() == '\n' || here() == ' '; ++at_) seal = hashed(seal, text_[at_]);
    seal_ = seal;
  }

  bool string(std::string_view& value) {
    if (here() != '"') return false;
    const auto end = std::min(text_.find('"', at_ + 1), text_.size() - 1);
    value = text_.substr(at_ + 1, end - at_ - 1);
    take(end + 1 - at_);
    const auto is_plain = [](char c) { return static_cast<unsigned char>(c) >= ' ' && c != '\\' && c != '"'; };
    return std::all_of(value.begin(), value.end(), is_plain);
  }

  bool scalar(Json& into) {
    const auto ends = [](char c) { return c == ',' || c == '\n' || c == ' ' || c == ']' || c == '}'; };
    const auto* const begin = text_.begin() + at_;
    const std::string_view token(begin, std::find_if(begin, text_.end(), ends));
    take(token.size());
    const auto number = [&]<class T>(T value) {
      const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), value);
      into = value;
      return error == std::errc() && end == token.data() + token.size();
    };
    if (token == "null" || token == "true" || token == "false") {
      if (token != "null") into = token == "true";
      return true;
    }
    if (token.find_first_of(".e") != std::string_view::npos) return number(double{});
    return token.starts_with('-') ? number(std::int64_t{}) : number(std::uint64_t{});
  }

  /// Reads the entries of a list or an object up to its last bracket.
  template <class Entry>
  bool entries(char last, const Entry& entry) {
    take(1);
    skip_space();
    if (take_if(last)) return true;
    do {
      skip_space();
      if (!entry()) return false;
      skip_space();
    } while (take_if(','));
    return take_if(last);
  }

  bool list(Json& into, Keep keep, int depth) {
    into = Json::array();
    const bool dropped = keep == Keep::short_lists && depth > 0;
    return entries(']', [&] { return dropped ? skip() : value(into.emplace_back(), keep, depth + 1); });
  }

  bool object(Json& into, Keep keep, int depth) {
    into = Json::object();
    return entries('}', [&] {
      std::string_view key;
      if (!string(key)) return false;
      // Json::emplace() would compare the key with all other ones.
      auto& child = into.get_ref<Json::object_t&>().emplace_back(std::string(key), nullptr).second;
      skip_space();
      if (!take_if(':')) return false;
      skip_space();
      return value(child, key == angles_key ? Keep::all : keep, depth + 1);
    });
  }

  bool value(Json& into, Keep keep, int depth) {
    if (depth == deepest) return false;
    if (here() == '{') return object(into, keep, depth);
    if (here() == '[') return list(into, keep, depth);
    if (here() != '"') return scalar(into);
    std::string_view text;
    if (!string(text)) return false;
    into = text;
    return true;
  }

  /// Skips a value that is not kept, up to the comma or bracket after it. Only brackets and strings are distinguished,
  /// because the checksum detects any damage.
  bool skip() {
    const auto ends = [](char c) {
      return c == ',' || c == '\n' || c == ' ' || c == '"' || c == '[' || c == ']' || c == '{' || c == '}';
    };
    const auto from = at_;
    for (int depth = 0; at_ < text_.size();) {
      const char c = here();
      std::string_view text;
      if (c == '"' && !string(text)) return false;
      if (c == '"') continue;
      const bool opens = c == '[' || c == '{', closes = c == ']' || c == '}';
      if (depth == 0 && (closes || c == ',')) break;
      depth += opens - closes;
      if (depth == deepest) return false;
      const auto* const begin = text_.begin() + at_;
      if (c != ' ' && c != '\n') take(static_cast<std::size_t>(std::find_if(begin + 1, text_.end(), ends) - begin));
      skip_space();
    }
    return at_ > from;
  }

  /// The checksum is that of the text with zeros in its place.
  bool checksum() {
    constexpr std::string_view zeros = "0000000000000000";
    if (!take_if('"') || text_.size() - at_ < zeros.size()) return false;
    checksum_ = text_.substr(at_, zeros.size());
    for (const char c : zeros) seal_ = hashed(seal_, c);
    at_ += zeros.size();
    return take_if('"');
  }

  bool member(Json& record) {
    const auto end = std::min(text_.find('"', at_ + 1), text_.size());
    const auto key = text_.substr(std::min(at_ + 1, end), end - std::min(at_ + 1, end));
    digested_ = is_in_result_digest(key);
    if (digested_) digest_ = hashed(digest_, std::exchange(digest_begun_, true) ? ',' : '{');
    std::string_view same;
    if (!string(same)) return false;
    skip_space();
    if (!take_if(':')) return false;
    skip_space();
    const auto keep = key == "spec" || key == "provenance" ? Keep::all : Keep::short_lists;
    const bool without_states = key == "states" && states_ == States::drop;
    if (without_states) record["states"] = Json::array();
    const bool good = key == "checksum"                 ? checksum()
                      : key == "path" || without_states ? skip()
                                                        : value(record[std::string(key)], keep, 0);
    skip_space();
    digested_ = false;
    return good;
  }

  bool record(Json& record) {
    if (here() != '{' || !entries('}', [&] { return member(record); })) return false;
    digest_ = hashed(digest_, '}');
    skip_space();
    return at_ == text_.size();
  }

  static constexpr std::uint64_t empty = 0xcbf29ce484222325U;  // hash_of("")

  std::string_view text_, checksum_;
  States states_;
  std::size_t at_ = 0;
  std::uint64_t seal_ = empty, digest_ = empty;
  bool digested_ = false, digest_begun_ = false;
};

}  // namespace

std::optional<Abridged> abridged(std::string_view text, States states) { return Reader(text, states).result(); }

}  // namespace isojam
