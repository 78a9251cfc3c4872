#pragma once

#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include "tasks/chart/pairs/pair_cases.hpp"

namespace isojam::oracle {

/// 50 decimal digits.
using Digits50 =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float_50::backend_type, boost::multiprecision::et_off>;

struct ReferenceOverlap {
  Digits50 volume;
  std::array<Digits50, 3> area;  ///< S_A = ∂V/∂x_A
};

/// V and S_A of a pair to 1e-25 or better, by cutting A with one face plane of B after another. The rotation by q/|q|
/// and the displacement are taken as exact, the solids to the 1e-32 of their constants. Not for pairs with coincident
/// or coplanar faces, which these constants cannot distinguish from nearly coplanar ones.
ReferenceOverlap reference_overlap(const PairCase& pair);

}  // namespace isojam::oracle
