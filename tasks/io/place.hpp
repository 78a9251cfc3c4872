#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/names/enum_names.hpp"
#include "tasks/io/input_error.hpp"
#include "tasks/io/json.hpp"

namespace isojam {

/// An interval of numbers. It includes each end that is not marked as excluded.
struct Range {
  double low = 0, high = 0;
  bool low_excluded = false, high_excluded = false;

  bool contains(double x) const {
    return (low_excluded ? x > low : x >= low) && (high_excluded ? x < high : x <= high);
  }
};

/// The number, if the value is one in the range. They are inline because the lists of records are long.
inline std::optional<double> accepted_number(const Json& value, const Range& range) {
  if (!value.is_number()) return std::nullopt;
  const auto x = value.get<double>();
  return range.contains(x) ? std::optional(x) : std::nullopt;
}
inline std::optional<std::int64_t> accepted_integer(const Json& value, const Range& range) {
  if (!value.is_number_integer()) return std::nullopt;
  // Compare as double first: a number beyond 2^63 must be too large, not negative. Then compare exactly.
  const auto n = value.get<std::int64_t>();
  const bool accepted = range.contains(value.get<double>()) && n <= static_cast<std::int64_t>(range.high);
  return accepted ? std::optional(n) : std::nullopt;
}

/// Texts that describe the allowed numbers: "a number in (0, 1]", "an integer from 1 to 20".
std::string number_in(const Range& range);
std::string integer_in(const Range& range);

/// The names in quotation marks: `"a", "b", "c"`.
std::string quoted_list(std::span<const std::string_view> names);
/// `"a"` for one name, `one of "a", "b", "c"` for several.
std::string one_of(std::span<const std::string_view> names);

/// The candidate that is most similar to `word`, according to the edit distance. If no candidate is similar enough, the
/// only candidate that begins with `word`, or an empty text.
std::string nearest_name(std::string_view word, std::span<const std::string_view> candidates);

/// Error message for an unknown name: `unknown flag "x"; did you mean "y"?`. If no name is similar, the message lists
/// all names: `unknown flag "x"; expected one of …`. The text `besides` precedes the list.
std::string unknown_name(std::string_view kind, std::string_view name, std::span<const std::string_view> names,
                         std::string_view besides = "");

/// Collects the errors of a document while it is read. For each JSON pointer it stores only the first error, because
/// later errors at the same value are consequences of it.
class Problems {
 public:
  /// The remedy of a missing key is to add it, except in a file of the program.
  explicit Problems(bool of_user = true) : of_user_(of_user) {}
  bool of_user() const { return of_user_; }
  void note(const InputError& error);
  /// Suppresses later errors at this JSON pointer, because they are consequences of an error at another pointer.
  void settle(std::string pointer) { settled_.insert(std::move(pointer)); }
  /// True if there is an error at this JSON pointer, inside this value or around it.
  bool concern(std::string_view pointer) const;
  /// If errors were collected, throws one InputError with all of them, in the order of the document. After the first
  /// 100 errors, it states only how many more there are. If a required key is missing, the error is listed at
  /// the position of the object that lacks this key.
  void refuse_any(const Json& document) const;

 private:
  bool of_user_;
  std::vector<InputError::Details> found_;
  std::set<std::string> settled_;
};

/// A value of a JSON document together with its location (file and JSON pointer), which error messages contain. The
/// document must outlive this object. All functions that read a value throw InputError if the value is not allowed.
class JsonPlace {
 public:
  /// If `problems` is given, attempt() collects errors in it. Otherwise the first error ends the reading.
  JsonPlace(const Json& value, std::string file, std::string pointer = "", Problems* problems = nullptr)
      : JsonPlace(value, std::make_shared<const std::string>(std::move(file)), std::move(pointer), problems) {}

  const Json& value() const { return value_; }
  const std::string& file() const { return *file_; }
  const std::string& pointer() const { return pointer_; }

  bool has(std::string_view key) const { return value_.contains(key); }
  JsonPlace at(std::string_view key) const;  ///< throws InputError if the value is not an object with this key
  JsonPlace at(std::size_t index) const;

  /// Throws an InputError for this value, with the allowed values.
  [[noreturn]] void refuse(std::string problem, std::string allowed = "", std::string suggestion = "") const;
  /// Throws an InputError for this value, with an instruction instead of the allowed values.
  [[noreturn]] void refuse_with_remedy(std::string problem, std::string remedy) const;
  /// Throws an InputError that states the value and the allowed values.
  [[noreturn]] void not_accepted(std::string_view allowed) const;

  /// False if errors are collected, and there is one at this value, inside it or around it. `inner` is the pointer from
  /// this value to one inside it.
  bool is_sound(std::string_view inner = "") const {
    return !problems_ || !problems_->concern(pointer_ + std::string(inner));
  }

  /// Calls `work`, and returns true if it does not throw. If it throws an InputError and errors are collected, adds the
  /// error to `problems` and returns false. If errors are not collected, the exception is not caught.
  template <class Work>
  bool attempt(const Work& work) const {
    try {
      work();
      return true;
    } catch (const InputError& error) {
      if (!problems_) throw;
      problems_->note(error);
      return false;
    }
  }
  /// Calls `work` with the value of a key, inside attempt(). The key is required for read(), and optional for
  /// read_if_any().
  template <class Work>
  void read(std::string_view key, const Work& work) const {
    attempt([&] { work(at(key)); });
  }
  template <class Work>
  void read_if_any(std::string_view key, const Work& work) const {
    if (has(key)) read(key, work);
  }

  void expect_object(std::string_view allowed) const;
  std::size_t expect_list(std::string_view allowed) const;  ///< returns the size of the list
  void expect_length(std::size_t length, std::string_view allowed) const;
  /// Throws unless the value is a list with 1 to `most` entries. Returns the number of entries.
  std::size_t expect_entries(std::size_t most, std::string_view allowed) const;
  /// Reports each key of the object that is not in `names`, inside attempt(). The error suggests the name that
  /// `elsewhere` returns for the key. If `elsewhere` is not given or returns an empty text, it suggests the most
  /// similar name.
  void expect_keys(std::span<const std::string_view> names,
                   const std::function<std::string(std::string_view)>& elsewhere = {}) const;

  double number(const Range& range) const;
  std::int64_t integer(const Range& range) const;
  bool boolean() const;
  std::string text(std::string_view allowed = "a string") const;
  /// Reads a text that must be one of `names`, and returns the index of this name.
  std::size_t choice(std::span<const std::string_view> names) const;
  /// Reads the name of an enumerator, and returns the enumerator.
  template <NamedEnum Enum>
  Enum choice() const {
    return all_of<Enum>[choice(all_names<Enum>)];
  }

 private:
  JsonPlace(const Json& value, std::shared_ptr<const std::string> file, std::string pointer, Problems* problems)
      : value_(value), file_(std::move(file)), pointer_(std::move(pointer)), problems_(problems) {}

  const Json& value_;
  std::shared_ptr<const std::string> file_;  ///< shared by all places of a document
  std::string pointer_;
  Problems* problems_;
};

}  // namespace isojam
