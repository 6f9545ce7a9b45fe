#include <algorithm>
#include <array>
#include <cmath>

#include "shown.hpp"
#include <seam/error.hpp>
#include <seam/orientation.hpp>

namespace seam {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double norm_tolerance = 1e-3;
constexpr double beyond = M_PI + 1e-9;  // [rad] a half turn itself is still within
constexpr double no_turn = 1e-100;      // below it squares would underflow
constexpr double alike =
    1e-3;  // squared sine from which on the series of the arc sine would be too short
constexpr double same_angle = 1e-8;  // [rad] between references that are one
constexpr std::array<const char*, 3> axes{"rx", "ry", "rz"};

// With θ² = u: b = (1 − cos θ)/u, c = (θ − sin θ)/θ³ and their slopes b'/θ, c'/θ.
struct Coefficients {
  double b, c, b_slope, c_slope;
};

constexpr int terms = 12;

// Of a term over the one before.
struct Ratios {
  double b[terms], c[terms];
};

constexpr Ratios ratios() noexcept {
  Ratios r{};
  for (int k = 1; k <= terms; ++k) {
    r.b[k - 1] = -1.0 / ((2.0 * k + 1.0) * (2.0 * k + 2.0));
    r.c[k - 1] = 1.0 / (2.0 * k + 3.0);
  }
  return r;
}

Coefficients series(double u) noexcept {
  constexpr Ratios ratio = ratios();
  Coefficients sum{0.5, 1.0 / 6.0, 0.0, 0.0};
  double term = 0.5;
  for (int k = 1; k <= terms; ++k) {
    const double slope = ratio.b[k - 1] * term;
    term = slope * u;
    sum.b += term;
    sum.c += ratio.c[k - 1] * term;
    sum.b_slope += 2.0 * k * slope;
    sum.c_slope += 2.0 * k * ratio.c[k - 1] * slope;
  }
  return sum;
}

Coefficients coefficients(const Vector3d& rho) noexcept {
  const double u = rho.squaredNorm();
  if (u < 4.0) return series(u);
  const double angle = std::sqrt(u);
  const double sine = std::sin(0.5 * angle);
  const double cosine = std::cos(0.5 * angle);
  const double b = 2.0 * sine * sine / u;
  const double c = (angle - 2.0 * sine * cosine) / (angle * u);
  return {b, c, 2.0 * sine * (angle * cosine - 2.0 * sine) / (u * u), (b - 3.0 * c) / u};
}

Vector3d turn(const Coefficients& k, const Vector3d& rho, const Vector3d& x) noexcept {
  const Vector3d across = rho.cross(x);
  return x + k.b * across + k.c * rho.cross(across);
}

// J⁻¹ = 1 − ½[ρ]× + (1 − (θ/2)cot(θ/2))/θ²·[ρ]×², in which the last factor is −b'/(2bθ).
Vector3d turn_back(const Coefficients& k, const Vector3d& rho, const Vector3d& x) noexcept {
  const Vector3d across = rho.cross(x);
  return x - 0.5 * across - k.b_slope / (2.0 * k.b) * rho.cross(across);
}

// J̇ρ̇
Vector3d drift(const Coefficients& k, const Vector3d& rho, const Vector3d& rate) noexcept {
  const Vector3d across = rho.cross(rate);
  const double s = rho.dot(rate);
  return s * (k.b_slope * across + k.c_slope * rho.cross(across)) + k.c * rate.cross(across);
}

// The vector, up to 2π long, that belongs to the quaternion with this sign.
Vector3d signed_vector(const Quaterniond& q) noexcept {
  const double sine = q.vec().norm();
  if (sine < no_turn) return 2.0 / q.w() * q.vec();
  return 2.0 * std::atan2(sine, q.w()) / sine * q.vec();
}

Quaterniond with_sign(double sign, const Quaterniond& q) noexcept {
  return sign < 0.0 ? Quaterniond(-q.coeffs()) : q;
}

// The other vector of the same orientation, if it is nearer.
Vector3d nearer(const Vector3d& rho, const Vector3d& to) noexcept {
  const double angle = rho.norm();
  if (angle < no_turn) return rho;
  const Vector3d other = rho * (1.0 - 2.0 * M_PI / angle);
  return (other - to).squaredNorm() < (rho - to).squaredNorm() ? other : rho;
}

struct Columns {
  Eigen::Index x, y, z, w;
};

Eigen::Index place_of(const std::vector<std::string>& coordinates, const char* name) {
  return std::find(coordinates.begin(), coordinates.end(), name) - coordinates.begin();
}

Eigen::Index column(const Demonstration& demo, const char* name) {
  const Eigen::Index found = place_of(demo.coordinates, name);
  if (found == static_cast<Eigen::Index>(demo.coordinates.size()))
    throw Error(demo.source, std::string("no column \"") + name +
                                 "\", an orientation must have qx, qy, qz and qw");
  return found;
}

Columns orientation_columns(const Demonstration& demo) {
  return {column(demo, "qx"), column(demo, "qy"), column(demo, "qz"), column(demo, "qw")};
}

std::string sample_name(const Demonstration& demo, Eigen::Index i) {
  return demo.source + ": sample " + std::to_string(i + 1);
}

void require_within_pi(const Demonstration& demo, Eigen::Index i, double angle) {
  if (!(angle <= beyond))
    throw Error(sample_name(demo, i), "turned by " + std::to_string(angle) +
                                          " rad from the reference orientation, must be within pi");
}

Quaterniond sample_orientation(const Demonstration& demo, const Columns& at, Eigen::Index i) {
  const auto row = demo.position.row(i);
  const Quaterniond q(row(at.w), row(at.x), row(at.y), row(at.z));
  if (!(std::abs(q.norm() - 1.0) <= norm_tolerance))
    throw Error(sample_name(demo, i),
                "quaternion of norm " + std::to_string(q.norm()) + ", must be 1 within 0.001");
  return q.normalized();
}

Eigen::MatrixXd rotation_vectors(const Demonstration& demo, const Quaterniond& q0) {
  const Columns at = orientation_columns(demo);
  Eigen::MatrixXd vectors(demo.position.rows(), 3);
  Quaterniond last = Quaterniond::Identity();
  for (Eigen::Index i = 0; i < vectors.rows(); ++i) {
    const Quaterniond turned = sample_orientation(demo, at, i) * q0.conjugate();
    last = with_sign(last.dot(turned), turned);
    vectors.row(i) = signed_vector(last);
    const double angle = vectors.row(i).norm();
    require_within_pi(demo, i, angle);
  }
  return vectors;
}

Demonstration without_columns(const Demonstration& demo) {
  Demonstration result;
  result.time = demo.time;
  result.source = demo.source;
  for (Eigen::MatrixXd* block : {&result.position, &result.velocity, &result.acceleration})
    block->resize(demo.position.rows(), demo.position.cols() - 1);
  return result;
}

void append(Demonstration& to, const Demonstration& from, Eigen::Index column) {
  const std::string& name = from.coordinates[static_cast<std::size_t>(column)];
  if (std::count(to.coordinates.begin(), to.coordinates.end(), name) > 0)
    throw Error(to.source, "column \"" + name + "\" is there beside qx, qy, qz and qw");
  const auto at = static_cast<Eigen::Index>(to.coordinates.size());
  to.position.col(at) = from.position.col(column);
  to.velocity.col(at) = from.velocity.col(column);
  to.acceleration.col(at) = from.acceleration.col(column);
  to.coordinates.push_back(name);
}

std::string text_of(const std::optional<Quaterniond>& q) {
  if (!q) return "unknown";
  return shown(q->x(), 9) + " " + shown(q->y(), 9) + " " + shown(q->z(), 9) + " " +
         shown(q->w(), 9);
}

}  // namespace

