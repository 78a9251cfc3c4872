#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "engine/geometry/convex_solid.hpp"

namespace isojam {

/// A particle as a mixture names it: a solid of unit volume, in a size, and which kind of the mixture's it is.
struct Particle {
  const ConvexSolid* unit;  ///< immutable, outlives every packing that has it
  double scale = 1;         ///< of its lengths
  int kind = 0;             ///< by number, from 0

  bool operator==(const Particle& other) const = default;
};

/// What a packing is made of: the solid of every particle, in their order. A value; copies share what they hold, and a
/// packing of one solid holds nothing but a pointer to it.
class Composition {
 public:
  /// Particles alike, of unit volume, however many there are. The solid must outlive all copies.
  Composition(const ConvexSolid& solid) : one_(&solid) {}  // NOLINT(google-explicit-constructor): one solid is one
  /// One of `particles` each, at least one; they are uniform if all are of one kind and unit volume.
  explicit Composition(std::span<const Particle> particles);

  bool is_uniform() const { return one_ != nullptr; }  ///< whether all particles are alike and of unit volume
  /// The solid of all particles, which are uniform.
  const ConvexSolid& only() const;
  /// The solid of particle i, in its size.
  const ConvexSolid& operator[](std::size_t i) const { return one_ ? *one_ : *mixed_->solids[i]; }
  /// The solid of particle i in unit volume: its shape. One pointer for one shape.
  const ConvexSolid& unit(std::size_t i) const { return one_ ? *one_ : *mixed_->particles[i].unit; }
  int kind(std::size_t i) const { return one_ ? 0 : mixed_->particles[i].kind; }  ///< kind of particle i
  int kinds() const { return one_ ? 1 : mixed_->kinds; }                          ///< number of kinds
  /// Whether all particles have one shape, if not one size.
  bool has_one_shape() const;
  /// The solids of all particles, none if they are uniform.
  std::span<const ConvexSolid* const> solids() const;
  std::span<const Particle> particles() const;  ///< one each; none if they are uniform

  /// Extremes over all particles, lengths in V_p^(1/3).
  const ConvexSolid& widest() const { return one_ ? *one_ : *mixed_->widest; }  ///< of greatest diameter
  /// Least distance of a face from its solid's centroid.
  double least_inradius() const { return one_ ? one_->inradius() : mixed_->least_inradius; }
  /// Greatest distance of a vertex from its solid's centroid.
  double greatest_circumradius() const { return one_ ? one_->circumradius() : mixed_->greatest_circumradius; }
  /// Mean of these over all particles.
  double mean_circumradius() const { return one_ ? one_->circumradius() : mixed_->mean_circumradius; }
  /// Circumradius over radius of gyration: how far from the centre a force may act.
  double greatest_lever() const {
    return one_ ? one_->circumradius() / one_->gyration_radius() : mixed_->greatest_lever;
  }

  /// Whether particle by particle they are the same.
  friend bool operator==(const Composition& a, const Composition& b);

 private:
  struct Mixed {
    std::vector<Particle> particles;
    std::vector<const ConvexSolid*> solids;                 ///< per particle
    std::vector<std::unique_ptr<const ConvexSolid>> sized;  ///< what `solids` points to
    const ConvexSolid* widest = nullptr;
    int kinds = 1;
    double least_inradius = 0, greatest_circumradius = 0, mean_circumradius = 0, greatest_lever = 0;
  };
  static void measure(Mixed& mixed);

  const ConvexSolid* one_ = nullptr;
  std::shared_ptr<const Mixed> mixed_;
};

}  // namespace isojam
