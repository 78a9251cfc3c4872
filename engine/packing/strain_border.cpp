#include "engine/packing/strain_border.hpp"

#include "engine/packing/cell/strain.hpp"

namespace isojam {

StrainBorder::StrainBorder(CellFreedom cell, int particles, BlockMatrix& matrix)
    : basis_(strain_basis(cell) / strain_length(particles)), matrix_(matrix) {
  matrix_.border.setZero(6 * Eigen::Index{particles}, basis_.cols());
  matrix_.corner.setZero(basis_.cols(), basis_.cols());
}

void StrainBorder::add_pair(int a, int b, const PairHessian& h, const Eigen::Vector3d& slope,
                            const Eigen::Vector3d& r) {
  if (basis_.cols() == 0) return;
  const Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 6> dr = strained(r) * basis_;
  // A strain moves B by dr relative to A.
  matrix_.border.middleRows<6>(6 * a) += h.ab.leftCols<3>() * dr;
  matrix_.border.middleRows<6>(6 * b) += h.bb.leftCols<3>() * dr;
  matrix_.corner += dr.transpose() * h.bb.topLeftCorner<3, 3>() * dr;
  virial_ += slope * r.transpose();
}

Eigen::VectorXd StrainBorder::slopes(const Eigen::Matrix3d& virial) const {
  return basis_.transpose() * strain_components(virial);
}

void StrainBorder::finish() {
  if (basis_.cols() == 0) return;
  matrix_.corner += basis_.transpose() * of_squared_strain((virial_ + virial_.transpose()) / 2) * basis_;
  matrix_.corner = ((matrix_.corner + matrix_.corner.transpose()) / 2).eval();
}

Matrix6d of_squared_strain(const Eigen::Matrix3d& tensor) {
  Matrix6d form;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      const Eigen::Matrix3d product = strain_tensor(Vector6d::Unit(i)) * strain_tensor(Vector6d::Unit(j));
      form(i, j) = tensor.cwiseProduct(product + product.transpose()).sum() / 2;
    }
  }
  return form;
}

}  // namespace isojam
