// SPDX-License-Identifier: Apache-2.0
#include "external_command/free_space/free_space_planner.h"

#include <algorithm>
#include <cmath>
#include <future>
#include <optional>

#include "external_command/core/error.h"
#include "external_command/core/text.h"
#include "free_space/driving_cost.h"
#include "free_space/improve/anytime_improver.h"
#include "free_space/ompl/first_path.h"
#include "free_space/search/narrow_passage.h"
#include "free_space/search/no_way.h"
#include "free_space/search/search_box.h"
#include "motion/collision_probe.h"
#include "path_finisher.h"
#include "planner_words.h"
#include "pull_away.h"

namespace external_command {

namespace {

constexpr double kMaxDistance = 10'000.0;    ///< between start and goals [m]
constexpr double kMostBent = 100.0;          ///< of a path before the start or after a goal [m]
constexpr std::size_t kFirstPatience = 150;  ///< trials that make a first path out of what the search found
constexpr double kForRamps = 0.1;            ///< share of time_budget in which no first path is made better
constexpr double kFinishing = 3.0;        ///< times what the first path took is kept for the ramps of the improved one
constexpr double kLeastFinishing = 0.02;  ///< share of time_budget that is kept for them
constexpr std::size_t kUnlimited = std::numeric_limits<std::size_t>::max();

/// A goal that is free.
struct Approach {
  std::size_t goal_index;
  Query query;
};

struct Solution {
  const Approach* approach = nullptr;
  Arcs arcs;
  double cost = std::numeric_limits<double>::infinity();
};

/// About the start (pose 0) or a goal.
struct Warning {
  std::size_t pose;
  std::string text;
};

/// One call of plan(): everything in the frame around the start.
class Planning {
 public:
  Planning(const VehicleParams& vehicle, const FreeSpaceParams& params, const Pose2d& start,
           const std::vector<Pose2d>& goals, const Region& region, const EndStates& ends, const CancelToken& cancel)
      : begin_(Clock::now()),
        vehicle_(vehicle),
        params_(params),
        origin_(start.position()),
        start_(local(start)),
        ends_(local(ends)),
        stop_(cancel, after(begin_, params.time_budget)),
        index_(vehicle, params.margin, region, origin_, local(start, goals), [this] { throwIfStopped(); }),
        scene_{index_, vehicle.min_turning_radius, {params.gear_change_cost, 1.0, params.reverse_factor}},
        cost_(scene_, params.steering_cost, {params.closeness_cost, params.closeness_distance}) {
    if (const auto collision = probeCollision(index_, start_)) {
      throw StartBlocked(described("the start", start, *collision));
    }
    addApproaches(goals);
    tellEasedMargins(start, goals);
  }

  FreeSpacePlan run() {
    Solution best = firstSolution();
    const Clock::time_point found = Clock::now();
    FreeSpacePlan result = finish(best);
    const double finishing = std::max(kFinishing * secondsSince(found), kLeastFinishing * params_.time_budget);
    result.first_path_time = secondsSince(begin_);
    result.first_path_cost = result.cost;
    result.first_path_length = result.length;
    result.first_path_gear_changes = result.gear_changes;
    if (params_.planner == "portfolio" && params_.improve_budget > 0.0) {
      const Solution better = improved(best, stop_.sooner(finishing).within(params_.improve_budget));
      if (better.cost < best.cost) replace(&result, better);
    }
    toMapFrame(&result.path);
    result.planner = params_.planner;
    for (const Warning& warning : warnings_) {
      if (warning.pose == 0 || warning.pose == result.goal_index + 1) result.warnings.push_back(warning.text);
    }
    result.planning_time = secondsSince(begin_);
    return result;
  }

 private:
  /// @throws Cancelled, PlanningTimeout
  void throwIfStopped() const {
    stop_.cancel().throwIfCancelled();
    if (!stop_.isReached()) return;
    throw PlanningTimeout(text("not all obstacles were taken in within ", budgetWords(params_.time_budget),
                               " (time_budget); give more time, or a smaller region"));
  }

  std::string described(const std::string& what, const Pose2d& pose, const Collision& collision) const {
    const bool is_grid = collision.kind == Collision::Kind::kGrid;
    return text(what, " ", at(pose), " ", collision.description(), " near ", at(collision.at), ", the margin of ",
                metres(params_.margin), " included",
                is_grid ? unknownCellsHint(vehicle_, params_.margin, index_.obstacles().region(), pose,
                                           stop_.cancel().checkpoint())
                        : "");
  }

