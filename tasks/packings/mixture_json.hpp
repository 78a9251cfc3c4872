#pragma once

#include <functional>

#include "engine/packing/mixture/mixture.hpp"
#include "tasks/packings/definitions.hpp"

namespace isojam {

/// Reads an entry of sweep.solid: the name of a solid, or {"mixture": [{"solid": …, "fraction": …, "size": …}, …],
/// "name": …}. A size is a length, or a distribution: {"discrete": [{"size": …, "fraction": …}, …]}, {"uniform": [from,
/// to]} or {"log_normal": {"median": …, "sigma": …}}. Throws InputError.
Mixture read_sweep_entry(const JsonPlace& place, const SolidDefinitions& definitions);
/// The entry of sweep.solid for a mixture, including its name.
Json sweep_entry(const Mixture& mixture);

/// Writes a mixture. If all particles have one solid, it writes the same as put_solid(). For several kinds, it writes
/// "solid", the name of the mixture, and "mixture", a list of the kinds, each as put_solid() writes it.
void put_mixture(Json& json, const Mixture& mixture);
/// Reads what put_mixture() has written.
Mixture read_mixture(const JsonPlace& place);

}  // namespace isojam
