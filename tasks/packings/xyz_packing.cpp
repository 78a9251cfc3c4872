#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "tasks/packings/foreign_packing.hpp"
#include "tasks/packings/packing_json.hpp"
#include "tasks/packings/text_lines.hpp"

namespace isojam {
namespace {

/// The values of the second line of a frame by their keys in small letters: key="…", key='…', key={…} or key=…. A value
/// in quotation marks may contain any text, also text that looks like another key.
class Header {
 public:
  explicit Header(const TextLines& lines) : lines_(lines) {
    std::string_view rest = lines.text();
    while (skip_blanks(rest)) {
      const auto end = rest.find_first_of(" \t=");
      const auto key = lower_case(rest.substr(0, end));
      rest.remove_prefix(std::min(end, rest.size()));
      if (!rest.starts_with('=')) continue;  // a flag, or a comment without quotation marks
      rest.remove_prefix(1);
      const auto value = take_value(rest);
      if (!values_.emplace(key, value).second && (key == "lattice" || key == "properties"))
        lines_.refuse(fmt::format("the key {} occurs twice", key), "remove one of them");
    }
  }

  bool has(std::string_view key) const { return values_.contains(key); }
  const std::string& at(std::string_view key, std::string_view example) const {
    const auto found = values_.find(lower_case(key));
    if (found == values_.end()) lines_.refuse(fmt::format("the line has no {}", key), fmt::format("add {}", example));
    return found->second;
  }

 private:
  static bool skip_blanks(std::string_view& rest) {
    rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
    return !rest.empty();
  }

  std::string take_value(std::string_view& rest) const {
    constexpr std::string_view open = "\"'{[", close = "\"'}]";
    const auto kind = rest.empty() ? std::string_view::npos : open.find(rest[0]);
    std::string value;
    std::size_t at = 0;
    if (kind == std::string_view::npos) {
      at = std::min(rest.find_first_of(" \t"), rest.size());
      value = rest.substr(0, at);
    } else {
      for (at = 1; at < rest.size() && rest[at] != close[kind]; ++at) {
        if (rest[at] == '\\' && at + 1 < rest.size()) ++at;
        value += rest[at];
      }
      if (at == rest.size()) lines_.refuse("a quotation mark or a bracket is not closed", "close it on the same line");
      ++at;
    }
    rest.remove_prefix(at);
    return value;
  }

  const TextLines& lines_;
  std::map<std::string, std::string, std::less<>> values_;
};

/// Refuses a packing that is not periodic in all three directions, which the key pbc states.
void expect_periodic(const TextLines& lines, const Header& header) {
  if (!header.has("pbc")) return;
  const auto& text = header.at("pbc", "");
  const auto words = words_of(text);
  for (std::size_t k = 0; k < words.size(); ++k) {
    const auto word = lower_case(words[k]);
    if (words.size() == 3 && (word == "t" || word == "true" || word == "1")) continue;
    if (words.size() == 3 && (word == "f" || word == "false" || word == "0"))
      lines.refuse(fmt::format("pbc=\"{}\": the packing is not periodic along lattice vector {}", text, k + 1),
                   "use a packing that is periodic in all three directions; if it is, write pbc=\"T T T\"");
    lines.refuse(fmt::format("pbc=\"{}\" does not state three directions", text), "write pbc=\"T T T\"");
  }
}

/// First column of each property, and the number of columns.
struct Columns {
  std::map<std::string, std::pair<std::size_t, std::size_t>, std::less<>> of;
  std::size_t count = 0;

