#pragma once

#include <string>

#include <seam/join.hpp>

namespace seam {

/// @throws Error  there is no gnuplot
void require_gnuplot();

/// A text as gnuplot reads it back.
std::string quoted(const std::string& text);

/// How a method's curves look, the same in every picture.
std::string style(Join method);

/// Size [pixels], fonts, colours, and CSV with headers; the picture is the script's first argument.
std::string preamble(int width, int height);

/// Draws FOLDER/NAME.png by a script, which stays beside it as NAME.gnuplot and is run in the folder. The picture
/// appears whole or not at all.
/// @throws Error  gnuplot is not there or fails (with what it says), a file cannot be written
void draw(const std::string& folder, const std::string& name, const std::string& script);

}  // namespace seam
