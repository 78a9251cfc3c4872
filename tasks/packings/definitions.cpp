#include "tasks/packings/definitions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "engine/geometry/hull.hpp"
#include "engine/geometry/solids/named_solids.hpp"
#include "tasks/io/options.hpp"
#include "tasks/packings/content_error.hpp"
#include "tasks/packings/intake.hpp"
#include "tasks/packings/surface.hpp"

namespace isojam {
namespace {

using Eigen::Vector3d;

constexpr std::array<std::string_view, 3> ways{"box", "file", "vertices"}, repair_keys{"merge", "hull", "corners"};
constexpr std::array<std::string_view, 6> definition_keys{"box", "file", "vertices", "merge", "hull", "corners"};
constexpr std::string_view allowed_definition =
    "{\"box\": [a, b, c]}, {\"file\": \"x.off\"} or {\"vertices\": [[x, y, z], ...]}";
constexpr std::string_view allowed_file = "an OFF, STL or OBJ file of one convex polyhedron";
constexpr Range edge_range{0, 1e9, true};

std::vector<Vector3d> box_vertices(const JsonPlace& place) {
  place.expect_length(3, "three edges");
  Vector3d edges;
  for (std::size_t c = 0; c < 3; ++c) edges[static_cast<Eigen::Index>(c)] = place.at(c).number(edge_range);
  std::vector<Vector3d> vertices;
  for (int k = 0; k < 8; ++k)
    vertices.emplace_back(edges.cwiseProduct(Vector3d(k & 1 ? 0.5 : -0.5, k & 2 ? 0.5 : -0.5, k & 4 ? 0.5 : -0.5)));
  return vertices;
}

RepairOptions read_repairs(const JsonPlace& place) {
  RepairOptions options;
  place.read_if_any("merge", [&](const JsonPlace& merge) { options.merge = merge.number({0, largest_merge, true}); });
  place.read_if_any("hull", [&](const JsonPlace& hull) { options.hull = hull.boolean(); });
  place.read_if_any("corners", [&](const JsonPlace& corners) {
    options.corners = static_cast<int>(corners.integer({4, ConvexSolid::max_vertices}));
  });
  return options;
}

/// The change of a definition that removes an error.
std::string remedy_for(const NoSolid& error) {
  // A solid with triangular faces only, such as one whose corners were reduced, has the most edges for its corners.
  constexpr int always_allowed = ConvexSolid::max_edges / 3 + 2;
  switch (error.cause()) {
    case NoSolid::Cause::equal_points: return "remove one of them, or set \"hull\" to true";
    case NoSolid::Cause::not_a_corner: return "remove it, or set \"hull\" to true to omit such points";
    case NoSolid::Cause::too_large: return fmt::format("set \"corners\" to {} or less", always_allowed);
    case NoSolid::Cause::not_planar: return "use a smaller \"merge\", or write the vertices with more digits";
    case NoSolid::Cause::other: break;
  }
  return "use " + allowed_features();
}

SolidDefinition read_solid_file(const JsonPlace& place, const std::string& name, const RepairOptions& options) {
  const auto path =
      (std::filesystem::path(place.file()).parent_path() / place.text("the path of an OFF, STL or OBJ file")).string();
  try {
    const auto intake = solid_in(read_mesh(read_named_file(place, path, allowed_file)), options);
    return {made_solid(place, name, intake.vertices), intake.report, intake.notes};
  } catch (const ContentError& error) {
    refuse_content(place, path, error, allowed_file);
  } catch (const NoSolid& error) {
    refuse_content(place, path, ContentError(error.what(), remedy_for(error)), allowed_file);
  }
}

SolidDefinition read_corners(const JsonPlace& place, const std::string& name, const RepairOptions& options) {
  const auto points = read_vertices(place);
  if (points.size() > most_surface_points)
    place.refuse(fmt::format("{} points are too many", points.size()), fmt::format("at most {}", most_surface_points));
  try {
    if (options.merge == 0 && !options.hull && options.corners == 0) return {made_solid(place, name, points)};
    const auto result = repaired(points, options);
    return {made_solid(place, name, result.vertices), result.report};
  } catch (const NoSolid& error) {
    place_of_error(place, error, points.size()).refuse_with_remedy(error.what(), remedy_for(error));
  }
}

/// Replaces a solid whose definition was refused, so that its name is known. Nothing is run with it.
Solid placeholder(const std::string& name) { return Solid::made_of(name, Solid(SolidKind::cube)->vertices()); }

SolidDefinition read_definition(const JsonPlace& place, const std::string& name) {
  place.expect_object(allowed_definition);
  place.expect_keys(definition_keys);
  const auto given = std::count_if(ways.begin(), ways.end(), [&](auto way) { return place.has(std::string(way)); });
  const auto options = read_repairs(place);
  const auto repairs =
      std::count_if(repair_keys.begin(), repair_keys.end(), [&](auto key) { return place.has(std::string(key)); });
  if (given == 0 && static_cast<std::size_t>(repairs) < place.value().size())
    return {placeholder(name)};  // its key was refused
  if (given != 1) place.refuse("the solid needs exactly one definition", std::string(allowed_definition));
  if (place.has("file")) return read_solid_file(place.at("file"), name, options);
  if (place.has("vertices")) return read_corners(place.at("vertices"), name, options);
  for (const auto key : repair_keys) {
    if (place.has(std::string(key)))
      place.at(std::string(key)).refuse_with_remedy("a box needs no repair", "remove the key");
  }
  return {solid_from(place.at("box"), name, box_vertices(place.at("box")))};
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
    const bool good = place.attempt([&] {
      check_solid_name(place.at(name), name);
      definitions.emplace(name, read_definition(place.at(name), name));
    });
    if (!good) definitions.emplace(name, SolidDefinition{placeholder(name)});
  }
  return definitions;
}

Solid read_solid_name(const JsonPlace& place, const SolidDefinitions& definitions) {
  std::vector<std::string_view> names(named_solids().begin(), named_solids().end());
  for (const auto& [name, definition] : definitions) names.push_back(name);
  const auto allowed = fmt::format("{}, or a name defined in /solids", allowed_solids());
  const auto name = place.text(allowed);
  if (const auto found = definitions.find(name); found != definitions.end()) return found->second.solid;
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
