#pragma once

#include <compare>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "engine/geometry/convex_solid.hpp"

namespace isojam {

/// A solid from which packings are made: a value with the size of a pointer. Equal solids with the same name share one
/// ConvexSolid, which lives until the program ends, so that packings may point to it. Order, as in lists and tables:
/// the Platonic solids as in all_solids, the other built-in solids, then the rest by name and vertices.
class Solid {
 public:
  /// The Platonic solid of a kind.
  Solid(SolidKind kind) : solid_(&platonic(kind)) {}  // NOLINT(google-explicit-constructor): a kind is a solid
  /// The built-in solid with this name (named_vertices); nullopt if there is none.
  static std::optional<Solid> named(std::string_view name);
  /// The convex hull of `vertices`. Throws NoSolid like ConvexSolid.
  static Solid made_of(const std::string& name, std::span<const Eigen::Vector3d> vertices);
  /// The Solid for a packing's ConvexSolid, which must come from a Solid.
  static Solid of(const ConvexSolid& solid) { return Solid(solid); }

  /// The polyhedron.
  const ConvexSolid& operator*() const { return *solid_; }
  /// The polyhedron's members.
  const ConvexSolid* operator->() const { return solid_; }

  /// True if the user defined the solid by its vertices.
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
