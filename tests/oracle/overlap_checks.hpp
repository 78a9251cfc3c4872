#pragma once

#include <string>

#include "engine/geometry/overlap/overlap.hpp"
#include "tasks/chart/pairs/pair_cases.hpp"
#include "tests/oracle/exact_overlap.hpp"

namespace isojam::oracle {

/// Distance of an Overlap from the exact one, each relative to its scale.
struct OverlapErrors {
  double volume = 0;  ///< |ΔV|/V; infinite if V = 0 is not met
  double area = 0;    ///< |ΔS|/|S|
  double moment = 0;  ///< |ΔM|/max(|M|, |S|·inradius): M alone may vanish while its parts do not
};

OverlapErrors errors(const Overlap& measured, const ExactOverlap& exact, SolidKind a);

/// Largest errors that a class of pairs may show.
struct OverlapTolerance {
  double volume = 0;
  /// Absolute: what a shift by plane_rounding() can add to V, hence the limit where V itself is that small.
  double volume_floor = 0;
  double gradient = 0;  ///< for area and moment, where they are single-valued
  /// Whether faces may nearly coincide, so that rounding of the pose limits S and M: they get gradient_noise() then.
  bool contested = false;
};

OverlapTolerance tolerance(PairClass pair_class, SolidKind a, SolidKind b);

/// What rounding of the pose alone may do to S and M, relative to their scales: contested_area/|S|, and for M the
/// longest lever besides. Where this exceeds the tolerance, a double does not determine the gradient to it. Infinite
/// where the gradient is not single-valued.
double gradient_noise(const ExactOverlap& exact, SolidKind a);

/// The limit on S and M that a pair is held to: the tolerance, or gradient_noise() where that is allowed and larger.
double gradient_limit(const ExactOverlap& exact, SolidKind a, const OverlapTolerance& tolerance);

/// What is wrong with `measured`, in words with the figures; empty if it agrees with the oracle.
std::string disagreement(const Overlap& measured, const ExactOverlap& exact, SolidKind a,
                         const OverlapTolerance& tolerance);

/// The input in full, so that a failure can be repeated.
std::string describe(const PairCase& pair);

}  // namespace isojam::oracle
