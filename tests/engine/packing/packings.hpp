#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "engine/packing/energy.hpp"
#include "engine/packing/packing.hpp"

namespace isojam::testing_packings {

/// rounding unit of double: the distance from 1 to the next larger double
inline constexpr double epsilon = 2.220446049250313e-16;

/// One random packing of every named solid. The contacts have many different depths.
std::vector<Packing> samples(std::uint64_t seed, int n, double density);

/// A random packing; equal arguments give equal packings.
Packing sample(SolidKind kind, int n, double density, std::uint64_t seed);

/// 6N independent numbers from the standard normal distribution, in the order that moved() expects.
Eigen::VectorXd random_step(RandomStream& random, int n);

/// Upper limit of the rounding error of the energy, which comes from the coordinates and from the sum over contacts.
double energy_tolerance(const Evaluation& evaluation);

/// Text such as "octahedron, N 60, L 4.2".
std::string describe(const Packing& packing);

}  // namespace isojam::testing_packings
