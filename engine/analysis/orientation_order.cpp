#include "engine/analysis/orientation_order.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "engine/analysis/order.hpp"
#include "engine/arithmetic/elementary.hpp"

namespace isojam {

namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr unsigned greatest_rank = 10;

/// Normalised associated Legendre function of order m and degree l, divided by sinᵐ. `top` is the function of degree m,
/// from which it is computed by recurrence in the degree (forward column method of Holmes and Featherstone 2002).
double raised(double top, unsigned m, unsigned l, double z) {
  double before = 0, here = top;
  const double m2 = squared(m);
  for (unsigned k = m + 1; k <= l; ++k) {
    const double k2 = squared(k), b2 = squared(k - 1.0);
    const double next = std::sqrt((4 * k2 - 1) / (k2 - m2)) *
                        (z * here - (k > m + 1 ? std::sqrt((b2 - m2) / (4 * b2 - 1)) * before : 0));
    before = here;
    here = next;
  }
  return here;
}

/// Real harmonics Y_lm of a direction, for m = −l to l.
VectorXd real_harmonics(const Vector3d& direction, unsigned l) {
  const Vector3d unit = direction.normalized();
  const double x = unit.x(), y = unit.y(), z = unit.z();
  VectorXd values(2 * l + 1);
  double top = 0.5 / std::sqrt(std::numbers::pi), cosine = 1, sine = 0;  // sinᵐ·cos and sinᵐ·sin of m·azimuth
  for (unsigned m = 0; m <= l; ++m) {
    if (m > 0) {
      top *= std::sqrt((2.0 * m + 1) / (2.0 * m));
      const double next = x * cosine - y * sine;
      sine = x * sine + y * cosine;
      cosine = next;
    }
    const double amplitude = (m > 0 ? std::numbers::sqrt2 : 1) * raised(top, m, l, z);
    values[l - m] = amplitude * sine;
    values[l + m] = amplitude * cosine;
  }
  return values;
}

/// Mean of P_l over all pairs of vertex directions. By the addition theorem, it is the squared norm of the mean of the
/// harmonics of rank l, so it is not negative. If the exact value is 0, the result is about 1e-15 due to rounding.
double strength(const ConvexSolid& solid, unsigned l) {
  double sum = 0;
  for (const Vector3d& v : solid.vertices()) {
    for (const Vector3d& w : solid.vertices())
      sum += legendre(l, std::clamp(v.normalized().dot(w.normalized()), -1.0, 1.0));
  }
  const auto n = static_cast<double>(solid.vertices().size());
  return sum / (n * n);
}

std::optional<double> mean_of(const std::vector<std::optional<double>>& values) {
  double sum = 0;
  long count = 0;
  for (const std::optional<double>& value : values) {
    sum += value.value_or(0);
    count += value.has_value();
  }
  if (count == 0) return std::nullopt;
  return sum / static_cast<double>(count);
}

}  // namespace

unsigned orientation_rank(const ConvexSolid& solid) {
  constexpr double vanishing = 1e-10;  // far above rounding, far below the 0.1 or more of ranks that do not vanish
  for (unsigned l = 1; l <= greatest_rank; ++l) {
    if (strength(solid, l) > vanishing) return l;
  }
  throw std::invalid_argument("the vertices of " + solid.name() + " show no orientation up to rank 10");
}

Eigen::MatrixXd orientation_harmonics(const Packing& packing, unsigned l) {
  Eigen::MatrixXd harmonics = Eigen::MatrixXd::Zero(2 * l + 1, packing.size());
  for (int i = 0; i < packing.size(); ++i) {
    const Eigen::Matrix3d rotation = rotation_matrix(packing.poses[i]).high;
    for (const Vector3d& vertex : packing.solids[i].vertices())
      harmonics.col(i) += real_harmonics(rotation * vertex, l);
    harmonics.col(i).normalize();
  }
  return harmonics;
}

double orientation_order(const Eigen::MatrixXd& harmonics) { return harmonics.rowwise().mean().norm(); }

