#pragma once

#include <functional>

#include "engine/packing/mixture/mixture.hpp"
#include "tasks/solids/definitions.hpp"

namespace isojam {

/// An entry of a sweep: the name of a solid, or {"mixture": [{"solid": …, "fraction": …, "size": …}, …], "name": …}.
/// A size is a length, or a law: {"discrete": [{"size": …, "fraction": …}, …]}, {"uniform": [from, to]} or
/// {"log_normal": {"median": …, "sigma": …}}. Throws InputError.
Mixture read_sweep_entry(const JsonPlace& place, const SolidDefinitions& definitions);
/// The entry, with the name that it has.
Json sweep_entry(const Mixture& mixture);

/// Writes what put_solid does for one solid; for several kinds "solid", the name of the mixture, and "mixture", its
/// kinds, each with what put_solid writes.
void put_mixture(Json& json, const Mixture& mixture);
/// Reads what put_mixture wrote.
Mixture read_mixture(const JsonPlace& place);

}  // namespace isojam
