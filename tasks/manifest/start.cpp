#include "tasks/manifest/start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "engine/packing/energy.hpp"
#include "tasks/manifest/manifest.hpp"
#include "tasks/measure/measure.hpp"
#include "tasks/packings/content_error.hpp"

namespace isojam {
namespace {

constexpr std::string_view allowed_file = "the path of a packing in GSD, extended XYZ or the JSON of isojam";
/// Largest depth of an overlap, in units of the smaller particle. With deeper overlaps, the file does not describe a
/// packing, and no minimiser can find the intended one.
constexpr double deepest_overlap = 0.5;
constexpr std::size_t most_files = 10000;
/// Least initial density in units of a strain step. At this density the first step reduces lengths by a factor 0.69.
constexpr double least_steps = 0.5;

StartFile read_file_place(const JsonPlace& place) {
  const std::filesystem::path given = place.text(allowed_file);
  auto path = given.is_absolute() ? given : std::filesystem::path(place.file()).parent_path() / given;
  const auto whole = std::filesystem::absolute(path).lexically_normal().string();
  // The path of the manifest may contain bytes that are not allowed in JSON.
  constexpr auto ignored = Json::error_handler_t::ignore;
  if (parsed(Json(whole).dump(-1, ' ', false, ignored)) != Json(whole))
    place.refuse_with_remedy("the path is not valid UTF-8, so records could not name it",
                             "rename the file or its folder");
  return {whole, -1, "", {}};
}

/// The deepest overlap, in units of the volume of the smaller particle, and its particles.
struct Deepest {
  double depth = 0;
  std::size_t a = 0, b = 0;
};

Deepest deepest_of(const Packing& packing) {
  Deepest deepest;
  for (const auto& contact : PackingEnergy().contacts(packing)) {
    const auto a = static_cast<std::size_t>(contact.pair.a), b = static_cast<std::size_t>(contact.pair.b);
    const double depth = contact.overlap.volume / std::min(packing.solids[a].volume(), packing.solids[b].volume());
    if (depth > deepest.depth) deepest = {depth, a, b};
  }
  return deepest;
}

/// The packing of a file whose quaternions have the order w x y z, although they were read as x y z w.
Packing reordered(Packing packing) {
  for (auto& pose : packing.poses) {
    const auto q = pose.orientation.coeffs();
    pose.orientation = Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
  }
  return packing;
}

void look_at_overlaps(const JsonPlace& place, const Packing& packing, StartFile& file) {
  try {
    const auto [depth, a, b] = deepest_of(packing);
    file.deepest_overlap = depth;
    if (file.is_xyz && depth > 0) file.deepest_reordered = deepest_of(reordered(packing)).depth;
    if (depth > deepest_overlap)
      place.refuse_with_remedy(
          fmt::format("particles {} and {} overlap by {:.0f} % of the volume of the smaller", a, b, 100 * depth),
          fmt::format("separate them until they overlap by at most {:.0f} %{}", 100 * deepest_overlap,
                      file.is_xyz ? "; the order of the quaternions must be x y z w" : ""));
  } catch (const std::invalid_argument& error) {
    place.refuse(error.what(), fmt::format("lattice translations longer than {} (two diameters)",
                                           least_side(packing.solids.widest())));
  }
}

void load_file(const JsonPlace& place, StartFile& file, const Manifest& manifest) {
  const auto expected = file.digest;
  const auto bytes = read_named_file(place, file.path, allowed_file);
  try {
    load(file, bytes, manifest.solids.front(), manifest.particles.front(), manifest.start->types);
  } catch (const ContentError& error) {
    const auto remedy = error.remedy().empty() ? "write the file again, or use another file" : error.remedy();
    refuse_content(place, file.path, ContentError(error.what(), remedy, error.line()), allowed_file);
  }
  if (!expected.empty() && file.digest != expected)
    place.refuse_with_remedy(fmt::format("{}: the file has changed since the first run", file.path),
                             "restore it, or choose another results directory");
}

void check_density(const JsonPlace& place, const Start& start, const Packing& packing, const Manifest& manifest) {
  const double density = start.density.value_or(packing.density());
  for (const auto& set : option_sets(manifest)) {
    const auto options = options_of(manifest, set, manifest.solids.front());
    const double least = least_steps * options.compression.step;
    if (density < least)
      place.refuse_with_remedy(
          fmt::format("the initial density {:.3g} is below {}, half of the first strain step: in this "
                      "step, particles that are far apart would overlap",
                      density, least),
          fmt::format("set /start/density to {:.2g} or more, or use a smaller cell", std::max(0.05, least)));
    if (density < options.compression.max_density) continue;
    place.refuse_with_remedy(
        fmt::format("the initial density {:.6g} is not below max_density {}", density, options.compression.max_density),
        "increase max_density, or set a lower /start/density");
  }
  if (packing.cell.is_cube()) return;
  for (const auto& set : option_sets(manifest)) {
    if (options_of(manifest, set, manifest.solids.front()).cell == CellShape::free) continue;
    place.refuse_with_remedy("the cell of the packing is not a cube", "set /protocol/cell to \"free\"");
  }
}

Json measures_as_given() {
  Json list;
  for (const auto what : all_measures) {
    if (definition_of(what).as_given) list.push_back(to_string(what));
  }
  return list;
}

/// A packing as given has no decompression, so that some measures and the goal phi_j are impossible.
void check_stage(const JsonPlace& place, const Manifest& manifest) {
  if (manifest.start->stage != JamStage::as_given) {
    if (manifest.start->gap)
      place.at("gap").refuse_with_remedy("gaps count only in packings as given",
                                         "remove the key, or set /start/stage to \"as_given\"");
    return;
  }
  for (const auto what : manifest.measures) {
    if (!definition_of(what).as_given)
      place.refuse_with_remedy(
          fmt::format("the measure {} is not possible for a packing as given: it needs a jammed packing",
                      to_string(what)),
          fmt::format("set /measure to {}", compact(measures_as_given())));
  }
  if (manifest.replicates.goal && manifest.replicates.goal->quantity == "phi_j")
    place.refuse_with_remedy("packings as given have no phi_j", "remove the goal in /replicates");
}

void read_packing(const JsonPlace& place, Start& start) {
  start.files.clear();
  if (!place.value().is_array()) return start.files.push_back(read_file_place(place));
  const auto count = place.expect_entries(most_files, fmt::format("1 to {} paths", most_files));
  for (std::size_t k = 0; k < count; ++k) place.attempt([&] { start.files.push_back(read_file_place(place.at(k))); });
}

Custom packing_field(Start& start) {
  const auto write = [&start] {
    Json list = Json::array();
    for (const auto& file : start.files) list.push_back(file.path);
    return list;
  };
  const Json path{{"type", "string"}};
  return {write,
          [&start](const JsonPlace& place) { read_packing(place, start); },
          {{"oneOf", {path, {{"type", "array"}, {"minItems", 1}, {"maxItems", most_files}, {"items", path}}}}},
          "path or list of paths"};
}

Custom types_field(Start& start) {
  return {[&start] { return start.types.empty() ? Json() : Json(start.types); },
          [&start](const JsonPlace& place) {
            place.expect_object("an object of types and names of solids");
            for (const auto& item : place.value().items())
              place.read(item.key(),
                         [&](const JsonPlace& name) { start.types[item.key()] = name.text("the name of a solid"); });
          },
          {{"type", "object"}, {"additionalProperties", {{"type", "string"}}}},
          "object of types and names of solids"};
}

Custom digests_field(Start& start) {
  const auto write = [&start] {
    Json list;
    for (const auto& file : start.files) list.push_back(file.digest);
    return list;
  };
  const auto read = [&start](const JsonPlace& place) {
    place.expect_length(start.files.size(), "one digest for each file");
    for (std::size_t k = 0; k < start.files.size(); ++k) start.files[k].digest = place.at(k).text();
  };
  return {write, read, {{"type", "array"}, {"items", {{"type", "string"}}}}, "list of texts"};
}

}  // namespace

void describe(Fields& field, Start& start) {
  field.custom("packing", packing_field(start),
               "A file, or a list with one file for each replicate. The format of a file is isojam's own JSON format, "
               "GSD with HOOMD-blue's schema, or extended XYZ. Paths are relative to the manifest.");
  field("frame", start.frame, "Index of the frame in the file, counted from 0. The value -1 means the last frame.")
      .range({-1e9, 1e9})
      .optional();
  field("density", start.density,
        "Density to which the packing is strained before the protocol starts. Without this key, the packing keeps the "
        "density that it has in the file.")
      .range({0, 1, true})
      .finite();
  field("stage", start.stage,
        "First stage of the protocol. `compression`: The packing is first compressed to the target energy. "
        "`decompression`: The packing is treated as jammed and only decompressed. `as_given`: The packing is measured "
        "as it is, and nothing is relaxed.")
      .optional();
  field("gap", start.gap,
        "Only with the stage `as_given`: pairs of particles with a smaller gap count as contacts, in addition to those "
        "that overlap. The gap is the largest distance of two separating planes that are parallel to a face of one "
        "particle, or to an edge of each.")
      .unit("V_p^(1/3)")
      .range({0, 1, true})
      .finite();
  field
      .custom("types", types_field(start),
              "Names of solids for the types of particles whose shapes are not in the files, for example {\"A\": "
              "\"octahedron\"}. Without an entry, the name of the type must be the name of a solid. isojam takes each "
              "of these solids to have the volume 1 in the unit of length of the file.")
      .optional();
  field
      .custom("digests", digests_field(start),
              "Digests of the files. isojam writes this key into the copy of the manifest in a results directory.")
      .optional();
}

void load_start(const JsonPlace& place, Manifest& manifest) {
  auto& start = *manifest.start;
  const auto packing = place.at("packing");
  if (manifest.solids.size() != 1 || manifest.particles.size() != 1)
    place.refuse_with_remedy("a start needs exactly one solid and one number of particles",
                             "give one entry in /sweep/solid and one in /sweep/particles");
  if (static_cast<int>(start.files.size()) < manifest.replicates.max)
    packing.refuse(fmt::format("too few files ({}) for {} replicates", start.files.size(), manifest.replicates.max),
                   "a file for each replicate");
  check_stage(place, manifest);
  for (std::size_t k = 0; k < start.files.size(); ++k) {
    auto& file = start.files[k];
    if (file.packing) continue;
    file.frame = start.frame;
    const auto here = packing.value().is_array() ? packing.at(k) : packing;
    load_file(here, file, manifest);
    if (start.stage != JamStage::as_given) check_density(here, start, *file.packing, manifest);
    look_at_overlaps(here, initial_packing(start, static_cast<int>(k)), file);
  }
}

void load_start(Manifest& manifest) {
  if (!manifest.start) return;
  Json document;
  document["start"] = written(*manifest.start);
  load_start(JsonPlace(document, manifest.name).at("start"), manifest);
}

Packing initial_packing(const Start& start, int replicate) {
  const Packing& packing = *start.files[static_cast<std::size_t>(replicate)].packing;
  return start.density ? strained_to(packing, *start.density) : packing;
}

}  // namespace isojam
