#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace isojam {

/// Element types of the GSD file layer, with their numbers in the file.
enum class GsdType : std::uint8_t { uint8 = 1, uint32 = 3, uint64 = 4, int8 = 5, int32 = 7, float32 = 9, float64 = 10 };

/// A named matrix of rows × columns, stored by rows.
struct GsdChunk {
  std::string name;
  GsdType type = GsdType::uint8;
  std::uint64_t rows = 0;
  std::uint32_t columns = 1;
  std::string data;  ///< little-endian
};

/// `values` in order, rows of `columns`.
GsdChunk gsd_chunk(std::string name, std::span<const double> values, std::uint32_t columns = 1);
GsdChunk gsd_chunk(std::string name, std::span<const float> values, std::uint32_t columns = 1);
GsdChunk gsd_chunk(std::string name, std::span<const std::int32_t> values, std::uint32_t columns = 1);
GsdChunk gsd_chunk(std::string name, std::span<const std::uint32_t> values, std::uint32_t columns = 1);
GsdChunk gsd_chunk(std::string name, std::span<const std::uint64_t> values, std::uint32_t columns = 1);
GsdChunk gsd_chunk(std::string name, std::span<const std::uint8_t> values, std::uint32_t columns = 1);
/// Rows of text, zero-terminated.
GsdChunk gsd_chunk(std::string name, std::span<const std::string> rows);

/// Identity of the writer, stored in the header.
struct GsdIdentity {
  std::string application, schema;  ///< at most 63 bytes each
  std::uint16_t schema_major = 1, schema_minor = 0;
};

/// A GSD file, layer version 2.0 (https://gsd.readthedocs.io, "File layer"), with one list of chunks for each frame:
///
///    header, 256 bytes │ data of the chunks │ names, zero-terminated │ index, 32 bytes for each chunk
///
/// The index is ordered by frame, then by name in order of first appearance, because readers search it so. By the
/// schemas built on the layer, a chunk that a frame lacks has its value from frame 0.
/// Throws std::invalid_argument if a frame names a chunk twice, if the data of a chunk is empty or does not match its
/// shape, or if a text of the identity is too long.
std::string gsd_bytes(const GsdIdentity& identity, std::span<const std::vector<GsdChunk>> frames);

}  // namespace isojam
