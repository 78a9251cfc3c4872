#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "engine/packing/energy.hpp"
#include "engine/packing/packing.hpp"

namespace isojam::testing_packings {

inline constexpr double epsilon = 2.220446049250313e-16;  ///< of a double

/// One random packing of every solid, full of contacts of all depths.
std::vector<Packing> samples(std::uint64_t seed, int n, double density);

/// A random packing as a function of its arguments.
Packing sample(SolidKind kind, int n, double density, std::uint64_t seed);

/// 6N independent standard normals, in moved()'s order.
Eigen::VectorXd random_step(RandomStream& random, int n);

/// What rounding of the coordinates and of a sum over the contacts may do to the energy.
double energy_tolerance(const Evaluation& evaluation);

Eigen::MatrixXd dense(const BlockMatrix& matrix);

/// "octahedron, N 60, L 4.2".
std::string describe(const Packing& packing);

}  // namespace isojam::testing_packings
