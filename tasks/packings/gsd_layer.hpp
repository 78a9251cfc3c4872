#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace isojam {

/// Constants of the file layer: the identification number of GSD files, and sizes in bytes.
inline constexpr std::uint64_t gsd_magic = 0x65DF65DF65DF65DF;
inline constexpr std::size_t gsd_header_size = 256, gsd_name_size = 64;

/// Types of the elements of a chunk, with their numbers in the file.
enum class GsdType : std::uint8_t { uint8 = 1, uint32 = 3, uint64 = 4, int8 = 5, int32 = 7, float32 = 9, float64 = 10 };

/// A chunk: a matrix of rows × columns with a name, stored row by row.
struct GsdChunk {
  std::string name;
  GsdType type = GsdType::uint8;
  std::uint64_t rows = 0;
  std::uint32_t columns = 1;
  std::string data;  ///< bytes of the elements, little-endian
};

/// Makes a chunk from `values`, which are in rows of `columns` elements.
GsdChunk gsd_chunk(std::string name, std::span<const double> values, std::uint32_t columns = 1);
GsdChunk gsd_chunk(std::string name, std::span<const float> values, std::uint32_t columns = 1);
GsdChunk gsd_chunk(std::string name, std::span<const std::int32_t> values, std::uint32_t columns = 1);
GsdChunk gsd_chunk(std::string name, std::span<const std::uint32_t> values, std::uint32_t columns = 1);
GsdChunk gsd_chunk(std::string name, std::span<const std::uint64_t> values, std::uint32_t columns = 1);
GsdChunk gsd_chunk(std::string name, std::span<const std::uint8_t> values, std::uint32_t columns = 1);
/// Makes a chunk from rows of text, each terminated by a zero.
GsdChunk gsd_chunk(std::string name, std::span<const std::string> rows);

/// Name of the program that writes a file, and of the schema. The header of the file contains both.
struct GsdIdentity {
  std::string application, schema;  ///< at most 63 bytes each
  std::uint16_t schema_major = 1, schema_minor = 0;
};

/// A GSD file, layer version 2.0 (https://gsd.readthedocs.io, "File layer"), with one list of chunks for each frame:
///
///    header, 256 bytes │ data of the chunks │ names, zero-terminated │ index, 32 bytes for each chunk
///
/// The index is sorted by frame, then by name in the order of first appearance, because programs that read the file
/// search it in this order. According to the schemas that use this layer, a chunk that a frame does not contain has the
/// value of frame 0. Throws std::invalid_argument if a frame names a chunk twice, if the data of a chunk is empty or
/// does not match its shape, or if a text of the identity is too long.
std::string gsd_bytes(const GsdIdentity& identity, std::span<const std::vector<GsdChunk>> frames);

}  // namespace isojam
