#include "tasks/extras/export/stored_states.hpp"

#include <fmt/format.h>

#include <system_error>

#include "tasks/io/input_error.hpp"
#include "tasks/io/place.hpp"
#include "tasks/packings/packing_json.hpp"
#include "tasks/records/state_file.hpp"
#include "tasks/records/texts.hpp"

namespace isojam {
namespace fs = std::filesystem;
namespace {

std::string file_of(const fs::path& directory, const char* folder, const std::string& name) {
  return (directory / folder / (name + ".json")).string();
}

/// The exponents of a state that the record has under the measure `exponents`.
std::vector<std::optional<double>> exponents_of(const RecordedReplicate& held, std::size_t state) {
  std::vector<std::optional<double>> list;
  const Json::json_pointer pointer(fmt::format("/states/{}/exponents/x", state));
  if (!held.record.contains(pointer)) return list;
  for (const Json& x : held.record.at(pointer))
    list.push_back(x.is_null() ? std::nullopt : std::optional(x.get<double>()));
  return list;
}

std::vector<StoredState> states_of_path(const fs::path& directory, const RecordedReplicate& held) {
  const auto file = file_of(directory, "paths", held.name);
  std::error_code error;
  if (!fs::exists(file, error))
    throw InputError({file, "", std::string(states_not_saved), "", "", std::string(how_to_keep_states)});
  const auto json = read_state_file_of(directory, held, "paths");
  const auto states = JsonPlace(json, file).at("states");
  const auto count = states.expect_list(list_of_states);
  if (count == 0) states.refuse(std::string(no_states));
  std::vector<StoredState> list;
  for (std::size_t k = 0; k < count; ++k) {
    const auto state = states.at(k);
    list.push_back({k, read<PathState>(state).delta_phi.value, read_packing(state), exponents_of(held, k), held.gap()});
    const auto &first = list.front().packing, &last = list.back().packing;
    if (!(last.solids == first.solids) || last.size() != first.size())
      state.refuse("the state has other particles than the first one");
  }
  return list;
}

}  // namespace

std::vector<StoredState> stored_states(const fs::path& directory, const RecordedReplicate& held, bool path) {
  if (path) return states_of_path(directory, held);
  const auto json = read_state_file_of(directory, held, "packings");
  const JsonPlace packing(json, file_of(directory, "packings", held.name));
  std::vector<StoredState> one;
  const auto nearest = static_cast<std::size_t>(*held.document.nearest.value);
  one.push_back({nearest, held.document.states[nearest].delta_phi.value, read_packing(packing),
                 exponents_of(held, nearest), held.gap()});
  return one;
}

}  // namespace isojam
