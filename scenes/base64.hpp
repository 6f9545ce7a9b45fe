#pragma once

#include <string>
#include <string_view>

namespace seam {

/// Bytes as text (RFC 4648, with padding), and back.
std::string base64(std::string_view bytes);
/// @throws Error  not base64
std::string from_base64(std::string_view text);

}  // namespace seam