  Pose2d local(const Pose2d& pose) const { return {pose.x - origin_.x(), pose.y - origin_.y(), pose.heading}; }

  std::vector<Pose2d> local(const Pose2d& start, const std::vector<Pose2d>& goals) const {
    std::vector<Pose2d> poses{local(start)};
    for (const Pose2d& goal : goals) poses.push_back(local(goal));
    return poses;
  }

  /// With curvatures that the vehicle can drive.
  EndStates local(EndStates ends) const {
    const auto convert = [&](EndState* state) {
      state->kappa = std::clamp(state->kappa, -vehicle_.maxKappa(), vehicle_.maxKappa());
      state->bend_from = local(state->bend_from);
    };
    if (ends.start) convert(&*ends.start);
    for (std::optional<EndState>& state : ends.goals) {
      if (state) convert(&*state);
    }
    return ends;
  }

  void tellEasedMargins(const Pose2d& start, const std::vector<Pose2d>& goals) {
    for (const EasedMargin& eased : index_.easedMargins()) {
      const bool is_start = eased.pose == 0;
      const Pose2d& pose = is_start ? start : goals[eased.pose - 1];
      warnings_.push_back(
          {eased.pose, text(is_start ? "the start" : nameOf(eased.pose - 1, goals), " ", at(pose), " is ",
                            closely(eased.distance), " from ", obstacleName(index_.obstacles().region(), eased.source),
                            ", nearer than the margin of ", metres(params_.margin), ": within ", metres(eased.within),
                            " of it the margin is ", closely(eased.margin))});
    }
  }

  void addApproaches(const std::vector<Pose2d>& goals) {
    std::string blocked;
    for (std::size_t i = 0; i < goals.size(); ++i) {
      const Pose2d goal = local(goals[i]);
      if (const auto collision = probeCollision(index_, goal)) {
        blocked += (blocked.empty() ? "" : "; ") + described(nameOf(i, goals), goals[i], *collision);
        continue;
      }
      approaches_.push_back({i, {start_, goal, junctionsOf(i)}});
    }
    if (approaches_.empty()) throw GoalBlocked(blocked);
  }

  Junctions junctionsOf(std::size_t goal) const {
    Junctions junctions;
    if (ends_.start) junctions.before = signOf(ends_.start->direction), junctions.kappa_before = ends_.start->kappa;
    const std::optional<EndState> after = ends_.goals.empty() ? std::nullopt : ends_.goals[goal];
    if (after) junctions.after = signOf(after->direction), junctions.kappa_after = after->kappa;
    return junctions;
  }

  std::vector<FirstPath> firstPaths(const Query& query, std::size_t steps) const {
    const FirstPathRequest request{params_.planner, steps, params_.seed};
    // the search alone is for callers that only want to know whether there is a way
    if (params_.planner == "portfolio") return findFirstPaths(scene_, query, searchArea(scene_, query), request, stop_);
    return {findFirstPath(scene_, query, searchArea(scene_, query), request, stop_)};
  }

  /// The cheapest of the approaches' first paths. With several of them, none may use up the time alone: the own search
  /// tries each with few steps first, then with more. OMPL's planners count none.
  Solution firstSolution() {
    Solution best;
    std::size_t steps = approaches_.size() > 1 ? kFirstLookSteps : params_.max_iterations;
    std::vector<const Approach*> open;
    std::optional<NoWay> no_way;  // to the first of them
    for (const Approach& approach : approaches_) open.push_back(&approach);
    while (true) {
      std::vector<const Approach*> left;
      for (const Approach* approach : open) {
        const std::vector<FirstPath> paths = firstPaths(approach->query, steps);
        stop_.cancel().throwIfCancelled();
        if (paths.back().outcome != TwoWaySearch::Outcome::kNone) left.push_back(approach);
        if (approach == &approaches_[0]) no_way = paths.back().no_way;
        for (const FirstPath& path : paths) {
          if (path.outcome == TwoWaySearch::Outcome::kFound) consider(*approach, path.arcs, &best);
        }
      }
      if (best.approach != nullptr) return best;
      if (left.empty()) throw NoPath(whyNone(whyHopeless(no_way)));
      open = std::move(left);
      if (stop_.isReached()) {
        throw PlanningTimeout(whyNone(text("none was found within ", budgetWords(params_.time_budget),
                                           "; give it more time (time_budget), or a smaller margin (margin)")));
      }
      if (steps >= params_.max_iterations) {
        throw NoPath(whyNone(text("none was found in at most ", params_.max_iterations,
                                  " steps; allow more (max_iterations)", whatIsNear())));
      }
      steps = std::min<std::size_t>(4 * steps, params_.max_iterations);
    }
  }

