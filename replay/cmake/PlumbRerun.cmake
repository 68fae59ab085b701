# plumb_rerun: the Rust crate in rerun/ as one static library.
#
# Cargo builds it once (about ten minutes of CPU for the SDK's 420 crates) into a folder outside the
# source and build trees, so that a clean C++ build does not pay for it again.
if(DEFINED ENV{XDG_CACHE_HOME} AND NOT "$ENV{XDG_CACHE_HOME}" STREQUAL "")
  set(plumb_cache "$ENV{XDG_CACHE_HOME}")
else()
  set(plumb_cache "$ENV{HOME}/.cache")
endif()
set(PLUMB_CARGO_TARGET "${plumb_cache}/plumb/cargo-target" CACHE PATH
    "Where cargo builds and keeps the Rerun SDK, shared by all builds of this user")

set(crate "${CMAKE_CURRENT_SOURCE_DIR}/rerun")
# A copy of one's own, because another checkout may put its version in the shared place.
set(library "${CMAKE_CURRENT_BINARY_DIR}/libplumb_rerun.a")
file(GLOB crate_sources CONFIGURE_DEPENDS "${crate}/src/*.rs")

add_custom_command(
  OUTPUT "${library}"
  COMMAND "${CMAKE_COMMAND}" -E env "CARGO_TARGET_DIR=${PLUMB_CARGO_TARGET}"
          "${PLUMB_CARGO}" rustc --locked --release --lib --crate-type staticlib
          --manifest-path "${crate}/Cargo.toml"
  COMMAND "${CMAKE_COMMAND}" -E copy "${PLUMB_CARGO_TARGET}/release/libplumb_rerun.a" "${library}"
  DEPENDS ${crate_sources} "${crate}/Cargo.toml" "${crate}/Cargo.lock"
  COMMENT "Building the Rerun SDK with cargo (minutes at the first time)"
  USES_TERMINAL VERBATIM)
add_custom_target(plumb_rerun_cargo DEPENDS "${library}")

add_library(plumb_rerun STATIC IMPORTED GLOBAL)
# Unused functions of the SDK are most of it: --gc-sections leaves them out of the program.
set_target_properties(plumb_rerun PROPERTIES
  IMPORTED_LOCATION "${library}"
  INTERFACE_LINK_LIBRARIES "Threads::Threads;${CMAKE_DL_LIBS};m"
  INTERFACE_LINK_OPTIONS "-Wl,--gc-sections")
add_dependencies(plumb_rerun plumb_rerun_cargo)
