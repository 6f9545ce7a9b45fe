#include <algorithm>

#include "require_inertia.hpp"
#include "urdf_document.hpp"
#include "urdf_elements.hpp"
#include <seam/error.hpp>
#include <seam/robot_model.hpp>

namespace seam {
namespace {

/// Steiner's term of a mass at r.
Eigen::Matrix3d point_inertia(double mass, const Eigen::Vector3d& r) {
  return mass * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
}

template <typename Items>
std::string names(const Items& items) {
  std::string line;
  for (const auto& item : items) line += " " + item.name;
  return line.empty() ? " none" : line;
}

/// Walks the tree from its root and merges what is fixed.
class ModelBuilder {
 public:
  ModelBuilder(const UrdfDocument& document, const std::string& path, const UrdfSettings& settings)
      : document_(document),
        places_{path, settings.package_path},
        leave_out_missing_meshes_(settings.leave_out_missing_meshes) {}

  RobotModel build() {
    const urdf::Link& root = *document_.model->getRoot();
    model_.name = document_.model->getName();
    model_.base.link = root.name;
    add_link(root, -1, Eigen::Isometry3d::Identity());
    resolve_leaders();
    require_inertia(model_, places_.urdf);
    return std::move(model_);
  }

 private:
  std::string where(const char* kind, const std::string& name) const {
    return places_.urdf + ": " + kind + " \"" + name + "\"";
  }

  Body& body(int index) {
    return index < 0 ? model_.base : model_.bodies[static_cast<std::size_t>(index)];
  }

  void add_link(const urdf::Link& link, int index, const Eigen::Isometry3d& X_body_link) {
    model_.frames.push_back({link.name, index, X_body_link});
    add_parts(link, body(index), X_body_link);
    for (const auto& joint : children(link)) {
      const urdf::Link& child = *document_.model->getLink(joint->child_link_name);
      const Eigen::Isometry3d X =
          X_body_link * pose_from_urdf(joint->parent_to_joint_origin_transform);
      if (joint->type == urdf::Joint::FIXED) {
        add_link(child, index, X);
      } else {
        add_joint(*joint, child, index, X);
      }
    }
  }

  void add_joint(const urdf::Joint& urdf_joint, const urdf::Link& child, int parent,
                 const Eigen::Isometry3d& X_parent_body) {
    Joint joint = joint_from_urdf(urdf_joint, where("joint", urdf_joint.name));
    joint.parent = parent;
    joint.X_parent_body = X_parent_body;
    model_.joints.push_back(std::move(joint));
    model_.bodies.emplace_back();
    model_.bodies.back().link = child.name;
    add_link(child, model_.dof() - 1, Eigen::Isometry3d::Identity());
  }

  void add_parts(const urdf::Link& link, Body& body, const Eigen::Isometry3d& X_body_link) {
    const std::string here = where("link", link.name);
    if (link.inertial) {
      body.inertial = body.inertial + X_body_link * inertial_from_urdf(*link.inertial, here);
      const urdf::Inertial& given = *link.inertial;
      if (given.mass == 0.0 && (given.ixx != 0.0 || given.iyy != 0.0 || given.izz != 0.0))
        model_.ignored_inertia.push_back("link \"" + link.name +
                                         "\": its mass is 0, its inertia not");
    }
    for (const auto& visual : link.visual_array) {
      add_shape(body.visuals, link.name, X_body_link,
                [&] { return visual_from_urdf(*visual, places_, here); });
    }
    for (const auto& collision : link.collision_array) {
      add_shape(body.collisions, link.name, X_body_link,
                [&] { return collision_from_urdf(*collision, places_, here); });
    }
  }

  template <typename Make>
  void add_shape(std::vector<Geometry>& shapes, const std::string& link,
                 const Eigen::Isometry3d& X_body_link, Make make) {
    try {
      Geometry shape = make();
      shape.link = link;
      shape.X_body_shape = X_body_link * shape.X_body_shape;
      shapes.push_back(std::move(shape));
    } catch (const MeshNotFound& missing) {
      if (!leave_out_missing_meshes_) throw;
      model_.missing_meshes.push_back(
          std::string(missing.what()).substr(places_.urdf.size() + std::string(": ").size()));
    }
  }

