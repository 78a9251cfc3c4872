#pragma once

#include <optional>
#include <string>

#include "tasks/chart/atlas/atlas.hpp"

// What the parts of the atlas share.

namespace isojam {

/// "holds" if error ≤ tolerance, "fails" otherwise or if there is no error to be had. `what` names the error.
AtlasRow judged(AtlasRow row, std::optional<double> error, double tolerance, const std::string& what);

AtlasRow refused(AtlasRow row, const std::string& why);

/// "1e-10"; "exactly" for 0.
std::string decade_name(double x);

}  // namespace isojam
