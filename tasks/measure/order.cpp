#include "engine/analysis/orientation_order.hpp"
#include "engine/packing/energy.hpp"
#include "tasks/measure/parts.hpp"

namespace isojam {
namespace {

Json order_record(const Order& order) {
  Json json;
  put_number(json, "Q4", order.Q4);
  put_number(json, "Q6", order.Q6);
  put_optional(json, "local_Q4", order.local_Q4, "no contacts");
  put_optional(json, "local_Q6", order.local_Q6, "no contacts");
  json["rank"] = order.rank;
  put_number(json, "S", order.S);
  put_number(json, "random_S", order.random_S);
  return json;
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

}  // namespace

Measurement measure_order(const JamResult& jam) {
  Measurement measurement;
  PackingEnergy energy;
  const auto nearest = nearest_state(jam);
  for (std::size_t k = 0; k < jam.states.size(); ++k) {
    const auto order = measure_order(jam.states[k], energy.contacts(jam.states[k]));
    auto json = order_record(order);
    if (k == nearest) json["orientation_correlation"] = correlation_record(jam.states[k], order.rank);
    measurement.states.push_back({{"order", std::move(json)}});
  }
  return measurement;
}

}  // namespace isojam
