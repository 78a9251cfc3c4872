#pragma once

#include <compare>
#include <string>
#include <string_view>
#include <vector>

#include "engine/geometry/solids/solid.hpp"
#include "engine/packing/mixture/composition.hpp"
#include "engine/packing/mixture/sizes.hpp"

namespace isojam {

/// One kind of particles in a mixture.
struct MixtureKind {
  Solid solid = SolidKind::tetrahedron;  ///< its shape
  double fraction = 1;                   ///< fraction of the particles, by number
  Sizes sizes{};                         ///< distribution of its sizes

  // NOLINTNEXTLINE(modernize-use-nullptr): the check mistakes the 0 of a defaulted comparison for a pointer
  friend auto operator<=>(const MixtureKind&, const MixtureKind&) = default;
};

/// The solids and sizes from which packings are made: one solid, or several kinds. A value.
class Mixture {
 public:
  /// All particles are the same solid.
  Mixture(Solid solid) : Mixture({{solid}}, "") {}  // NOLINT(google-explicit-constructor): the simplest mixture
  /// All particles are the same Platonic solid.
  Mixture(SolidKind kind) : Mixture(Solid(kind)) {}  // NOLINT(google-explicit-constructor)
  /// Kinds whose fractions sum to 1. An empty name is replaced by a description of the kinds.
  Mixture(std::vector<MixtureKind> kinds, std::string name);

  /// True if all particles are identical.
  bool is_one_solid() const;
  /// The solid of all particles; requires is_one_solid().
  const Solid& solid() const { return kinds_.front().solid; }
  const std::vector<MixtureKind>& kinds() const { return kinds_; }  ///< in the order given
  const std::string& name() const { return name_; }                 ///< name in files and messages

  /// n particles, kind by kind. The number of each kind is its fraction of n, rounded by the method of largest
  /// remainders. The sizes of the m particles of a kind are the quantiles (k + ½)/m of its distribution. Sizes are
  /// scaled so that the mean volume is 1; if all are equal, every volume is exactly 1.
  std::vector<Particle> particles(int n) const;
  /// Number of particles of each kind among n.
  std::vector<int> counts(int n) const;

  friend bool operator==(const Mixture&, const Mixture&) = default;
  /// Single solids first, in their order, then mixtures by their kinds.
  friend std::strong_ordering operator<=>(const Mixture& a, const Mixture& b);

 private:
  std::vector<MixtureKind> kinds_;
  std::string name_;
};

/// Name of the mixture.
inline std::string_view to_string(const Mixture& mixture) { return mixture.name(); }

/// Smallest number of particles of a mixture whose cubic cell is legal up to density φ; 2^17 if that is too few.
int least_particles(const Mixture& mixture, double density);

}  // namespace isojam
