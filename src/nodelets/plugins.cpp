// SPDX-License-Identifier: Apache-2.0
#include <pluginlib/class_list_macros.hpp>

#include "free_space_command_processor.h"
#include "lane_follow_command_processor.h"
#include "nodelets/action/action_command_processor.h"
#include "nodelets/chassis/chassis_command_processor.h"
#include "nodelets/component/external_command_process_component.h"
#include "nodelets/move_base/move_base_adapter.h"
#include "nodelets/old_routing/old_routing_adapter.h"
#include "nodelets/path_follow/path_follow_command_processor.h"
#include "nodelets/zone_cover/zone_cover_command_processor.h"
#include "precise_parking_command_processor.h"
#include "speed_command_processor.h"
#include "valet_parking_command_processor.h"

PLUGINLIB_EXPORT_CLASS(external_command::ActionCommandProcessor, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(external_command::ChassisCommandProcessor, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(external_command::ExternalCommandProcessComponent, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(external_command::FreeSpaceCommandProcessor, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(external_command::LaneFollowCommandProcessor, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(external_command::MoveBaseAdapter, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(external_command::OldRoutingAdapter, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(external_command::PathFollowCommandProcessor, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(external_command::PreciseParkingCommandProcessor, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(external_command::SpeedCommandProcessor, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(external_command::ValetParkingCommandProcessor, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(external_command::ZoneCoverCommandProcessor, nodelet::Nodelet)
