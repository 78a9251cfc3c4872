#include "engine/rigidity/pair_stiffness.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/QR>
#include <cmath>
#include <stdexcept>

#include "engine/arithmetic/elementary.hpp"
#include "engine/parallel/parallel.hpp"

namespace isojam {

namespace {

using Eigen::Vector3d;

/// The six rigid motions of a pair, as columns: three translations, and three rotations about the centre of A.
Eigen::Matrix<double, 12, 6> rigid_motions(const Vector3d& r, double radius_a, double radius_b) {
  Eigen::Matrix<double, 12, 6> motions = Eigen::Matrix<double, 12, 6>::Zero();
  for (int k = 0; k < 3; ++k) {
    const Vector3d axis = Vector3d::Unit(k);
    motions.col(k) << axis, Vector3d::Zero(), axis, Vector3d::Zero();
    motions.col(3 + k) << Vector3d::Zero(), radius_a * axis, axis.cross(r), radius_b * axis;
  }
  return motions;
}

/// Orthonormal basis of the relative motions of the pair that are perpendicular to the normal.
Eigen::Matrix<double, 12, 5> relative_motions(const Eigen::Matrix<double, 12, 6>& rigid, const Vector12d& normal) {
  Eigen::Matrix<double, 12, 7> others;
  others << rigid, normal;
  const Matrix12d q = others.householderQr().householderQ();
  return q.rightCols<5>();
}

Matrix12d assembled(const OverlapHessian& hessian, double radius_a, double radius_b) {
  Matrix12d w;
  w << hessian.aa, hessian.ab, hessian.ab.transpose(), hessian.bb;
  Vector12d scale = Vector12d::Ones();
  scale.segment<3>(3).setConstant(1 / radius_a);
  scale.segment<3>(9).setConstant(1 / radius_b);
  return scale.asDiagonal() * w * scale.asDiagonal();
}

PairStiffness pair_stiffness(const Packing& packing, const PlacedSolids& placed, const NeighbourPair& pair) {
  const PlacedSolid a = placed[static_cast<std::size_t>(pair.a)], b = placed[static_cast<std::size_t>(pair.b)];
  const double radius_a = a.solid().gyration_radius(), radius_b = b.solid().gyration_radius();
  const DoubleDoubleVector r = displacement_double_double(packing, pair);
  SeparatingAxis unused;
  OverlapHessian hessian;
  const Overlap overlap = overlap_with_hessian(a, b, r, unused, hessian);
  PairStiffness result;
  Vector12d g;
  g << overlap.area, overlap.moment / radius_a, -overlap.area, (r.high.cross(overlap.area) - overlap.moment) / radius_b;
  result.normal = g.normalized();
  result.normal_stiffness = g.squaredNorm() / 2;
  result.force = overlap.volume * overlap.area.norm() / 2;
  result.length = (radius_a + radius_b) / 2;
  result.has_second = overlap.path == OverlapPath::loop;
  const Matrix12d w = assembled(hessian, radius_a, radius_b);
  result.second = overlap.volume / 4 * (w + w.transpose());
  const auto relative = relative_motions(rigid_motions(r.high, radius_a, radius_b), result.normal);
  const Eigen::Matrix<double, 5, 5> in_them = relative.transpose() * result.second * relative;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 5, 5>> solver((in_them + in_them.transpose()) / 2);
  result.tilts = relative * solver.eigenvectors().rowwise().reverse();
  result.tilt_stiffness = solver.eigenvalues().reverse();
  return result;
}

/// Adds the motion of a pair as a row of the rigidity matrix.
void add_row(const Contact& contact, const Vector12d& motion, int row, std::vector<Eigen::Triplet<double>>& entries) {
  for (int k = 0; k < 6; ++k) {
    entries.emplace_back(row, 6 * contact.pair.a + k, motion[k]);
    entries.emplace_back(row, 6 * contact.pair.b + k, motion[6 + k]);
  }
}

}  // namespace

int PairStiffness::stiff_tilts(double threshold) const {
  int count = 0;
  while (count < 5 && relative_tilt(count) > threshold) ++count;
  return count;
}

std::vector<PairStiffness> pair_stiffnesses(const Packing& packing, std::span<const Contact> contacts) {
  PlacedSolids placed;
  place_all(packing, Precision::double_double, placed);
  std::vector<PairStiffness> pairs(contacts.size());
  for_each_small(contacts.size(), [&](std::size_t k) { pairs[k] = pair_stiffness(packing, placed, contacts[k].pair); });
  return pairs;
}

double stiff_constraint_number(int particles, std::span<const PairStiffness> pairs, double threshold) {
  long count = 0;
  for (const PairStiffness& pair : pairs) count += 1 + pair.stiff_tilts(threshold);
  return 2 * static_cast<double>(count) / particles;
}

RigidityMatrix stiff_constraints(const Packing& packing, std::span<const Contact> contacts,
                                 std::span<const PairStiffness> pairs, double threshold) {
  if (pairs.size() != contacts.size()) throw std::invalid_argument("each contact needs one stiffness");
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<double> forces;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const PairStiffness& pair = pairs[c];
    add_row(contacts[c], pair.normal, static_cast<int>(forces.size()), entries);
    forces.push_back(contacts[c].overlap.volume / 2 * std::sqrt(2 * pair.normal_stiffness));
    for (int k = 0; k < pair.stiff_tilts(threshold); ++k) {
      add_row(contacts[c], pair.tilts.col(k), static_cast<int>(forces.size()), entries);
      forces.push_back(0);
    }
  }
  RigidityMatrix matrix;
  matrix.rows.resize(static_cast<Eigen::Index>(forces.size()), 6 * Eigen::Index{packing.size()});
  matrix.rows.setFromTriplets(entries.begin(), entries.end());
  matrix.forces = Eigen::Map<const Eigen::VectorXd>(forces.data(), static_cast<Eigen::Index>(forces.size()));
  const double size = matrix.forces.norm();
  if (size > 0) matrix.imbalance = (matrix.rows.transpose() * matrix.forces).norm() / size;
  return matrix;
}

StiffnessShares stiffness_shares(std::span<const Contact> contacts, std::span<const PairStiffness> pairs,
                                 double threshold, const Eigen::Ref<const Eigen::VectorXd>& u) {
  StiffnessShares shares;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const PairStiffness& pair = pairs[c];
    Vector12d motion;
    motion << u.segment<6>(6 * contacts[c].pair.a), u.segment<6>(6 * contacts[c].pair.b);
    shares.normal += pair.normal_stiffness * squared(pair.normal.dot(motion));
    double tilt = 0;
    for (int k = 0; k < pair.stiff_tilts(threshold); ++k)
      tilt += pair.tilt_stiffness[k] * squared(pair.tilts.col(k).dot(motion));
    shares.tilt += tilt;
    shares.prestress += motion.dot(pair.second * motion) - tilt;
  }
  return shares;
}

}  // namespace isojam
