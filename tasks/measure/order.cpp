#include "engine/analysis/orientation_order.hpp"
#include "engine/packing/energy.hpp"
#include "tasks/measure/shared_parts.hpp"

namespace isojam {
namespace {

struct Correlation {
  double width = 0;
  std::vector<std::optional<double>> mean;
  std::vector<long> pairs;
};
void describe(Fields& field, Correlation& correlation) {
  field("width", correlation.width, "Width of a bin of the distance, in units of V_p^(1/3).");
  field("mean", correlation.mean,
        "Mean q_ij of the pairs in each bin. The first bin begins at the distance 0. Null for a bin without pairs.")
      .detail();
  field("pairs", correlation.pairs, "Number of pairs in each bin.").detail();
}

struct OrderRecord {
  double Q4 = 0, Q6 = 0;
  Reasoned<> local_Q4, local_Q6;
  Reasoned<unsigned> rank;
  Reasoned<> S;
  double random_S = 0;
  Reasoned<> local_S;
  double random_local_S = 0;
  std::optional<Correlation> orientation_correlation;
};
void describe(Fields& field, OrderRecord& order) {
  constexpr QuantityGroup group{"order", "Order of the contact directions (Q4, Q6) and of the orientations (S)."};
  field("Q4", order.Q4, "Steinhardt's Q4 of the directions of all contacts.").column({"Q4", group, "Q_4"});
  field("Q6", order.Q6, "Steinhardt's Q6 of the directions of all contacts.").column({"Q6", group, "Q_6"});
  field("local_Q4", order.local_Q4,
        "Mean of the local Q4 over all particles that have a contact. The local Q4 of a particle is Steinhardt's Q4 of "
        "the directions of its contacts.")
      .column({"local_Q4", group, "q_4"});
  field("local_Q6", order.local_Q6,
        "Mean of the local Q6 over all particles that have a contact. The local Q6 of a particle is Steinhardt's Q6 of "
        "the directions of its contacts.")
      .column({"local_Q6", group, "q_6"});
  field("rank", order.rank, "Rank l of the orientational order S_l; null if the particles have several shapes.")
      .range({1, count_range.high});
  field("S", order.S,
        "Orientational order S_l of the lowest rank l that the symmetry of the solid allows. It is 1 if all particles "
        "have the same orientation, and about 1/√N if their orientations are independent. Null if the particles have "
        "several shapes.")
      .column({"S_orientation", group, "S_o"});
  field("random_S", order.random_S, "1/√N, the approximate value of `S` for independent orientations.");
  field("local_S", order.local_S,
        "Local orientational order: the mean alignment q_ij of the pairs of touching particles. It is 1 if the two "
        "particles of every pair have the same orientation. It is also large in a packing of several crystallites. "
        "Null if the particles have several shapes.")
      .column({"local_S_orientation", group, "s_o"});
  field("random_local_S", order.random_local_S,
        "Standard deviation of `local_S` for independent orientations; 0 if `local_S` is null.");
  field("orientation_correlation", order.orientation_correlation,
        "Mean alignment q_ij of two particles i and j as a function of the distance between their centres. q_ij is 1 "
        "for particles with the same orientation, and 0 on average for independent orientations. The field is present "
        "only in the state nearest jamming, and only if all particles have the same shape.");
}

struct State {
  OrderRecord order;
};
void describe(Fields& field, State& state) {
  field("order", state.order,
        "Order of the directions of the contacts (Q), and of the orientations of the particles (S).");
}

OrderRecord order_record(const Order& order) {
  constexpr std::string_view no_contacts = "no contacts",
                             several = "particles of several shapes have no orientation in common";
  OrderRecord record;
  record.Q4 = order.Q4;
  record.Q6 = order.Q6;
  record.local_Q4 = reasoned(order.local_Q4, no_contacts);
  record.local_Q6 = reasoned(order.local_Q6, no_contacts);
  record.rank = given(order.S.has_value(), order.rank, several);
  record.S = reasoned(order.S, several);
  record.random_S = order.random_S;
  record.local_S = reasoned(order.local_S, order.S ? no_contacts : several);
  record.random_local_S = order.random_local_S;
  return record;
}

Correlation correlation_of(const Packing& packing, unsigned rank) {
  const auto found = orientation_correlation(packing, orientation_harmonics(packing, rank));
  Correlation correlation{found.width, {}, {}};
  for (const auto& bin : found.bins) {
    correlation.mean.push_back(bin.mean);
    correlation.pairs.push_back(bin.pairs);
  }
  return correlation;
}

Measurement measure_order(const JamResult& jam, const MeasureOptions& options) {
  Measurement measurement;
  PackingEnergy energy;
  const auto nearest = nearest_state(jam);
  for (std::size_t k = 0; k < jam.states.size(); ++k) {
    const auto order = order_of(jam.states[k], contacts_of(jam.states[k], energy, options.gap).contacts);
    State state{order_record(order)};
    if (k == nearest && order.S) state.order.orientation_correlation = correlation_of(jam.states[k], order.rank);
    if (k == nearest && is_aligned(order)) measurement.flags.emplace_back(to_string(Flag::crystalline));
    measurement.states.push_back(written(state));
  }
  return measurement;
}

constexpr std::array flags{Flag::crystalline};

}  // namespace

const MeasureDefinition measures::order{.state = part_of<State>(),
                                        .measure = measure_order,
                                        .flags = flags,
                                        .by_default = true,
                                        .at_zero_pressure = true,
                                        .as_given = true};

}  // namespace isojam
