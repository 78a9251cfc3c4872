#include "tasks/io/json.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

template class nlohmann::basic_json<nlohmann::ordered_map>;

namespace isojam {
namespace {

bool is_scalar(const Json& value) { return value.is_primitive(); }

void append_pretty(const Json& value, int indent, std::string& out) {
  const bool flat = value.is_array() && std::all_of(value.begin(), value.end(), is_scalar);
  if (is_scalar(value) || flat || value.empty()) {
    if (!flat || value.empty()) {
      out += value.dump();
      return;
    }
    out += '[';
    for (std::size_t i = 0; i < value.size(); ++i) out += (i ? ", " : "") + value[i].dump();
    out += ']';
    return;
  }
  const std::string margin(static_cast<std::size_t>(indent) + 2, ' ');
  out += value.is_object() ? "{\n" : "[\n";
  bool first = true;
  for (const auto& item : value.items()) {
    out += (first ? "" : ",\n") + margin;
    if (value.is_object()) out += Json(item.key()).dump() + ": ";
    append_pretty(item.value(), indent + 2, out);
    first = false;
  }
  out += '\n' + std::string(static_cast<std::size_t>(indent), ' ') + (value.is_object() ? '}' : ']');
}

}  // namespace

std::string pretty(const Json& value) {
  std::string out;
  append_pretty(value, 0, out);
  return out + '\n';
}

std::string compact(const Json& value) { return value.dump(); }

Json parsed(std::string_view text, bool throws) { return Json::parse(text, nullptr, throws); }

void put_number(Json& object, std::string_view key, double value) {
  if (std::isfinite(value)) {
    object[key] = value;
  } else {
    put_absent(object, key, std::isnan(value) ? "not a number" : "infinite");
  }
}

void put_absent(Json& object, std::string_view key, std::string_view reason) {
  assert(!reason.empty());
  object[key] = nullptr;
  object[std::string(key) + "_reason"] = reason;
}

std::string pointer_step(std::string_view name) {
  if (name.find_first_of("~/") == std::string_view::npos) return std::string("/").append(name);
  std::string step = "/";
  for (const char c : name) step += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
  return step;
}

}  // namespace isojam
