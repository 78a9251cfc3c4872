#pragma once

#include <Eigen/Core>

#include "engine/geometry/overlap/overlap.hpp"
#include "engine/geometry/pose.hpp"

namespace isojam {

// Strain is logarithmic: r → exp(ε) r for every centre-to-centre vector r, ε symmetric, orientations as they are. A
// traceless ε then keeps the volume to all orders. Symmetric tensors are written in the orthonormal basis
//   (ε_xx, ε_yy, ε_zz, √2 ε_yz, √2 ε_zx, √2 ε_xy)   (Mandel),
// in which rotations are orthogonal and eigenvalues mean something.

/// The tensor with these six components.
Eigen::Matrix3d strain_tensor(const Vector6d& components);
/// The six components of the symmetric part of a tensor.
Vector6d strain_components(const Eigen::Matrix3d& tensor);

/// 3 × 6: column I is the change of r by the I-th unit strain.
using Strains = Eigen::Matrix<double, 3, 6>;
/// Of a centre-to-centre vector.
Strains strained(const Eigen::Vector3d& r);

/// Orthonormal basis of the traceless tensors, as columns.
Eigen::Matrix<double, 6, 5> traceless_basis();
/// The tensor 1/√3 along the trace.
Vector6d trace_direction();

/// exp(ε) to 1e-31, ε symmetric or not, |ε| < 1.
DoubleDoubleMatrix exponential(const Eigen::Matrix3d& strain);

}  // namespace isojam
