#include "engine/packing/pair_energy.hpp"

#include <Eigen/Geometry>

namespace isojam {

namespace {

/// Factors of the derivatives if the rotations θ are replaced by R·θ.
Vector6d scale_of(double radius) {
  Vector6d scale = Vector6d::Ones();
  scale.tail<3>().setConstant(1 / radius);
  return scale;
}

}  // namespace

PairEnergy pair_energy(const PlacedSolid& a, const PlacedSolid& b, const DoubleDoubleVector& r) {
  SeparatingAxis unused;
  OverlapHessian h;
  const Overlap value = overlap_with_hessian(a, b, r, unused, h);
  if (!value.touching()) return {};
  return pair_energy(value, h, r.high, a.solid().gyration_radius(), b.solid().gyration_radius());
}

PairEnergy pair_energy(const Overlap& overlap, const OverlapHessian& hessian, const Eigen::Vector3d& r, double radius_a,
                       double radius_b) {
  const Vector6d scale_a = scale_of(radius_a), scale_b = scale_of(radius_b);
  const Vector6d ga = joined(overlap.area, overlap.moment);
  const Vector6d gb = joined(-overlap.area, r.cross(overlap.area) - overlap.moment);
  const auto set_block = [&](const Vector6d& g, const Vector6d& k, const Matrix6d& second, const Vector6d& rows,
                             const Vector6d& columns, Matrix6d& block) {
    for (int c = 0; c < 6; ++c)
      block.col(c) = (rows.array() * ((g * k[c] + overlap.volume * second.col(c)) / 2).array() * columns[c]).matrix();
  };
  PairEnergy pair;
  pair.energy = overlap.volume * overlap.volume / 4;
  pair.gradient_a = overlap.volume / 2 * scale_a.cwiseProduct(ga);
  pair.gradient_b = overlap.volume / 2 * scale_b.cwiseProduct(gb);
  set_block(ga, ga, hessian.aa, scale_a, scale_a, pair.hessian.aa);
  set_block(ga, gb, hessian.ab, scale_a, scale_b, pair.hessian.ab);
  set_block(gb, gb, hessian.bb, scale_b, scale_b, pair.hessian.bb);
  return pair;
}

PairHessian volume_hessian(const OverlapHessian& hessian, double radius_a, double radius_b) {
  const Vector6d a = scale_of(radius_a), b = scale_of(radius_b);
  return {a.asDiagonal() * hessian.aa * a.asDiagonal(), a.asDiagonal() * hessian.ab * b.asDiagonal(),
          b.asDiagonal() * hessian.bb * b.asDiagonal()};
}

}  // namespace isojam
