# SPDX-License-Identifier: Apache-2.0
# Helpers, so that each target takes a few lines. The commands of tests are run by a shell, and what catkin, rostest and
# roslaunch register leaves out the quotes that a path with spaces needs: these helpers register the same, quoted.

set(EC_WARNINGS -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor)

# ec_compile_quickly(TARGET [JOINED] [HEADERS...])
# Parsing headers takes half of a build, and templates of roscpp and actionlib most of the rest. With EC_QUICK_BUILD,
# which the scripts set, HEADERS are parsed once for all targets of a kind that name the same ones. Only what all of these
# are compiled with may be defined for that: a compiler takes it for no other. Sources of targets that are JOINED are
# compiled eight at a time, so that these share what they include: a name in an unnamed namespace must be the only one of
# its target there. Plain catkin builds do without both, and see to it that each file includes what it uses.
function(ec_compile_quickly target)
  if(NOT EC_QUICK_BUILD)
    return()
  endif()
  cmake_parse_arguments(ARG "JOINED" "" "" ${ARGN})
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${ARG_JOINED})
  set(headers ${ARG_UNPARSED_ARGUMENTS})
  if(NOT headers)
    return()
  endif()
  get_target_property(kind ${target} TYPE)
  get_target_property(is_pic ${target} POSITION_INDEPENDENT_CODE)
  string(MAKE_C_IDENTIFIER "ec_parsed_${kind}_${is_pic}${headers}" parsed)
  if(NOT TARGET ${parsed})
    if(NOT EXISTS ${CMAKE_BINARY_DIR}/${parsed}.cpp)  # else each configuration would compile it anew
      file(TOUCH ${CMAKE_BINARY_DIR}/${parsed}.cpp)
    endif()
    add_library(${parsed} OBJECT EXCLUDE_FROM_ALL ${CMAKE_BINARY_DIR}/${parsed}.cpp)
    foreach(property COMPILE_FEATURES COMPILE_OPTIONS POSITION_INDEPENDENT_CODE)
      get_target_property(value ${target} ${property})
      set_target_properties(${parsed} PROPERTIES ${property} "${value}")
    endforeach()
    target_include_directories(${parsed} SYSTEM PRIVATE
      ${EIGEN3_INCLUDE_DIRS} ${catkin_INCLUDE_DIRS} ${GTEST_INCLUDE_DIRS})
    if(kind STREQUAL EXECUTABLE)  # a test program
      target_link_libraries(${parsed} PRIVATE ${GTEST_LIBRARIES})
    endif()
    target_precompile_headers(${parsed} PRIVATE ${headers})
  endif()
  target_precompile_headers(${target} REUSE_FROM ${parsed})
endfunction()

# ec_add_library(NAME SOURCES... [PUBLIC libs...] [PRIVATE libs...] [SYSTEM include dirs...] [JOINED] [HEADERS headers...])
# A shared library with our warnings, in which every symbol must resolve; it is installed. JOINED and HEADERS: for
# ec_compile_quickly().
function(ec_add_library name)
  cmake_parse_arguments(ARG "JOINED" "" "SOURCES;PUBLIC;PRIVATE;SYSTEM;HEADERS" ${ARGN})
  add_library(${name} SHARED ${ARG_SOURCES})
  target_compile_features(${name} PUBLIC cxx_std_17)
  target_compile_options(${name} PRIVATE ${EC_WARNINGS})
  target_include_directories(${name} PUBLIC ${PROJECT_SOURCE_DIR}/include PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_include_directories(${name} SYSTEM PUBLIC ${EIGEN3_INCLUDE_DIRS} ${ARG_SYSTEM})
  target_link_libraries(${name} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE} -Wl,--no-undefined)
  if(ARG_JOINED)
    list(APPEND ARG_HEADERS JOINED)
  endif()
  ec_compile_quickly(${name} <Eigen/Core> ${ARG_HEADERS})
  install(TARGETS ${name}
    ARCHIVE DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
    LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
    RUNTIME DESTINATION ${CATKIN_GLOBAL_BIN_DESTINATION})
endfunction()

# ec_quote_python_install()
# To be called after catkin_python_setup(), whose script hands the build folder to setup.py without quotes.
function(ec_quote_python_install)
  set(script ${CMAKE_CURRENT_BINARY_DIR}/catkin_generated/python_distutils_install.sh)
  file(READ ${script} text)
  string(REPLACE "--egg-base ${CMAKE_CURRENT_BINARY_DIR}" "--egg-base \"${CMAKE_CURRENT_BINARY_DIR}\"" text "${text}")
  file(WRITE ${script} "${text}")
endfunction()