Vector3d rotation_vector(const Quaterniond& q, const Quaterniond& q0) noexcept {
  const Quaterniond turned = q * q0.conjugate();
  return signed_vector(with_sign(turned.w(), turned));
}

Vector3d rotation_vector(const Eigen::Matrix3d& R, const Eigen::Matrix3d& R0) noexcept {
  Vector3d sine = Vector3d::Zero();  // of the angle, along the axis
  for (Eigen::Index k = 0; k < 3; ++k) sine += 0.5 * R0.col(k).cross(R.col(k));
  const double s = sine.squaredNorm();
  const bool less_than_right = R.cwiseProduct(R0).sum() > 1.0;
  if (!(s < alike && less_than_right)) return rotation_vector(Quaterniond(R), Quaterniond(R0));
  return (1.0 + s * (1.0 / 6.0 + s * (3.0 / 40.0 + s * (5.0 / 112.0 + s * 35.0 / 1152.0)))) * sine;
}

Quaterniond orientation(const Vector3d& vector, const Quaterniond& q0) noexcept {
  const double angle = vector.norm();
  const double factor = angle < no_turn ? 0.5 : std::sin(0.5 * angle) / angle;
  Quaterniond turned;
  turned.w() = std::cos(0.5 * angle);
  turned.vec() = factor * vector;
  return turned * q0;
}

