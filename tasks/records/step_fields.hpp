#pragma once

#include <cstdint>

#include "engine/solve/jam.hpp"
#include "tasks/io/describe.hpp"

// The fields of strain steps and of the work that they took, in records and checkpoints.

namespace isojam {

template <>
inline constexpr std::array enum_names<Precision>{EnumName{Precision::working, "working"},
                                                  EnumName{Precision::double_double, "double_double"}};

void describe(Fields& field, PairCounts& counts);
void describe(Fields& field, MinimiseWork& work);
void describe(Fields& field, Rearrangement& rearrangement);

/// The list that contains a step: the path of a record, its states, or the path of a checkpoint.
enum class StepOf : std::uint8_t { path, state, checkpoint };
/// Adds the fields of a step. `delta_phi` is written in records only, because a checkpoint does not know φ_J.
void describe(Fields& field, JamStep& step, Reasoned<>& delta_phi, StepOf of);

/// A step in the path of a record.
struct StepRow {
  JamStep step;
  Reasoned<> delta_phi{std::nullopt, "no jamming point"};
};
void describe(Fields& field, StepRow& row);

/// A step in the path of a checkpoint.
struct CheckpointStep {
  JamStep step;
};
void describe(Fields& field, CheckpointStep& row);

}  // namespace isojam
