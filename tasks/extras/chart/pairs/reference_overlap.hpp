#pragma once

#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include "tasks/extras/chart/pairs/pair_cases.hpp"

namespace isojam::oracle {

/// A number with 50 decimal digits.
using Digits50 =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float_50::backend_type, boost::multiprecision::et_off>;

struct ReferenceOverlap {
  Digits50 volume;
  std::array<Digits50, 3> area;  ///< S_A = ∂V/∂x_A
};

/// Computes V and S_A of a pair with an error of at most 1e-25: it cuts A with the face planes of B, one after another.
/// The rotation by q/|q| and the displacement are exact. The vertices of the solids have an error of 1e-32. Do not use
/// the function for pairs with coplanar faces, because this error can make such faces cross each other.
ReferenceOverlap reference_overlap(const PairCase& pair);

}  // namespace isojam::oracle
