#include "tasks/manifest/shear_settings.hpp"

#include <fmt/format.h>

#include <array>

#include "tasks/io/options.hpp"

namespace isojam {
namespace {

constexpr std::array<std::string_view, 5> keys{"mode", "control", "step", "until", "back"};

/// Strains of 0.01 are already large near jamming. Stresses are fractions of the pressure.
constexpr Range load_range{0, 1, true};

/// Largest number of states of a shear; nobody would plot more.
constexpr double most_steps = 10000;

}  // namespace

ShearOptions read_shear(const JsonPlace& place) {
  ShearOptions options;
  place.expect_keys(keys);
  place.read_if_any("mode", [&](const JsonPlace& value) { options.mode = value.choice<ShearMode>(); });
  place.read_if_any("control", [&](const JsonPlace& value) { options.control = value.choice<ShearControl>(); });
  place.read_if_any("step", [&](const JsonPlace& value) { options.step = value.number(load_range); });
  place.read_if_any("until", [&](const JsonPlace& value) { options.until = value.number(load_range); });
  place.read_if_any("back", [&](const JsonPlace& value) { options.back = value.boolean(); });
  if (!(options.step <= options.until && options.until <= most_steps * options.step)) {
    const bool is_short = options.until < options.step;
    place.at(place.has("until") ? "until" : "step")
        .refuse_with_remedy(is_short ? fmt::format("until {} is less than step {}", options.until, options.step)
                                     : fmt::format("until {} needs more than {:.0f} steps of {}", options.until,
                                                   most_steps, options.step),
                            is_short ? "increase until or decrease step" : "decrease until or increase step");
  }
  return options;
}

Json shear_json(const ShearOptions& options) {
  return {{"mode", to_string(options.mode)},
          {"control", to_string(options.control)},
          {"step", options.step},
          {"until", options.until},
          {"back", options.back}};
}

}  // namespace isojam
