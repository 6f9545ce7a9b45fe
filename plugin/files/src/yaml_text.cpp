#include "yaml_text.hpp"

#include <charconv>

namespace seam {

namespace {

template <typename List, typename Format>
std::string bracketed(const List& list, Format format) {
  std::string text;
  for (const auto& item : list) text += (text.empty() ? "" : ", ") + format(item);
  return "[" + text + "]";
}

std::string escaped(char c) {
  constexpr char hex[] = "0123456789ABCDEF";
  const auto code = static_cast<unsigned char>(c);
  if (c == '"' || c == '\\') return {'\\', c};
  if (code >= 0x20 && code != 0x7F) return {c};
  return {'\\', 'x', hex[code / 16], hex[code % 16]};
}

}  // namespace

// YAML 1.1 takes 1e+22 for a text and 1.0e+22 for a number.
std::string yaml_number(double value) {
  char digits[32];
  const auto end =
      std::to_chars(digits, digits + sizeof digits, value, std::chars_format::general, 17).ptr;
  std::string text(digits, end);
  const auto exponent = text.find('e');
  if (exponent != std::string::npos && text.find('.') == std::string::npos)
    text.insert(exponent, ".0");
  return text;
}

std::string yaml_text(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) quoted += escaped(c);
  return quoted + "\"";
}

std::string yaml_list(const Eigen::VectorXd& values) {
  return bracketed(values, yaml_number);
}

std::string yaml_list(const std::vector<std::string>& texts) {
  return bracketed(texts, yaml_text);
}

std::string yaml_reference(const std::optional<Eigen::Quaterniond>& reference) {
  if (!reference) return {};
  return "reference: " + yaml_list(Eigen::VectorXd(reference->coeffs())) + "  # x y z w\n";
}

}  // namespace seam
