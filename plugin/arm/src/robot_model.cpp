#include <algorithm>

#include "require_inertia.hpp"
#include "text.hpp"
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

/// 0, or the limit next to it.
double next_to_zero(const Joint& joint) {
  return std::min(std::max(0.0, joint.lower), joint.upper);
}

/// Walks the tree from its root and merges what is fixed.
class ModelBuilder {
 public:
  ModelBuilder(UrdfDocument document, const std::string& path, const UrdfSettings& settings)
      : document_(std::move(document)),
        places_{path, settings.package_path},
        leave_out_missing_meshes_(settings.leave_out_missing_meshes) {}

  RobotModel build() {
    const urdf::Link& root = *document_.model->getRoot();
    model_.name = document_.model->getName();
    model_.base.link = root.name;
    model_.warnings = std::move(document_.warnings);
    add_link(root, -1, Eigen::Isometry3d::Identity());
    resolve_leaders();
    require_masses();
    require_inertia(model_, places_.urdf);
    return std::move(model_);
  }

 private:
  UrdfPlace place(const char* kind, const std::string& name) {
    return {places_.urdf, std::string(kind) + " \"" + name + "\"", model_.warnings};
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
      if (!(X.translation().norm() <= farthest))
        place("joint", joint->name)
            .refuse(text("is more than ", farthest, " m from the joint before"));
      if (joint->type == urdf::Joint::FIXED) {
        add_link(child, index, X);
      } else if (!has_mass(child)) {
        add_link(child, index, X * held(*joint));
      } else {
        add_joint(*joint, child, index, X);
      }
    }
  }

  // Where a joint stays that moves nothing with mass.
  Eigen::Isometry3d held(const urdf::Joint& urdf_joint) {
    const UrdfPlace here = place("joint", urdf_joint.name);
    const Joint joint = joint_from_urdf(urdf_joint, here);
    const double q = next_to_zero(joint);
    const char* const unit = joint.type == Joint::Type::prismatic ? " m" : " rad";
    here.warn(text("moves nothing with mass: held at ", q, unit));
    return joint.X_parent_body_at(q);
  }

  void add_joint(const urdf::Joint& urdf_joint, const urdf::Link& child, int parent,
                 const Eigen::Isometry3d& X_parent_body) {
    Joint joint = joint_from_urdf(urdf_joint, place("joint", urdf_joint.name));
    joint.parent = parent;
    joint.X_parent_body = X_parent_body;
    model_.joints.push_back(std::move(joint));
    model_.bodies.emplace_back();
    model_.bodies.back().link = child.name;
    add_link(child, model_.dof() - 1, Eigen::Isometry3d::Identity());
  }

  void add_parts(const urdf::Link& link, Body& body, const Eigen::Isometry3d& X_body_link) {
    const UrdfPlace here = place("link", link.name);
    if (link.inertial)
      body.inertial = body.inertial + X_body_link * inertial_from_urdf(*link.inertial, here);
    for (std::size_t i = 0; i < link.visual_array.size(); ++i) {
      const bool is_capsule = document_.capsule_visuals.count({link.name, i}) > 0;
      add_shapes(body.visuals, link.name, X_body_link, [&] {
        return visual_from_urdf(*link.visual_array[i], is_capsule, places_, here);
      });
    }
    for (std::size_t i = 0; i < link.collision_array.size(); ++i) {
      const bool is_capsule = document_.capsule_collisions.count({link.name, i}) > 0;
      add_shapes(body.collisions, link.name, X_body_link, [&] {
        return collision_from_urdf(*link.collision_array[i], is_capsule, places_, here);
      });
    }
  }

  template <typename Make>
  void add_shapes(std::vector<Geometry>& shapes, const std::string& link,
                  const Eigen::Isometry3d& X_body_link, Make make) {
    try {
      for (Geometry& shape : make()) {
        shape.link = link;
        shape.X_body_shape = X_body_link * shape.X_body_shape;
        shapes.push_back(std::move(shape));
      }
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

  // A follower of a follower follows that one's leader; one that is led by none that moves follows none.
  void resolve_leaders() {
    for (Joint& joint : model_.joints) {
      const auto mimic = document_.model->getJoint(joint.name)->mimic;
      if (!mimic) continue;
      const UrdfPlace here = place("joint", joint.name);
      follow(joint, *mimic, here);
      for (const double number : {joint.multiplier, joint.offset})
        if (!(std::abs(number) <= farthest))
          here.refuse(text("mimics by ", number, ", must be at most ", farthest, " in magnitude"));
    }
  }

  void follow(Joint& joint, const urdf::JointMimic& first, const UrdfPlace& here) const {
    double multiplier = first.multiplier, offset = first.offset;
    const urdf::JointMimic* mimic = &first;
    for (int steps = 0;; ++steps) {
      const int leader = moving_joint(mimic->joint_name);
      if (leader < 0)
        return here.warn(
            "mimics joint \"" + mimic->joint_name + "\", which " +
            (document_.model->getJoint(mimic->joint_name) ? "does not move" : "is not there") +
            ": follows none");
      if (steps == model_.dof()) return here.warn("mimics itself: follows none");
      const auto next = document_.model->getJoint(mimic->joint_name)->mimic;
      if (!next) {
        joint.leader = leader;
        joint.multiplier = multiplier;
        joint.offset = offset;
        return;
      }
      offset += multiplier * next->offset;
      multiplier *= next->multiplier;
      mimic = next.get();
    }
  }

  int moving_joint(const std::string& name) const {
    for (int i = 0; i < model_.dof(); ++i)
      if (model_.joints[static_cast<std::size_t>(i)].name == name) return i;
    return -1;
  }

  void require_masses() {
    for (const Body& body : model_.bodies) {
      const Inertial& all = body.inertial;
      if (all.mass == 0.0 && all.com.isZero(0.0) && all.inertia.isZero(0.0)) continue;
      const UrdfPlace here = place("link", body.link);
      if (!(all.mass > 0.0 && all.com.allFinite()))
        here.refuse(text("mass ", all.mass, " kg, with what is fixed to it, must be > 0"));
      if (!(all.com.norm() <= farthest))
        here.refuse(text("its centre of mass is more than ", farthest, " m from its joint"));
    }
  }

  UrdfDocument document_;
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

bool RobotModel::is_elastic() const {
  return std::any_of(joints.begin(), joints.end(),
                     [](const Joint& joint) { return joint.is_elastic(); });
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
  for (int i = 0; i < dof(); ++i) q(i) = next_to_zero(joints[static_cast<std::size_t>(i)]);
  place_followers(q);
  return q;
}

RobotModel RobotModel::read(const std::string& urdf_path, const UrdfSettings& settings) {
  return ModelBuilder(read_urdf(urdf_path), urdf_path, settings).build();
}

}  // namespace seam
