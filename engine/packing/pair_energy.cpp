#include "engine/packing/pair_energy.hpp"

#include <Eigen/Geometry>

namespace isojam {

PairEnergy pair_energy(const PlacedSolid& a, const PlacedSolid& b, const DoubleDoubleVector& r) {
  SeparatingAxis unused;
  OverlapHessian h;
  const Overlap value = overlap_with_hessian(a, b, r, unused, h);
  return value.touching() ? pair_energy(value, h, r.high, a.solid().gyration_radius()) : PairEnergy{};
}

PairEnergy pair_energy(const Overlap& overlap, const OverlapHessian& hessian, const Eigen::Vector3d& r,
                       double gyration_radius) {
  Vector6d scale = Vector6d::Ones();
  scale.tail<3>().setConstant(1 / gyration_radius);
  const Vector6d ga = joined(overlap.area, overlap.moment);
  const Vector6d gb = joined(-overlap.area, r.cross(overlap.area) - overlap.moment);
  const auto set_block = [&](const Vector6d& g, const Vector6d& k, const Matrix6d& second, Matrix6d& block) {
    for (int c = 0; c < 6; ++c)
      block.col(c) = (scale.array() * ((g * k[c] + overlap.volume * second.col(c)) / 2).array() * scale[c]).matrix();
  };
  PairEnergy pair;
  pair.energy = overlap.volume * overlap.volume / 4;
  pair.gradient_a = overlap.volume / 2 * scale.cwiseProduct(ga);
  pair.gradient_b = overlap.volume / 2 * scale.cwiseProduct(gb);
  set_block(ga, ga, hessian.aa, pair.hessian.aa);
  set_block(ga, gb, hessian.ab, pair.hessian.ab);
  set_block(gb, gb, hessian.bb, pair.hessian.bb);
  return pair;
}

}  // namespace isojam