  std::optional<std::size_t> find(const TextLines& lines, std::string_view name, std::size_t width) const {
    const auto found = of.find(name);
    if (found == of.end()) return std::nullopt;
    if (found->second.second != width)
      lines.refuse(fmt::format("the property {} has {} columns instead of {}", name, found->second.second, width));
    return found->second.first;
  }
  std::size_t at(const TextLines& lines, std::string_view name, std::size_t width) const {
    const auto found = find(lines, name, width);
    if (!found)
      lines.refuse(fmt::format("the Properties have no {}", name),
                   "add the columns species:S:1:pos:R:3:orientation:R:4");
    return *found;
  }
};

Columns columns_of(const TextLines& lines, std::string_view properties) {
  constexpr long widest = 100;
  std::vector<std::string_view> parts;
  while (!properties.empty()) {
    const auto end = properties.find(':');
    parts.push_back(properties.substr(0, end));
    properties.remove_prefix(end == std::string_view::npos ? properties.size() : end + 1);
  }
  if (parts.size() % 3 != 0) lines.refuse("the Properties do not have the form name:type:columns");
  Columns columns;
  for (std::size_t k = 0; k < parts.size(); k += 3) {
    const auto width = static_cast<std::size_t>(lines.integer(parts[k + 2], 1, widest, "number of columns"));
    if (!columns.of.emplace(lower_case(parts[k]), std::pair(columns.count, width)).second)
      lines.refuse(fmt::format("the Properties contain {} twice", in_quotes(parts[k])), "remove one of them");
    columns.count += width;
  }
  return columns;
}

/// Reads the line with the number of particles; nullopt at the end of the file.
std::optional<std::size_t> next_count(TextLines& lines) {
  if (!lines.next_line() || (lines.words().empty() && !lines.next())) return std::nullopt;
  if (lines.words().size() != 1)
    lines.refuse("this line is not the number of particles", "begin each frame of an XYZ file with a line for it");
  return static_cast<std::size_t>(
      lines.integer(lines.words()[0], 1, static_cast<long>(most_particles), "number of particles"));
}

/// Moves to the line with the number of particles of a frame, and returns this number.
std::size_t go_to_frame(TextLines& lines, std::string_view text, int frame) {
  constexpr char none = '\0';
  std::vector<TextLines> frames;
  TextLines rest(text, none);
  for (auto before = rest; const auto count = next_count(rest); before = rest) {
    frames.push_back(before);
    for (std::size_t k = 0; k <= *count; ++k) {
      if (!rest.next_line())
        rest.refuse(fmt::format("frame {} ends after {} of {} lines", frames.size() - 1, k, *count + 1),
                    "complete the frame, or correct its number of particles");
    }
  }
  lines = frames[index_of_frame(frames.size(), frame)];
  return *next_count(lines);
}

/// True for words like symbols of elements, "O" or "Ne", and for "X", which stands for any.
bool is_symbol(std::string_view word) {
  const bool small = word.size() == 1 || (word.size() == 2 && word[1] >= 'a' && word[1] <= 'z');
  return small && word[0] >= 'A' && word[0] <= 'Z';
}

}  // namespace

ForeignPacking read_xyz_packing(std::string_view text, int frame) {
  TextLines lines(text);
  const auto n = go_to_frame(lines, text, frame);
  lines.next_line();
  const Header header(lines);
  expect_periodic(lines, header);
  ForeignPacking packing;
  const auto& lattice_text = header.at("Lattice", "Lattice=\"ax ay az bx by bz cx cy cz\"");
  const auto lattice = words_of(lattice_text);
  if (lattice.size() != 9)
    lines.refuse(fmt::format("the Lattice has {} numbers", lattice.size()), "write three vectors of three numbers");
  for (std::size_t k = 0; k < 9; ++k) packing.cell.data()[k] = lines.real(lattice[k]);
  const auto columns = columns_of(lines, header.at("Properties", "Properties=species:S:1:pos:R:3:orientation:R:4"));
  // isojam writes the names of the solids to a column of their own, because species are symbols of elements.
  const auto solid = columns.find(lines, "solid", 1);
  const auto species = solid ? *solid : columns.at(lines, "species", 1), pos = columns.at(lines, "pos", 3),
             orientation = columns.at(lines, "orientation", 4);
  const auto size = columns.find(lines, "size", 1);
  std::map<std::string, int, std::less<>> types;
  for (std::size_t i = 0; i < n; ++i) {
    lines.next_line();
    const auto& words = lines.words();
    if (words.size() != columns.count)
      lines.refuse(fmt::format("particle {} has {} columns instead of {}", i, words.size(), columns.count));
    const auto [type, added] = types.try_emplace(std::string(words[species]), static_cast<int>(types.size()));
    // ASE writes symbols of elements, whatever the particles are.
    if (added) packing.types.push_back({type->first, {}, {}, !solid && is_symbol(type->first)});
    const auto at = [&](std::size_t column) { return lines.real(words[column]); };
    const auto q = unit_quaternion({at(orientation + 3), at(orientation), at(orientation + 1), at(orientation + 2)}, i,
                                   "x y z w", lines.number());
    const double scale = size ? at(*size) : 1;
    if (!(scale > 0)) lines.refuse(fmt::format("particle {} has the size {}", i, scale), "write a size above 0");
    packing.bodies.push_back({type->second, scale, {at(pos), at(pos + 1), at(pos + 2)}, q});
  }
  return packing;
}

}  // namespace isojam
