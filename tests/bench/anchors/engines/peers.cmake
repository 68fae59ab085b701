# The peers, each where it can be had; what is missing is said and left out.

function(plumb_peer name)
  cmake_parse_arguments(arg "" "" "LIBRARIES;INCLUDES" ${ARGN})
  string(TOUPPER ${name} upper)
  target_sources(plumb_engines PRIVATE engines/engine_${name}.cpp)
  target_compile_definitions(plumb_engines PRIVATE PLUMB_ANCHORS_${upper})
  target_include_directories(plumb_engines SYSTEM PRIVATE ${arg_INCLUDES})
  target_link_libraries(plumb_engines PRIVATE ${arg_LIBRARIES})
endfunction()

# --- Debian's Bullet, in single precision, and ODE, in double ------------------------------------
find_package(Bullet COMPONENTS BulletDynamics)
if(BULLET_FOUND)
  plumb_peer(bullet LIBRARIES ${BULLET_LIBRARIES} INCLUDES ${BULLET_INCLUDE_DIRS})
else()
  message(STATUS "Plumb: no Bullet (Debian: libbullet-dev), so it is not compared")
endif()

find_path(PLUMB_ODE_INCLUDE ode/ode.h)
find_library(PLUMB_ODE_LIBRARY ode)
if(PLUMB_ODE_INCLUDE AND PLUMB_ODE_LIBRARY)
  plumb_peer(ode LIBRARIES "${PLUMB_ODE_LIBRARY}" INCLUDES "${PLUMB_ODE_INCLUDE}")
else()
  message(STATUS "Plumb: no ODE (Debian: libode-dev), so it is not compared")
endif()

# --- MuJoCo, in double: the C library and headers out of its Python package ------------------------
include("${CMAKE_CURRENT_LIST_DIR}/mujoco.cmake")

# --- Rapier and Box3D, by cargo -------------------------------------------------------------------
if(NOT PLUMB_CARGO)
  message(STATUS "Plumb: no cargo, so Rapier and Box3D are not compared")
  return()
endif()
set(crate "${CMAKE_CURRENT_SOURCE_DIR}/engines/rapier")
set(PLUMB_CARGO_TARGET_PEERS "$ENV{HOME}/.cache/plumb/cargo-target-peers" CACHE PATH
    "Where cargo builds and keeps Rapier, shared by all builds of this user")

set(library "${CMAKE_CURRENT_BINARY_DIR}/libplumb_rapier.a")
file(GLOB crate_sources CONFIGURE_DEPENDS "${crate}/src/*.rs")
add_custom_command(
  OUTPUT "${library}"
  COMMAND "${CMAKE_COMMAND}" -E env "CARGO_TARGET_DIR=${PLUMB_CARGO_TARGET_PEERS}"
          "RUSTFLAGS=-C target-cpu=native"
          "${PLUMB_CARGO}" build --locked --release --jobs 1 --manifest-path "${crate}/Cargo.toml"
  COMMAND "${CMAKE_COMMAND}" -E copy "${PLUMB_CARGO_TARGET_PEERS}/release/libplumb_rapier.a"
          "${library}"
  DEPENDS ${crate_sources} "${crate}/Cargo.toml" "${crate}/Cargo.lock"
  COMMENT "Building Rapier with cargo (minutes at the first time)"
  USES_TERMINAL VERBATIM)
add_custom_target(plumb_rapier_cargo DEPENDS "${library}")
add_dependencies(plumb_engines plumb_rapier_cargo)
plumb_peer(rapier LIBRARIES "${library}" Threads::Threads ${CMAKE_DL_LIBS})

# The crate box3d-sys carries Box3D's C sources; cargo tells where it has put them.
execute_process(
  COMMAND "${PLUMB_CARGO}" metadata --locked --format-version 1 --features box3d-sources
          --manifest-path "${crate}/Cargo.toml"
  OUTPUT_VARIABLE metadata ERROR_VARIABLE complaint RESULT_VARIABLE failed)
if(NOT failed AND metadata MATCHES "\"manifest_path\":\"([^\"]*/box3d-sys-[^\"/]*)/Cargo.toml\"")
  set(box3d "${CMAKE_MATCH_1}/vendor/box3d")
  file(GLOB box3d_sources "${box3d}/src/*.c")
  add_library(plumb_peer_box3d STATIC ${box3d_sources})
  set_target_properties(plumb_peer_box3d PROPERTIES C_STANDARD 17 C_EXTENSIONS ON)
  target_include_directories(plumb_peer_box3d PUBLIC "${box3d}/include" PRIVATE "${box3d}/src")
  # As its own build does, and for this processor.
  target_compile_options(plumb_peer_box3d PRIVATE -O3 -march=native -ffp-contract=off -w)
  target_compile_definitions(plumb_peer_box3d PRIVATE NDEBUG)
  target_link_libraries(plumb_peer_box3d PUBLIC m Threads::Threads)
  plumb_peer(box3d LIBRARIES plumb_peer_box3d)
else()
  message(STATUS "Plumb: cargo did not find Box3D's sources, so it is not compared: ${complaint}")
endif()
