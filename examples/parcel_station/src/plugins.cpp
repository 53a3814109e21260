// SPDX-License-Identifier: Apache-2.0
#include <pluginlib/class_list_macros.hpp>

#include "deliver_parcel_processor.h"
#include "hatch_processor.h"

PLUGINLIB_EXPORT_CLASS(parcel_station::DeliverParcelProcessor, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(parcel_station::HatchProcessor, nodelet::Nodelet)
