#include "tests/engine/packing/packings.hpp"

#include <sstream>

namespace isojam::testing_packings {

Packing sample(SolidKind kind, int n, double density, std::uint64_t seed) {
  RandomStream random{seed, static_cast<std::uint64_t>(kind), static_cast<std::uint64_t>(n)};
  return random_packing(platonic(kind), n, density, random);
}

std::vector<Packing> samples(std::uint64_t seed, int n, double density) {
  std::vector<Packing> result;
  for (const SolidKind kind : all_solids) result.push_back(sample(kind, n, density, seed));
  return result;
}

Eigen::VectorXd random_step(RandomStream& random, int n) {
  Eigen::VectorXd step(6 * n);
  for (double& x : step) x = random.normal();
  return step;
}

double energy_tolerance(const Evaluation& evaluation) {
  return 16 * evaluation.energy_noise + epsilon * static_cast<double>(evaluation.contacts) * evaluation.energy;
}

Eigen::MatrixXd dense(const BlockMatrix& matrix) {
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(6 * matrix.size(), 6 * matrix.size());
  for (int i = 0; i < matrix.size(); ++i) full.block<6, 6>(6 * i, 6 * i) = matrix.diagonal[i];
  for (const BlockMatrix::Block& block : matrix.off_diagonal) {
    full.block<6, 6>(6 * block.row, 6 * block.column) = block.value;
    full.block<6, 6>(6 * block.column, 6 * block.row) = block.value.transpose();
  }
  return full;
}

std::string describe(const Packing& packing) {
  std::ostringstream text;
  text << packing.solids.unit(0).name() << (packing.solids.is_uniform() ? "" : " and others") << ", N "
       << packing.size() << ", L " << packing.cell.side();
  return text.str();
}

}  // namespace isojam::testing_packings
