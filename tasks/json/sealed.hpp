#pragma once

#include <map>
#include <string>
#include <string_view>

#include "tasks/json/json.hpp"

namespace isojam {

/// Text of a document that vouches for its own bytes: after the first key stands "checksum", a 64-bit FNV-1a of the
/// text with sixteen zeros in its place. Every change of a single byte shows, and a cut or a mixture but for one in
/// 2^64.
std::string sealed(const Json& document);

/// Throws InputError if the text is not what was sealed. Does not look at the document.
void check_seal(std::string_view text, const std::string& file);

/// The document of a sealed text, "checksum" included. Throws InputError if the text is not what was sealed, or is
/// nested so deep that nobody could use it.
Json parse_sealed(std::string_view text, const std::string& file);

/// Reads and parses. Throws FileError if there is no such file or it cannot be read now, InputError if it is damaged
/// or something else than a file stands there.
Json read_sealed(const std::string& file);

/// The members of a sealed document up to the first that is not a text. Throws as read_sealed does.
std::map<std::string, std::string> read_sealed_head(const std::string& file);

}  // namespace isojam
