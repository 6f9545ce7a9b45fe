#include "urdf_document.hpp"

#include <exception>
#include <filesystem>
#include <mutex>
#include <set>
#include <vector>

#include <console_bridge/console.h>
#include <tinyxml2.h>
#include <urdf_parser/urdf_parser.h>

#include "mend_urdf.hpp"
#include <seam/error.hpp>
#include <seam/whole_file.hpp>

namespace seam {
namespace {

/// Takes urdfdom's messages while it lives. The handler is global: one at a time.
class UrdfdomErrors final : public console_bridge::OutputHandler {
 public:
  UrdfdomErrors() : lock_(mutex()), level_(console_bridge::getLogLevel()) {
    console_bridge::setLogLevel(console_bridge::CONSOLE_BRIDGE_LOG_ERROR);
    console_bridge::useOutputHandler(this);
  }
  UrdfdomErrors(const UrdfdomErrors&) = delete;
  UrdfdomErrors& operator=(const UrdfdomErrors&) = delete;
  ~UrdfdomErrors() override {
    console_bridge::restorePreviousOutputHandler();
    console_bridge::setLogLevel(level_);
  }

  void log(const std::string& message, console_bridge::LogLevel, const char*, int) override {
    text_ += (text_.empty() ? "" : "; ") + message;
  }

  const std::string& text() const { return text_; }

 private:
  static std::mutex& mutex() {
    static std::mutex instance;
    return instance;
  }

  std::lock_guard<std::mutex> lock_;
  console_bridge::LogLevel level_;
  std::string text_;
};

constexpr std::uintmax_t most_bytes = std::uintmax_t{4} << 20;
constexpr std::size_t most_joints =
    1000;  // one behind the other they are read one within the other

std::string read_text(const std::string& path) {
  std::error_code status;
  if (!std::filesystem::exists(path, status)) throw Error(path, "no such file");
  std::string text = read_whole(path, "URDF file", most_bytes);
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) throw Error(path, "is empty");
  return text;
}

/// A joint as the file's XML has it.
struct JointElement {
  std::string name, parent, child;
};

bool is_xacro(const tinyxml2::XMLElement& element) {
  return std::string(element.Name()).rfind("xacro:", 0) == 0;
}

/// The first element of xacro, null if there is none.
const tinyxml2::XMLElement* find_xacro(const tinyxml2::XMLElement& element) {
  if (is_xacro(element)) return &element;
  for (auto* child = element.FirstChildElement(); child; child = child->NextSiblingElement())
    if (const auto* found = find_xacro(*child)) return found;
  return nullptr;
}

tinyxml2::XMLElement& parse(tinyxml2::XMLDocument& xml, const std::string& path,
                            const std::string& text) {
  if (xml.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    throw Error(path + ":" + std::to_string(xml.ErrorLineNum()),
                std::string("not well-formed XML (") + xml.ErrorName() + ")");
  }
  tinyxml2::XMLElement* root = xml.RootElement();
  const std::string root_name = root ? root->Name() : "";
  if (root_name != "robot")
    throw Error(path, "root element is <" + root_name + ">, must be <robot>");
  if (const auto* found = find_xacro(*root))
    throw Error(path + ":" + std::to_string(found->GetLineNum()),
                std::string("<") + found->Name() +
                    "> is xacro, must be expanded first: xacro in.xacro > out.urdf");
  return *root;
}

std::vector<JointElement> joint_elements(const tinyxml2::XMLElement& robot) {
  std::vector<JointElement> joints;
  for (auto* joint = robot.FirstChildElement("joint"); joint;
       joint = joint->NextSiblingElement("joint")) {
    joints.push_back({attribute(joint, "name"),
                      attribute(joint->FirstChildElement("parent"), "link"),
                      attribute(joint->FirstChildElement("child"), "link")});
  }
  return joints;
}

/// urdfdom takes a link with two parents, and leaks a ring.
void check_tree(const std::string& path, const std::vector<JointElement>& joints) {
  const auto where = [&](const std::string& link) { return path + ": link \"" + link + "\""; };
  std::map<std::string, const JointElement*> above;  // the joint that carries a link
  for (const JointElement& joint : joints) {
    const auto [other, is_new] = above.emplace(joint.child, &joint);
    if (is_new || joint.child.empty()) continue;
    const std::string both = other->second->name + "\" and \"" + joint.name;
    throw Error(where(joint.child), "is the child of joints \"" + both + "\", must be of one");
  }
  std::set<std::string> rooted;
  for (const JointElement& joint : joints) {
    std::set<std::string> way;
    auto up = above.find(joint.child);
    for (; up != above.end() && rooted.count(up->first) == 0; up = above.find(up->second->parent)) {
      if (way.insert(up->first).second) continue;
      throw Error(where(up->first), "is its own ancestor, must be in a tree");
    }
    rooted.insert(way.begin(), way.end());
  }
}

}  // namespace

UrdfDocument read_urdf(const std::string& path) {
  const std::string text = read_text(path);
  tinyxml2::XMLDocument xml;
  tinyxml2::XMLElement& robot = parse(xml, path, text);
  const std::vector<JointElement> joints = joint_elements(robot);
  if (joints.size() > most_joints)
    throw Error(
        path, std::to_string(joints.size()) + " joints, must be <= " + std::to_string(most_joints));
  check_tree(path, joints);
  UrdfDocument document;
  for (const JointElement& joint : joints)
    document.joint_order.emplace(joint.name, document.joint_order.size());
  mend_urdf(robot, path, document);
  tinyxml2::XMLPrinter mended(nullptr, true);
  xml.Print(&mended);

  const UrdfdomErrors errors;
  try {
    document.model = urdf::parseURDF(mended.CStr());
  } catch (const std::exception& error) {
    throw Error(path, error.what());
  }
  if (!errors.text().empty()) throw Error(path, errors.text());
  if (!document.model) throw Error(path, "urdfdom refuses it without a reason");
  return document;
}

}  // namespace seam