std::optional<double> local_orientation_order(std::span<const Contact> contacts, const Eigen::MatrixXd& harmonics) {
  if (contacts.empty()) return std::nullopt;
  double sum = 0;
  for (const Contact& contact : contacts) sum += harmonics.col(contact.pair.a).dot(harmonics.col(contact.pair.b));
  return sum / static_cast<double>(contacts.size());
}

OrderLimits order_limits(unsigned rank) {
  if (rank == 4) return {0.6, 0.6};
  return {0.5, 0.5};
}

bool is_aligned(const Order& order) {
  const OrderLimits limits = order_limits(order.rank);
  // In packings of fewer than 49 particles, S of disordered packings can exceed 0.5.
  constexpr double deviations = 3.5;
  return (order.S && *order.S > std::max(limits.S, deviations * order.random_S)) ||
         (order.local_S && *order.local_S > limits.local_S);
}

std::vector<std::optional<double>> local_steinhardt_order(std::span<const Contact> contacts, int particles,
                                                          unsigned l) {
  std::vector<std::vector<Vector3d>> bonds(particles);
  for (const Contact& contact : contacts) {
    bonds.at(contact.pair.a).push_back(contact.displacement);
    bonds.at(contact.pair.b).push_back(-contact.displacement);
  }
  std::vector<std::optional<double>> values(particles);
  for (int i = 0; i < particles; ++i) {
    if (!bonds[i].empty()) values[i] = steinhardt_order(bonds[i], l);
  }
  return values;
}

Order order_of(const Packing& packing, std::span<const Contact> contacts) {
  std::vector<Vector3d> bonds;
  for (const Contact& contact : contacts) bonds.push_back(contact.displacement);
  Order order;
  order.Q4 = steinhardt_order(bonds, 4);
  order.Q6 = steinhardt_order(bonds, 6);
  order.local_Q4 = mean_of(local_steinhardt_order(contacts, packing.size(), 4));
  order.local_Q6 = mean_of(local_steinhardt_order(contacts, packing.size(), 6));
  if (packing.solids.has_one_shape()) {
    order.rank = orientation_rank(packing.solids.unit(0));
    const Eigen::MatrixXd harmonics = orientation_harmonics(packing, order.rank);
    order.S = orientation_order(harmonics);
    order.local_S = local_orientation_order(contacts, harmonics);
    if (order.local_S)
      order.random_local_S = 1 / std::sqrt((2.0 * order.rank + 1) * static_cast<double>(contacts.size()));
  }
  order.random_S = 1 / std::sqrt(static_cast<double>(packing.size()));
  return order;
}

OrientationCorrelation orientation_correlation(const Packing& packing, const Eigen::MatrixXd& harmonics,
                                               const OrientationCorrelationOptions& options) {
  const double reach = options.reach.value_or(packing.cell.heights().minCoeff() / 2);
  if (!(options.width > 0) || !(reach > 0) || !std::isfinite(reach))
    throw std::invalid_argument("the bins and the range of an orientational correlation must be positive");
  OrientationCorrelation result{options.width, {}};
  result.bins.resize(static_cast<std::size_t>(std::max(1.0, std::floor(reach / options.width))));
  const double end = options.width * static_cast<double>(result.bins.size());
  std::vector<double> sums(result.bins.size(), 0.0);
  for (const NeighbourPair& pair : find_neighbours(packing, end)) {
    const auto bin = static_cast<std::size_t>(displacement(packing, pair).norm() / options.width);
    if (bin >= result.bins.size()) continue;
    sums[bin] += harmonics.col(pair.a).dot(harmonics.col(pair.b));
    ++result.bins[bin].pairs;
  }
  for (std::size_t k = 0; k < sums.size(); ++k) {
    if (result.bins[k].pairs > 0) result.bins[k].mean = sums[k] / static_cast<double>(result.bins[k].pairs);
  }
  return result;
}

}  // namespace isojam
