#pragma once

#include <Eigen/Geometry>

#include <seam/demonstration.hpp>

namespace seam {

/// Orientation as three coordinates: the rotation vector ρ that turns a reference orientation q₀
/// into q,
///     q = exp(ρ)·q₀,  |ρ| the angle, ρ/|ρ| the axis in the frame in which q and q₀ are given.
/// Every primitive that is joined to another must have the same q₀. The coordinates are valid
/// within π of q₀, where ρ and q determine each other; a motion that is continuous in ρ, ρ̇, ρ̈ is
/// so in q, ω, ω̇.
struct RotationState {
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();        // ρ [rad]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();      // ρ̇ [rad/s]
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();  // ρ̈ [rad/s²]
};

/// Orientation, angular velocity and angular acceleration, all in one fixed frame (a body's own:
/// q⁻¹·ω).
struct OrientationState {
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();      // ω [rad/s]
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();  // ω̇ [rad/s²]
};

/// The shorter of the two rotation vectors [rad] of q·q₀⁻¹, its length in [0, π]; q and −q give the
/// same.
/// @param q, q0  unit quaternions
Eigen::Vector3d rotation_vector(const Eigen::Quaterniond& q, const Eigen::Quaterniond& q0) noexcept;
/// exp(ρ)·q₀, for ρ [rad] of any length; the inverse of rotation_vector within π.
Eigen::Quaterniond orientation(const Eigen::Vector3d& vector,
                               const Eigen::Quaterniond& q0) noexcept;

/// q = exp(ρ)·q₀,  ω = J(ρ)ρ̇,  ω̇ = J(ρ)ρ̈ + J̇ρ̇  with the left Jacobian of SO(3)
///     J(ρ) = 1 + (1 − cos θ)/θ²·[ρ]× + (θ − sin θ)/θ³·[ρ]×²,  θ = |ρ|
/// Neither allocates nor throws.
/// @return  false where the state is not finite (`to` is then left as it is) or beyond π of q₀
///          (`to` is then still right)
[[nodiscard]] bool to_orientation(const RotationState& from, const Eigen::Quaterniond& q0,
                                  OrientationState& to) noexcept;

/// The inverse: ρ̇ = J⁻¹ω,  ρ̈ = J⁻¹(ω̇ − J̇ρ̇). Of the two vectors of q·q₀⁻¹ that which is nearer
/// to `to.vector` as it comes in: 0 gives the shorter one, and the last tick's state follows a
/// motion across π. Neither allocates nor throws.
/// @param from  its orientation a unit quaternion, of either sign
/// @return      false where the state is not finite (`to` is then left as it is) or beyond π of q₀
///              (`to` is then still right, up to 2π, where J is singular)
[[nodiscard]] bool to_rotation(const OrientationState& from, const Eigen::Quaterniond& q0,
                               RotationState& to) noexcept;

/// Whether any of the columns qx qy qz qw is there.
bool has_orientation(const Demonstration& demo);

/// The orientation of a demonstration's first sample, from its columns qx qy qz qw.
/// @throws Error  one of the columns is missing, or the quaternion's norm is not 1 within 1e-3
Eigen::Quaterniond first_orientation(const Demonstration& demo);

/// The demonstration with its columns qx qy qz qw replaced, at the place of qx, by the rotation
/// vector rx ry rz [rad] about q₀. Quaternions are normalised and followed continuously, whatever
/// their signs; derivatives of the new columns are taken by a smoothing fit, those of all others
/// are kept.
/// @param q0  unit quaternion, the same for all demonstrations whose primitives are to be joined
/// @throws Error  names source and sample: a norm that is not 1 within 1e-3, an orientation beyond
///                π of q₀, a missing column, or one that is named rx, ry or rz already
Demonstration with_rotation_vector(const Demonstration& demo, const Eigen::Quaterniond& q0,
                                   const DerivativeSettings& settings = {});

}  // namespace seam
