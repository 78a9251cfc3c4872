#include "tasks/packings/start_packing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <tuple>
#include <vector>

#include "tasks/io/hash.hpp"
#include "tasks/io/input_error.hpp"
#include "tasks/io/sealed.hpp"
#include "tasks/packings/packing_json.hpp"
#include "tasks/packings/text_lines.hpp"

namespace isojam {
namespace {

constexpr std::string_view formats = "GSD, extended XYZ or the JSON of isojam";

/// Throws if a text does not begin with the number of particles, as an XYZ file does.
void refuse_other_text(std::string_view text) {
  TextLines lines(text);
  if (!lines.next() || std::string_view("+-0123456789").find(lines.words()[0][0]) != std::string_view::npos) return;
  lines.refuse(fmt::format("{} does not begin a packing in {}", in_quotes(lines.words()[0]), formats),
               "save the packing in one of these formats");
}

Packing read_any(const std::string& bytes, StartFile& file, const Mixture& mixture, const TypeNames& types) {
  constexpr std::string_view gsd_magic = "\xDF\x65\xDF\x65\xDF\x65\xDF\x65";
  const auto converted = [&](const ForeignPacking& foreign) {
    return packing_of(foreign, mixture, types, &file.notes);
  };
  if (bytes.starts_with(gsd_magic)) return converted(read_gsd_packing(bytes, file.frame));
  if (!bytes.starts_with('{')) {
    refuse_other_text(bytes);
    file.is_xyz = true;
    return converted(read_xyz_packing(bytes, file.frame));
  }
  if (!types.empty()) throw ContentError("packings of isojam contain their solids", "remove /start/types");
  try {
    const auto json = parse_sealed(bytes, file.path);
    return read_packing(JsonPlace(json, file.path));
  } catch (const InputError& error) {
    const auto& details = error.details();
    throw ContentError((details.pointer.empty() ? "" : details.pointer + ": ") + details.problem, details.remedy);
  }
}

}  // namespace

bool are_particles_of(const Packing& packing, const Mixture& mixture) {
  std::vector<Particle> own(packing.solids.particles().begin(), packing.solids.particles().end());
  if (packing.solids.is_uniform()) own.assign(packing.poses.size(), Particle{&packing.solids.only()});
  auto expected = mixture.particles(packing.size());
  const auto key = [](const Particle& p) { return std::tuple(p.kind, p.scale, p.unit->name(), p.unit); };
  const auto before = [&](const Particle& a, const Particle& b) { return key(a) < key(b); };
  std::sort(own.begin(), own.end(), before);
  std::sort(expected.begin(), expected.end(), before);
  return own == expected;
}

void load(StartFile& file, const std::string& bytes, const Mixture& mixture, int n, const TypeNames& types) {
  file.notes.clear();
  auto packing = read_any(bytes, file, mixture, types);
  if (packing.size() != n)
    throw ContentError(fmt::format("the packing has {} particles instead of {}", packing.size(), n),
                       fmt::format("set /sweep/particles to [{}], or use another file", packing.size()));
  if (!are_particles_of(packing, mixture))
    throw ContentError(fmt::format("its particles do not match {}", to_string(mixture)),
                       "change /sweep/solid, or use another file");
  file.digest = hex_hash(bytes);
  file.packing = std::make_shared<const Packing>(std::move(packing));
}

}  // namespace isojam
