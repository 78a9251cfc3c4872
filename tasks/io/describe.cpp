#include "tasks/io/describe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <list>

namespace isojam {
namespace {

constexpr std::array<std::string_view, 2> not_finite{"infinite", "not a number"};

template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
decltype(auto) match(const MemberRef& member, Cases... cases) {
  return std::visit(Overloaded<Cases...>{std::move(cases)...}, static_cast<const MemberRef::variant&>(member));
}

// ---- Writing --------------------------------------------------------------------------------------------------------
Json value_of(const MemberRef& member) {
  return match(
      member, [](const double* value) { return Json(*value); }, [](const bool* value) { return Json(*value); },
      [](const std::string* value) { return Json(*value); }, [](const Integer& value) { return Json(value.get()); },
      [](const Choice& value) { return Json(value.names[value.get()]); },
      [](const Nested& object) {
        Fields fields;
        object.describe(fields);
        return written(fields);
      },
      [](const Many& list) {
        Json json = Json::array();
        for (std::size_t k = 0; k < list.size(); ++k) json.push_back(value_of(list.at(k)));
        return json;
      },
      [](const Maybe& value) { return value.has() ? value_of(value.value()) : Json(nullptr); },
      [](const Custom& value) { return value.write(); });
}

void write_field(Json& object, const FieldEntry& field, const MemberRef& member) {
  if (const auto* const number = std::get_if<double*>(&member)) return put_number(object, field.key, **number);
  if (const auto* const maybe = std::get_if<Maybe>(&member)) {
    if (maybe->has()) return write_field(object, field, maybe->value());
    if (maybe->reason) put_absent(object, field.key, *maybe->reason);
    return;
  }
  auto json = value_of(member);
  if (std::holds_alternative<Custom>(member) && json.is_null() && !field.writes_null) return;
  if (field.presence == Presence::if_true && json == false) return;
  if (field.presence == Presence::if_any && json.empty()) return;
  object[field.key] = std::move(json);
}

/// Calls `work` with the field, or if its key has stars with the fields for which it stands. `size` returns the number
/// of elements of a list, whose keys it is given.
template <class Size, class Work>
void for_each_numbered(const FieldEntry& field, const Size& size, const Work& work) {
  if (field.key.find('*') == std::string::npos) return work(field);
  const auto& list = std::get<Many>(field.member);
  const std::size_t count = size(list, field.key);
  for (std::size_t k = 0; k < count; ++k) {
    FieldEntry one = field;
    one.key = numbered(field.key, k + 1);
    one.member = list.at(k);
    for_each_numbered(one, size, work);
  }
}

// ---- Reading --------------------------------------------------------------------------------------------------------
double read_number(const JsonPlace& place, const FieldEntry& field) {
  return place.number(field.allowed.value_or(any_number));
}

Range integer_range(const FieldEntry& field, const Integer& integer) {
  auto range = field.allowed.value_or(count_range);
  range.high = std::min(range.high, integer.most);
  return range;
}

void read_list(const JsonPlace& place, const FieldEntry& field, const Many& list);

/// Reads a value that is not null.
void read_value(const JsonPlace& place, const FieldEntry& field, const MemberRef& member) {
  match(
      member, [&](double* value) { *value = read_number(place, field); },
      [&](bool* value) { *value = place.boolean(); }, [&](std::string* value) { *value = place.text(); },
      [&](const Integer& value) { value.set(place.integer(integer_range(field, value))); },
      [&](const Choice& value) { value.set(place.choice(value.names)); },
      [&](const Nested& object) {
        Fields fields;
        object.describe(fields);
        read_into(place, fields);
      },
      [&](const Many& list) { read_list(place, field, list); },
      [&](const Maybe& value) { read_value(place, field, value.value()); },
      [&](const Custom& value) { value.read(place); });
}

std::string allowed_length(const Many& list) {
  if (list.least == list.most) return fmt::format("a list of {}", list.least);
  if (list.most < std::numeric_limits<std::size_t>::max())
    return fmt::format("a list of {} to {}", list.least, list.most);
  return fmt::format("a list of {} or more", list.least);
}

void read_list(const JsonPlace& place, const FieldEntry& field, const Many& list) {
  const auto count = place.expect_list("a list");
  if (count < list.least || count > list.most)
    place.refuse(count == 0 ? "the list is empty" : "the list has the wrong length", allowed_length(list));
  list.resize(count);
  if (list.numbers && !list.all_different && list.numbers(place.value(), field.allowed)) return;
  const auto first = place.value().begin();
  for (std::size_t k = 0; k < count; ++k) {
    const auto entry = place.at(k);
    place.attempt([&] {
      const auto element = list.at(k);
      const auto* const maybe = std::get_if<Maybe>(&element);
      if (maybe && entry.value().is_null()) return maybe->clear();
      read_value(entry, field, element);
      const auto earlier = first + static_cast<std::ptrdiff_t>(k);
      if (list.all_different && std::find(first, earlier, entry.value()) != earlier)
        entry.refuse_with_remedy(fmt::format("{} is given twice", compact(entry.value())), "give each value once");
    });
  }
}

std::string reason_key(const FieldEntry& field) { return std::string(field.key) + "_reason"; }

double not_a_finite_number(const JsonPlace& object, const FieldEntry& field) {
  return object.at(reason_key(field)).choice(not_finite) == 0 ? std::numeric_limits<double>::infinity()
                                                              : std::numeric_limits<double>::quiet_NaN();
}

void read_null(const JsonPlace& object, const FieldEntry& field, const MemberRef& member) {
  if (auto* const* number = std::get_if<double*>(&member); number && !field.finite_only) {
    **number = not_a_finite_number(object, field);
    return;
  }
  const auto* const maybe = std::get_if<Maybe>(&member);
  if (!maybe) return read_value(object.at(field.key), field, member);
  if (!maybe->reason) return read_null(object, field, maybe->value());
  *maybe->reason = object.at(reason_key(field)).text();
  maybe->clear();
  if (std::find(not_finite.begin(), not_finite.end(), *maybe->reason) == not_finite.end()) return;
  const MemberRef value = maybe->value();
  if (auto* const* number = std::get_if<double*>(&value)) {
    **number = not_a_finite_number(object, field);
  } else {
    maybe->clear();
  }
}

void read_field(const JsonPlace& object, const FieldEntry& field) {
  const auto place = object.at(field.key);
  if (field.presence == Presence::if_true && place.value() != true) place.not_accepted("true");
  if (place.value().is_null()) return read_null(object, field, field.member);
  read_value(place, field, field.member);
}

/// Gives a list as many elements as the object has keys for them. Their numbers begin with 1 and have no gap.
std::size_t sized_by_keys(const JsonPlace& object, const Many& list, std::string_view key) {
  std::size_t count = 0;
  const auto has = [&](std::string name) {
    while (name.find('*') != std::string::npos) name = numbered(name, 1);
    return object.has(name);
  };
  while (has(numbered(key, count + 1))) ++count;
  list.resize(count);
  return count;
}

bool can_be_absent(const FieldEntry& field) {
  const auto* const maybe = std::get_if<Maybe>(&field.member);
  return field.presence != Presence::always || (maybe && !maybe->reason);
}

bool can_be_null(const FieldEntry& field, const MemberRef& member) {
  if (const auto* const maybe = std::get_if<Maybe>(&member))
    return maybe->reason || can_be_null(field, maybe->example());
  return std::holds_alternative<double*>(member) && !field.finite_only;
}

/// Refuses unknown keys of the object.
void check_keys(const JsonPlace& place, const std::vector<const FieldEntry*>& fields,
                const std::vector<std::pair<std::string, std::string>>& renamed) {
  constexpr std::string_view ending = "_reason";
  const auto is_known = [&](const auto& item) {
    const std::string_view key = item.key();
    const auto base = key.substr(0, key.ends_with(ending) ? key.size() - ending.size() : 0);
    return std::any_of(fields.begin(), fields.end(), [&](const FieldEntry* field) {
      return field->key == key || (field->key == base && can_be_null(*field, field->member));
    });
  };
  const auto items = place.value().items();
  if (place.value().is_object() && std::all_of(items.begin(), items.end(), is_known)) return;
  std::vector<std::string> known;
  for (const auto* field : fields) known.emplace_back(field->key);
  for (const auto* field : fields)
    if (can_be_null(*field, field->member)) known.push_back(reason_key(*field));
  place.expect_keys(std::vector<std::string_view>(known.begin(), known.end()), [&](std::string_view key) {
    for (const auto& [before, now] : renamed)
      if (before == key) return now;
    return std::string();
  });
}

/// Reads a number in its range. Returns false for any other value, which takes longer because errors need its place.
bool read_plainly(const Json& value, const FieldEntry& field, const MemberRef& member) {
  if (const auto* const maybe = std::get_if<Maybe>(&member))
    return value.is_number() && read_plainly(value, field, maybe->value());
  if (auto* const* const number = std::get_if<double*>(&member)) {
    const auto x = accepted_number(value, field.allowed.value_or(any_number));
    if (x) **number = *x;
    return x.has_value();
  }
  const auto* const integer = std::get_if<Integer>(&member);
  if (!integer) return false;
  const auto n = accepted_integer(value, integer_range(field, *integer));
  if (n) integer->set(*n);
  return n.has_value();
}

}  // namespace

std::string numbered(std::string_view text, std::size_t number) {
  std::string result(text);
  const auto star = result.find('*');
  return star == std::string::npos ? result : result.replace(star, 1, std::to_string(number));
}

Json written(const Fields& fields) {
  Json object = Json::object();
  for (const auto& field : fields.list)
    for_each_numbered(
        field, [](const Many& list, std::string_view) { return list.size(); },
        [&](const FieldEntry& one) { write_field(object, one, one.member); });
  return object;
}

void read_into(const JsonPlace& place, const Fields& fields, Missing missing) {
  for (const auto& removed : fields.removed)
    place.read_if_any(removed.first,
                      [&](const JsonPlace& value) { value.refuse_with_remedy("the key was removed", removed.second); });
  std::list<FieldEntry> numbered_fields;
  std::vector<const FieldEntry*> all;
  all.reserve(fields.list.size());
  const auto size = [&](const Many& list, std::string_view key) { return sized_by_keys(place, list, key); };
  for (const auto& field : fields.list)
    for_each_numbered(field, size, [&](const FieldEntry& one) {
      all.push_back(&one == &field ? &field : &numbered_fields.emplace_back(one));
    });
  if (fields.are_all) {
    check_keys(place, all, fields.renamed);
  } else if (!place.value().is_object()) {
    place.not_accepted("an object");
  }
  const Json& object = place.value();
  for (const auto* field : all) {
    const auto found = object.find(field->key);
    if (found == object.end() && (missing == Missing::kept || can_be_absent(*field))) continue;
    if (found != object.end() && read_plainly(*found, *field, field->member)) continue;
    place.attempt([&] { read_field(place, *field); });
  }
}

void read_into(const JsonPlace& value, const FieldEntry& entry) { read_value(value, entry, entry.member); }

Json written(const FieldEntry& entry) { return value_of(entry.member); }

void copy_value(const MemberRef& from, const MemberRef& to) {
  match(
      to, [&](double* value) { *value = *std::get<double*>(from); },
      [&](bool* value) { *value = *std::get<bool*>(from); },
      [&](std::string* value) { *value = *std::get<std::string*>(from); },
      [&](const Integer& value) { value.set(std::get<Integer>(from).get()); },
      [&](const Choice& value) { value.set(std::get<Choice>(from).get()); }, [](const auto&) { assert(false); });
}

}  // namespace isojam