  /// What closes the way to the first of the approaches, if one narrow place does.
  std::string whyHopeless(std::optional<NoWay> no_way) const {
    const std::string none = "the finest search found none" + whatIsNear();
    if (params_.planner != "portfolio") return none;
    const Query& query = approaches_[0].query;
    const BoundingBox area = searchArea(scene_, query);
    const auto stop = [this] { return stop_.isReached(); };
    if (!no_way) {
      const DistanceMap to_start(index_, area, query.start), to_goal(index_, area, query.goal);
      no_way = proveNoWay(index_, area, query.start, query.goal, {to_start, to_goal}, stop);
    }
    if (!no_way) return none;
    if (no_way->turn) return described(*no_way->turn);
    const auto passage = narrowestPassage(index_, area, query.start, query.goal, stop);
    if (!passage) return "obstacles close every way, or leave less room than the vehicle needs";
    return text("the widest way is only ", metres(passage->width), " wide at ", at(Point2d(passage->at + origin_)),
                "; the vehicle needs ", metres(vehicle_.width + passage->margins),
                ", the margins to both sides included");
  }

  /// Start and goal as far as obstacles are nearer to them than the margin, and what to do; else empty.
  std::string whatIsNear() const {
    std::string near;
    for (const Warning& warning : warnings_) {
      if (warning.pose == 0 || warning.pose == approaches_[0].goal_index + 1) near += "; " + warning.text;
    }
    return near.empty() ? near : near + "; choose a pose farther away, or a smaller margin (margin)";
  }

  std::string described(const TightTurn& turn) const {
    const std::string body = text("no body of ", metres(vehicle_.length()), " by ", metres(vehicle_.width),
                                  " could, even if it moved sideways and turned on the spot");
    if (!turn.heading_off) return text("there is too little room for the bends on the way: ", body);
    return text("there is too little room to turn to that heading on the way: ", body,
                "; there it would be off by at least ", radians(*turn.heading_off));
  }

  std::string whyNone(const std::string& why) const {
    const Pose2d start{origin_.x(), origin_.y(), start_.heading};
    return text("no path from the start ", at(start), " to ", theGoals(), " with a margin of ", metres(params_.margin),
                ": ", why);
  }

  std::string theGoals() const {
    if (approaches_.size() > 1) return "any of the free goals";
    const Pose2d& goal = approaches_[0].query.goal;
    return text("the goal ", at(Pose2d{goal.x + origin_.x(), goal.y + origin_.y(), goal.heading}));
  }

  void consider(const Approach& approach, const Arcs& arcs, Solution* best) const {
    Arcs better = arcs;
    if (params_.planner == "portfolio") {
      const double for_ramps = params_.continuous_curvature ? kForRamps * params_.time_budget : 0.0;
      WorkBudget budget(kUnlimited, stop_.sooner(for_ramps));
      better = PathImprover(scene_, cost_, approach.query, params_.seed).improve(arcs, kFirstPatience, &budget);
    }
    const double cost = cost_.of(start_, better, approach.query.junctions);
    if (cost < best->cost) *best = {&approach, better, cost};
  }

  /// Improves side by side with different seeds and takes the cheapest.
  Solution improved(const Solution& first, const StopCondition& stop) const {
    const Query& query = first.approach->query;
    const auto improve = [&](unsigned thread) {
      WorkBudget budget(params_.improve_iterations > 0 ? params_.improve_iterations : kUnlimited, stop);
      return AnytimeImprover(scene_, cost_, query, searchArea(scene_, query), params_.seed + 7919 * thread)
          .improve(first.arcs, &budget);
    };
    std::vector<std::future<Arcs>> others;
    for (unsigned i = 1; i < params_.threads; ++i) others.push_back(std::async(std::launch::async, improve, i));
    Solution best{first.approach, improve(0), 0.0};
    best.cost = cost_.of(start_, best.arcs, query.junctions);
    for (std::future<Arcs>& other : others) {
      const Arcs arcs = other.get();
      const double cost = cost_.of(start_, arcs, query.junctions);
      if (cost < best.cost) best.arcs = arcs, best.cost = cost;
    }
    stop_.cancel().throwIfCancelled();
    return best;
  }

