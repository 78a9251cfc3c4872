#pragma once

#include <span>

#include "tasks/io/json.hpp"

namespace isojam {

/// Distributions over several states, from the records of the measures `contacts`, `gaps` and `exponents`:
/// - `forces`: probability density P of f = force/mean force. It is the sum of the curves of the contact classes.
/// - `pairs`: mean of g(r) over the states, up to the largest r that all states have.
/// - `exponents`: probability density of the exponents x of the contacts.
/// - `face_face` and `edge_face`: alignment angles in degrees, as probability per decade. Angles below 1e-4 rad are
///   left out.
/// Each is {"curves": {name: [[x, y], ...]}, "states": number of states}, with x in the middle of each bin, or null if
/// no state has it.
Json pooled_distributions(std::span<const Json> states);

}  // namespace isojam
