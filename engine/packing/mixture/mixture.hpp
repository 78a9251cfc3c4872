#pragma once

#include <compare>
#include <string>
#include <string_view>
#include <vector>

#include "engine/geometry/solids/solid.hpp"
#include "engine/packing/mixture/composition.hpp"
#include "engine/packing/mixture/sizes.hpp"

namespace isojam {

/// One kind of a mixture: particles with the same shape, and a distribution of their sizes.
struct MixtureKind {
  Solid solid = SolidKind::tetrahedron;  ///< shape of the particles
  double fraction = 1;                   ///< fraction of all particles (by number) that are of this kind
  Sizes sizes{};                         ///< distribution of the sizes of this kind

  // NOLINTNEXTLINE(modernize-use-nullptr): the check mistakes the 0 of a defaulted comparison for a pointer
  friend auto operator<=>(const MixtureKind&, const MixtureKind&) = default;
};

/// The solids and sizes of the particles of a packing: one solid, or several kinds of particles. It is a value type.
class Mixture {
 public:
  /// All particles have the same solid and size.
  Mixture(Solid solid) : Mixture({{solid}}, "") {}  // NOLINT(google-explicit-constructor): the simplest mixture
  /// All particles have the same Platonic solid and size.
  Mixture(SolidKind kind) : Mixture(Solid(kind)) {}  // NOLINT(google-explicit-constructor)
  /// Several kinds; their fractions must sum to 1. If the name is empty, it is composed from the kinds.
  Mixture(std::vector<MixtureKind> kinds, std::string name);

  /// True if there is one kind with a fixed size, and the mixture has no name of its own. All particles are then
  /// identical.
  bool is_one_solid() const;
  /// The solid of all particles; requires is_one_solid().
  const Solid& solid() const { return kinds_.front().solid; }
  const std::vector<MixtureKind>& kinds() const { return kinds_; }  ///< kinds in the order in which they were given
  const std::string& name() const { return name_; }                 ///< name in files and messages

  /// Makes a list of n particles, sorted by kind. counts() gives the number of particles of each kind, and
  /// Sizes::of_particle() their sizes. Then all sizes are scaled so that the mean volume is 1. If all sizes are equal,
  /// every scaled size is exactly 1.
  std::vector<Particle> particles(int n) const;
  /// Number of particles of each kind in a packing of n particles: the fraction times n, rounded by the method of
  /// largest remainders.
  std::vector<int> counts(int n) const;

  friend bool operator==(const Mixture&, const Mixture&) = default;
  /// Order: first single solids in the order of Solid, then mixtures in the order of their kinds and names.
  friend std::strong_ordering operator<=>(const Mixture& a, const Mixture& b);

 private:
  std::vector<MixtureKind> kinds_;
  std::string name_;
};

/// The name of the mixture.
inline std::string_view to_string(const Mixture& mixture) { return mixture.name(); }

/// Largest diameter of n particles of the mixture after all their faces have moved outwards by `grown_by` (V_p^(1/3)).
/// All solids of the mixture must be able to grow (can_grow() in cohesion.hpp), unless `grown_by` is 0.
double widest_diameter(const Mixture& mixture, int n, double grown_by = 0);

/// Smallest number n such that a cubic cell with n particles of the mixture is legal at density φ and at all lower
/// densities. In a legal cell, no particle can touch two images of another one (is_legal() in cell/periodic_cell.hpp).
/// `grown_by` is as in widest_diameter(). If the particles are not identical, the result is at most 2^17, even if more
/// particles would be needed.
int least_particles(const Mixture& mixture, double density, double grown_by = 0);

}  // namespace isojam
