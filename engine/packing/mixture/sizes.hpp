#pragma once

#include <array>
#include <compare>
#include <string>
#include <vector>

#include "engine/names/enum_names.hpp"

namespace isojam {

/// Distribution of sizes.
enum class SizeLaw { fixed, discrete, uniform, log_normal };
template <>
inline constexpr std::array enum_names<SizeLaw>{
    EnumName{SizeLaw::fixed, "fixed"}, EnumName{SizeLaw::discrete, "discrete"}, EnumName{SizeLaw::uniform, "uniform"},
    EnumName{SizeLaw::log_normal, "log_normal"}};

/// One of several sizes, and the fraction of particles that have it.
struct SizeShare {
  double size = 1, fraction = 1;  ///< a length, and a fraction by number

  // NOLINTNEXTLINE(modernize-use-nullptr): the check mistakes the 0 of a defaulted comparison for a pointer
  friend auto operator<=>(const SizeShare&, const SizeShare&) = default;
};

/// Distribution of the sizes of one kind of particles: lengths, in the same units as those of the other kinds of a
/// mixture.
struct Sizes {
  SizeLaw law = SizeLaw::fixed;   ///< type of the distribution
  double from = 1;                ///< the size, or the smallest size, or the median
  double to = 1;                  ///< for `uniform`: the largest size
  double sigma = 0;               ///< for `log_normal`: standard deviation of ln V, V the volume
  std::vector<SizeShare> list{};  ///< for `discrete`: sizes; their fractions sum to 1

  /// The size that a fraction `share` of the particles does not exceed, 0 < share < 1.
  double quantile(double share) const;
  /// Text for names: "" for a fixed size of 1, otherwise such as "1.4", "0.8to1.2" or "1ln0.3".
  std::string text() const;

  // NOLINTNEXTLINE(modernize-use-nullptr): the check mistakes the 0 of a defaulted comparison for a pointer
  friend auto operator<=>(const Sizes&, const Sizes&) = default;
};

/// The shortest text that converts back to the same number.
std::string shortest_text(double x);

}  // namespace isojam
