#include "tasks/records/failure_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>

#include "engine/solve/jam.hpp"
#include "tasks/records/replicate.hpp"

namespace isojam {
namespace {

constexpr std::string_view cell_limit_remedy = "use more particles";

StopReason end_of_last_step(const Json& record) {
  const auto& stopped = record.at("path").back().at("stopped").get_ref<const std::string&>();
  return from_string<StopReason>(stopped).value_or(StopReason::not_called);
}

/// The change of the manifest after which a decompression probably finds more states. Empty if none is known.
std::string remedy_of_decompression(const Json& record) {
  const auto& path = record.at("path");
  // If solution branches ended, a change of the manifest only selects other branches at random.
  if (std::any_of(path.begin(), path.end(), [](const Json& step) { return step.contains("lost"); })) return "";
  const bool multipliers = record.at("spec").at("minimiser").at("method") == to_string(Method::multipliers);
  switch (end_of_last_step(record)) {
    case StopReason::budget:
      return multipliers ? "increase max_evaluations" : "increase max_evaluations, or use the method multipliers";
    case StopReason::line_search_failed: return multipliers ? "" : "use the method multipliers";
    case StopReason::unjammed:
      return path.front().at("stage") == to_string(JamStage::compression) ? "increase target_energy"
                                                                          : "use a denser initial packing";
    // The first state is already so close to jamming that there is no second one.
    case StopReason::residual_reached:
    case StopReason::precision_floor:
    case StopReason::energy_change:
      // target_energy has no effect without a compression.
      return path.front().at("stage") == to_string(JamStage::compression)
                 ? "decrease final_distance, or increase target_energy"
                 : "decrease final_distance, or use a denser initial packing";
    default: return "";
  }
}

/// True if the run relaxes to zero pressure and has no decompression.
bool is_to_zero_pressure(const Json& record) {
  const auto& cohesion = record.at("spec").at("protocol").at("cohesion");
  return cohesion.at("until") == to_string(CohesionUntil::end) && cohesion.at("strength") > 0;
}

struct Explanation {
  std::string problem, remedy;
};

std::optional<Explanation> explanation_of(JamStatus status, const Json& record) {
  const auto stage = record.at("path").back().at("stage").get_ref<const std::string&>();
  switch (status) {
    case JamStatus::density_limit:
      return Explanation{"max_density was reached before the end of compression", "increase max_density"};
    case JamStatus::step_limit:
      return Explanation{fmt::format("max_steps was reached before the end of {}", stage), "increase max_steps"};
    case JamStatus::cell_limit:
      return Explanation{"the cell became so small or skew that a particle can touch two images of another",
                         std::string(cell_limit_remedy)};
    case JamStatus::not_jammed:
      if (is_to_zero_pressure(record))
        return Explanation{"no equilibrium at zero pressure was found",
                           end_of_last_step(record) == StopReason::budget ? "increase max_evaluations" : ""};
      return Explanation{"decompression found fewer than two states", remedy_of_decompression(record)};
    case JamStatus::detached:
      return Explanation{"no particles touch at zero pressure", "increase the strength or the range of the cohesion"};
    case JamStatus::not_finite: return Explanation{fmt::format("an energy or a force in {} is not finite", stage), ""};
    default: return std::nullopt;
  }
}

std::string number_text(const Json& value, int digits) {
  return value.is_number() ? fmt::format("{:.{}g}", value.get<double>(), digits) : "not finite";
}

}  // namespace

std::string failure_text(const Json& record) {
  const auto where = record.at("failure").at("where").get<std::string>();
  auto why = record.at("failure").at("why").get<std::string>();
  if (where != "jam") return fmt::format("{} ({})", why, where == "begin" ? "initial packing" : "measure " + where);
  const auto& path = record.at("path");
  const auto status = from_string<JamStatus>(why.substr(0, why.find(' ')));
  const auto explanation = status && !path.empty() ? explanation_of(*status, record) : std::nullopt;
  if (!explanation)
    return why.starts_with("the cell is so small") ? fmt::format("{}; {}", why, cell_limit_remedy) : why;
  const auto& last = path.back();
  return fmt::format("{} ({} steps, density {}, residual {}){}{}", explanation->problem, path.size(),
                     number_text(last.at("density"), 4), number_text(last.at("residual"), 2),
                     explanation->remedy.empty() ? "" : "; ", explanation->remedy);
}

}  // namespace isojam
