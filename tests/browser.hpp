#pragma once

#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>
#include <sys/types.h>

#include "tests/temp_folder.hpp"

namespace seam::test {

/// Debian's Chromium without a window, driven through the DevTools protocol over two pipes: no port, no driver, no Node.
/// Every wait ends after a minute, with an exception.
class Browser {
 public:
  /// Empty where there is none.
  static std::string program();

  Browser();
  ~Browser();
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

  void resize(int width, int height, bool phone = false);
  void prefer_dark(bool dark);
  /// Opens a file and waits until the page says that it is ready.
  void open(const std::string& path);

  /// The value of a JavaScript expression.
  nlohmann::json value(const std::string& expression);
  void wait_for(const std::string& condition);
  void press(const std::string& key);
  /// Over an element, from one place to another: shares of its width.
  void drag(const std::string& selector, double from, double to);
  void click(const std::string& selector, int times = 1);
  /// What is seen, as a PNG.
  std::string screenshot();

  /// What the page asked the network for, and what went wrong in it.
  const std::vector<std::string>& requests() const { return requests_; }
  const std::vector<std::string>& errors() const { return errors_; }

 private:
  nlohmann::json command(const std::string& method, const nlohmann::json& parameters = {});
  void mouse(const char* type, double x, double y, int buttons, int clicks);
  nlohmann::json read();
  void hear(const nlohmann::json& event);

  TempFolder profile_;
  pid_t process_ = -1;
  int to_ = -1, from_ = -1;  // pipes
  std::string heard_;        // not yet a whole message
  std::string session_;
  int commands_ = 0;
  std::vector<std::string> requests_, errors_;
};

}  // namespace seam::test
