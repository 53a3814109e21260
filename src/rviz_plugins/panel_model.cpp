// SPDX-License-Identifier: Apache-2.0
#include "panel_model.h"

#include <algorithm>

#include "draft_markers.h"

namespace external_command {

namespace {

constexpr std::size_t kMaxAnswers = 50;
constexpr std::uint32_t kMaxObjects = 5000;  // in the list
constexpr double kPickRadius = 5.0;          // from a click to the object that is meant [m]

const char* objectWord(std::uint8_t kind) { return kind == MapObject::AREA ? "area" : "parking space"; }

}  // namespace

PanelModel::PanelModel(QObject* parent) : QObject(parent) {
  connect(&gateway_, &GatewayLink::answered, this, &PanelModel::takeAnswer);
  connect(&gateway_, &GatewayLink::objectsFound, this, &PanelModel::takeObjects);
  connect(&gateway_, &GatewayLink::pathPlanned, this, [this](const PlannedPath& path) {
    planned_ = path;
    showDraft();
  });
  connect(&gateway_, &GatewayLink::stateChanged, this, [this] {
    const bool is_found = gateway_.state().is_found;
    if (is_found && !was_found_) refreshObjects();
    was_found_ = is_found;
  });
}

void PanelModel::connectTo(const std::string& vehicle) {
  gateway_.connectTo(vehicle);
  objects_.clear();
  planned_ = {};
  was_found_ = false;
  showDraft();
  Q_EMIT objectsChanged();
}

void PanelModel::noteEdit() {
  planned_ = {};
  if (draft_.kind != listed_for_) {
    listed_for_ = draft_.kind;
    refreshObjects();
  }
  showDraft();
  Q_EMIT draftChanged();
}

void PanelModel::showDraft() {
  const auto chosen = std::find_if(objects_.begin(), objects_.end(), [this](const MapObject& object) {
    return object.kind == draft_.objectKind() && object.id == draft_.object_id;
  });
  const std::optional<MapObject> object = chosen == objects_.end() ? std::nullopt : std::make_optional(*chosen);
  gateway_.publishDraft(draftMarkers(draft_, object, planned_));
}

void PanelModel::refreshObjects() {
  objects_.clear();
  if (draft_.objectKind() != 0 && gateway_.state().is_found) {
    FindMapObjects::Request wanted;
    wanted.kind = draft_.objectKind();
    wanted.max_count = kMaxObjects;
    gateway_.find(wanted);
  }
  Q_EMIT objectsChanged();
}

void PanelModel::send(bool is_dry_run) {
  const QString missing = draft_.missing();
  if (!missing.isEmpty()) return say("not sent", missing);
  planned_ = {};
  showDraft();
  draft_.send(is_dry_run, &gateway_);
}

void PanelModel::setSpeed(double target_speed) {
  SpeedCommand command;
  command.kind = target_speed > 0.0 ? SpeedCommand::TARGET_SPEED : SpeedCommand::RESTORE_TARGET_SPEED;
  command.target_speed = target_speed;
  gateway_.send(command);
}

void PanelModel::takeGoal(double x, double y, double heading) {
  if (!draft_.needsGoal()) {
    return say("goal", "this command takes no goal; choose lane follow, free space or precise parking");
  }
  edit([&](CommandDraft& draft) {
    draft.goal.emplace();
    draft.goal->x = x;
    draft.goal->y = y;
    draft.goal->heading = heading;
    draft.goal->has_heading = true;
  });
}

void PanelModel::takePoint(double x, double y) {
  if (draft_.objectKind() != 0) {
    FindMapObjects::Request wanted;
    wanted.kind = draft_.objectKind();
    wanted.is_near = true;
    wanted.point.x = x;
    wanted.point.y = y;
    wanted.radius = kPickRadius;
    wanted.max_count = 1;
    return gateway_.find(wanted);
  }
  if (!draft_.takesPoints())
    return say("point", "this command takes no points; drag its goal with the tool Destination");
  edit([&](CommandDraft& draft) {
    draft.points.emplace_back();
    draft.points.back().x = x;
    draft.points.back().y = y;
  });
}

void PanelModel::takeObjects(const FindMapObjects::Request& wanted, const FindMapObjects::Response& found) {
  if (wanted.kind != draft_.objectKind()) return;  // another command was chosen since
  if (found.error_code != 0) return say("look into the map", QString::fromStdString(found.error_message));
  if (wanted.is_near) return choose(wanted, found);
  objects_ = found.objects;
  Q_EMIT objectsChanged();
  showDraft();
}

/// What was clicked on.
void PanelModel::choose(const FindMapObjects::Request& wanted, const FindMapObjects::Response& found) {
  if (found.objects.empty()) {
    return say("click", QString("no %1 within %2 m of (%3, %4)")
                            .arg(objectWord(wanted.kind))
                            .arg(wanted.radius)
                            .arg(wanted.point.x, 0, 'f', 1)
                            .arg(wanted.point.y, 0, 'f', 1));
  }
  const MapObject& object = found.objects.front();
  const bool is_listed =
      std::any_of(objects_.begin(), objects_.end(), [&](const MapObject& listed) { return listed.id == object.id; });
  if (!is_listed) {
    objects_.push_back(object);
    Q_EMIT objectsChanged();
  }
  edit([&](CommandDraft& draft) { draft.object_id = object.id; });
}

/// The end of a command replaces the same end as its answer, and the other way round: either may come first.
void PanelModel::takeAnswer(const Answer& answer) {
  const auto same = std::find_if(answers_.begin(), answers_.end(), [&](const Answer& known) {
    return answer.status && known.status && known.command_id == answer.command_id && known.vehicle == answer.vehicle &&
           *known.status == *answer.status;
  });
  if (same != answers_.end()) answers_.erase(same);
  answers_.push_front(answer);
  if (answers_.size() > kMaxAnswers) answers_.pop_back();
  Q_EMIT answersChanged();
}

void PanelModel::say(const QString& what, const QString& words) {
  Answer answer;
  answer.vehicle = gateway_.vehicle();
  answer.what = what;
  answer.words = words;
  takeAnswer(answer);
}

}  // namespace external_command
