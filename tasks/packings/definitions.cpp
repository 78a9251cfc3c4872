#include "tasks/packings/definitions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "engine/geometry/solids/named_solids.hpp"
#include "tasks/io/file.hpp"
#include "tasks/io/options.hpp"
#include "tasks/packings/solid_file.hpp"

namespace isojam {
namespace {

using Eigen::Vector3d;

constexpr std::array<std::string_view, 3> ways{"box", "file", "vertices"};
constexpr std::string_view allowed_definition =
    "{\"box\": [a, b, c]}, {\"file\": \"x.off\"} or {\"vertices\": [[x, y, z], ...]}";
constexpr std::string_view allowed_file = "an OFF or STL file of one convex polyhedron";
constexpr Range edge_range{0, 1e9, true};

std::vector<Vector3d> box_vertices(const JsonPlace& place) {
  place.expect_length(3, "three edges");
  Vector3d edges;
  for (std::size_t c = 0; c < 3; ++c) edges[static_cast<Eigen::Index>(c)] = place.at(c).number(edge_range);
  std::vector<Vector3d> vertices;
  for (int k = 0; k < 8; ++k)
    vertices.emplace_back(edges.cwiseProduct(Vector3d(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1)));
  return vertices;
}

std::vector<Vector3d> file_vertices(const JsonPlace& place) {
  const auto name = place.text("the path of an OFF or STL file");
  const auto path = std::filesystem::path(place.file()).parent_path() / name;
  try {
    return read_solid_file(path);
  } catch (const NoSolidFile& error) {
    place.refuse(fmt::format("{}: {}", path.string(), error.what()), std::string(allowed_file));
  } catch (const FileError& error) {
    if (error.reason() == FileError::Reason::resource_failure)
      throw;  // a resource failure, not an error of the manifest
    place.refuse(error.what(), std::string(allowed_file));
  }
}

/// Replaces a solid whose definition was refused, so that its name is known. Nothing is run with it.
Solid placeholder(const std::string& name) { return Solid::made_of(name, Solid(SolidKind::cube)->vertices()); }

Solid read_definition(const JsonPlace& place, const std::string& name) {
  place.expect_object(allowed_definition);
  place.expect_keys(ways);
  const auto given = std::count_if(ways.begin(), ways.end(), [&](auto way) { return place.has(std::string(way)); });
  if (given == 0 && !place.value().empty()) return placeholder(name);  // its key was refused
  if (given != 1) place.refuse("the solid needs exactly one definition", std::string(allowed_definition));
  if (place.has("box")) return solid_from(place.at("box"), name, box_vertices(place.at("box")));
  if (place.has("file")) return solid_from(place.at("file"), name, file_vertices(place.at("file")));
  return solid_from(place.at("vertices"), name, read_vertices(place.at("vertices")));
}

}  // namespace

void check_solid_name(const JsonPlace& place, const std::string& name) {
  const auto allowed = fmt::format("1 to {} letters, digits and '_', the first a letter", longest_solid_name);
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const auto may_follow = [&](char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '_'; };
  if (name.empty() || name.size() > longest_solid_name || !is_letter(name.front()) ||
      !std::all_of(name.begin(), name.end(), may_follow))
    place.refuse("the name cannot be used for a solid", allowed);
  if (Solid::named(name)) place.refuse_with_remedy("this is the name of a built-in solid", "choose another name");
}

SolidDefinitions read_definitions(const JsonPlace& place) {
  place.expect_object("an object of names and definitions of solids");
  SolidDefinitions definitions;
  for (const auto& item : place.value().items()) {
    const auto& name = item.key();
    definitions.emplace(name, placeholder(name));
    place.attempt([&] {
      check_solid_name(place.at(name), name);
      definitions.insert_or_assign(name, read_definition(place.at(name), name));
    });
  }
  return definitions;
}

Solid read_solid_name(const JsonPlace& place, const SolidDefinitions& definitions) {
  std::vector<std::string_view> names(named_solids().begin(), named_solids().end());
  for (const auto& [name, solid] : definitions) names.push_back(name);
  const auto allowed = fmt::format("{}, or a name defined in /solids", allowed_solids());
  const auto name = place.text(allowed);
  if (const auto found = definitions.find(name); found != definitions.end()) return found->second;
  if (const auto solid = Solid::named(name)) return *solid;
  place.refuse(fmt::format("unknown solid {}", compact(place.value())), allowed, nearest_name(name, names));
}

Json definitions_json(const std::vector<Solid>& solids) {
  Json definitions;
  for (const auto& solid : solids) {
    if (!solid.is_defined()) continue;
    Json one;
    put_solid(one, solid);
    definitions[std::string(to_string(solid))]["vertices"] = one.at("vertices");
  }
  return definitions;
}

}  // namespace isojam
