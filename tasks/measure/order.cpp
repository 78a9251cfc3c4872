#include "engine/analysis/orientation_order.hpp"
#include "engine/packing/energy.hpp"
#include "tasks/measure/shared_parts.hpp"

namespace isojam {
namespace {

constexpr QuantityGroup group{"order", "Order of the contact directions (Q4, Q6) and of the orientations (S)."};
constexpr Quantity Q4{"Q4", "/order/Q4", group, "1", "Q_4"}, Q6{"Q6", "/order/Q6", group, "1", "Q_6"};
constexpr Quantity local_Q4{"local_Q4", "/order/local_Q4", group, "1", "q_4"};
constexpr Quantity local_Q6{"local_Q6", "/order/local_Q6", group, "1", "q_6"};
constexpr Quantity S{"S_orientation", "/order/S", group, "1", "S_o"};
constexpr Quantity local_S = {"local_S_orientation", "/order/local_S", group, "1", "s_o"};
constexpr std::array quantities{Q4, Q6, local_Q4, local_Q6, S, local_S};

Json order_record(const Order& order) {
  Json state;
  put(state, Q4, order.Q4);
  put(state, Q6, order.Q6);
  put(state, local_Q4, order.local_Q4, "no contacts");
  put(state, local_Q6, order.local_Q6, "no contacts");
  constexpr auto several = "particles of several shapes have no orientation in common";
  if (order.S) {
    state["order"]["rank"] = order.rank;
  } else {
    put_optional(state["order"], "rank", std::nullopt, several);
  }
  put(state, S, order.S, several);
  put_number(state["order"], "random_S", order.random_S);
  put(state, local_S, order.local_S, order.S ? "no contacts" : several);
  put_number(state["order"], "random_local_S", order.random_local_S);
  return state;
}

Json correlation_record(const Packing& packing, unsigned rank) {
  const auto correlation = orientation_correlation(packing, orientation_harmonics(packing, rank));
  Json json;
  put_number(json, "width", correlation.width);
  json["mean"] = Json::array();
  json["pairs"] = Json::array();
  for (const auto& bin : correlation.bins) {
    json["mean"].push_back(bin.mean ? Json(*bin.mean) : Json(nullptr));
    json["pairs"].push_back(bin.pairs);
  }
  return json;
}

Measurement measure_order(const JamResult& jam, const MeasureOptions&) {
  Measurement measurement;
  PackingEnergy energy;
  const auto nearest = nearest_state(jam);
  for (std::size_t k = 0; k < jam.states.size(); ++k) {
    const auto order = order_of(jam.states[k], energy.contacts(jam.states[k]));
    auto state = order_record(order);
    if (k == nearest && order.S)
      state["order"]["orientation_correlation"] = correlation_record(jam.states[k], order.rank);
    if (k == nearest && is_aligned(order)) measurement.flags.emplace_back(to_string(Flag::crystalline));
    measurement.states.push_back(std::move(state));
  }
  return measurement;
}

constexpr std::array flags{Flag::crystalline};

}  // namespace

const MeasureDefinition measures::order{
    .quantities = quantities, .measure = measure_order, .flags = flags, .by_default = true, .at_zero_pressure = true};

}  // namespace isojam
