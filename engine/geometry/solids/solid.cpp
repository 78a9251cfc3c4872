#include "engine/geometry/solids/solid.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <mutex>
#include <tuple>
#include <utility>
#include <vector>

#include "engine/geometry/solids/named_solids.hpp"

namespace isojam {

namespace {

using Vertices = std::vector<std::array<double, 3>>;
using Key = std::pair<std::string, Vertices>;

Vertices coordinates_of(std::span<const Eigen::Vector3d> vertices) {
  Vertices result;
  for (const Eigen::Vector3d& v : vertices) result.push_back({v.x(), v.y(), v.z()});
  return result;
}

/// All solids that were requested so far, with their names and vertices as keys. Several threads may use it at the same
/// time.
class SolidRegistry {
 public:
  template <class Make>
  const ConvexSolid& get(Key key, const Make& make) {
    const std::scoped_lock lock(mutex_);
    auto found = solids_.find(key);
    if (found == solids_.end()) found = solids_.emplace(std::move(key), std::make_unique<ConvexSolid>(make())).first;
    return *found->second;
  }

 private:
  std::mutex mutex_;
  std::map<Key, std::unique_ptr<const ConvexSolid>> solids_;
};

SolidRegistry& registry() {
  static SolidRegistry solids;
  return solids;
}

/// Index of the name in named_solids(). A name that is not in the list has the index after the last one, so that prisms
/// come after the other built-in solids.
std::ptrdiff_t place_of(std::string_view name) {
  const auto names = named_solids();
  return std::find(names.begin(), names.end(), name) - names.begin();
}

}  // namespace

std::optional<Solid> Solid::named(std::string_view name) {
  if (const auto kind = from_string<SolidKind>(name)) return Solid(*kind);
  const auto vertices = named_vertices(name);
  if (!vertices) return std::nullopt;
  const std::string key_name(name);
  return Solid(registry().get({key_name, {}}, [&] { return ConvexSolid(key_name, *vertices); }));
}

Solid Solid::made_of(const std::string& name, std::span<const Eigen::Vector3d> vertices) {
  return Solid(registry().get({name, coordinates_of(vertices)}, [&] { return ConvexSolid(name, vertices); }));
}

std::strong_ordering operator<=>(const Solid& a, const Solid& b) {
  if (a == b) return std::strong_ordering::equal;
  const auto key = [](const Solid& solid) {
    return std::tuple(solid.is_defined(), place_of(solid->name()), solid->name());
  };
  if (const auto order = key(a) <=> key(b); std::is_neq(order)) return order;
  return coordinates_of(a->given()) < coordinates_of(b->given()) ? std::strong_ordering::less
                                                                 : std::strong_ordering::greater;
}

}  // namespace isojam
