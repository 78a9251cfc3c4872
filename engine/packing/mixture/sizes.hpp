#pragma once

#include <array>
#include <compare>
#include <string>
#include <vector>

#include "engine/names/enum_names.hpp"

namespace isojam {

/// How sizes are distributed.
enum class SizeLaw { fixed, discrete, uniform, log_normal };
template <>
inline constexpr std::array enum_names<SizeLaw>{
    EnumName{SizeLaw::fixed, "fixed"}, EnumName{SizeLaw::discrete, "discrete"}, EnumName{SizeLaw::uniform, "uniform"},
    EnumName{SizeLaw::log_normal, "log_normal"}};

/// One of several sizes, and the share of particles that have it.
struct SizeShare {
  double size = 1, fraction = 1;  ///< a length, and a share by number

  // NOLINTNEXTLINE(modernize-use-nullptr): it takes the 0 of a defaulted comparison for a pointer
  friend auto operator<=>(const SizeShare&, const SizeShare&) = default;
};

/// How the sizes of one kind of particles are distributed: lengths, to scale with those of the other kinds of a
/// mixture.
struct Sizes {
  SizeLaw law = SizeLaw::fixed;   ///< which of them
  double from = 1;                ///< the size, or the least, or the median
  double to = 1;                  ///< of `uniform`: the greatest
  double sigma = 0;               ///< of `log_normal`: standard deviation of ln V, V the volume
  std::vector<SizeShare> list{};  ///< of `discrete`; the fractions sum to 1

  /// The size that this share of particles does not exceed, 0 < share < 1.
  double quantile(double share) const;
  /// For names: "" of a fixed size of 1, otherwise as "1.4", "0.8to1.2" or "1ln0.3".
  std::string text() const;

  // NOLINTNEXTLINE(modernize-use-nullptr): it takes the 0 of a defaulted comparison for a pointer
  friend auto operator<=>(const Sizes&, const Sizes&) = default;
};

/// The shortest text that gives the number again.
std::string shortest_text(double x);

}  // namespace isojam
