// SPDX-License-Identifier: Apache-2.0
#include "view_watch.h"

#include <OgreCamera.h>
#include <OgrePlane.h>
#include <OgreViewport.h>
#include <rviz/geometry.h>
#include <rviz/view_controller.h>
#include <rviz/view_manager.h>

#include <cmath>
#include <utility>

namespace external_command {

namespace {

constexpr int kPeriod = 1000;    // [ms]
constexpr double kMoved = 30.0;  // what is nearer is not told [m]

}  // namespace

ViewWatch::ViewWatch(rviz::DisplayContext* context, std::function<void(double x, double y)> tell, QObject* parent)
    : QObject(parent), context_(context), tell_(std::move(tell)) {
  connect(&timer_, &QTimer::timeout, this, [this] { look(); });
  timer_.start(kPeriod);
}

void ViewWatch::look() {
  rviz::ViewController* const view = context_->getViewManager()->getCurrent();
  Ogre::Viewport* const viewport = view && view->getCamera() ? view->getCamera()->getViewport() : nullptr;
  if (!viewport) return;
  Ogre::Plane ground(Ogre::Vector3::UNIT_Z, 0.0F);
  Ogre::Vector3 middle;
  const int x = viewport->getActualWidth() / 2, y = viewport->getActualHeight() / 2;
  if (!rviz::getPointOnPlaneFromWindowXY(viewport, ground, x, y, middle)) return;
  const auto place = toMapFrame(*context_, middle, 0.0);
  if (!place || (told_ && std::hypot(place->x - told_->x, place->y - told_->y) < kMoved)) return;
  told_ = place;
  tell_(place->x, place->y);
}

}  // namespace external_command
