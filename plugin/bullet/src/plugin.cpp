#include <algorithm>

#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>

#include "world_watch.hpp"
#include <seam/controller.hpp>
#include <seam/plugin.hpp>

namespace seam {

Plugin::Plugin(btMultiBodyDynamicsWorld& world)
    : world_(world), watch_(std::make_unique<WorldWatch>(world)) {
  world_.setInternalTickCallback(&Plugin::pre_tick, this, true);
}

Plugin::~Plugin() {
  for (Controller* controller : controllers_) controller->plugin_ = nullptr;
  if (watch_->world_is_there() && world_.getWorldUserInfo() == this)
    world_.setInternalTickCallback(nullptr, nullptr, true);
}

void Plugin::add(Controller& controller) {
  if (controller.plugin_ == this) return;
  if (controller.plugin_) controller.plugin_->remove(controller);
  controllers_.push_back(&controller);
  controller.plugin_ = this;
}

void Plugin::remove(Controller& controller) noexcept {
  const auto place = std::find(controllers_.begin(), controllers_.end(), &controller);
  if (place == controllers_.end()) return;
  controllers_.erase(place);
  controller.plugin_ = nullptr;
}

void Plugin::pre_tick(btDynamicsWorld* world, btScalar dt) {
  const auto* plugin = static_cast<const Plugin*>(world->getWorldUserInfo());
  for (Controller* controller : plugin->controllers_) controller->pre_tick(dt);
}

}  // namespace seam
