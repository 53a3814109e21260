// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/geometry/core/coordinate_dimension.hpp>  // before the next, which lacks it in some releases
#include <boost/geometry/core/cs.hpp>
#include <boost/geometry/geometries/register/point.hpp>

#include "external_command/core/pose.h"

// Makes Point2d a point of Boost.Geometry's. Public headers do without.
BOOST_GEOMETRY_REGISTER_POINT_2D(external_command::Point2d, double, boost::geometry::cs::cartesian, x(), y())
