#include "tests/browser.hpp"

#include <chrono>
#include <csignal>
#include <filesystem>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include "scenes/base64.hpp"

namespace seam::test {

namespace {

using Json = nlohmann::json;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds patience{60};

// Its last processes may still write.
void forget(const std::string& profile) {
  std::error_code failed;
  for (int i = 0; i < 100; ++i) {
    std::filesystem::remove_all(profile, failed);
    if (!failed) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

[[noreturn]] void run_chromium(const std::string& program, int in, int out,
                               const std::string& profile) {
  setpgid(0, 0);
  const int high_in = fcntl(in, F_DUPFD, 10), high_out = fcntl(out, F_DUPFD, 10);
  dup2(high_in, 3);  // where the protocol is spoken
  dup2(high_out, 4);
  const int nowhere = ::open("/dev/null", O_RDWR);
  for (const int fd : {0, 1, 2}) dup2(nowhere, fd);
  const std::string user = "--user-data-dir=" + profile;
  execl(program.c_str(), program.c_str(), "--headless", "--no-sandbox", "--disable-gpu",
        "--enable-unsafe-swiftshader", "--disable-background-networking", "--no-first-run",
        "--disable-dev-shm-usage", "--hide-scrollbars", "--remote-debugging-pipe", user.c_str(),
        "about:blank", nullptr);
  _exit(127);
}

}  // namespace

std::string Browser::program() {
  for (const char* path : {"/usr/bin/chromium", "/usr/bin/chromium-browser"})
    if (access(path, X_OK) == 0) return path;
  return {};
}

Browser::Browser() {
  int to[2], from[2];
  if (pipe2(to, O_CLOEXEC) != 0 || pipe2(from, O_CLOEXEC) != 0)
    throw std::runtime_error("no pipes");
  process_ = fork();
  if (process_ == 0) run_chromium(program(), to[0], from[1], profile_.path("profile"));
  close(to[0]);
  close(from[1]);
  to_ = to[1];
  from_ = from[0];
  signal(SIGPIPE, SIG_IGN);
  const Json target = command("Target.createTarget", {{"url", "about:blank"}});
  session_ =
      command("Target.attachToTarget", {{"targetId", target.at("targetId")}, {"flatten", true}})
          .at("sessionId");
  for (const char* domain : {"Page", "Runtime", "Network", "Log"})
    command(std::string(domain) + ".enable");
}

Browser::~Browser() {
  try {
    session_.clear();
    command("Browser.close");
    while (true) read();
  } catch (const std::exception&) {
    // it has ended
  }
  killpg(process_, SIGKILL);
  waitpid(process_, nullptr, 0);
  close(to_);
  close(from_);
  forget(profile_.path("profile"));
}

Json Browser::read() {
  const auto end = Clock::now() + patience;
  for (;;) {
    const auto whole = heard_.find('\0');
    if (whole != std::string::npos) {
      Json message = Json::parse(heard_.substr(0, whole));
      heard_.erase(0, whole + 1);
      return message;
    }
    pollfd ready{from_, POLLIN, 0};
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now());
    if (left.count() <= 0 || poll(&ready, 1, static_cast<int>(left.count())) != 1)
      throw std::runtime_error("Chromium does not answer");
    char part[65536];
    const ssize_t n = ::read(from_, part, sizeof part);
    if (n <= 0) throw std::runtime_error("Chromium has ended");
    heard_.append(part, static_cast<std::size_t>(n));
  }
}

void Browser::hear(const Json& event) {
  const std::string method = event.value("method", "");
  if (method == "Network.requestWillBeSent") requests_.push_back(event["params"]["request"]["url"]);
  if (method == "Runtime.exceptionThrown")
    errors_.push_back(event["params"]["exceptionDetails"].dump());
  if (method == "Log.entryAdded" && event["params"]["entry"]["level"] == "error")
    errors_.push_back(event["params"]["entry"]["text"]);
  if (method == "Runtime.consoleAPICalled" &&
      (event["params"]["type"] == "error" || event["params"]["type"] == "warning"))
    errors_.push_back(event["params"]["args"].dump());
}

Json Browser::command(const std::string& method, const Json& parameters) {
  Json message{{"id", ++commands_}, {"method", method}};
  if (!parameters.is_null()) message["params"] = parameters;
  if (!session_.empty()) message["sessionId"] = session_;
  const std::string text = message.dump() + '\0';
  for (std::size_t sent = 0; sent < text.size();) {
    const ssize_t n = write(to_, text.data() + sent, text.size() - sent);
    if (n <= 0) throw std::runtime_error("Chromium has ended");
    sent += static_cast<std::size_t>(n);
  }
  for (;;) {
    const Json answer = read();
    if (answer.value("id", 0) != commands_) {
      hear(answer);
      continue;
    }
    if (answer.contains("error")) throw std::runtime_error(method + ": " + answer["error"].dump());
    return answer.at("result");
  }
}

void Browser::resize(int width, int height, bool phone) {
  command("Emulation.setDeviceMetricsOverride",
          {{"width", width}, {"height", height}, {"deviceScaleFactor", 1}, {"mobile", phone}});
}

void Browser::prefer_dark(bool dark) {
  const Json scheme{{"name", "prefers-color-scheme"}, {"value", dark ? "dark" : "light"}};
  command("Emulation.setEmulatedMedia", {{"features", Json::array({scheme})}});
}

void Browser::open(const std::string& path) {
  command("Page.navigate", {{"url", "file://" + path}});
  wait_for("document.documentElement?.dataset.ready === 'yes'");
}

Json Browser::value(const std::string& expression) {
  const Json answer =
      command("Runtime.evaluate",
              {{"expression", expression}, {"awaitPromise", true}, {"returnByValue", true}});
  if (answer.contains("exceptionDetails"))
    throw std::runtime_error(expression + ": " + answer["exceptionDetails"].dump());
  return answer.at("result").value("value", Json());
}

void Browser::wait_for(const std::string& condition) {
  const auto end = Clock::now() + patience;
  while (value("Boolean(" + condition + ")") != true) {
    if (Clock::now() > end) throw std::runtime_error("waited in vain for " + condition);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

void Browser::press(const std::string& key) {
  for (const char* type : {"keyDown", "keyUp"})
    command("Input.dispatchKeyEvent", {{"type", type}, {"key", key}});
}

void Browser::mouse(const char* type, double x, double y, int buttons, int clicks) {
  command("Input.dispatchMouseEvent", {{"type", type},
                                       {"x", x},
                                       {"y", y},
                                       {"button", clicks ? "left" : "none"},
                                       {"buttons", buttons},
                                       {"clickCount", clicks}});
}

void Browser::drag(const std::string& selector, double from, double to) {
  const Json box = value("(() => { const e = document.querySelector('" + selector +
                         "'); e.scrollIntoView({block: 'center'}); const r = "
                         "e.getBoundingClientRect(); return [r.x, r.y, r.width, r.height]; })()");
  const double x = box[0], y = box[1], width = box[2], height = box[3];
  const double middle = y + 0.5 * height;
  mouse("mouseMoved", x + from * width, middle, 0, 0);
  mouse("mousePressed", x + from * width, middle, 1, 1);
  for (const double share : {0.5, 1.0})
    mouse("mouseMoved", x + (from + share * (to - from)) * width, middle, 1, 0);
  mouse("mouseReleased", x + to * width, middle, 0, 1);
}

void Browser::click(const std::string& selector, int times) {
  const Json at = value("(() => { const e = document.querySelector('" + selector +
                        "'); e.scrollIntoView({block: 'center'}); const r = "
                        "e.getBoundingClientRect(); return [r.x + r.width / 2, r.y + r.height / "
                        "2]; })()");
  mouse("mouseMoved", at[0], at[1], 0, 0);
  for (int i = 1; i <= times; ++i) {
    mouse("mousePressed", at[0], at[1], 1, i);
    mouse("mouseReleased", at[0], at[1], 0, i);
  }
}

std::string Browser::screenshot() {
  const Json picture = command("Page.captureScreenshot", {{"format", "png"}});
  return from_base64(picture.at("data").get_ref<const std::string&>());
}

}  // namespace seam::test
