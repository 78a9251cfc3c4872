#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/names/enum_names.hpp"

namespace isojam {

/// Type of a distribution of sizes.
enum class SizeLaw { fixed, discrete, uniform, log_normal, values };
template <>
inline constexpr std::array enum_names<SizeLaw>{
    EnumName{SizeLaw::fixed, "fixed"}, EnumName{SizeLaw::discrete, "discrete"}, EnumName{SizeLaw::uniform, "uniform"},
    EnumName{SizeLaw::log_normal, "log_normal"}, EnumName{SizeLaw::values, "values"}};

/// How the sizes of the particles of one kind are taken from their distribution.
enum class SizeChoice {
  quantiles,  ///< the quantiles (k + ½)/n, k = 0 … n − 1
  drawn,      ///< independent random sizes
  in_order    ///< for `values` only: one value after another, from the beginning again after the last one
};
template <>
inline constexpr std::array enum_names<SizeChoice>{EnumName{SizeChoice::quantiles, "quantiles"},
                                                   EnumName{SizeChoice::drawn, "drawn"},
                                                   EnumName{SizeChoice::in_order, "in_order"}};

/// A size, and the fraction of particles that have this size.
struct SizeShare {
  double size = 1, fraction = 1;  ///< size, as a length; fraction, by number

  // NOLINTNEXTLINE(modernize-use-nullptr): the check mistakes the 0 of a defaulted comparison for a pointer
  friend auto operator<=>(const SizeShare&, const SizeShare&) = default;
};

/// Distribution of the sizes of one kind of particles. A size is a length in any unit that is the same for all kinds of
/// the mixture; Mixture::particles() scales all sizes.
struct Sizes {
  SizeLaw law = SizeLaw::fixed;  ///< type of the distribution
  double from = 1;   ///< for `fixed`: the size; for `uniform`: the smallest size; for `log_normal`: the median
  double to = 1;     ///< for `uniform`: the largest size
  double sigma = 0;  ///< for `log_normal`: standard deviation of ln V, where V is the volume
  std::vector<SizeShare> list{};  ///< for `discrete`: the sizes; their fractions sum to 1

  std::vector<double> values{};             ///< for `values`: the sizes; ascending unless they are taken in order
  SizeChoice take = SizeChoice::quantiles;  ///< how the sizes of the particles are chosen
  std::uint64_t seed = 0;                   ///< for `drawn`: seed of the random sizes

  /// Size of particle k of n particles of this kind.
  double of_particle(int k, int n) const;
  /// Quantile: the fraction `share` of the particles has at most this size. For `discrete`, it is the first size of the
  /// list at which the sum of the fractions reaches `share`; the list need not be sorted. Requires 0 < share < 1.
  double quantile(double share) const;
  /// Text that describes the sizes in the name of a mixture: "" for the fixed size 1, otherwise for example "1.4",
  /// "0.8to1.2" or "1ln0.3".
  std::string text() const;
  std::string law_text() const;  ///< the same without the choice of the sizes

  // NOLINTNEXTLINE(modernize-use-nullptr): the check mistakes the 0 of a defaulted comparison for a pointer
  friend auto operator<=>(const Sizes&, const Sizes&) = default;
};

/// The shortest text from which x can be read back exactly.
std::string shortest_text(double x);

}  // namespace isojam
