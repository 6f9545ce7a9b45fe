#include <charconv>
#include <cmath>
#include <set>
#include <string>
#include <string_view>

#include <seam/error.hpp>
#include <seam/table.hpp>
#include <seam/whole_file.hpp>

namespace seam {

namespace {

constexpr std::uintmax_t most_bytes = std::uintmax_t{1} << 30;

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::string_view take_until(std::string_view& rest, char separator) {
  const auto end = rest.find(separator);
  const std::string_view head = rest.substr(0, end);
  rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 1);
  return head;
}

void split(std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  for (std::size_t begin = 0; begin <= line.size();) {
    const auto end = std::min(line.find(',', begin), line.size());
    fields.push_back(trimmed(line.substr(begin, end - begin)));
    begin = end + 1;
  }
}

std::vector<std::string> read_header(const std::string& place, std::string_view line) {
  if (line.substr(0, 3) == "\xEF\xBB\xBF") line.remove_prefix(3);
  std::vector<std::string> columns;
  std::set<std::string_view> seen;
  std::vector<std::string_view> names;
  split(line, names);
  for (const std::string_view name : names) {
    if (name.empty())
      throw Error(place, "column " + std::to_string(columns.size() + 1) + " has no name");
    if (!seen.insert(name).second)
      throw Error(place, "column \"" + std::string(name) + "\" appears twice");
    columns.emplace_back(name);
  }
  return columns;
}

// A line of the file, for messages.
struct Place {
  const std::string& path;
  int line;

  std::string text() const { return path + ":" + std::to_string(line); }
};

double read_number(const Place& place, const std::string& column, std::string_view field) {
  if (!field.empty() && field.front() == '+') field.remove_prefix(1);
  double value = 0.0;
  const auto [end, status] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (status != std::errc{} || end != field.data() + field.size() || !std::isfinite(value))
    throw Error(place.text(), "column \"" + column + "\": \"" + std::string(field) +
                                  "\", must be a finite number");
  return value;
}

void read_row(const Place& place, const std::vector<std::string>& columns,
              const std::vector<std::string_view>& fields, std::vector<double>& values) {
  if (fields.size() != columns.size())
    throw Error(place.text(), std::to_string(fields.size()) + " fields, must be " +
                                  std::to_string(columns.size()) + " as in the header");
  for (std::size_t c = 0; c < fields.size(); ++c)
    values.push_back(read_number(place, columns[c], fields[c]));
}

void append_number(std::string& text, double value) {
  char digits[32];
  const auto end =
      std::to_chars(digits, digits + sizeof digits, value, std::chars_format::general, 17).ptr;
  text.append(digits, end);
}

}  // namespace

Table Table::read(const std::string& path) {
  const std::string content = read_whole(path, "CSV file", most_bytes);
  std::string_view rest = content;
  if (trimmed(rest.substr(0, rest.find('\n'))).empty()) throw Error(path + ":1", "no header");
  Table table;
  table.columns = read_header(path + ":1", take_until(rest, '\n'));
  std::vector<double> values;
  std::vector<std::string_view> fields;
  for (int line = 2; !rest.empty(); ++line) {
    const std::string_view text = take_until(rest, '\n');
    if (trimmed(text).empty() && trimmed(rest).empty()) break;
    split(text, fields);
    read_row({path, line}, table.columns, fields, values);
  }
  if (values.empty()) throw Error(path, "no rows below the header");
  const auto C = static_cast<Eigen::Index>(table.columns.size());
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  table.values =
      Eigen::Map<const RowMajor>(values.data(), static_cast<Eigen::Index>(values.size()) / C, C);
  return table;
}

void Table::write(const std::string& path) const {
  std::string text;
  text.reserve(static_cast<std::size_t>(values.size()) * 22);
  for (std::size_t c = 0; c < columns.size(); ++c) text += (c ? "," : "") + columns[c];
  text += '\n';
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    for (Eigen::Index c = 0; c < values.cols(); ++c) {
      if (c) text += ',';
      append_number(text, values(i, c));
    }
    text += '\n';
  }
  write_whole(path, text);
}

}  // namespace seam
