#pragma once

#include <string_view>

namespace isojam {

// Texts of messages that several source files use.

inline constexpr std::string_view no_directory = "no such directory";
inline constexpr std::string_view no_results = "contains no results";
inline constexpr std::string_view how_to_get_results = "give a results directory of isojam run";
inline constexpr std::string_view no_records = "contains no records yet; run its manifest first";
inline constexpr std::string_view how_to_recompute =
    "run the manifest again in this directory to recompute the replicate";
inline constexpr std::string_view other_manifest = "contains results of another manifest";
inline constexpr std::string_view choose_another_directory = "choose another results directory";
inline constexpr std::string_view states_not_saved = "the states of the decompression were not saved";
inline constexpr std::string_view how_to_keep_states =
    "set \"keep_path\": true in the manifest and run it again; isojam then recomputes the replicates without saved "
    "states";
inline constexpr std::string_view no_states = "the list of states is empty";

inline constexpr std::string_view list_of_states = "a list of states";
inline constexpr std::string_view list_of_steps = "a list of steps";

}  // namespace isojam
