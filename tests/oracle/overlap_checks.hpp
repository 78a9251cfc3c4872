#pragma once

#include <string>

#include "engine/geometry/overlap/overlap.hpp"
#include "tasks/extras/chart/pairs/pair_cases.hpp"
#include "tests/oracle/exact_overlap.hpp"

namespace isojam::oracle {

/// Deviation of an Overlap from the exact one, each relative to its scale.
struct OverlapErrors {
  double volume = 0;  ///< |ΔV|/V; infinite if the exact V is 0 and the other is not
  double area = 0;    ///< |ΔS|/|S|
  double moment = 0;  ///< |ΔM|/max(|M|, |S|·inradius): M may vanish although its parts do not
};

OverlapErrors errors(const Overlap& measured, const ExactOverlap& exact, SolidKind a);

/// Largest errors permitted for a class of pairs.
struct OverlapTolerance {
  double volume = 0;
  /// Absolute: the change of V due to a shift by plane_rounding(), hence the limit if V itself is that small.
  double volume_floor = 0;
  double gradient = 0;  ///< for area and moment, if they are single-valued
  /// True if faces may nearly coincide, so that rounding of the pose limits S and M. The limit is then
  /// gradient_noise().
  bool contested = false;
};

OverlapTolerance tolerance(PairClass pair_class, SolidKind a, SolidKind b);

/// Effect of rounding of the pose alone on S and M, relative to their scales: contested_area/|S|, and for M times the
/// longest lever arm. Above the tolerance, a pose in double does not determine the gradient to that accuracy. Infinite
/// if the gradient is not single-valued.
double gradient_noise(const ExactOverlap& exact, SolidKind a);

/// The limit on S and M for a pair: the tolerance, or gradient_noise() if that is permitted and larger.
double gradient_limit(const ExactOverlap& exact, SolidKind a, const OverlapTolerance& tolerance);

/// Description of the deviations of `measured`, with numbers; empty if it agrees with the oracle.
std::string disagreement(const Overlap& measured, const ExactOverlap& exact, SolidKind a,
                         const OverlapTolerance& tolerance);

/// The complete input, so that a failure can be reproduced.
std::string describe(const PairCase& pair);

}  // namespace isojam::oracle