  FreeSpacePlan finish(const Solution& solution) const {
    const Approach& approach = *solution.approach;
    return PathFinisher(scene_, cost_, vehicle_, params_, ends_, stop_)
        .finish({solution.arcs, approach.goal_index, approach.query});
  }

  /// Takes the better solution, unless it fails the last check, or time runs out before all its ramps are made: then
  /// the first path stays.
  void replace(FreeSpacePlan* result, const Solution& better) const {
    try {
      FreeSpacePlan finished = finish(better);
      if (params_.continuous_curvature && stop_.isReached()) return;
      finished.first_path_time = result->first_path_time;
      finished.first_path_cost = result->first_path_cost;
      finished.first_path_length = result->first_path_length;
      finished.first_path_gear_changes = result->first_path_gear_changes;
      *result = std::move(finished);
    } catch (const NoPath&) {
    }
  }

  void toMapFrame(Path* path) const {
    for (ReferencePoint& point : *path) {
      point.x += origin_.x();
      point.y += origin_.y();
      point.speed = vehicle_.max_speed;
    }
    if (params_.continuous_curvature) limitSteering(vehicle_, path);
  }

  Clock::time_point begin_;
  const VehicleParams& vehicle_;
  const FreeSpaceParams& params_;
  Point2d origin_;
  Pose2d start_;
  EndStates ends_;
  StopCondition stop_;
  FootprintIndex index_;
  Scene scene_;
  DrivingCost cost_;
  std::vector<Approach> approaches_;
  std::vector<Warning> warnings_;
};

bool isUsable(const std::optional<EndState>& state) {
  return !state || (std::isfinite(state->kappa) && state->bend_from.isFinite() && state->bend_length >= 0.0 &&
                    state->bend_length <= kMostBent);
}

void requireUsable(const Pose2d& start, const std::vector<Pose2d>& goals, const EndStates& ends) {
  if (!start.isFinite()) throw InvalidRequest("the start is not finite");
  if (goals.empty()) throw InvalidRequest("there is no goal; give at least one");
  for (std::size_t i = 0; i < goals.size(); ++i) {
    if (!goals[i].isFinite()) throw InvalidRequest(nameOf(i, goals) + " is not finite");
    const double distance = (goals[i].position() - start.position()).norm();
    if (distance > kMaxDistance) {
      throw InvalidRequest(text(nameOf(i, goals), " ", at(goals[i]), " is ", metres(distance), " from the start ",
                                at(start), "; the limit is ", metres(kMaxDistance)));
    }
  }
  if (!isUsable(ends.start) || !std::all_of(ends.goals.begin(), ends.goals.end(), isUsable)) {
    throw InvalidRequest(
        text("what is told of the paths before the start and after the goals is not finite, or may be bent",
             " for more than ", metres(kMostBent)));
  }
  if (!ends.goals.empty() && ends.goals.size() != goals.size()) {
    throw InvalidRequest(text("there are ", goals.size(), " goals, and ways to go on from ", ends.goals.size(),
                              " of them; give one for each, or none"));
  }
}

}  // namespace

FreeSpacePlanner::FreeSpacePlanner(const VehicleParams& vehicle, const FreeSpaceParams& params)
    : vehicle_(vehicle), params_(params) {
  vehicle_.validate();
  params_.validate();
}

FreeSpacePlan FreeSpacePlanner::plan(const Pose2d& start, const std::vector<Pose2d>& goals, const Region& region,
                                     const CancelToken& cancel, const EndStates& ends,
                                     const std::function<void()>& checked) const {
  requireUsable(start, goals, ends);
  cancel.throwIfCancelled();
  Planning planning(vehicle_, params_, start, goals, region, ends, cancel);
  if (checked) checked();
  return planning.run();
}

}  // namespace external_command
