#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <seam/alignment.hpp>
#include <seam/demonstration.hpp>
#include <seam/export.hpp>

namespace SEAM_API seam {

/// Orientation as three coordinates: the rotation vector ρ that turns a reference orientation q₀
/// into q,
///     q = exp(ρ)·q₀,  |ρ| the angle, ρ/|ρ| the axis in the frame in which q and q₀ are given.
/// Every primitive that is joined to another must have the same q₀: it travels with the values as
/// `reference_orientation`, from the demonstration to the primitive and its file. One that has the
/// coordinates rx ry rz without it (from a file with such columns of its own) can be learned, played
/// and joined to its like, but not to one that has it. The coordinates are valid within π of q₀, where ρ and q determine each other; a motion that is continuous in ρ, ρ̇, ρ̈ is
/// so in q, ω, ω̇.
struct RotationState {
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();        // ρ [rad]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();      // ρ̇ [rad/s]
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();  // ρ̈ [rad/s²]
};

/// Orientation, angular velocity and angular acceleration, all in one fixed frame (a body's own:
/// q⁻¹·ω).
struct OrientationState {
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  // q
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();               // ω [rad/s]
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();           // ω̇ [rad/s²]
};

/// The shorter of the two rotation vectors [rad] of q·q₀⁻¹, its length in [0, π]; q and −q give the
/// same.
/// @param q, q0  unit quaternions
Eigen::Vector3d rotation_vector(const Eigen::Quaterniond& q, const Eigen::Quaterniond& q0) noexcept;
/// The same of rotation matrices, R·R₀ᵀ; quick where they are alike.
Eigen::Vector3d rotation_vector(const Eigen::Matrix3d& R, const Eigen::Matrix3d& R0) noexcept;
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
/// @param q0  unit quaternion, the same for all demonstrations whose primitives are to be joined;
///            the result's reference orientation
/// @throws Error  names source and sample: a norm that is not 1 within 1e-3 (of q₀: 1e-9), an
///                orientation beyond π of q₀, a missing column, or one that is named rx, ry or rz
///                already
Demonstration with_rotation_vector(const Demonstration& demo, const Eigen::Quaterniond& q0,
                                   const DerivativeSettings& settings = {});

/// The same demonstration with its rotation vectors rx ry rz about another q₀. They and their
/// derivatives are mapped exactly, sample by sample; all other columns are kept.
/// @throws Error  the demonstration is not valid or has no reference orientation, q₀ is not a unit
///                quaternion within 1e-9, or a sample is beyond π of either
Demonstration with_reference(const Demonstration& demo, const Eigen::Quaterniond& q0);

/// Whether rx, ry and rz are all there.
bool has_rotation_vector(const std::vector<std::string>& coordinates);

/// How far a reference orientation's norm may be from 1.
inline constexpr double unit_tolerance = 1e-9;

/// @throws Error  names the place and the value: a reference orientation that is not a unit
///                quaternion within unit_tolerance, or without the coordinates rx, ry, rz
void require_reference(const std::string& place, const std::vector<std::string>& coordinates,
                       const std::optional<Eigen::Quaterniond>& reference);

/// @throws Error  names the place and both values: reference orientations that differ by more than
///                1e-8 rad (q and −q are the same), or of which one alone is known
void require_same_reference(const std::string& place,
                            const std::optional<Eigen::Quaterniond>& expected,
                            const std::optional<Eigen::Quaterniond>& found);

}  // namespace seam
