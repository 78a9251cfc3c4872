#include "tasks/packings/gsd_layer.hpp"

#include <algorithm>
#include <bit>
#include <concepts>
#include <map>
#include <stdexcept>

namespace isojam {
namespace {

constexpr std::uint32_t layer_version = 2 << 16;

template <std::unsigned_integral T>
void append(std::string& bytes, T value) {
  for (std::size_t k = 0; k < sizeof(T); ++k) bytes += static_cast<char>(static_cast<unsigned char>(value >> 8 * k));
}
void append(std::string& bytes, std::int32_t value) { append(bytes, static_cast<std::uint32_t>(value)); }
void append(std::string& bytes, float value) { append(bytes, std::bit_cast<std::uint32_t>(value)); }
void append(std::string& bytes, double value) { append(bytes, std::bit_cast<std::uint64_t>(value)); }

void append_padded(std::string& bytes, const std::string& text) {
  if (text.size() >= gsd_name_size) throw std::invalid_argument("too long for a GSD header: " + text);
  bytes += text;
  bytes.append(gsd_name_size - text.size(), '\0');
}

std::size_t size_of(GsdType type) {
  switch (type) {
    case GsdType::uint8:
    case GsdType::int8: return 1;
    case GsdType::uint32:
    case GsdType::int32:
    case GsdType::float32: return 4;
    case GsdType::uint64:
    case GsdType::float64: break;
  }
  return 8;
}

template <class T>
GsdChunk chunk_of(std::string name, GsdType type, std::span<const T> values, std::uint32_t columns) {
  GsdChunk chunk{std::move(name), type, values.size() / columns, columns, {}};
  for (const T value : values) append(chunk.data, value);
  return chunk;
}

struct IndexEntry {
  std::uint64_t frame = 0, rows = 0, location = 0;
  std::uint32_t columns = 0;
  std::uint16_t name = 0;
  GsdType type = GsdType::uint8;
};

void append(std::string& bytes, const IndexEntry& entry) {
  append(bytes, entry.frame);
  append(bytes, entry.rows);
  append(bytes, entry.location);
  append(bytes, entry.columns);
  append(bytes, entry.name);
  append(bytes, static_cast<std::uint8_t>(entry.type));
  append(bytes, std::uint8_t{0});  // flags, reserved
}

/// Names in order of first appearance, with their numbers.
struct NameList {
  std::map<std::string, std::uint16_t> numbers;
  std::string text;

  std::uint16_t number(const std::string& name) {
    const auto [place, is_new] = numbers.try_emplace(name, static_cast<std::uint16_t>(numbers.size()));
    if (is_new) text.append(name).push_back('\0');
    return place->second;
  }
};

void check(const GsdChunk& chunk) {
  if (chunk.data.empty() || chunk.data.size() != chunk.rows * chunk.columns * size_of(chunk.type)) {
    throw std::invalid_argument("GSD chunk " + chunk.name + ": the data do not match the shape");
  }
}

/// Appends the frame's data to `bytes` and its entries to `index`.
void append_frame(std::uint64_t number, const std::vector<GsdChunk>& chunks, NameList& names,
                  std::vector<IndexEntry>& index, std::string& bytes) {
  const auto first = index.size();
  for (const auto& chunk : chunks) {
    check(chunk);
    index.push_back({number, chunk.rows, bytes.size(), chunk.columns, names.number(chunk.name), chunk.type});
    bytes += chunk.data;
  }
  const auto begin = index.begin() + static_cast<std::ptrdiff_t>(first);
  std::sort(begin, index.end(), [](const IndexEntry& a, const IndexEntry& b) { return a.name < b.name; });
  const auto twin =
      std::adjacent_find(begin, index.end(), [](const IndexEntry& a, const IndexEntry& b) { return a.name == b.name; });
  if (twin != index.end()) throw std::invalid_argument("a frame of a GSD file contains a chunk twice");
}

void pad_to_multiple(std::string& bytes, std::size_t size) { bytes.append((size - bytes.size() % size) % size, '\0'); }

}  // namespace

GsdChunk gsd_chunk(std::string name, std::span<const double> values, std::uint32_t columns) {
  return chunk_of(std::move(name), GsdType::float64, values, columns);
}
GsdChunk gsd_chunk(std::string name, std::span<const float> values, std::uint32_t columns) {
  return chunk_of(std::move(name), GsdType::float32, values, columns);
}
GsdChunk gsd_chunk(std::string name, std::span<const std::int32_t> values, std::uint32_t columns) {
  return chunk_of(std::move(name), GsdType::int32, values, columns);
}
GsdChunk gsd_chunk(std::string name, std::span<const std::uint32_t> values, std::uint32_t columns) {
  return chunk_of(std::move(name), GsdType::uint32, values, columns);
}
GsdChunk gsd_chunk(std::string name, std::span<const std::uint64_t> values, std::uint32_t columns) {
  return chunk_of(std::move(name), GsdType::uint64, values, columns);
}
GsdChunk gsd_chunk(std::string name, std::span<const std::uint8_t> values, std::uint32_t columns) {
  return chunk_of(std::move(name), GsdType::uint8, values, columns);
}
GsdChunk gsd_chunk(std::string name, std::span<const std::string> rows) {
  std::size_t columns = 1;
  for (const auto& row : rows) columns = std::max(columns, row.size() + 1);
  std::string data;
  for (const auto& row : rows) {
    data += row;
    data.append(columns - row.size(), '\0');
  }
  return {std::move(name), GsdType::int8, rows.size(), static_cast<std::uint32_t>(columns), std::move(data)};
}

std::string gsd_bytes(const GsdIdentity& identity, std::span<const std::vector<GsdChunk>> frames) {
  NameList names;
  std::vector<IndexEntry> index;
  std::string bytes(gsd_header_size, '\0');  // filled in once the rest is known
  for (std::size_t k = 0; k < frames.size(); ++k) append_frame(k, frames[k], names, index, bytes);

  // Readers map the index into memory, which requires alignment.
  pad_to_multiple(bytes, sizeof(std::uint64_t));
  const auto names_at = bytes.size();
  pad_to_multiple(names.text, gsd_name_size);
  bytes += names.text;
  const auto index_at = bytes.size();
  for (const auto& entry : index) append(bytes, entry);

  std::string header;
  append(header, gsd_magic);
  append(header, std::uint64_t{index_at});
  append(header, std::uint64_t{index.size()});
  append(header, std::uint64_t{names_at});
  append(header, std::uint64_t{names.text.size() / gsd_name_size});
  append(header, std::uint32_t{identity.schema_major} << 16 | identity.schema_minor);
  append(header, layer_version);
  append_padded(header, identity.application);
  append_padded(header, identity.schema);
  return bytes.replace(0, header.size(), header);
}

}  // namespace isojam
