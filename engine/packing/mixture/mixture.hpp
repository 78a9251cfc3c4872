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
  double fraction = 1;                   ///< of the particles, by number
  Sizes sizes{};                         ///< of its particles

  // NOLINTNEXTLINE(modernize-use-nullptr): it takes the 0 of a defaulted comparison for a pointer
  friend auto operator<=>(const MixtureKind&, const MixtureKind&) = default;
};

/// What packings are made of: one solid, or several kinds of solids and sizes. A value.
class Mixture {
 public:
  /// All particles alike.
  Mixture(Solid solid) : Mixture({{solid}}, "") {}  // NOLINT(google-explicit-constructor): the simplest one
  /// The same of a Platonic solid.
  Mixture(SolidKind kind) : Mixture(Solid(kind)) {}  // NOLINT(google-explicit-constructor)
  /// Kinds whose fractions sum to 1. Without a name it has one that says what it is.
  Mixture(std::vector<MixtureKind> kinds, std::string name);

  /// Whether all particles are alike.
  bool is_one_solid() const;
  /// The solid of all particles, which are alike.
  const Solid& solid() const { return kinds_.front().solid; }
  const std::vector<MixtureKind>& kinds() const { return kinds_; }  ///< in the order given
  const std::string& name() const { return name_; }                 ///< what files and messages call it

  /// n particles, kind by kind: as many of each as its fraction of n says, rounded so that they are n (largest
  /// remainders); the m of a kind with sizes the quantiles (k + ½)/m of their law. Scaled so that their mean volume is
  /// 1; all of exactly unit volume if they are of one size.
  std::vector<Particle> particles(int n) const;
  /// How many of each kind there are among n.
  std::vector<int> counts(int n) const;

  friend bool operator==(const Mixture&, const Mixture&) = default;
  /// Single solids in their order, then mixtures by their kinds.
  friend std::strong_ordering operator<=>(const Mixture& a, const Mixture& b);

 private:
  std::vector<MixtureKind> kinds_;
  std::string name_;
};

/// Its name.
inline std::string_view to_string(const Mixture& mixture) { return mixture.name(); }

/// Least number of particles of a mixture whose cubic cell is legal up to density φ; 2^17 if that is not enough.
int least_particles(const Mixture& mixture, double density);

}  // namespace isojam
