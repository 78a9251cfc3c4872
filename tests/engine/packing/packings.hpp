#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "engine/packing/energy.hpp"
#include "engine/packing/packing.hpp"

namespace isojam::testing_packings {

inline constexpr double epsilon = 2.220446049250313e-16;  ///< of double

/// One random packing of every solid, with contacts of all depths.
std::vector<Packing> samples(std::uint64_t seed, int n, double density);

/// A random packing that depends only on the arguments.
Packing sample(SolidKind kind, int n, double density, std::uint64_t seed);

/// 6N independent standard normal numbers, in the order of moved().
Eigen::VectorXd random_step(RandomStream& random, int n);

/// Rounding error of the energy due to the coordinates and to a sum over the contacts.
double energy_tolerance(const Evaluation& evaluation);

Eigen::MatrixXd dense(const BlockMatrix& matrix);

/// Text such as "octahedron, N 60, L 4.2".
std::string describe(const Packing& packing);

}  // namespace isojam::testing_packings
