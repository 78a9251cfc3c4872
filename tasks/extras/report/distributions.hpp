#pragma once

#include <array>
#include <optional>
#include <vector>

#include "engine/analysis/alignment/angle_histogram.hpp"
#include "tasks/io/json.hpp"

namespace isojam {

/// Distributions over several states, from the records of the measures `contacts`, `gaps` and `exponents`. They are
/// sums over bins, so that they need no more memory for more states.
class Distributions {
 public:
  /// Adds a state, and its histogram of angles if the record has one.
  void add(const Json& state, const std::optional<AngleHistogram>& angles);
  /// - `forces`: probability density P of f = force/mean force. It is the sum of the curves of the contact classes.
  /// - `pairs`: mean of g(r) over the states, up to the largest r that all states have.
  /// - `exponents`: probability density of the exponents x of the contacts.
  /// - `face_face` and `edge_face`: alignment angles in degrees, as probability per decade. Angles below 1e-4 rad are
  ///   left out.
  /// Each is {"curves": {name: [[x, y], ...]}, "states": number of states}, with x in the middle of each bin, or null
  /// if no state has it.
  Json json() const;

  /// Sum of a list over the states. `edges` are the edges of the bins, which are the same in all states.
  struct Summed {
    std::vector<double> edges, sums;
    int states = 0;
  };

 private:
  void add_exponents(const Json& state);
  Json forces() const;
  Json pairs() const;
  Json exponents() const;

  std::array<Summed, 3> forces_;  ///< face-face, edge-face and lower-order contacts
  Summed pairs_, face_face_, edge_face_, exponents_;
  long contacts_ = 0;  ///< contacts with or without an exponent
};

}  // namespace isojam
