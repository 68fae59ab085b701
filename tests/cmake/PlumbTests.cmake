# Hang guard for one test case, far above what any takes; no test passes or fails by its speed.
set(PLUMB_TEST_TIMEOUT 900)  # [s]

# One Google Test program from tests/<FOLDER> (one or more), and one ctest entry per test case in it.
#   plumb_test_program(<target> FOLDER f... [READS_TREE] [PREFIX p] [LIBRARIES ...] [INCLUDES ...])
# READS_TREE: the tests read files of this source tree, found below PLUMB_SOURCE_DIR. The others know
# no absolute path, so that the compiler cache serves any checkout.
function(plumb_test_program target)
  cmake_parse_arguments(arg "READS_TREE" "PREFIX" "FOLDER;LIBRARIES;INCLUDES" ${ARGN})
  list(TRANSFORM arg_FOLDER APPEND /*.cpp OUTPUT_VARIABLE cpp_files)
  list(TRANSFORM arg_FOLDER APPEND /*.c OUTPUT_VARIABLE c_files)
  plumb_glob(sources ${cpp_files} ${c_files})
  if(NOT sources)
    return()
  endif()
  add_executable(${target} ${sources})
  target_include_directories(${target} PRIVATE "${CMAKE_CURRENT_SOURCE_DIR}" ${arg_INCLUDES})
  target_link_libraries(${target} PRIVATE ${arg_LIBRARIES} GTest::gtest GTest::gtest_main
                                          plumb_warnings)
  if(arg_READS_TREE)
    target_compile_definitions(${target} PRIVATE PLUMB_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  endif()
  set(headers gtest/gtest.h cmath string vector)
  if(arg_LIBRARIES)
    list(APPEND headers Eigen/Core Eigen/Geometry)
  endif()
  plumb_precompile(${target} ${headers})
  gtest_discover_tests(${target} TEST_PREFIX "${arg_PREFIX}" DISCOVERY_MODE PRE_TEST
                       DISCOVERY_TIMEOUT 120 PROPERTIES TIMEOUT ${PLUMB_TEST_TIMEOUT})
endfunction()
