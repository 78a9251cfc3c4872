#pragma once

#include <compare>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "engine/geometry/convex_solid.hpp"

namespace isojam {

/// A solid of which packings consist. It is a value type with the size of a pointer. Equal solids with the same name
/// share one ConvexSolid, which exists until the program ends, so packings may store pointers to it. Solids are ordered
/// as in lists and tables: first the Platonic solids as in all_solids, then the other built-in solids, then
/// user-defined solids by name and vertices.
class Solid {
 public:
  /// The Platonic solid with this SolidKind.
  Solid(SolidKind kind) : solid_(&platonic(kind)) {}  // NOLINT(google-explicit-constructor): a kind is a solid
  /// The built-in solid with this name, see named_vertices(). nullopt if there is none.
  static std::optional<Solid> named(std::string_view name);
  /// The convex hull of `vertices`. Throws NoSolid under the same conditions as the constructor of ConvexSolid.
  static Solid made_of(const std::string& name, std::span<const Eigen::Vector3d> vertices);
  /// The Solid to which a ConvexSolid of a packing belongs. The ConvexSolid must have been obtained from a Solid.
  static Solid of(const ConvexSolid& solid) { return Solid(solid); }

  /// The polyhedron.
  const ConvexSolid& operator*() const { return *solid_; }
  /// The polyhedron's members.
  const ConvexSolid* operator->() const { return solid_; }

  /// True if the solid is user-defined by its vertices.
  bool is_defined() const { return !solid_->given().empty(); }

  friend bool operator==(const Solid& a, const Solid& b) { return a.solid_ == b.solid_; }
  friend std::strong_ordering operator<=>(const Solid& a, const Solid& b);

 private:
  explicit Solid(const ConvexSolid& solid) : solid_(&solid) {}

  const ConvexSolid* solid_;
};

/// Name of the solid.
inline std::string_view to_string(const Solid& solid) { return solid->name(); }

}  // namespace isojam
