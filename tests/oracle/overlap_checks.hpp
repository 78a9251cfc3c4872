#pragma once

#include <string>

#include "engine/geometry/overlap/overlap.hpp"
#include "tasks/extras/chart/pairs/pair_cases.hpp"
#include "tests/oracle/exact_overlap.hpp"

namespace isojam::oracle {

/// Deviations of an Overlap from the exact overlap. Each is relative to a scale.
struct OverlapErrors {
  double volume = 0;  ///< |ΔV|/V; infinite if the exact V is 0 and the measured V is not
  double area = 0;    ///< |ΔS|/|S|
  double moment = 0;  ///< |ΔM|/max(|M|, |S|·inradius of A); |M| alone can be 0 although its contributions are not
};

OverlapErrors errors(const Overlap& measured, const ExactOverlap& exact, SolidKind a);

/// Largest allowed errors for a class of pairs.
struct OverlapTolerance {
  double volume = 0;
  /// Largest allowed absolute error of V, which applies if V is very small: the effect of plane_rounding() on V.
  double volume_floor = 0;
  double gradient = 0;  ///< largest allowed error of `area` and `moment`
  /// True if faces may nearly coincide, so that rounding of the pose changes S and M. The allowed error is then
  /// gradient_noise() if this is larger.
  bool contested = false;
};

OverlapTolerance tolerance(PairClass pair_class, SolidKind a, SolidKind b);

/// Upper limit of the relative errors of S and M that rounding of the pose alone can cause: contested_area/|S|, times
/// the ratio of circumradius and inradius of A.
double gradient_noise(const ExactOverlap& exact, SolidKind a);

/// Largest allowed error of S and M for a pair: the tolerance, or gradient_noise() if it is larger and faces may nearly
/// coincide.
double gradient_limit(const ExactOverlap& exact, SolidKind a, const OverlapTolerance& tolerance);

/// Text with the errors of `measured` that are too large; empty if there are none.
std::string disagreement(const Overlap& measured, const ExactOverlap& exact, SolidKind a,
                         const OverlapTolerance& tolerance);

/// Text with all digits of the pair, so that a failure can be reproduced.
std::string describe(const PairCase& pair);

}  // namespace isojam::oracle
