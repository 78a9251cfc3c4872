#pragma once

#include <functional>

#include "engine/packing/mixture/mixture.hpp"
#include "tasks/solids/definitions.hpp"

namespace isojam {

/// An entry of a sweep: the name of a solid, or {"mixture": [{"solid": …, "fraction": …, "size": …}, …], "name": …}.
/// A size is a length, or a law: {"discrete": [{"size": …, "fraction": …}, …]}, {"uniform": [from, to]} or
/// {"log_normal": {"median": …, "sigma": …}}. Throws InputError.
Mixture read_sweep_entry(const JsonPlace& place, const SolidDefinitions& definitions);
/// The entry, with its name.
Json sweep_entry(const Mixture& mixture);

/// Writes the same as put_solid for one solid. For several kinds writes "solid", the name of the mixture, and
/// "mixture", its kinds, each as put_solid writes it.
void put_mixture(Json& json, const Mixture& mixture);
/// Reads the output of put_mixture.
Mixture read_mixture(const JsonPlace& place);

}  // namespace isojam
