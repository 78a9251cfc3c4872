#include <algorithm>

#include "tasks/manifest/manifest.hpp"

namespace isojam {
namespace {

bool has_entry(const Json& list, const Json& entry) { return std::find(list.begin(), list.end(), entry) != list.end(); }

/// True if every list of `part` is contained in the list of `whole` with the same name, and there are no other lists.
bool contains_lists(const Json& whole, const Json& part) {
  if (whole.size() != part.size()) return false;
  for (const auto& item : part.items()) {
    if (!whole.contains(item.key())) return false;
    const auto& list = whole.at(item.key());
    if (!std::all_of(item.value().begin(), item.value().end(),
                     [&](const Json& entry) { return has_entry(list, entry); }))
      return false;
  }
  return true;
}

/// True if every user-defined solid of `part` has the same definition in `whole`.
bool contains_solids(const Json& whole, const Json& part) {
  if (!part.contains("solids")) return true;
  for (const auto& item : part.at("solids").items()) {
    if (!whole.contains("solids") || !whole.at("solids").contains(item.key()) ||
        whole.at("solids").at(item.key()) != item.value())
      return false;
  }
  return true;
}

}  // namespace

bool contains_sweep(const Manifest& whole, const Manifest& part) {
  auto a = identity(whole), b = identity(part);
  if (!contains_lists(a.at("sweep"), b.at("sweep")) || !contains_solids(a, b)) return false;
  for (auto* json : {&a, &b}) {
    for (const auto* key : {"sweep", "solids", "measure"}) json->erase(key);
    json->at("protocol").erase("by_solid");
  }
  return a == b;
}

}  // namespace isojam
