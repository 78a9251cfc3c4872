#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "engine/geometry/convex_solid.hpp"

namespace isojam {

/// A particle of a mixture.
struct Particle {
  /// solid scaled to unit volume; it must not change, and must outlive every packing that contains it
  const ConvexSolid* unit;
  double scale = 1;  ///< size of the particle: factor by which the lengths of `unit` are multiplied
  int kind = 0;      ///< index of the kind in the mixture, from 0

  bool operator==(const Particle& other) const = default;
};

/// The solids of all particles of a packing, in the order of the particles. It is a value type whose copies share their
/// data. If all particles are identical and have unit volume, the composition is called uniform and stores only one
/// pointer.
class Composition {
 public:
  /// N identical particles of unit volume, for any N. The solid must outlive all copies of the composition.
  Composition(const ConvexSolid& solid) : one_(&solid) {}  // NOLINT(google-explicit-constructor): one solid suffices
  /// Particles from a list with at least one element.
  explicit Composition(std::span<const Particle> particles);

  bool is_uniform() const { return one_ != nullptr; }  ///< true if all particles are identical and have unit volume
  /// The solid of all particles; requires is_uniform().
  const ConvexSolid& only() const;
  /// The solid of particle i with its actual size.
  const ConvexSolid& operator[](std::size_t i) const { return one_ ? *one_ : *mixed_->solids[i]; }
  /// The shape of particle i: its solid scaled to unit volume. Particles of the same shape return the same object.
  const ConvexSolid& unit(std::size_t i) const { return one_ ? *one_ : *mixed_->particles[i].unit; }
  int kind(std::size_t i) const { return one_ ? 0 : mixed_->particles[i].kind; }  ///< kind of particle i
  int kinds() const { return one_ ? 1 : mixed_->kinds; }                          ///< number of kinds
  /// True if all particles have the same shape; sizes may differ.
  bool has_one_shape() const;
  /// The solids of all particles; empty if the composition is uniform.
  std::span<const ConvexSolid* const> solids() const;
  std::span<const Particle> particles() const;  ///< one element per particle; empty if the composition is uniform

  // The next functions describe all particles together. Lengths are in units of V_p^(1/3).
  const ConvexSolid& widest() const { return one_ ? *one_ : *mixed_->widest; }  ///< solid with the largest diameter
  /// Smallest inradius: the smallest distance of a face from the centroid of its solid.
  double least_inradius() const { return one_ ? one_->inradius() : mixed_->least_inradius; }
  /// Largest circumradius: the largest distance of a vertex from the centroid of its solid.
  double greatest_circumradius() const { return one_ ? one_->circumradius() : mixed_->greatest_circumradius; }
  /// Mean of the circumradii of all particles.
  double mean_circumradius() const { return one_ ? one_->circumradius() : mixed_->mean_circumradius; }
  /// Largest ratio of circumradius to radius of gyration R: an upper bound of the lever arm of a force, in units of R.
  double greatest_lever_arm() const {
    return one_ ? one_->circumradius() / one_->gyration_radius() : mixed_->greatest_lever_arm;
  }

  /// True if both contain equal particles in the same order.
  friend bool operator==(const Composition& a, const Composition& b);

 private:
  struct Mixed {
    std::vector<Particle> particles;
    std::vector<const ConvexSolid*> solids;                 ///< per particle
    std::vector<std::unique_ptr<const ConvexSolid>> sized;  ///< the solids to which `solids` points
    const ConvexSolid* widest = nullptr;
    int kinds = 1;
    double least_inradius = 0, greatest_circumradius = 0, mean_circumradius = 0, greatest_lever_arm = 0;
  };
  static void measure(Mixed& mixed);

  const ConvexSolid* one_ = nullptr;
  std::shared_ptr<const Mixed> mixed_;
};

}  // namespace isojam
