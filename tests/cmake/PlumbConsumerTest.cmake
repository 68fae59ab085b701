# Proves that the installed package is usable: installs into a fresh prefix, then configures, builds
# and runs tests/consumer, a project of its own that knows only find_package(plumb).
set(consumer_dir "${CMAKE_CURRENT_BINARY_DIR}/consumer")
set(consumer_prefix "${consumer_dir}/prefix")

get_property(consumer_components GLOBAL PROPERTY PLUMB_INSTALLED_COMPONENTS)
list(REMOVE_DUPLICATES consumer_components)

add_test(NAME consumer.clean COMMAND ${CMAKE_COMMAND} -E rm -rf "${consumer_dir}")
add_test(NAME consumer.install
  COMMAND ${CMAKE_COMMAND} --install "${PROJECT_BINARY_DIR}" --prefix "${consumer_prefix}")
add_test(NAME consumer.configure
  COMMAND ${CMAKE_COMMAND} -S "${CMAKE_CURRENT_SOURCE_DIR}/consumer" -B "${consumer_dir}/build"
          -G "${CMAKE_GENERATOR}"
          "-DCMAKE_PREFIX_PATH=${consumer_prefix}"
          "-DCMAKE_BUILD_TYPE=${CMAKE_BUILD_TYPE}"
          "-DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}"
          "-DCMAKE_EXE_LINKER_FLAGS=${CMAKE_EXE_LINKER_FLAGS}"
          "-DPRECISIONS=${PLUMB_ALL_PRECISIONS}"
          "-DOTHER_HEADERS=${consumer_dir}/other_headers"
          "-DSANITIZE=${PLUMB_SANITIZE}"
          "-DCOMPONENTS=${consumer_components}")
add_test(NAME consumer.build COMMAND ${CMAKE_COMMAND} --build "${consumer_dir}/build")

set_tests_properties(consumer.clean PROPERTIES FIXTURES_SETUP consumer_clean)
set_tests_properties(consumer.install PROPERTIES
  FIXTURES_REQUIRED consumer_clean FIXTURES_SETUP consumer_installed)
set_tests_properties(consumer.configure PROPERTIES
  FIXTURES_REQUIRED consumer_installed FIXTURES_SETUP consumer_configured)
set_tests_properties(consumer.build PROPERTIES
  FIXTURES_REQUIRED consumer_configured FIXTURES_SETUP consumer_built)

set(consumer_programs drop_ball all_components)
foreach(precision IN LISTS PLUMB_ALL_PRECISIONS)
  list(APPEND consumer_programs drop_ball_${precision})
endforeach()
foreach(program IN LISTS consumer_programs)
  add_test(NAME consumer.${program} COMMAND "${consumer_dir}/build/${program}")
  set_tests_properties(consumer.${program} PROPERTIES FIXTURES_REQUIRED consumer_built)
endforeach()

add_test(NAME consumer.stale_library_does_not_link
  COMMAND ${CMAKE_COMMAND} "-DINSTALLED=${consumer_prefix}/${CMAKE_INSTALL_INCLUDEDIR}"
          "-DOTHER_HEADERS=${consumer_dir}/other_headers" "-DBUILD=${consumer_dir}/build"
          "-DABI_TAG=${PROJECT_SOURCE_DIR}/physics/cmake/PlumbAbiTag.cmake"
          -P "${CMAKE_CURRENT_SOURCE_DIR}/cmake/CheckStaleLibrary.cmake")
set_tests_properties(consumer.stale_library_does_not_link PROPERTIES
  FIXTURES_REQUIRED consumer_built)
