#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "engine/geometry/convex_solid.hpp"

namespace isojam {

/// A particle in terms of a mixture: a solid of unit volume, its size, and its kind in the mixture.
struct Particle {
  const ConvexSolid* unit;  ///< immutable; must outlive every packing that contains it
  double scale = 1;         ///< factor of its lengths
  int kind = 0;             ///< number of its kind, from 0

  bool operator==(const Particle& other) const = default;
};

/// The solids of all particles of a packing, in their order. A value: copies share the data, and a packing of one solid
/// consists of a single pointer to it.
class Composition {
 public:
  /// Identical particles of unit volume, in any number. The solid must outlive all copies.
  Composition(const ConvexSolid& solid) : one_(&solid) {}  // NOLINT(google-explicit-constructor): one solid is one
  /// One entry of `particles` per particle, at least one. The composition is uniform if all have the same solid, kind
  /// and unit volume.
  explicit Composition(std::span<const Particle> particles);

  bool is_uniform() const { return one_ != nullptr; }  ///< true if all particles are identical and have unit volume
  /// The solid of all particles; requires is_uniform().
  const ConvexSolid& only() const;
  /// The solid of particle i in its actual size.
  const ConvexSolid& operator[](std::size_t i) const { return one_ ? *one_ : *mixed_->solids[i]; }
  /// The solid of particle i scaled to unit volume: its shape. Equal shapes have equal pointers.
  const ConvexSolid& unit(std::size_t i) const { return one_ ? *one_ : *mixed_->particles[i].unit; }
  int kind(std::size_t i) const { return one_ ? 0 : mixed_->particles[i].kind; }  ///< kind of particle i
  int kinds() const { return one_ ? 1 : mixed_->kinds; }                          ///< number of kinds
  /// True if all particles have the same shape; sizes may differ.
  bool has_one_shape() const;
  /// The solids of all particles; empty if they are uniform.
  std::span<const ConvexSolid* const> solids() const;
  std::span<const Particle> particles() const;  ///< one entry per particle; empty if they are uniform

  /// Extremes over all particles, lengths in V_p^(1/3).
  const ConvexSolid& widest() const { return one_ ? *one_ : *mixed_->widest; }  ///< solid with the largest diameter
  /// Smallest distance of a face from its solid's centroid.
  double least_inradius() const { return one_ ? one_->inradius() : mixed_->least_inradius; }
  /// Largest distance of a vertex from its solid's centroid.
  double greatest_circumradius() const { return one_ ? one_->circumradius() : mixed_->greatest_circumradius; }
  /// Mean circumradius of all particles.
  double mean_circumradius() const { return one_ ? one_->circumradius() : mixed_->mean_circumradius; }
  /// Largest ratio of circumradius to radius of gyration: an upper bound of the lever arm of a force.
  double greatest_lever() const {
    return one_ ? one_->circumradius() / one_->gyration_radius() : mixed_->greatest_lever;
  }

  /// True if all particles are equal, in their order.
  friend bool operator==(const Composition& a, const Composition& b);

 private:
  struct Mixed {
    std::vector<Particle> particles;
    std::vector<const ConvexSolid*> solids;                 ///< per particle
    std::vector<std::unique_ptr<const ConvexSolid>> sized;  ///< owns the solids of `solids`
    const ConvexSolid* widest = nullptr;
    int kinds = 1;
    double least_inradius = 0, greatest_circumradius = 0, mean_circumradius = 0, greatest_lever = 0;
  };
  static void measure(Mixed& mixed);

  const ConvexSolid* one_ = nullptr;
  std::shared_ptr<const Mixed> mixed_;
};

}  // namespace isojam
