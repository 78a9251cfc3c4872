#include "engine/analysis/order.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/arithmetic/elementary.hpp"

namespace isojam {

double steinhardt_order(std::span<const Eigen::Vector3d> bonds, unsigned l) {
  if (bonds.empty()) return 0;
  std::vector<Eigen::Vector3d> directions;
  for (const Eigen::Vector3d& bond : bonds) directions.push_back(bond.normalized());
  const auto n = static_cast<double>(directions.size());
  double sum = n;  // P_l(1) of every bond with itself
  for (std::size_t i = 0; i < directions.size(); ++i) {
    for (std::size_t j = i + 1; j < directions.size(); ++j)
      sum += 2 * legendre(l, std::clamp(directions[i].dot(directions[j]), -1.0, 1.0));
  }
  return std::sqrt(std::max(sum, 0.0)) / n;
}

double contact_q6(std::span<const Contact> contacts) {
  std::vector<Eigen::Vector3d> bonds;
  for (const Contact& contact : contacts) bonds.push_back(contact.displacement);
  return steinhardt_order(bonds, 6);
}

}  // namespace isojam
