#include "tasks/packings/definitions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "engine/geometry/hull.hpp"
#include "engine/geometry/solids/named_solids.hpp"
#include "tasks/io/fields.hpp"
#include "tasks/packings/content_error.hpp"
#include "tasks/packings/intake.hpp"
#include "tasks/packings/planes.hpp"
#include "tasks/packings/surface.hpp"

namespace isojam {
namespace {

using Eigen::Vector3d;

constexpr std::array<std::string_view, 4> ways{"box", "file", "vertices", "planes"};
constexpr std::array<std::string_view, 4> repair_keys{"merge", "hull", "corners", "max_volume_change"};
constexpr std::array<std::string_view, 9> definition_keys{
    "box", "file", "vertices", "planes", "merge", "hull", "corners", "max_volume_change", "volume_change"};
constexpr std::string_view allowed_definition =
    "{\"box\": [a, b, c]}, {\"file\": \"x.off\"}, {\"vertices\": [[x, y, z], ...]} or {\"planes\": [[nx, ny, nz, d], "
    "...]}";
constexpr std::string_view allowed_file = "an OFF, STL, OBJ, PLY or SHP file of one convex polyhedron";

std::vector<Vector3d> box_vertices(const std::array<double, 3>& edges) {
  std::vector<Vector3d> vertices;
  for (int k = 0; k < 8; ++k)
    vertices.emplace_back((k & 1 ? 0.5 : -0.5) * edges[0], (k & 2 ? 0.5 : -0.5) * edges[1],
                          (k & 4 ? 0.5 : -0.5) * edges[2]);
  return vertices;
}

/// A list of at least four rows of `width` numbers.
Json rows_schema(int width, std::size_t most) {
  const Json row{{"type", "array"},
                 {"minItems", width},
                 {"maxItems", width},
                 {"items", {{"type", "number"}, {"minimum", -1e9}, {"maximum", 1e9}}}};
  return {{"type", "array"}, {"minItems", 4}, {"maxItems", most}, {"items", row}};
}

/// The keys of a definition.
struct Definition {
  std::array<double, 3> box{1, 1, 1};
  std::string file;
  RepairOptions repairs;
  double volume_change = 0;
};

Fields fields_of(Definition& of, std::string_view way) {
  Fields field;
  if (way == "box") {
    field("box", of.box, "Lengths of the three edges, in any unit of length.").range({0, 1e9, true}).finite();
    return field;
  }
  if (way == "file")
    field(
        "file", of.file,
        "File in the format OFF, STL or PLY (text or binary), OBJ, or SHP (Rockable, exaDEM). Its path is relative to "
        "the manifest. The faces must form the closed surface of one convex solid.");
  if (way == "vertices") {
    // read_corners() reads them.
    field.custom("vertices", {{}, [](const JsonPlace&) {}, rows_schema(3, most_surface_points), "list of vertices"},
                 "Corners of the convex hull, with any unit of length and any origin. At most 192 edges and 128 faces "
                 "may remain after the repairs that the keys `merge`, `hull` and `corners` request.");
  }
  if (way == "planes") {
    field.custom(
        "planes", {{}, [](const JsonPlace&) {}, rows_schema(4, most_planes), "list of planes"},
        "The solid n·x ≤ d for all planes. Each plane has the three components of its outward normal n, of any "
        "length, and the number d. Planes that do not touch the solid are allowed.");
  }
  field("merge", of.repairs.merge,
        "Length within which points are welded and faces are joined, relative to the diameter of the solid. Each "
        "point is welded to the first remaining point that is at most this far away. Adjacent faces become one exactly "
        "planar face if all "
        "their corners are within this distance of one plane. Points that are not corners are omitted if they are "
        "within this distance of a face. A corner moves by at most five of these lengths. Without this key only "
        "rounding errors (64 ulp) are removed.")
      .range({0, largest_merge, true})
      .optional()
      .finite();
  field("hull", of.repairs.hull,
        "If true, the solid is the convex hull of the vertices. Points that are not corners of the hull are omitted. "
        "The faces of a file need not form a closed surface, but vertices that belong to no face are omitted first.")
      .optional();
  field("corners", of.repairs.corners,
        "Number of corners to which the solid is reduced. isojam removes the corners that change the volume least, "
        "and `isojam validate` prints the change of the volume. Without this key all corners are kept.")
      .range({4, ConvexSolid::max_vertices})
      .optional();
  field("max_volume_change", of.repairs.max_volume_change,
        "Largest relative change of the volume by the repairs. A solid that they would change more is refused.")
      .range({0, 1})
      .optional()
      .finite();
  if (way == "vertices")
    field("volume_change", of.volume_change,
          "Relative change of the volume by repairs that have been made. isojam writes this key into the copy of the "
          "manifest in a results directory.")
        .range({-1, 1})
        .optional()
        .finite();
  return field;
}

SolidDefinition read_solid_file(const JsonPlace& place, const std::string& name, const RepairOptions& options) {
  const auto path =
      (std::filesystem::path(place.file()).parent_path() / place.text("the path of an OFF, STL, OBJ, PLY or SHP file"))
          .string();
  try {
    const auto intake = solid_in(read_mesh(read_named_file(place, path, allowed_file)), options);
    return {made_solid(place, name, intake.vertices), intake.report, intake.notes};
  } catch (const ContentError& error) {
    refuse_content(place, path, error, allowed_file);
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
    place_of_error(place, error, points.size()).refuse_with_remedy(error.what(), remedy_for(error, points, options));
  }
}

/// The rows of numbers at a place, each of the same width.
std::vector<Eigen::Vector4d> read_planes(const JsonPlace& place) {
  std::vector<Eigen::Vector4d> planes(
      place.expect_entries(most_planes, fmt::format("4 to {} planes of four numbers each", most_planes)));
  for (std::size_t k = 0; k < planes.size(); ++k) {
    place.at(k).expect_length(4, "four numbers");
    for (std::size_t c = 0; c < 4; ++c) planes[k][static_cast<Eigen::Index>(c)] = place.at(k).at(c).number({-1e9, 1e9});
  }
  return planes;
}

/// More than three planes whose numbers are rounded meet in several corners, which are so near to each other.
constexpr double nearest_corners = 1e-9;

SolidDefinition read_half_spaces(const JsonPlace& place, const std::string& name, RepairOptions options) {
  std::vector<Vector3d> corners;
  try {
    corners = corners_between(read_planes(place));
    options.hull = true;
    const bool repairs = options.merge > 0 || options.corners > 0;
    options.merge = std::max(options.merge, nearest_corners);
    const auto result = repaired(corners, options);
    return {made_solid(place, name, result.vertices), repairs ? result.report : RepairReport{}};
  } catch (const ContentError& error) {
    place.refuse_with_remedy(error.what(), error.remedy());
  } catch (const NoSolid& error) {
    place.refuse_with_remedy(error.what(), remedy_for(error, corners, options));
  }
}

/// Replaces a solid whose definition was refused, so that its name is known. Nothing is run with it.
Solid placeholder(const std::string& name) { return Solid::made_of(name, Solid(SolidKind::cube)->vertices()); }

SolidDefinition read_definition(const JsonPlace& place, const std::string& name) {
  place.expect_object(allowed_definition);
  place.expect_keys(definition_keys);
  if (!place.is_sound()) return {placeholder(name)};
  const auto is_given = [&](std::string_view key) { return place.has(std::string(key)); };
  if (std::count_if(ways.begin(), ways.end(), is_given) != 1)
    place.refuse("the solid needs exactly one definition", std::string(allowed_definition));
  const auto way = *std::find_if(ways.begin(), ways.end(), is_given);
  for (const auto repair : repair_keys) {
    const std::string key(repair);
    if (way == "box" && place.has(key)) place.at(key).refuse_with_remedy("a box needs no repair", "remove the key");
  }
  Definition definition;
  read_into(place, fields_of(definition, way));
  if (!place.is_sound()) return {placeholder(name)};
  const auto inner = place.at(std::string(way));
  if (way == "file") return read_solid_file(inner, name, definition.repairs);
  if (way == "planes") return read_half_spaces(inner, name, definition.repairs);
  if (way == "vertices") {
    auto solid = read_corners(inner, name, definition.repairs);
    if (definition.volume_change != 0) solid.report.volume_change = definition.volume_change;
    return solid;
  }
  return {solid_from(inner, name, box_vertices(definition.box))};
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

Json definitions_schema() {
  Definition definition;
  Json json{{"type", "object"}, {"propertyNames", {{"pattern", solid_name_pattern}}}};
  for (const auto way : ways)
    json["additionalProperties"]["oneOf"].push_back(object_schema(fields_of(definition, way)));
  return json;
}

Json solid_schema() {
  const Json solid{
      {"description",
       "Convex solid, scaled to unit volume. It is a named solid, a prism or antiprism whose edges all have the same "
       "length (for example `prism6` or `antiprism5`), or a name that the key `solids` defines."},
      {"anyOf",
       {{{"enum", named_solids()}},
        {{"type", "string"},
         {"pattern",
          "^(prism([3-9]|[1-5][0-9]|6[0-4])|antiprism([4-9]|[1-3][0-9]|4[0-8])|[A-Za-z][A-Za-z0-9_]{0,47})$"}}}}};
  return {{"$ref", "#/definitions/solid"}, {"definitions", {{"solid", solid}}}};
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

std::map<std::string, double> volume_changes(const Mixture& mixture, const SolidDefinitions& definitions) {
  constexpr double noticeable = 1e-9;
  std::map<std::string, double> changes;
  for (const auto& kind : mixture.kinds()) {
    const auto found = definitions.find(to_string(kind.solid));
    if (found != definitions.end() && std::abs(found->second.report.volume_change) > noticeable)
      changes[found->first] = found->second.report.volume_change;
  }
  return changes;
}

Json definitions_json(const std::vector<Mixture>& mixtures, const SolidDefinitions& definitions) {
  Json json;
  for (const auto& mixture : mixtures) {
    for (const auto& kind : mixture.kinds()) {
      if (!kind.solid.is_defined()) continue;
      Json one;
      put_solid(one, kind.solid);
      json[std::string(to_string(kind.solid))]["vertices"] = one.at("vertices");
    }
    for (const auto& [name, change] : volume_changes(mixture, definitions)) json[name]["volume_change"] = change;
  }
  return json;
}

}  // namespace isojam
