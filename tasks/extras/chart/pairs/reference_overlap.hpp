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

/// Computes V and S_A of a pair with an error of at most 1e-25, by cutting A with one face plane of B after another.
/// The rotation by q/|q| and the displacement are used as exact numbers. The vertices of the solids have an error of
/// 1e-32. Do not use it for pairs with coplanar faces, because with this error they cannot be distinguished from nearly
/// coplanar ones.
ReferenceOverlap reference_overlap(const PairCase& pair);

}  // namespace isojam::oracle
