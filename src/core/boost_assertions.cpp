// SPDX-License-Identifier: Apache-2.0
// What Boost's assertions do in the sources that are compiled with BOOST_ENABLE_ASSERT_HANDLER and
// BOOST_GEOMETRY_ENABLE_ASSERT_HANDLER: Boost.Geometry's overlays and buffers find now and then that they have gone
// wrong, by shapes that are legal. That ends the command, in builds of every kind, not the process; nor does it go on
// with broken indices, as it would without assertions.
#ifndef BOOST_ENABLE_ASSERT_HANDLER
#define BOOST_ENABLE_ASSERT_HANDLER
#endif
#ifndef BOOST_GEOMETRY_ENABLE_ASSERT_HANDLER
#define BOOST_GEOMETRY_ENABLE_ASSERT_HANDLER
#endif
#include <boost/assert.hpp>
#include <boost/geometry/core/assert.hpp>

#include "external_command/core/error.h"
#include "external_command/core/text.h"

namespace {

[[noreturn]] void fail(const char* condition, const char* file, long line) {
  throw external_command::InternalError(external_command::text("Boost.Geometry went wrong with a shape: ", condition,
                                                               " does not hold in ", file, ":", line));
}

}  // namespace

namespace boost {

void assertion_failed(const char* condition, const char* /*function*/, const char* file, long line) {
  fail(condition, file, line);
}

void assertion_failed_msg(const char* condition, const char* /*message*/, const char* /*function*/, const char* file,
                          long line) {
  fail(condition, file, line);
}

namespace geometry {

void assertion_failed(const char* condition, const char* /*function*/, const char* file, long line) {
  fail(condition, file, line);
}

void assertion_failed_msg(const char* condition, const char* /*message*/, const char* /*function*/, const char* file,
                          long line) {
  fail(condition, file, line);
}

}  // namespace geometry
}  // namespace boost
