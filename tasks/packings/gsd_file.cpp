#include "tasks/packings/gsd_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <concepts>
#include <utility>

#include "tasks/packings/gsd_layer.hpp"

namespace isojam {
namespace {

constexpr std::size_t entry_size = 32;
/// Far more than any file of packings contains, and far from overflow.
constexpr std::uint64_t most_entries = 1U << 24, most_numbers = 1U << 28;

template <std::unsigned_integral T>
T little_endian(std::string_view bytes, std::size_t at) {
  T value = 0;
  for (std::size_t k = 0; k < sizeof(T); ++k)
    value = static_cast<T>(value | static_cast<T>(static_cast<T>(static_cast<unsigned char>(bytes[at + k])) << 8 * k));
  return value;
}

std::string text_until_zero(std::string_view bytes) { return std::string(bytes.substr(0, bytes.find('\0'))); }

std::size_t size_of(std::uint8_t type) {
  constexpr std::size_t sizes[]{0, 1, 2, 4, 8, 1, 2, 4, 8, 4, 8, 1};
  return type < std::size(sizes) ? sizes[type] : 0;
}

double number_at(std::string_view data, std::uint8_t type, std::size_t k) {
  switch (type) {
    case 1: return little_endian<std::uint8_t>(data, k);
    case 2: return little_endian<std::uint16_t>(data, 2 * k);
    case 3: return little_endian<std::uint32_t>(data, 4 * k);
    case 4: return static_cast<double>(little_endian<std::uint64_t>(data, 8 * k));
    case 6: return std::bit_cast<std::int16_t>(little_endian<std::uint16_t>(data, 2 * k));
    case 7: return std::bit_cast<std::int32_t>(little_endian<std::uint32_t>(data, 4 * k));
    case 8: return static_cast<double>(std::bit_cast<std::int64_t>(little_endian<std::uint64_t>(data, 8 * k)));
    case 9: return std::bit_cast<float>(little_endian<std::uint32_t>(data, 4 * k));
    case 10: return std::bit_cast<double>(little_endian<std::uint64_t>(data, 8 * k));
    default: return static_cast<signed char>(data[k]);
  }
}

/// Layer version 1 stores one name per block of 64 bytes, version 2 one after another.
std::vector<std::string> names_in(std::string_view region, bool packed) {
  std::vector<std::string> names;
  for (std::size_t at = 0; at < region.size();) {
    auto name = text_until_zero(region.substr(at, packed ? std::string_view::npos : gsd_name_size));
    if (name.empty()) break;
    at += packed ? name.size() + 1 : gsd_name_size;
    names.push_back(std::move(name));
  }
  return names;
}

}  // namespace

GsdFile::GsdFile(std::string bytes) : bytes_(std::move(bytes)) {
  if (bytes_.size() < gsd_header_size || little_endian<std::uint64_t>(bytes_, 0) != gsd_magic)
    throw ContentError("it is not a GSD file");
  const auto version = little_endian<std::uint32_t>(bytes_, 44) >> 16;
  if (version != 1 && version != 2)
    throw ContentError(fmt::format("version {} of the GSD layer is not supported", version));
  schema_ = text_until_zero(std::string_view(bytes_).substr(48 + gsd_name_size, gsd_name_size));
  const auto names_at = little_endian<std::uint64_t>(bytes_, 24), names = little_endian<std::uint64_t>(bytes_, 32);
  if (names > most_entries || names_at > bytes_.size() || names * gsd_name_size > bytes_.size() - names_at)
    throw ContentError("its GSD list of names is truncated");
  read_index(little_endian<std::uint64_t>(bytes_, 8), little_endian<std::uint64_t>(bytes_, 16),
             names_in(std::string_view(bytes_).substr(names_at, names * gsd_name_size), version == 2));
}

void GsdFile::read_index(std::uint64_t location, std::uint64_t entries, const std::vector<std::string>& names) {
  if (entries > most_entries || location > bytes_.size() || entries * entry_size > bytes_.size() - location)
    throw ContentError("its GSD index is truncated");
  for (std::uint64_t k = 0; k < entries; ++k) {
    const std::size_t at = location + k * entry_size;
    const Entry entry{little_endian<std::uint64_t>(bytes_, at + 8), little_endian<std::uint64_t>(bytes_, at + 16),
                      little_endian<std::uint32_t>(bytes_, at + 24), static_cast<std::uint8_t>(bytes_[at + 30])};
    if (entry.location == 0) break;
    const auto name = little_endian<std::uint16_t>(bytes_, at + 28);
    if (name >= names.size()) throw ContentError("its GSD index contains a chunk without a name");
    const auto frame = little_endian<std::uint64_t>(bytes_, at);
    frames_ = std::max(frames_, frame + 1);
    entries_[{frame, names[name]}] = entry;
  }
}

const GsdFile::Entry* GsdFile::find(std::uint64_t frame, std::string_view name) const {
  for (const std::uint64_t which : {frame, std::uint64_t{0}}) {
    const auto found = entries_.find(std::pair(which, std::string(name)));
    if (found != entries_.end()) return &found->second;
  }
  return nullptr;
}

std::string_view GsdFile::data(const Entry& entry, std::string_view name) const {
  const auto size = size_of(entry.type);
  if (size == 0 || entry.columns == 0 || entry.columns > most_numbers || entry.rows > most_numbers / entry.columns ||
      entry.location > bytes_.size() || entry.rows * entry.columns * size > bytes_.size() - entry.location)
    throw ContentError(fmt::format("its chunk {} is truncated or has an unknown type", name));
  return std::string_view(bytes_).substr(entry.location, entry.rows * entry.columns * size);
}

std::optional<std::vector<double>> GsdFile::numbers(std::uint64_t frame, std::string_view name,
                                                    std::uint32_t columns) const {
  const auto* entry = find(frame, name);
  if (!entry) return std::nullopt;
  const auto bytes = data(*entry, name);
  if (entry->columns != columns)
    throw ContentError(fmt::format("its chunk {} has {} columns instead of {}", name, entry->columns, columns));
  std::vector<double> values(entry->rows * entry->columns);
  for (std::size_t k = 0; k < values.size(); ++k) {
    values[k] = number_at(bytes, entry->type, k);
    if (!std::isfinite(values[k]))
      throw ContentError(
          fmt::format("row {} of its chunk {} contains a value that is not a finite number", k / columns, name),
          name.starts_with("particles/") ? "remove this particle or frame, or write the file again"
                                         : "remove this frame, or write the file again");
  }
  return values;
}

std::optional<std::vector<std::string>> GsdFile::texts(std::uint64_t frame, std::string_view name) const {
  const auto* entry = find(frame, name);
  if (!entry) return std::nullopt;
  const auto bytes = data(*entry, name);
  if (size_of(entry->type) != 1) throw ContentError(fmt::format("its chunk {} is not text", name));
  std::vector<std::string> rows;
  for (std::uint64_t k = 0; k < entry->rows; ++k)
    rows.push_back(text_until_zero(bytes.substr(k * entry->columns, entry->columns)));
  return rows;
}

}  // namespace isojam
