# Everything a user of the build can choose, and the compiler settings that hold for all targets.
include(GNUInstallDirs)

set(PLUMB_PRECISION f32 CACHE STRING "What plumb::physics is: f32, f32d (double positions) or f64")
set_property(CACHE PLUMB_PRECISION PROPERTY STRINGS f32 f32d f64)
# All three live side by side in one program; a build that needs fewer, such as one under a
# sanitizer, names them.
set(PLUMB_ALL_PRECISIONS "f32;f32d;f64" CACHE STRING "Which precisions are built and tested")
foreach(precision IN LISTS PLUMB_ALL_PRECISIONS)
  if(NOT precision MATCHES "^(f32|f32d|f64)$")
    message(FATAL_ERROR "PLUMB_ALL_PRECISIONS names '${precision}'. There are f32, f32d and f64.")
  endif()
endforeach()
if(NOT PLUMB_PRECISION IN_LIST PLUMB_ALL_PRECISIONS)
  message(FATAL_ERROR
    "PLUMB_PRECISION is '${PLUMB_PRECISION}'. Give one of: ${PLUMB_ALL_PRECISIONS}.")
endif()

# The recorder is built on the Rerun SDK, which is written in Rust.
find_program(PLUMB_CARGO cargo HINTS "$ENV{HOME}/.cargo/bin" DOC "Rust's cargo, for replay")
if(PLUMB_CARGO)
  set(plumb_replay_default ON)
else()
  set(plumb_replay_default OFF)
endif()
option(PLUMB_REPLAY "Build replay, the Rerun recorder (needs cargo)" ${plumb_replay_default})
if(PLUMB_REPLAY AND NOT PLUMB_CARGO)
  message(FATAL_ERROR
    "PLUMB_REPLAY is ON, but no cargo was found. Install Rust (./build.sh does) or set it to OFF.")
endif()
if(NOT PLUMB_REPLAY)
  message(STATUS "Plumb: replay is off, so nothing can be recorded (no cargo, or PLUMB_REPLAY=OFF)")
endif()

option(PLUMB_TESTS "Build the tests" ${PROJECT_IS_TOP_LEVEL})
option(PLUMB_BENCHMARKS "Build the benchmarks in tests/bench (needs Google Benchmark)" OFF)
option(PLUMB_PEERS "Benchmark other engines beside Plumb where they can be had (tests/bench)" OFF)
option(PLUMB_WERROR "Treat warnings as errors" OFF)
set(PLUMB_SANITIZE "" CACHE STRING "Sanitizers for all targets: address,undefined or thread")

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)

if(PROJECT_IS_TOP_LEVEL)
  if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
    set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
  endif()
  set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

  # A compiler cache makes a second build of the same text cheap, also from another checkout: paths
  # are taken relative to the source tree. Precompiled headers need the sloppiness.
  find_program(PLUMB_CCACHE ccache)
  if(PLUMB_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    set(CMAKE_CXX_COMPILER_LAUNCHER env
        "CCACHE_BASEDIR=${PROJECT_SOURCE_DIR}" CCACHE_NOHASHDIR=1
        CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime
        "${PLUMB_CCACHE}")
  endif()
endif()

if(PLUMB_SANITIZE)
  add_compile_options(-fsanitize=${PLUMB_SANITIZE} -fno-sanitize-recover=all
                      -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${PLUMB_SANITIZE})
endif()

find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(Threads REQUIRED)
