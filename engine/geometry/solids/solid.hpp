#pragma once

#include <compare>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "engine/geometry/convex_solid.hpp"

namespace isojam {

/// One of the solids that packings are made of: a value the size of a pointer. Equal solids of one name are one
/// ConvexSolid, which lives as long as the program, so that packings may point to it. Ordered as lists and tables are:
/// the Platonic solids in the order of all_solids, the others that have names of their own, then by name and vertices.
class Solid {
 public:
  /// The Platonic solid of that kind.
  Solid(SolidKind kind) : solid_(&platonic(kind)) {}  // NOLINT(google-explicit-constructor): is one of them
  /// The solid with that name of its own (named_vertices); nullopt if there is none.
  static std::optional<Solid> named(std::string_view name);
  /// The hull of `vertices`. Throws NoSolid as ConvexSolid does.
  static Solid made_of(const std::string& name, std::span<const Eigen::Vector3d> vertices);
  /// The one that a packing points to, which must be one of these.
  static Solid of(const ConvexSolid& solid) { return Solid(solid); }

  /// Its geometry.
  const ConvexSolid& operator*() const { return *solid_; }
  /// Members of its geometry.
  const ConvexSolid* operator->() const { return solid_; }

  /// Whether it has to be defined by vertices.
  bool is_defined() const { return !solid_->given().empty(); }

  friend bool operator==(const Solid& a, const Solid& b) { return a.solid_ == b.solid_; }
  friend std::strong_ordering operator<=>(const Solid& a, const Solid& b);

 private:
  explicit Solid(const ConvexSolid& solid) : solid_(&solid) {}

  const ConvexSolid* solid_;
};

/// Its name.
inline std::string_view to_string(const Solid& solid) { return solid->name(); }

}  // namespace isojam
