#include "tasks/packings/solid_json.hpp"

#include <fmt/format.h>

#include <cmath>

#include "engine/arithmetic/elementary.hpp"
#include "engine/geometry/solids/named_solids.hpp"

namespace isojam {
namespace {

/// Squares and products of three coordinates stay far from overflow and underflow.
constexpr Range coordinate_range{-1e9, 1e9};
/// Upper limit for the smallest cell of a solid, in units of its volume: particles at density 1.
constexpr double largest_cell = 1e8;

}  // namespace

void put_solid(Json& json, const Solid& solid) {
  json["solid"] = to_string(solid);
  if (!solid.is_defined()) return;
  json["vertices"] = Json::array();
  for (const auto& v : solid->given()) json["vertices"].push_back({v.x(), v.y(), v.z()});
}

std::string allowed_solids() { return fmt::format("{}, {}", one_of(named_solids()), prism_names); }

Solid read_solid(const JsonPlace& place) {
  const auto name = place.at("solid").text(allowed_solids());
  if (place.has("vertices")) return solid_from(place.at("vertices"), name, read_vertices(place.at("vertices")));
  const auto solid = Solid::named(name);
  if (!solid) {
    place.at("solid").refuse(fmt::format("unknown solid {}", compact(place.at("solid").value())), allowed_solids(),
                             nearest_name(name, named_solids()));
  }
  return *solid;
}

std::vector<Eigen::Vector3d> read_vertices(const JsonPlace& place) {
  constexpr std::string_view allowed = "a list of vertices, three numbers each";
  std::vector<Eigen::Vector3d> vertices(place.expect_list(allowed));
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    const auto vertex = place.at(k);
    vertex.expect_length(3, "three numbers");
    for (std::size_t c = 0; c < 3; ++c)
      vertices[k][static_cast<Eigen::Index>(c)] = vertex.at(c).number(coordinate_range);
  }
  return vertices;
}

std::string allowed_features() {
  return fmt::format("4 to {} corners of a convex polyhedron with at most {} faces and {} edges",
                     ConvexSolid::max_vertices, ConvexSolid::max_faces, ConvexSolid::max_edges);
}

JsonPlace place_of_error(const JsonPlace& vertices, const NoSolid& error, std::size_t points) {
  const bool listed = error.vertex() >= 0 && vertices.value().size() == points;
  return listed ? vertices.at(static_cast<std::size_t>(error.vertex())) : vertices;
}

Solid made_solid(const JsonPlace& place, const std::string& name, const std::vector<Eigen::Vector3d>& vertices) {
  auto solid = Solid::made_of(name, vertices);
  if (cubed(2 * solid->diameter()) > largest_cell)
    place.refuse("the solid is too long or too flat for any periodic cell",
                 fmt::format("a diameter of at most {:.0f} times the cube root of its volume",
                             std::floor(nearest::cbrt(largest_cell) / 2)));
  return solid;
}

Solid solid_from(const JsonPlace& place, const std::string& name, const std::vector<Eigen::Vector3d>& vertices) {
  try {
    return made_solid(place, name, vertices);
  } catch (const NoSolid& error) {
    place_of_error(place, error, vertices.size()).refuse(error.what(), allowed_features());
  }
}

}  // namespace isojam
