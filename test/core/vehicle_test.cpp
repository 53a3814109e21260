// SPDX-License-Identifier: Apache-2.0
#include "external_command/core/vehicle.h"

#include <gtest/gtest.h>

#include <string>

#include "external_command/core/error.h"

namespace external_command {
namespace {

TEST(Vehicle, StandsWithItsRearAxleOnThePose) {
  VehicleParams vehicle;
  vehicle.wheelbase = 3.0;
  vehicle.front_overhang = 1.0;
  vehicle.rear_overhang = 0.5;
  vehicle.width = 2.0;
  const auto corners = footprintAt(vehicle, {10, 20, M_PI / 2}, 0.0);
  const Point2d expected[] = {{11, 19.5}, {11, 24}, {9, 24}, {9, 19.5}};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR((corners[i] - expected[i]).norm(), 0.0, 1e-9) << "corner " << i;
  EXPECT_EQ(vehicle.length(), 4.5);
}

TEST(Vehicle, GrowsByTheMarginOnEverySide) {
  const VehicleParams vehicle;
  for (const double heading : {0.0, 1.0, -2.5}) {
    const auto corners = footprintAt(vehicle, {5, 6, heading}, 0.3);
    EXPECT_NEAR((corners[1] - corners[0]).norm(), vehicle.length() + 0.6, 1e-9);
    EXPECT_NEAR((corners[2] - corners[1]).norm(), vehicle.width + 0.6, 1e-9);
    EXPECT_GT(cross(corners[1] - corners[0], corners[2] - corners[1]), 0.0);
  }
}

TEST(VehicleParams, TakesItsDefaults) {
  EXPECT_NO_THROW(VehicleParams().validate());
  EXPECT_NEAR(VehicleParams().maxKappa() * VehicleParams().min_turning_radius, 1.0, 1e-12);
}

TEST(VehicleParams, NamesTheValueThatIsOutOfRange) {
  const std::pair<const char*, double VehicleParams::*> fields[] = {
      {"wheelbase", &VehicleParams::wheelbase},
      {"width", &VehicleParams::width},
      {"front_overhang", &VehicleParams::front_overhang},
      {"rear_overhang", &VehicleParams::rear_overhang},
      {"min_turning_radius", &VehicleParams::min_turning_radius},
      {"max_speed", &VehicleParams::max_speed},
      {"max_reverse_speed", &VehicleParams::max_reverse_speed},
      {"max_acceleration", &VehicleParams::max_acceleration},
      {"max_deceleration", &VehicleParams::max_deceleration},
      {"max_lateral_acceleration", &VehicleParams::max_lateral_acceleration},
      {"max_steering_rate", &VehicleParams::max_steering_rate},
  };
  for (const auto& [key, field] : fields) {
    for (const double bad : {-1.0, 1e6, std::nan(""), HUGE_VAL}) {
      VehicleParams vehicle;
      vehicle.*field = bad;
      try {
        vehicle.validate();
        ADD_FAILURE() << key << " may be " << bad;
      } catch (const InvalidParameter& error) {
        EXPECT_EQ(std::string(error.what()).find("vehicle/" + std::string(key) + " is "), 0u) << error.what();
      }
    }
  }
}

}  // namespace
}  // namespace external_command
