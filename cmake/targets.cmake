# SPDX-License-Identifier: Apache-2.0
# Two helpers, so that each target takes a few lines.

set(EC_WARNINGS -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor)

# ec_add_library(NAME SOURCES... [PUBLIC libs...] [PRIVATE libs...] [SYSTEM include dirs...])
# A shared library with our warnings, in which every symbol must resolve; it is installed.
function(ec_add_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE;SYSTEM" ${ARGN})
  add_library(${name} SHARED ${ARG_SOURCES})
  target_compile_features(${name} PUBLIC cxx_std_17)
  target_compile_options(${name} PRIVATE ${EC_WARNINGS})
  target_include_directories(${name} PUBLIC ${PROJECT_SOURCE_DIR}/include)
  target_include_directories(${name} SYSTEM PUBLIC ${EIGEN3_INCLUDE_DIRS} ${ARG_SYSTEM})
  target_link_libraries(${name} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE} -Wl,--no-undefined)
  install(TARGETS ${name}
    ARCHIVE DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
    LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
    RUNTIME DESTINATION ${CATKIN_GLOBAL_BIN_DESTINATION})
endfunction()

# ec_add_gtest(NAME SOURCES... LIBRARIES libs...)
# A gtest without a ROS master. Data beside the checkout is found by EC_SHARED_DIR.
function(ec_add_gtest name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBRARIES" ${ARGN})
  catkin_add_gtest(${name} ${ARG_SOURCES} ${PROJECT_SOURCE_DIR}/test/support/gtest_main.cpp)
  target_compile_features(${name} PRIVATE cxx_std_17)
  target_compile_options(${name} PRIVATE ${EC_WARNINGS})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/test)
  target_compile_definitions(${name} PRIVATE
    EC_SOURCE_DIR="${PROJECT_SOURCE_DIR}" EC_SHARED_DIR="${EC_SHARED_DIR}")
  target_link_libraries(${name} ${ARG_LIBRARIES})
endfunction()

# ec_add_unittest(NAME FILE)
# A file of Python's unittest that needs no ROS master.
function(ec_add_unittest name file)
  set(result unittest-${name}.xml)
  set(runner ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/scripts/lib/run_unittest.py)
  string(REPLACE ";" " " command
    "${runner};${CMAKE_CURRENT_SOURCE_DIR}/${file};${CATKIN_TEST_RESULTS_DIR}/${PROJECT_NAME}/${result}")
  catkin_run_tests_target("unittest" ${name} ${result} COMMAND "${command}")
endfunction()
