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

std::string describe(const Packing& packing) {
  std::ostringstream text;
  text << packing.solids.unit(0).name() << (packing.solids.is_uniform() ? "" : " and others") << ", N "
       << packing.size() << ", L " << packing.cell.side();
  return text.str();
}

}  // namespace isojam::testing_packings
