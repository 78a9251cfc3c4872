#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tasks/io/place.hpp"
#include "tasks/manifest/manifest.hpp"

namespace isojam {

/// Checks the combinations of cohesion with other values, and throws InputError for those that are not possible: solids
/// that cannot grow, target_before_relaxation, and a measure or a goal that a packing at zero pressure does not have.
/// `root` is the whole manifest.
void check_cohesion(const JsonPlace& root, const Manifest& manifest, const std::vector<OptionSet>& sets);

/// The reason why the packings of this manifest cannot have one of the measures; nullopt if they can have all of them.
std::optional<std::string> problem_of_measures(const Manifest& manifest, const std::vector<Measure>& measures);

}  // namespace isojam
