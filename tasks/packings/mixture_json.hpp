#pragma once

#include "engine/packing/mixture/mixture.hpp"
#include "tasks/packings/definitions.hpp"

namespace isojam {

/// Reads an entry of sweep.solid: the name of a solid, or {"mixture": [{"solid": …, "fraction": …, "size": …}, …],
/// "name": …}. A size is a number, or a distribution: {"discrete": [{"size": …, "fraction": …}, …]}, {"uniform": [from,
/// to]} or {"log_normal": {"median": …, "sigma": …}}. Throws InputError if the entry is not allowed.
Mixture read_sweep_entry(const JsonPlace& place, const SolidDefinitions& definitions);
/// Converts a mixture to an entry of sweep.solid. The entry has a name only if the user chose it.
Json sweep_entry(const Mixture& mixture);
/// The schema of an entry of sweep.solid.
Json sweep_entry_schema();

/// Writes a mixture. If all particles have the same solid and size, it writes what put_solid() writes. Otherwise it
/// writes two keys: "solid", the name of the mixture, and "mixture", a list of its kinds. Each kind contains what
/// put_solid() writes.
void put_mixture(Json& json, const Mixture& mixture);
/// Reads a mixture that put_mixture() has written. Throws InputError if the JSON has another form.
Mixture read_mixture(const JsonPlace& place);

}  // namespace isojam
