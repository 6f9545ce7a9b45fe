#include "mend_urdf.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <sstream>

#include "urdf_place.hpp"

namespace seam {
namespace {

using tinyxml2::XMLElement;

template <typename Visit>
void for_each(XMLElement& parent, const char* name, Visit visit) {
  for (XMLElement* child = parent.FirstChildElement(name); child;) {
    XMLElement* next = child->NextSiblingElement(name);
    visit(*child);
    child = next;
  }
}

void remove(XMLElement& element) {
  element.Parent()->DeleteChild(&element);
}

XMLElement& add(XMLElement& parent, const char* name) {
  return *parent.InsertEndChild(parent.GetDocument()->NewElement(name))->ToElement();
}

bool is_one_of(const std::string& name, std::initializer_list<const char*> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

class Mender {
 public:
  Mender(XMLElement& robot, const std::string& path, UrdfDocument& document)
      : robot_(robot), path_(path), document_(document) {}

  void mend() {
    require_no_format(robot_);
    for (const char* read : {"material", "link", "joint"})
      for_each(robot_, read, [this](XMLElement& element) { require_none_within(element); });
    mend_name();
    for_each(robot_, "material", [this](XMLElement& material) { mend_material(material); });
    for_each(robot_, "link", [this](XMLElement& link) { mend_link(link); });
    for_each(robot_, "joint", [this](XMLElement& joint) { mend_joint(joint); });
  }

 private:
  UrdfPlace place(const XMLElement& element) const {
    return {path_, std::string(element.Name()) + " \"" + attribute(&element, "name") + "\"",
            document_.warnings};
  }

  // urdfdom prints some values as formats of printf.
  void require_no_format(const XMLElement& element) const {
    for (const auto* one = element.FirstAttribute(); one; one = one->Next()) {
      if (one->Name() == std::string("filename") || !std::strchr(one->Value(), '%')) continue;
      throw Error(path_ + ":" + std::to_string(element.GetLineNum()),
                  std::string("<") + element.Name() + " " + one->Name() + "=\"" + one->Value() +
                      "\">, must not contain %");
    }
  }

  void require_none_within(XMLElement& element) const {
    require_no_format(element);
    for_each(element, nullptr, [this](XMLElement& child) { require_none_within(child); });
  }

  void mend_name() {
    if (robot_.Attribute("name")) return;
    const std::string name = std::filesystem::path(path_).stem().string();
    UrdfPlace(path_, "robot", document_.warnings).warn("has no name: called \"" + name + "\"");
    robot_.SetAttribute("name", name.c_str());
  }

  void mend_material(XMLElement& material) {
    const UrdfPlace here = place(material);
    mend_vectors(material, here);
    if (!materials_.insert(attribute(&material, "name")).second) {
      here.warn("is given twice: the first one counts");
    } else if (!material.Attribute("name")) {
      here.warn("has no name: left out");
    } else if (!material.FirstChildElement("color") && !material.FirstChildElement("texture")) {
      here.warn("has neither colour nor texture: left out");
    } else {
      return;
    }
    remove(material);
  }

  void mend_link(XMLElement& link) {
    const UrdfPlace here = place(link);
    mend_vectors(link, here);
    for_each(link, "inertial", [&](XMLElement& inertial) { mend_inertial(inertial, here); });
    const std::string name = attribute(&link, "name");
    for (const char* kind : {"visual", "collision"}) {
      auto& capsules =
          kind == std::string("visual") ? document_.capsule_visuals : document_.capsule_collisions;
      std::size_t kept = 0;
      for_each(link, kind, [&](XMLElement& part) {
        const Shape shape = mend_shape(part, here.part(kind));
        if (shape == Shape::capsule) capsules.emplace(name, kept);
        if (shape == Shape::left_out) remove(part);
        if (shape != Shape::left_out) ++kept;
      });
    }
  }

  void mend_inertial(XMLElement& inertial, const UrdfPlace& here) {
    XMLElement* inertia = inertial.FirstChildElement("inertia");
    if (!inertia) {
      if (inertial.FirstChildElement("mass")) here.warn("has no inertia: taken for a point");
      inertia = &add(inertial, "inertia");
      for (const char* moment : {"ixx", "iyy", "izz"}) inertia->SetAttribute(moment, "0");
      for (const char* product : {"ixy", "ixz", "iyz"}) inertia->SetAttribute(product, "0");
    }
    for (const char* product : {"ixy", "ixz", "iyz"}) {
      if (inertia->Attribute(product)) continue;
      here.warn(std::string("inertia without ") + product + ": taken for 0");
      inertia->SetAttribute(product, "0");
    }
  }

  enum class Shape { known, capsule, left_out };

  static Shape mend_shape(XMLElement& part, const UrdfPlace& here) {
    XMLElement* geometry = part.FirstChildElement("geometry");
    XMLElement* shape = geometry ? geometry->FirstChildElement() : nullptr;
    const std::string kind = shape ? shape->Name() : "";
    if (is_one_of(kind, {"box", "cylinder", "sphere"})) return Shape::known;
    if (kind == "mesh" && shape->Attribute("filename")) return Shape::known;
    if (kind == "capsule") {
      here.warn("<capsule>, which URDF lacks: taken for Bullet's, along z");
      shape->SetName("cylinder");
      return Shape::capsule;
    }
    here.warn(kind.empty()     ? "has no shape: left out"
              : kind == "mesh" ? "mesh without a file name: left out"
                               : "<" + kind + ">, which URDF lacks: left out");
    return Shape::left_out;
  }

  void mend_joint(XMLElement& joint) {
    const UrdfPlace here = place(joint);
    mend_vectors(joint, here);
    const std::string type = attribute(&joint, "type");
    if (is_one_of(type, {"spherical", "floating", "planar"})) {
      here.warn("is " + type + ", seam's joints have one degree of freedom: held where it is");
      joint.SetAttribute("type", "fixed");
    }
    std::vector<const char*> unread = {"safety_controller", "calibration"};
    if (attribute(&joint, "type") == "fixed") {
      unread.insert(unread.end(), {"axis", "limit", "dynamics", "mimic"});
    } else {
      mend_limits(joint, here);
    }
    for (const char* name : unread) for_each(joint, name, remove);
    for_each(joint, "dynamics", [](XMLElement& dynamics) {
      if (!dynamics.Attribute("damping") && !dynamics.Attribute("friction")) remove(dynamics);
    });
  }

  static void mend_limits(XMLElement& joint, const UrdfPlace& here) {
    XMLElement* limit = joint.FirstChildElement("limit");
    if (!limit && attribute(&joint, "type") == "continuous") return;
    if (!limit) {
      here.warn("has no <limit>: moves without limits");
      limit = &add(joint, "limit");
      limit->SetAttribute("lower", ("-" + std::string(unlimited_text)).c_str());
      for (const char* name : {"upper", "effort", "velocity"})
        limit->SetAttribute(name, unlimited_text);
    }
    for (const char* name : {"effort", "velocity"}) {
      if (limit->Attribute(name)) continue;
      here.warn(std::string("has no ") + name + " limit: taken for none");
      limit->SetAttribute(name, unlimited_text);
    }
  }

  static void mend_vectors(XMLElement& element, const UrdfPlace& here) {
    static constexpr std::array<std::pair<const char*, std::size_t>, 5> vectors = {
        {{"xyz", 3}, {"rpy", 3}, {"size", 3}, {"scale", 3}, {"rgba", 4}}};
    for (const auto& [name, count] : vectors)
      if (element.Attribute(name)) mend_vector(element, name, count, here);
    for_each(element, nullptr, [&](XMLElement& child) { mend_vectors(child, here); });
  }

  static void mend_vector(XMLElement& element, const char* name, std::size_t count,
                          const UrdfPlace& here) {
    const std::string value = attribute(&element, name);
    std::istringstream in(value);
    std::vector<std::string> numbers{std::istream_iterator<std::string>(in), {}};
    std::string done;
    if (numbers.size() > count) {
      numbers.resize(count);
      done = "the first " + std::to_string(count) + " count";
    } else if (name == std::string("scale") && numbers.size() == 1) {
      numbers.resize(count, numbers.front());
      done = "taken for all axes";
    } else if (name == std::string("rgba") && numbers.size() == 3) {
      numbers.emplace_back("1");
      done = "taken for opaque";
    } else {
      return;
    }
    const std::string shown = value.size() > 60 ? value.substr(0, 60) + "..." : value;
    here.warn(std::string(name) + " \"" + shown + "\", must be " + std::to_string(count) +
              " numbers: " + done);
    std::string mended;
    for (const std::string& number : numbers) mended += (mended.empty() ? "" : " ") + number;
    element.SetAttribute(name, mended.c_str());
  }

  XMLElement& robot_;
  const std::string& path_;
  UrdfDocument& document_;
  std::set<std::string> materials_;
};

}  // namespace

std::string attribute(const tinyxml2::XMLElement* element, const char* name) {
  const char* value = element ? element->Attribute(name) : nullptr;
  return value ? value : "";
}

void mend_urdf(tinyxml2::XMLElement& robot, const std::string& path, UrdfDocument& document) {
  Mender(robot, path, document).mend();
}

}  // namespace seam
