#include "engine/packing/cell/strain.hpp"

#include <numbers>

namespace isojam {

namespace {

DoubleDoubleMatrix sum(const DoubleDoubleMatrix& a, const DoubleDoubleMatrix& b) {
  DoubleDoubleMatrix result;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) result.set(r, c, a(r, c) + b(r, c));
  }
  return result;
}

DoubleDoubleMatrix quotient(const DoubleDoubleMatrix& a, double b) {
  DoubleDoubleMatrix result;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) result.set(r, c, a(r, c) / b);
  }
  return result;
}

}  // namespace

Eigen::Matrix3d strain_tensor(const Vector6d& components) {
  const Eigen::Vector3d shear = components.tail<3>() / std::numbers::sqrt2;
  Eigen::Matrix3d tensor;
  tensor << components[0], shear[2], shear[1], shear[2], components[1], shear[0], shear[1], shear[0], components[2];
  return tensor;
}

Vector6d strain_components(const Eigen::Matrix3d& tensor) {
  Vector6d components;
  components.head<3>() = tensor.diagonal();
  for (int c = 0; c < 3; ++c) {
    const int a = (c + 1) % 3, b = (c + 2) % 3;
    components[3 + c] = (tensor(a, b) + tensor(b, a)) / std::numbers::sqrt2;
  }
  return components;
}

Strains strained(const Eigen::Vector3d& r) {
  Strains changes = Strains::Zero();
  const Eigen::Vector3d half = 1 / std::numbers::sqrt2 * r;
  for (int c = 0; c < 3; ++c) {
    const int a = (c + 1) % 3, b = (c + 2) % 3;
    changes(c, c) = r[c];
    changes(a, 3 + c) = half[b];
    changes(b, 3 + c) = half[a];
  }
  return changes;
}

Eigen::Matrix<double, 6, 5> traceless_basis() {
  Eigen::Matrix<double, 6, 5> basis = Eigen::Matrix<double, 6, 5>::Zero();
  basis.col(0).head<3>() = Eigen::Vector3d(1, -1, 0).normalized();
  basis.col(1).head<3>() = Eigen::Vector3d(1, 1, -2).normalized();
  basis.bottomRightCorner<3, 3>().setIdentity();
  return basis;
}

Vector6d trace_direction() {
  Vector6d direction = Vector6d::Zero();
  direction.head<3>().setConstant(1 / std::numbers::sqrt3);
  return direction;
}

DoubleDoubleMatrix exponential(const Eigen::Matrix3d& strain) {
  DoubleDoubleMatrix base, result, term;  // term = result = 1
  base.high = strain;
  const double size = strain.norm();
  double bound = 1;
  // Stops when the next term is below 1e-33 |ε|, so that even for a small ε the change exp(ε) − 1 is accurate.
  for (int k = 1; bound > 1e-33 * size; ++k) {
    term = quotient(term * base, k);
    result = sum(result, term);
    bound *= size / k;
  }
  return result;
}

}  // namespace isojam
