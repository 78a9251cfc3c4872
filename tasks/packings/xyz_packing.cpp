#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include "tasks/packings/foreign_packing.hpp"
#include "tasks/packings/packing_json.hpp"

namespace isojam {
namespace {

std::string_view next_line(std::string_view& text) {
  const auto end = text.find('\n');
  auto line = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  constexpr std::string_view blanks = " \t";
  for (auto at = line.find_first_not_of(blanks); at != std::string_view::npos;) {
    const auto end = std::min(line.find_first_of(blanks, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(blanks, end);
  }
  return words;
}

double number(std::string_view word) {
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
    throw NoPackingFile(fmt::format("\"{}\" is not a number", word));
  return value;
}

/// The value of key="…" or key=… in the second line of a frame; empty if the key is missing.
std::string_view value_of(std::string_view line, const std::string& key) {
  for (auto at = line.find(key + "="); at != std::string_view::npos; at = line.find(key + "=", at + 1)) {
    if (at > 0 && line[at - 1] != ' ') continue;
    auto rest = line.substr(at + key.size() + 1);
    if (!rest.starts_with('"')) return rest.substr(0, rest.find(' '));
    rest.remove_prefix(1);
    return rest.substr(0, rest.find('"'));
  }
  return {};
}

/// First column of each property, and the number of columns.
struct Columns {
  std::map<std::string, std::pair<std::size_t, std::size_t>, std::less<>> of;
  std::size_t count = 0;

  const std::pair<std::size_t, std::size_t>* find(std::string_view name, std::size_t width) const {
    const auto found = of.find(name);
    if (found == of.end()) return nullptr;
    if (found->second.second != width)
      throw NoPackingFile(fmt::format("its property {} has the wrong number of columns", name));
    return &found->second;
  }
};

Columns columns_of(std::string_view properties) {
  std::vector<std::string_view> parts;
  while (!properties.empty()) {
    const auto end = properties.find(':');
    parts.push_back(properties.substr(0, end));
    properties.remove_prefix(end == std::string_view::npos ? properties.size() : end + 1);
  }
  if (parts.size() % 3 != 0) throw NoPackingFile("its Properties do not have the form name:type:columns");
  Columns columns;
  for (std::size_t k = 0; k < parts.size(); k += 3) {
    const double width = number(parts[k + 2]);
    if (!(width >= 1 && width <= 100)) throw NoPackingFile("a property has no columns, or too many");
    columns.of[std::string(parts[k])] = {columns.count, static_cast<std::size_t>(width)};
    columns.count += static_cast<std::size_t>(width);
  }
  return columns;
}

std::size_t particles_in(std::string_view line) {
  const auto words = words_of(line);
  const double count = words.size() == 1 ? number(words[0]) : 0;
  if (!(count >= 1 && count <= static_cast<double>(most_particles)) || count != std::floor(count))
    throw NoPackingFile("its first line is not a number of particles");
  return static_cast<std::size_t>(count);
}

/// The text from the beginning of the frame on.
std::string_view at_frame(std::string_view text, int frame) {
  std::vector<std::string_view> frames;
  for (auto rest = text; !words_of(rest.substr(0, rest.find('\n'))).empty();) {
    frames.push_back(rest);
    const auto lines = particles_in(next_line(rest)) + 1;
    for (std::size_t k = 0; k < lines; ++k) next_line(rest);
  }
  const auto count = static_cast<int>(frames.size()), index = frame < 0 ? count + frame : frame;
  if (index < 0 || index >= count) throw NoPackingFile(fmt::format("it has only {} frames", count));
  return frames[static_cast<std::size_t>(index)];
}

}  // namespace

ForeignPacking read_xyz_packing(std::string_view text, int frame) {
  auto rest = at_frame(text, frame);
  const auto n = particles_in(next_line(rest));
  const auto head = next_line(rest);
  ForeignPacking packing;
  const auto lattice = words_of(value_of(head, "Lattice"));
  if (lattice.size() != 9) throw NoPackingFile("it has no Lattice of nine numbers");
  for (std::size_t k = 0; k < 9; ++k) packing.cell.data()[k] = number(lattice[k]);
  const auto columns = columns_of(value_of(head, "Properties"));
  const auto *species = columns.find("species", 1), *pos = columns.find("pos", 3),
             *orientation = columns.find("orientation", 4), *size = columns.find("size", 1);
  if (!species || !pos || !orientation) throw NoPackingFile("its Properties lack species, pos or orientation");
  std::map<std::string, int, std::less<>> types;
  for (std::size_t i = 0; i < n; ++i) {
    const auto words = words_of(next_line(rest));
    if (words.size() != columns.count)
      throw NoPackingFile(fmt::format("the line of particle {} has the wrong number of columns", i));
    const auto [type, added] = types.try_emplace(std::string(words[species->first]), static_cast<int>(types.size()));
    if (added) packing.types.push_back({type->first, {}});
    const auto at = [&](const auto* column, std::size_t k) { return number(words[column->first + k]); };
    const Eigen::Quaterniond q(at(orientation, 3), at(orientation, 0), at(orientation, 1), at(orientation, 2));
    if (!(q.norm() > 0.5)) throw NoPackingFile(fmt::format("particle {} has no orientation", i));
    if (size && !(at(size, 0) > 0)) throw NoPackingFile(fmt::format("particle {} has no size", i));
    packing.bodies.push_back(
        {type->second, size ? at(size, 0) : 1, {at(pos, 0), at(pos, 1), at(pos, 2)}, q.normalized()});
  }
  return packing;
}

}  // namespace isojam
