#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "tasks/io/place.hpp"

// One description per field. Beside a struct whose members are fields of a file stands one function:
//
//   struct Bins { long below = 0; std::vector<long> counts; };
//
//   inline void describe(Fields& field, Bins& bins) {
//     field.type("bins", "Histogram of gaps, of forces or of angles.");
//     field("below", bins.below, "Number of values below the first bin.");
//     field("counts", bins.counts, "Number of values in each bin.");
//   }
//
// From it follow written(bins), read<Bins>(place) and fields_of<Bins>(), and from the fields the schema, the page of
// fields, the columns of tables and the quantities of a measure (tasks/io/fields.hpp). The order of the fields is that
// of the file. A member may be a number, a bool, a text, an enumerator with a name, a Reasoned value, another described
// struct, an optional of one of these (absent in the file if it has no value), a list of these, or a Custom value. A
// key with stars stands for keys with numbers from 1 in their place: with `kind_*`, the elements of a list are the
// fields kind_1, kind_2, …; with `Z_*_*`, the fields Z_1_1, Z_1_2, … are the elements of a list of lists.

namespace isojam {

inline constexpr Range any_number{-std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
inline constexpr Range not_negative{0, std::numeric_limits<double>::max()};
inline constexpr Range positive{0, std::numeric_limits<double>::max(), true};
/// Counts that a double represents exactly.
inline constexpr Range count_range{0, 9007199254740992};

/// A value, or the reason why there is none. In a file: the value, or null and the field with the ending `_reason`.
template <class T = double>
struct Reasoned {
  std::optional<T> value = std::nullopt;
  std::string reason = {};
};
/// The value with the reason that counts if there is none.
template <class T>
Reasoned<T> reasoned(std::optional<T> value, std::string_view reason) {
  if (value) return {std::move(value), ""};
  return {std::nullopt, std::string(reason)};
}

/// Quantities with a common table.
struct QuantityGroup {
  std::string_view name;     ///< title of the table
  std::string_view meaning;  ///< one sentence about the quantities, printed below the title

  friend constexpr bool operator==(const QuantityGroup& a, const QuantityGroup& b) { return a.name == b.name; }
};

/// A text of a description. Literals are not copied, because each object that is read or written is described anew.
class Words : public std::string_view {
 public:
  // NOLINTBEGIN(google-explicit-constructor): a text of any kind is a text
  Words(const char* literal = "") : std::string_view(literal) {}
  Words(std::string text) : Words(std::make_shared<const std::string>(std::move(text))) {}
  operator std::string() const { return {data(), size()}; }
  // NOLINTEND(google-explicit-constructor)

 private:
  explicit Words(std::shared_ptr<const std::string> text) : std::string_view(*text), owned_(std::move(text)) {}
  std::shared_ptr<const std::string> owned_ = nullptr;
};

/// What tables add to a field that is a quantity.
struct Column {
  Words name = {};           ///< name in tables: the symbol of the paper, if there is one
  QuantityGroup group = {};  ///< the table of main_group is the first one
  Words latex = {};
  Words meaning = {};  ///< among all quantities, if that of the field is clear only inside its object
  /// Quantities of a group are sorted by this number; those with the same number have the order of the file.
  int place = 0;
  bool proportion = false;  ///< true if each value is 0 or 1, so that the mean is a proportion
  /// smallest number of kinds of particles for which a packing has the quantity
  int kinds = 1;
  bool cohesive = false;  ///< true if only packings with cohesion at zero pressure have the quantity
};

class Fields;
template <class T>
concept Described = std::is_class_v<T> && requires(Fields& fields, T& object) {
  describe(fields, object);
};

// ---- References to members, by kind. They are valid as long as the described object. ------------------------------
struct MemberRef;
struct Integer {
  std::function<std::int64_t()> get;
  std::function<void(std::int64_t)> set;
  double most = 0;
};
struct Choice {
  std::span<const std::string_view> names;
  std::function<std::size_t()> get;
  std::function<void(std::size_t)> set;
};
struct Nested {
  std::function<void(Fields&)> describe;
};
struct Many {
  std::function<std::size_t()> size;
  std::function<void(std::size_t)> resize;
  std::function<MemberRef(std::size_t)> at;
  std::function<MemberRef()> example;                                     ///< an element with default values
  std::size_t least = 0, most = std::numeric_limits<std::size_t>::max();  ///< allowed numbers of elements
  bool all_different = false;                                             ///< true if no two elements may be equal
  /// Only for lists of numbers: reads all of them, or returns false if one is not an allowed number. Long lists would
  /// take too long if a reference were made to each element.
  std::function<bool(const Json& list, const std::optional<Range>& allowed)> numbers = nullptr;
};
struct Maybe {
  std::function<bool()> has;
  std::function<MemberRef()> value;  ///< makes a value if there is none
  std::function<void()> clear;
  std::function<MemberRef()> example;  ///< a value with default values
  std::string* reason = nullptr;       ///< of a Reasoned value
};
/// A value that no struct describes, for example a choice between a number and a list. It has its own schema, which
/// may contain definitions.
struct Custom {                 // NOLINT(bugprone-exception-escape): to move Json throws nothing
  std::function<Json()> write;  ///< null if the field is absent
  std::function<void(const JsonPlace&)> read;
  Json schema = nullptr;
  std::string kind = {};  ///< the allowed values in words, for the page of fields
  /// fields of the value, if it is an object; it then needs no schema
  std::function<void(Fields&)> fields = nullptr;
};

struct MemberRef : std::variant<double*, bool*, std::string*, Integer, Choice, Nested, Many, Maybe, Custom> {
  using variant::variant;
};

enum class Presence : std::uint8_t {
  always,    ///< a file without the field is refused
  optional,  ///< if a file lacks the field, it keeps the value of a default-constructed object
  if_true,   ///< written only if the bool is true
  if_any,    ///< written only if the list has entries
};

/// A copy of the text with a number in place of the first star.
std::string numbered(std::string_view text, std::size_t number);

/// All that is known of a field. Its functions can be chained behind the call that adds it.
struct FieldEntry {
  Words key, meaning;  ///< the meaning is a sentence in Markdown; empty if the type of the field has one
  MemberRef member;
  Words unit_name = {};                  ///< empty if the meaning states it or the field is a pure number
  std::optional<Range> allowed = {};     ///< by default any number, and integers from 0 to 2^53
  Presence presence = Presence::always;  ///< an std::optional is always optional
  bool finite_only = false;              ///< true if the number is never infinite or NaN, and so never null
  bool apart = false;                    ///< true if a record has the field among its details
  bool writes_null = false;              ///< true if a Custom value that is null is written, without a reason
  Column quantity = {};                  ///< without name if tables do not have it

  FieldEntry& unit(const Words& name) { return unit_name = name, *this; }
  FieldEntry& range(const Range& range) { return allowed = range, *this; }
  FieldEntry& optional() { return presence = Presence::optional, *this; }
  FieldEntry& if_true() { return presence = Presence::if_true, *this; }
  FieldEntry& if_any() { return presence = Presence::if_any, *this; }
  FieldEntry& finite() { return finite_only = true, *this; }
  /// For a list: the allowed numbers of elements, and that they all differ.
  FieldEntry& length(std::size_t least, std::size_t most = std::numeric_limits<std::size_t>::max()) {
    std::get<Many>(member).least = least;
    return std::get<Many>(member).most = most, *this;
  }
  FieldEntry& distinct() { return std::get<Many>(member).all_different = true, *this; }
  FieldEntry& nulls() { return writes_null = true, *this; }
  FieldEntry& detail() { return apart = true, *this; }
  FieldEntry& column(const Column& column) { return quantity = column, *this; }
};

template <class T>
MemberRef ref_to(T& member);

/// The fields of one object, in the order of the file.
class Fields {
 public:
  /// Names a type that several fields have, with its meaning.
  void type(const Words& name, const Words& meaning) {
    type_name = name;
    type_meaning = meaning;
  }
  /// Adds a field.
  template <class T>
  FieldEntry& operator()(const Words& key, T& member, const Words& meaning) {
    return this->member(key, ref_to(member), meaning);
  }
  /// Adds a field whose fields `describe` adds, for a struct whose description needs more than the object.
  FieldEntry& nested(Words key, std::function<void(Fields&)> describe, Words meaning) {
    return member(std::move(key), Nested{std::move(describe)}, std::move(meaning));
  }
  FieldEntry& custom(Words key, Custom value, Words meaning) {
    return member(std::move(key), std::move(value), std::move(meaning));
  }
  /// Adds a field with a reference that the caller has made.
  FieldEntry& member(Words key, MemberRef ref, Words meaning) {
    if (list.empty()) list.reserve(32);  // moving the entries to a longer list takes long
    return list.emplace_back(FieldEntry{std::move(key), std::move(meaning), std::move(ref)});
  }

  Words type_name, type_meaning;
  std::vector<FieldEntry> list;
  bool are_all = true;   ///< false if the object has other keys, which are read elsewhere
  Json rules = nullptr;  ///< members of the object's schema for rules across fields
  /// The error for the old name of a key suggests the new one.
  std::vector<std::pair<std::string, std::string>> renamed = {};
  /// The error for a key that was removed says what to do instead.
  std::vector<std::pair<std::string, std::string>> removed = {};
};

// ---- Writing and reading --------------------------------------------------------------------------------------------
/// The fields of a default-constructed object, with references into it. The object lives as long as the program; it
/// must not be changed.
template <class T>
Fields fields_of() {
  static T example{};
  Fields fields;
  describe(fields, example);
  return fields;
}

Json written(const Fields& fields);
/// The JSON of a described object.
template <Described T>
Json written(const T& object) {
  Fields fields;
  // One describe() serves reading and writing. Writing changes nothing.
  describe(fields, const_cast<T&>(object));  // NOLINT(cppcoreguidelines-pro-type-const-cast)
  return written(fields);
}

enum class Missing : bool { refused, kept };

/// Reads into the described object, with every bit. Throws InputError, or notes one for each wrong field if the place
/// collects them. The error has the file, the JSON pointer and the allowed values. Keys that the description does not
/// have are refused. With Missing::kept, fields that are absent keep their values.
void read_into(const JsonPlace& place, const Fields& fields, Missing missing = Missing::refused);
template <Described T>
void read_into(const JsonPlace& place, T& object, Missing missing = Missing::refused) {
  Fields fields;
  describe(fields, object);
  read_into(place, fields, missing);
}
template <Described T>
T read(const JsonPlace& place) {
  T object{};
  read_into(place, object);
  return object;
}
/// Reads a whole document of the program, and throws one InputError with all errors.
template <Described T>
T read_document(const Json& document, const std::string& file) {
  Problems problems(false);
  T object{};
  const JsonPlace place(document, file, "", &problems);
  place.attempt([&] { read_into(place, object); });
  problems.refuse_any(document);
  return object;
}
/// Reads the value of one field, and writes it.
void read_into(const JsonPlace& value, const FieldEntry& entry);
Json written(const FieldEntry& entry);
/// Copies the value of a number, a bool, a text or an enumerator to the same member of another object.
void copy_value(const MemberRef& from, const MemberRef& to);

// ---- Kinds of members -----------------------------------------------------------------------------------------------
namespace kinds {

template <class T>
MemberRef example_of() {
  static T example{};
  return ref_to(example);
}

/// One of some enumerators.
template <const auto& values, NamedEnum T>
Choice among(T& member) {
  static constexpr auto names = [] {
    std::array<std::string_view, values.size()> list{};
    for (std::size_t k = 0; k < list.size(); ++k) list[k] = to_string(values[k]);
    return list;
  }();
  return {names,
          [&member] {
            std::size_t k = 0;
            while (values[k] != member) ++k;
            return k;
          },
          [&member](std::size_t k) { member = values[k]; }};
}

template <class T>
struct Kind {
  static MemberRef of(T& member) requires std::integral<T> {
    return Integer{[&member] { return static_cast<std::int64_t>(member); },
                   [&member](std::int64_t value) { member = static_cast<T>(value); },
                   static_cast<double>(std::numeric_limits<T>::max())};
  }
  static MemberRef of(T& member) requires NamedEnum<T> { return among<all_of<T>>(member); }
  static MemberRef of(T& member) requires Described<T> {
    return Nested{[&member](Fields& fields) { describe(fields, member); }};
  }
};
template <class List>
bool read_numbers(List& numbers, const Json& list, const std::optional<Range>& allowed) {
  using T = typename List::value_type;
  Range range = allowed.value_or(std::integral<T> ? count_range : any_number);
  range.high = std::min(range.high, static_cast<double>(std::numeric_limits<T>::max()));
  for (std::size_t k = 0; k < list.size(); ++k) {
    std::conditional_t<std::integral<T>, std::optional<std::int64_t>, std::optional<double>> number;
    if constexpr (std::integral<T>) {
      number = accepted_integer(list[k], range);
    } else {
      number = accepted_number(list[k], range);
    }
    if (!number) return false;
    numbers[k] = static_cast<T>(*number);
  }
  return true;
}
template <class List>
Many list_of(List& member) {
  using T = typename List::value_type;
  Many many{[&member] { return member.size(); },
            [&](std::size_t size) {
              if constexpr (requires { member.resize(size); }) member.resize(size);
            },
            [&member](std::size_t k) { return ref_to(member[k]); }, example_of<T>};
  if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>)
    many.numbers = [&member](const Json& list, const std::optional<Range>& allowed) {
      return read_numbers(member, list, allowed);
    };
  return many;
}
template <class T>
struct Kind<std::vector<T>> {
  static MemberRef of(std::vector<T>& member) { return list_of(member); }
};
template <class T, std::size_t n>
struct Kind<std::array<T, n>> {
  static MemberRef of(std::array<T, n>& member) {
    auto many = list_of(member);
    many.least = many.most = n;
    return many;
  }
};
template <class T>
Maybe maybe(std::optional<T>& value, std::string* reason) {
  return {[&value] { return value.has_value(); }, [&value] { return ref_to(value ? *value : value.emplace()); },
          [&value] { value.reset(); }, example_of<T>, reason};
}
template <class T>
struct Kind<std::optional<T>> {
  static MemberRef of(std::optional<T>& member) { return maybe(member, nullptr); }
};
template <class T>
struct Kind<Reasoned<T>> {
  static MemberRef of(Reasoned<T>& member) { return maybe(member.value, &member.reason); }
};

}  // namespace kinds

template <class T>
MemberRef ref_to(T& member) {
  if constexpr (std::is_same_v<T, double> || std::is_same_v<T, bool> || std::is_same_v<T, std::string>) {
    return &member;
  } else {
    return kinds::Kind<T>::of(member);
  }
}

}  // namespace isojam