  std::vector<urdf::JointSharedPtr> children(const urdf::Link& link) const {
    std::vector<urdf::JointSharedPtr> joints = link.child_joints;
    const auto place = [this](const urdf::JointSharedPtr& joint) {
      const auto found = document_.joint_order.find(joint->name);
      return found == document_.joint_order.end() ? document_.joint_order.size() : found->second;
    };
    std::sort(joints.begin(), joints.end(),
              [&](const auto& a, const auto& b) { return place(a) < place(b); });
    return joints;
  }

  // A follower of a follower follows that one's leader.
  void resolve_leaders() {
    for (Joint& joint : model_.joints) {
      const auto mimic = document_.model->getJoint(joint.name)->mimic;
      const std::string here = where("joint", joint.name);
      int steps = 0;
      for (auto next = mimic; next; ++steps) {
        if (steps == model_.dof()) throw Error(here, "mimics itself, must lead to another joint");
        joint.leader = joint_behind(*next, here);
        const auto& leader = *document_.model->getJoint(next->joint_name);
        next = leader.mimic;
        if (!next) continue;
        joint.offset += joint.multiplier * next->offset;
        joint.multiplier *= next->multiplier;
      }
    }
  }

  int joint_behind(const urdf::JointMimic& mimic, const std::string& here) const {
    for (int i = 0; i < model_.dof(); ++i)
      if (model_.joints[static_cast<std::size_t>(i)].name == mimic.joint_name) return i;
    throw Error(here, "mimics joint \"" + mimic.joint_name + "\", must be one that moves");
  }

  const UrdfDocument& document_;
  MeshPlaces places_;
  bool leave_out_missing_meshes_;
  RobotModel model_;
};

}  // namespace

Eigen::Matrix3d Inertial::about_origin() const {
  return inertia + point_inertia(mass, com);
}

Inertial operator*(const Eigen::Isometry3d& X_a_b, const Inertial& b) {
  const Eigen::Matrix3d turned = X_a_b.linear() * b.inertia * X_a_b.linear().transpose();
  return {b.mass, X_a_b * b.com, 0.5 * (turned + turned.transpose())};
}

Inertial operator+(const Inertial& a, const Inertial& b) {
  if (a.mass == 0.0) return b;
  if (b.mass == 0.0) return a;
  Inertial sum;
  sum.mass = a.mass + b.mass;
  sum.com = (a.mass * a.com + b.mass * b.com) / sum.mass;
  sum.inertia = a.inertia + point_inertia(a.mass, a.com - sum.com)  //
                + b.inertia + point_inertia(b.mass, b.com - sum.com);
  return sum;
}

Eigen::Isometry3d Joint::X_parent_body_at(double q) const {
  Eigen::Isometry3d X = X_parent_body;
  if (type == Type::prismatic) {
    X.translate(q * axis);
  } else {
    X.rotate(Eigen::AngleAxisd(q, axis));
  }
  return X;
}

int RobotModel::joint(const std::string& joint_name) const {
  const auto found = std::find_if(joints.begin(), joints.end(), [&](const Joint& candidate) {
    return candidate.name == joint_name;
  });
  if (found != joints.end()) return static_cast<int>(found - joints.begin());
  throw Error("robot \"" + name + "\"", "no joint \"" + joint_name + "\", it has" + names(joints));
}

const Frame& RobotModel::frame(const std::string& link_name) const {
  const auto found = std::find_if(frames.begin(), frames.end(), [&](const Frame& candidate) {
    return candidate.name == link_name;
  });
  if (found != frames.end()) return *found;
  throw Error("robot \"" + name + "\"", "no link \"" + link_name + "\", it has" + names(frames));
}

void RobotModel::place_followers(Eigen::Ref<Eigen::VectorXd> q) const noexcept {
  for (int i = 0; i < dof(); ++i) {
    const Joint& joint = joints[static_cast<std::size_t>(i)];
    if (joint.follows()) q(i) = joint.multiplier * q(joint.leader) + joint.offset;
  }
}

Eigen::VectorXd RobotModel::neutral() const {
  Eigen::VectorXd q(dof());
  for (int i = 0; i < dof(); ++i) {
    const Joint& joint = joints[static_cast<std::size_t>(i)];
    q(i) = std::min(std::max(0.0, joint.lower), joint.upper);
  }
  place_followers(q);
  return q;
}

RobotModel RobotModel::read(const std::string& urdf_path, const UrdfSettings& settings) {
  const UrdfDocument document = read_urdf(urdf_path);
  return ModelBuilder(document, urdf_path, settings).build();
}

}  // namespace seam
