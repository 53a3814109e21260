// SPDX-License-Identifier: Apache-2.0
#include "ompl_space.h"

#include <ompl/base/MotionValidator.h>
#include <ompl/base/StateValidityChecker.h>
#include <ompl/base/spaces/ReedsSheppStateSpace.h>
#include <ompl/geometric/PathGeometric.h>

#include <algorithm>
#include <cmath>

#include "free_space/random.h"

namespace external_command {

namespace {

namespace ob = ompl::base;

constexpr double kCheckStep = 0.05;  ///< most that a corner moves between two checks of the first look [m]
constexpr double kShortTurn = 1.0;   ///< the shortest curve between the ends of a turn up to this is that turn [rad]

class FootprintIsFree : public ob::StateValidityChecker {
 public:
  FootprintIsFree(const ob::SpaceInformationPtr& space, const FootprintIndex& index)
      : ob::StateValidityChecker(space), index_(index) {}

  bool isValid(const ob::State* state) const override { return index_.isFree(poseOf(state)); }

 private:
  const FootprintIndex& index_;
};

class CurveIsFree : public ob::MotionValidator {
 public:
  CurveIsFree(const ob::SpaceInformationPtr& space, const Scene& scene) : ob::MotionValidator(space), scene_(scene) {}

  bool checkMotion(const ob::State* from, const ob::State* to) const override {
    const Pose2d begin = poseOf(from);
    const SteeringWord word = shortestWord(begin, poseOf(to));
    return isFree(scene_.index, begin, word, kCheckStep) && keepsMargin(scene_.index, begin, word);
  }

  bool checkMotion(const ob::State* from, const ob::State* to,
                   std::pair<ob::State*, double>& last_valid) const override {
    Pose2d pose = poseOf(from);
    const SteeringWord word = shortestWord(pose, poseOf(to));
    double driven = 0.0;
    const Pose2d begin = pose;
    for (int i = 0; i < word.size; ++i) {
      const ArcSegment& arc = word.arcs[static_cast<std::size_t>(i)];
      const double free = scene_.index.freeLength(pose, arc, kCheckStep);
      driven += free;
      pose = advance(pose, arc, free);
      if (free >= std::abs(arc.length)) continue;
      if (last_valid.first != nullptr) setPose(pose, last_valid.first);
      last_valid.second = driven / word.length;
      return false;
    }
    return keepsMargin(scene_.index, begin, word);
  }

 private:
  SteeringWord shortestWord(const Pose2d& from, const Pose2d& to) const {
    WordSet words;
    WordQuery query;
    query.radius = scene_.radius;
    reedsSheppWords(from, to, query, &words);
    return words.takeCheapest();
  }

  Scene scene_;
};

/// Uniform samples from a generator of our own: those of OMPL follow each other through the whole process.
class SeededSampler : public ob::StateSampler {
 public:
  SeededSampler(const ob::StateSpace* space, std::uint64_t seed) : ob::StateSampler(space), random_(seed) {}

  void sampleUniform(ob::State* state) override {
    const ob::RealVectorBounds& bounds = space_->as<ob::SE2StateSpace>()->getBounds();
    setPose({random_.uniform(bounds.low[0], bounds.high[0]), random_.uniform(bounds.low[1], bounds.high[1]),
             random_.uniform(-M_PI, M_PI)},
            state);
  }

  void sampleUniformNear(ob::State* state, const ob::State* near, double distance) override {
    const Pose2d pose = poseOf(near);
    setPose({pose.x + random_.uniform(-distance, distance), pose.y + random_.uniform(-distance, distance),
             normalizeAngle(pose.heading + random_.uniform(-distance, distance))},
            state);
    space_->enforceBounds(state);
  }

  void sampleGaussian(ob::State* state, const ob::State* mean, double deviation) override {
    const Pose2d pose = poseOf(mean);
    setPose({pose.x + deviation * random_.bell(), pose.y + deviation * random_.bell(),
             normalizeAngle(pose.heading + deviation * random_.bell())},
            state);
    space_->enforceBounds(state);
  }

 private:
  Random random_;
};

}  // namespace

Pose2d poseOf(const ob::State* state) {
  const auto* se2 = state->as<ob::SE2StateSpace::StateType>();
  return {se2->getX(), se2->getY(), se2->getYaw()};
}

void setPose(const Pose2d& pose, ob::State* state) {
  auto* se2 = state->as<ob::SE2StateSpace::StateType>();
  se2->setXY(pose.x, pose.y);
  se2->setYaw(normalizeAngle(pose.heading));  // OMPL takes no other value
}

ob::SpaceInformationPtr makeSpace(const Scene& scene, const BoundingBox& area, std::uint64_t seed) {
  auto space = std::make_shared<ob::ReedsSheppStateSpace>(scene.radius);
  ob::RealVectorBounds bounds(2);
  for (unsigned i = 0; i < 2; ++i) bounds.setLow(i, area.min[i]), bounds.setHigh(i, area.max[i]);
  space->setBounds(bounds);
  space->setStateSamplerAllocator([seed](const ob::StateSpace* s) { return std::make_shared<SeededSampler>(s, seed); });
  auto information = std::make_shared<ob::SpaceInformation>(space);
  information->setStateValidityChecker(std::make_shared<FootprintIsFree>(information, scene.index));
  information->setMotionValidator(std::make_shared<CurveIsFree>(information, scene));
  information->setup();
  return information;
}

std::shared_ptr<ompl::geometric::PathGeometric> pathOf(const ob::SpaceInformationPtr& space, const Pose2d& start,
                                                       const Arcs& arcs) {
  auto path = std::make_shared<ompl::geometric::PathGeometric>(space);
  ob::State* state = space->allocState();
  const auto add = [&](const Pose2d& pose) {
    setPose(pose, state);
    path->append(state);
  };
  Pose2d begin = start;
  add(begin);
  for (const ArcSegment& arc : arcs) {
    const int pieces = std::max(1, static_cast<int>(std::ceil(std::abs(arc.length * arc.kappa) / kShortTurn)));
    for (int i = 1; i <= pieces; ++i) add(advance(begin, arc, std::abs(arc.length) * i / pieces));
    begin = advance(begin, arc);
  }
  space->freeState(state);
  return path;
}

Arcs arcsOf(const ompl::geometric::PathGeometric& path, double radius) {
  Arcs arcs;
  for (std::size_t i = 1; i < path.getStateCount(); ++i) {
    const auto piece = shortestReedsShepp(poseOf(path.getState(static_cast<unsigned>(i - 1))),
                                          poseOf(path.getState(static_cast<unsigned>(i))), radius);
    arcs.insert(arcs.end(), piece.begin(), piece.end());
  }
  return merged(arcs);
}

}  // namespace external_command
