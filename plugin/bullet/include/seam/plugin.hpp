#pragma once

#include <memory>
#include <vector>

#include <seam/bullet_precision.hpp>
#include <seam/export.hpp>

class btDynamicsWorld;
class btMultiBodyDynamicsWorld;

namespace SEAM_API seam {

class Controller;
class WorldWatch;

/// Calls `pre_tick` of any number of controllers before each of a world's ticks, substeps included.
///
/// A Bullet world has one pre-tick slot and one user pointer, and the plugin takes both
/// (`setInternalTickCallback(…, isPreTick = true)`). An app that needs them calls
/// `Controller::pre_tick` from its own callback and leaves the plugin out. Whoever takes the slot last
/// has it; a plugin that has lost it leaves it alone. The world is borrowed; it, controllers and the plugin may go in any
/// order, though not from inside a tick.
class Plugin {
 public:
  /// Takes the world's pre-tick.
  explicit Plugin(btMultiBodyDynamicsWorld& world);
  Plugin(const Plugin&) = delete;
  Plugin& operator=(const Plugin&) = delete;
  ~Plugin();

  /// Controllers are called in the order in which they were added; adding one twice does nothing.
  void add(Controller& controller);
  /// The controller is not called any more.
  void remove(Controller& controller) noexcept;

 private:
  static void pre_tick(btDynamicsWorld* world, btScalar dt);

  btMultiBodyDynamicsWorld& world_;
  std::unique_ptr<WorldWatch> watch_;
  std::vector<Controller*> controllers_;
};

}  // namespace seam
