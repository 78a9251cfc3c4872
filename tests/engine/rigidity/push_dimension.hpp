#pragma once

#include <optional>
#include <span>

#include "engine/random/stream.hpp"
#include "engine/rigidity/contact_patch.hpp"

namespace isojam {

/// What is seen of the states of self-stress in which contacts only push, at the corners of their patches.
struct PushedStates {
  /// Dimension of what they span, as forces and torques of contacts; 0 if there is none, nullopt if the solver gave no
  /// answer.
  std::optional<int> dimension;
  /// Least and largest part of a state that lay beside all before it, of those that counted as new and of those that
  /// did not; the dimension is as certain as they are apart. 0 where there is none.
  double least_new = 0, largest_old = 0;
  int programmes = 0;          ///< that were solved
  double most_below = 0;       ///< that a push was below 0; their sum is 1
  double most_unbalanced = 0;  ///< of the sums of forces, and of torques over R, on particles
};

/// By linear programmes whose objectives are at right angles to all that was seen before, each in both directions: as
/// long as there is more, one of the two finds it but for bad luck. They end when several have found nothing new.
/// `corners` are the corner_constraints() of the patches. Pushes balance to rounding, or if none do, as well as the
/// forces of the state itself along its `normals`: a state of self-stress that the contacts have by their number is
/// there in any state, one that an equilibrium has besides is as good as the equilibrium.
PushedStates pushed_states(std::span<const Contact> contacts, std::span<const ContactPatch> patches,
                           const RigidityMatrix& normals, const RigidityMatrix& corners, RandomStream& random);

}  // namespace isojam