bool to_orientation(const RotationState& from, const Quaterniond& q0,
                    OrientationState& to) noexcept {
  const Vector3d& rho = from.vector;
  if (!(rho.allFinite() && from.velocity.allFinite() && from.acceleration.allFinite()))
    return false;
  const Coefficients k = coefficients(rho);
  to.orientation = orientation(rho, q0);
  to.velocity = turn(k, rho, from.velocity);
  to.acceleration = turn(k, rho, from.acceleration) + drift(k, rho, from.velocity);
  return rho.norm() <= beyond;
}

bool to_rotation(const OrientationState& from, const Quaterniond& q0, RotationState& to) noexcept {
  if (!(from.orientation.coeffs().allFinite() && from.velocity.allFinite() &&
        from.acceleration.allFinite()))
    return false;
  const Vector3d rho = nearer(rotation_vector(from.orientation, q0), to.vector);
  const Coefficients k = coefficients(rho);
  to.vector = rho;
  to.velocity = turn_back(k, rho, from.velocity);
  to.acceleration = turn_back(k, rho, from.acceleration - drift(k, rho, to.velocity));
  return rho.norm() <= beyond;
}

bool has_orientation(const Demonstration& demo) {
  return std::any_of(demo.coordinates.begin(), demo.coordinates.end(), [](const auto& name) {
    return name == "qx" || name == "qy" || name == "qz" || name == "qw";
  });
}

Quaterniond first_orientation(const Demonstration& demo) {
  if (demo.position.rows() == 0) throw Error(demo.source, "no samples");
  return sample_orientation(demo, orientation_columns(demo), 0);
}

Demonstration with_rotation_vector(const Demonstration& demo, const Quaterniond& q0,
                                   const DerivativeSettings& settings) {
  require_reference(demo.source, {axes.begin(), axes.end()}, q0);
  const Columns at = orientation_columns(demo);
  const Demonstration turned = Demonstration::from_positions({"rx", "ry", "rz"}, demo.time,
                                                             rotation_vectors(demo, q0), settings);
  Demonstration result = without_columns(demo);
  for (Eigen::Index c = 0; c < demo.position.cols(); ++c) {
    if (c == at.x)
      for (Eigen::Index axis = 0; axis < 3; ++axis) append(result, turned, axis);
    else if (c != at.y && c != at.z && c != at.w)
      append(result, demo, c);
  }
  result.reference_orientation = q0;
  return result;
}

Demonstration with_reference(const Demonstration& demo, const Quaterniond& q0) {
  demo.validate();
  if (!demo.reference_orientation)
    throw Error(demo.source, "has no reference orientation, must have one to get another");
  require_reference(demo.source, demo.coordinates, q0);
  Demonstration result = demo;
  result.reference_orientation = q0;
  std::array<Eigen::Index, 3> at{};
  for (std::size_t k = 0; k < 3; ++k) at[k] = place_of(demo.coordinates, axes[k]);
  RotationState to;
  for (Eigen::Index i = 0; i < demo.position.rows(); ++i) {
    const RotationState from{demo.position(i, at), demo.velocity(i, at), demo.acceleration(i, at)};
    OrientationState turned;
    require_within_pi(demo, i, from.vector.norm());
    (void)to_orientation(from, *demo.reference_orientation, turned);
    (void)to_rotation(turned, q0, to);
    require_within_pi(demo, i, to.vector.norm());
    result.position(i, at) = to.vector;
    result.velocity(i, at) = to.velocity;
    result.acceleration(i, at) = to.acceleration;
  }
  return result;
}

bool has_rotation_vector(const std::vector<std::string>& coordinates) {
  return std::all_of(axes.begin(), axes.end(), [&](const char* axis) {
    return std::count(coordinates.begin(), coordinates.end(), axis) > 0;
  });
}

void require_reference(const std::string& place, const std::vector<std::string>& coordinates,
                       const std::optional<Quaterniond>& reference) {
  if (!reference) return;
  if (!(std::abs(reference->norm() - 1.0) <= unit_tolerance))
    throw Error(place, "reference orientation " + text_of(reference) + " of norm " +
                           shown(reference->norm(), 9) + ", must be 1 within 1e-9");
  if (!has_rotation_vector(coordinates))
    throw Error(place, "reference orientation " + text_of(reference) +
                           ", must have the coordinates rx, ry and rz");
}

void require_same_reference(const std::string& place, const std::optional<Quaterniond>& expected,
                            const std::optional<Quaterniond>& found) {
  if (!expected && !found) return;
  if (expected && found && rotation_vector(*found, *expected).norm() <= same_angle) return;
  throw Error(place, "reference orientation " + text_of(found) + ", must be " + text_of(expected) +
                         " (x y z w), the same for all");
}

}  // namespace seam
