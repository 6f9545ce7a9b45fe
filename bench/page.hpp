#pragma once

#include <string>

namespace seam {

/// Writes what a bench left in a folder (summary.json, recordings and replays) as one page that a browser opens from
/// anywhere, without a network: tables, curves, the arm in motion, and what made them. The same folder gives the same
/// bytes. A run without a replay, or whose meshes are not there any more, is shown without its arm, and the page says so.
/// @param path  the page appears there whole or not at all
/// @throws Error  the summary is not there or of another format, a recording is not there or not of the summary, the
///                page cannot be written
void write_page(const std::string& results, const std::string& path);

}  // namespace seam
