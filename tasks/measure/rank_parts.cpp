#include "tasks/measure/rank_parts.hpp"

namespace isojam {

void describe_rank(Fields& field, Rank& rank, const std::string& name, const std::string& letter,
                   const std::string& condition) {
  constexpr QuantityGroup group{
      "rigidity", "Numbers of floppy motions and states of self-stress, from the rank of the rigidity matrix."};
  field.type("rank", "Number and rank of the constraints.");
  field("constraints", rank.constraints, "Number of constraints, the rows of the rigidity matrix.");
  field("rank", rank.rank, "Number of independent constraints, the rank of the rigidity matrix.");
  field("self_stress", rank.self_stress,
        "Number of states of self-stress, which is the number of constraints minus the rank.")
      .column({"self_stress_" + name, group, "s_" + letter, "Number of states of self-stress, " + condition});
  field("floppy", rank.floppy, "Number of floppy motions, including the three translations. It is 6N minus the rank.")
      .column({"floppy_" + name, group, "f_" + letter,
               "Number of floppy motions, including the three translations, " + condition, 1});
  field("tolerance", rank.tolerance,
        "A singular value of the rigidity matrix counts as zero if it is at most this value.");
  field("least_kept", rank.least_kept,
        "Smallest singular value that counts as nonzero. It is an upper limit, accurate to a few per cent.");
  field("largest_dropped", rank.largest_dropped, "Largest singular value that counts as zero.");
}

Rank rank_of(const RigidityMatrix& matrix, const RigidityOptions& options) {
  const auto found = analyse_rigidity(matrix, options);
  return {{found.constraints, ""}, {found.rank, ""}, {found.self_stress, ""}, {found.floppy, ""},
          found.tolerance,         found.least_kept, found.largest_dropped};
}

Rank no_rank(std::string_view why) {
  const Reasoned<int> none{std::nullopt, std::string(why)};
  return {none, none, none, none, {}, {}, {}};
}

}  // namespace isojam
