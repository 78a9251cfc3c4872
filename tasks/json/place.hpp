#pragma once

#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/names/enum_names.hpp"
#include "tasks/json/input_error.hpp"
#include "tasks/json/json.hpp"

namespace isojam {

/// An interval of numbers; its ends belong to it unless excluded.
struct Range {
  double low = 0, high = 0;
  bool low_excluded = false, high_excluded = false;

  bool contains(double x) const {
    return (low_excluded ? x > low : x >= low) && (high_excluded ? x < high : x <= high);
  }
};

/// "a number in (0, 1]", "an integer from 1 to 20".
std::string number_in(const Range& range);
std::string integer_in(const Range& range);

/// `"a", "b", "c"`
std::string quoted_list(std::span<const std::string_view> names);

/// The candidate nearest to `word` by edit distance; empty if none is near enough.
std::string nearest_name(std::string_view word, std::span<const std::string_view> candidates);

/// Errors of a document, collected while it is read. Only the first error of a place is kept, because others there
/// follow from it.
class Problems {
 public:
  void note(const InputError& error);
  /// Suppresses errors at this place, because they follow from an error at another place.
  void settle(std::string pointer) { settled_.insert(std::move(pointer)); }
  /// Throws all collected errors as one InputError, in the order of the document. Missing keys come at the position of
  /// their object.
  void refuse_any(const Json& document) const;

 private:
  std::vector<InputError::Details> found_;
  std::set<std::string> settled_;
};

/// A value of a document with its location, for error messages. Refers to the document and must not outlive it. Every
/// reader throws InputError.
class JsonPlace {
 public:
  /// With `problems`, errors are collected instead of ending at the first: see attempt().
  JsonPlace(const Json& value, std::string file, std::string pointer = "", Problems* problems = nullptr)
      : value_(value), file_(std::move(file)), pointer_(std::move(pointer)), problems_(problems) {}

  const Json& value() const { return value_; }
  const std::string& file() const { return file_; }
  const std::string& pointer() const { return pointer_; }

  bool has(const std::string& key) const { return value_.contains(key); }
  JsonPlace at(const std::string& key) const;  ///< throws if the value is no object or lacks the key
  JsonPlace at(std::size_t index) const;

  [[noreturn]] void refuse(std::string problem, std::string allowed = "", std::string suggestion = "") const;

  /// Calls `work` and returns true unless it threw an InputError that was collected. Rethrows if errors are not
  /// collected.
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
  /// Attempts `work` on the value of a required key, or of an optional one.
  template <class Work>
  void read(const std::string& key, const Work& work) const {
    attempt([&] { work(at(key)); });
  }
  template <class Work>
  void read_if_any(const std::string& key, const Work& work) const {
    if (has(key)) read(key, work);
  }

  void expect_object(std::string_view allowed) const;
  std::size_t expect_list(std::string_view allowed) const;  ///< returns its size
  /// Refuses an object with a key that is not in `names`. `elsewhere` may give a better suggestion.
  void expect_keys(std::span<const std::string_view> names, std::string (*elsewhere)(std::string_view) = nullptr) const;

  double number(const Range& range) const;
  std::int64_t integer(const Range& range) const;
  bool boolean() const;
  std::string text(std::string_view allowed = "a string") const;
  /// Index in `names`.
  std::size_t choice(std::span<const std::string_view> names) const;
  /// The enumerator of that name.
  template <NamedEnum Enum>
  Enum choice() const {
    return all_of<Enum>[choice(all_names<Enum>)];
  }

 private:
  [[noreturn]] void wrong_type(std::string_view allowed) const;

  const Json& value_;
  std::string file_, pointer_;
  Problems* problems_;
};

}  // namespace isojam