# ec_add_test(KIND NAME RESULT COMMAND words... [DEPENDENCIES targets...])
# Registers a test that writes RESULT, a JUnit file, into the folder of results.
function(ec_add_test kind name result)
  cmake_parse_arguments(ARG "" "" "COMMAND;DEPENDENCIES" ${ARGN})
  list(TRANSFORM ARG_COMMAND REPLACE "^.+$" "\"\\0\"")
  string(JOIN " " command ${ARG_COMMAND})
  catkin_run_tests_target(${kind} ${name} ${result} COMMAND "${command}" DEPENDENCIES ${ARG_DEPENDENCIES})
endfunction()

set(EC_TEST_RESULTS_DIR ${CATKIN_TEST_RESULTS_DIR}/${PROJECT_NAME})

# ec_add_test_program(NAME SOURCES... LIBRARIES libs... [HEADERS headers...])
# A program of gtest. Optimising it as what it tests is would take longer than it runs. HEADERS: for ec_compile_quickly().
function(ec_add_test_program name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBRARIES;HEADERS" ${ARGN})
  catkin_add_executable_with_gtest(${name} ${ARG_SOURCES} EXCLUDE_FROM_ALL)
  target_compile_features(${name} PRIVATE cxx_std_17)
  target_compile_options(${name} PRIVATE ${EC_WARNINGS} $<$<CONFIG:Release>:-O1>)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR}/test)
  target_link_libraries(${name} ${ARG_LIBRARIES})
  ec_compile_quickly(${name} JOINED <Eigen/Core> <gtest/gtest.h> ${ARG_HEADERS})
  add_dependencies(tests ${name})
endfunction()

# ec_add_gtest(NAME SOURCES... LIBRARIES libs... [HEADERS headers...])
# A test program that needs no ROS master. Data beside the checkout is found by EC_SHARED_DIR.
function(ec_add_gtest name)
  ec_add_test_program(${name} ${ARGN})
  target_sources(${name} PRIVATE ${PROJECT_SOURCE_DIR}/test/support/gtest_main.cpp)
  target_compile_definitions(${name} PRIVATE
    EC_SOURCE_DIR="${PROJECT_SOURCE_DIR}" EC_SHARED_DIR="${EC_SHARED_DIR}")
  ec_add_test(gtest ${name} gtest-${name}.xml DEPENDENCIES ${name}
    COMMAND $<TARGET_FILE:${name}> --gtest_output=xml:${EC_TEST_RESULTS_DIR}/gtest-${name}.xml)
endfunction()

# ec_add_unittest(NAME FILE)
# A file of Python's unittest that needs no ROS master.
function(ec_add_unittest name file)
  ec_add_test(unittest ${name} unittest-${name}.xml
    COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/scripts/lib/run_unittest.py ${CMAKE_CURRENT_SOURCE_DIR}/${file}
            ${EC_TEST_RESULTS_DIR}/unittest-${name}.xml)
endfunction()

# ec_add_rostest(FILE [ALONE] DEPENDENCIES targets...)
# A rostest file of this folder. ALONE where it measures times, or needs the whole machine: nothing runs beside it.
function(ec_add_rostest file)
  cmake_parse_arguments(ARG "ALONE" "" "DEPENDENCIES" ${ARGN})
  file(RELATIVE_PATH path ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR}/${file})
  string(REPLACE "/" "_" name ${path})
  string(REGEX REPLACE "\\.test$" ".xml" output ${name})
  find_program(EC_ROSTEST rostest)
  ec_add_test(rostest ${name} rostest-${output} DEPENDENCIES ${ARG_DEPENDENCIES}
    COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/scripts/lib/run_rostest.py ${EC_TEST_RESULTS_DIR} ${PROJECT_NAME}
            ${EC_ROSTEST} --pkgdir=${PROJECT_SOURCE_DIR} --results-filename ${output} ${CMAKE_CURRENT_SOURCE_DIR}/${file})
  if(ARG_ALONE)
    set_tests_properties(_ctest_${PROJECT_NAME}_rostest_${name} PROPERTIES RUN_SERIAL TRUE)
  endif()
endfunction()

# ec_tests_take(SECONDS KIND NAMES...)
# About how long these tests take on a small machine: the longest begin first. Rostests are named without .test.
function(ec_tests_take seconds kind)
  foreach(name ${ARGN})
    if(kind STREQUAL rostest)
      file(RELATIVE_PATH path ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR}/${name}.test)
      string(REPLACE "/" "_" name ${path})
    endif()
    set_tests_properties(_ctest_${PROJECT_NAME}_${kind}_${name} PROPERTIES COST ${seconds})
  endforeach()
endfunction()

# ec_add_launch_check(FILE)
# roslaunch's check of a launch file: it parses, and package.xml names what it starts.
function(ec_add_launch_check file)
  get_filename_component(name ${file} NAME)
  ec_add_test(roslaunch-check ${name} roslaunch-check-${name}.xml
    COMMAND ${PYTHON_EXECUTABLE} ${roslaunch_check_script} -o ${EC_TEST_RESULTS_DIR}/roslaunch-check-${name}.xml
            --use-test-depends ${file})
endfunction()
