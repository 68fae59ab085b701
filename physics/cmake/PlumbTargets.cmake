# Helpers that every folder's CMakeLists.txt uses.

# The warnings all of Plumb's own code is clean of. Linked privately and only while building, so
# that no user inherits them.
add_library(plumb_warnings INTERFACE)
target_compile_options(plumb_warnings INTERFACE
  -Wall -Wextra -Wconversion -Wshadow $<$<BOOL:${PLUMB_WERROR}>:-Werror>
  # GCC 12 warns falsely about "text" + std::string (its bug 105651).
  $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict>)
if(PLUMB_SANITIZE AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # GCC's own advice: under a sanitizer it warns of what cannot happen.
  target_compile_options(plumb_warnings INTERFACE -Wno-maybe-uninitialized -Wno-error)
endif()

# The sources of a folder, found by name; new files are picked up by the next build.
function(plumb_glob out)
  file(GLOB_RECURSE found CONFIGURE_DEPENDS LIST_DIRECTORIES false ${ARGN})
  set(${out} ${found} PARENT_SCOPE)
endfunction()

# Reads the named system headers once for all files of a target: Eigen's are most of what a file
# costs to compile. Every file still includes what it uses; the preset `clang` builds without.
function(plumb_precompile target)
  foreach(header IN LISTS ARGN)
    target_precompile_headers(${target} PRIVATE
                              "$<$<COMPILE_LANGUAGE:CXX>:<${header}$<ANGLE-R>>")
  endforeach()
  # What ccache needs to see through a precompiled header.
  target_compile_options(${target} PRIVATE
    $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>
    $<$<CXX_COMPILER_ID:Clang>:SHELL:-Xclang -fno-pch-timestamp>)
endfunction()

# A library of Plumb: plumb_<name>, known as plumb::<name> here and in the installed package.
# Without sources yet it is an interface library, so that the rest still configures.
#   plumb_library(<name> COMPONENT <folder> SOURCES ...)
function(plumb_library name)
  cmake_parse_arguments(arg "" "COMPONENT" "SOURCES" ${ARGN})
  set(target plumb_${name})
  if(arg_SOURCES)
    add_library(${target} STATIC ${arg_SOURCES})
    set(scope PUBLIC)
    target_compile_features(${target} PUBLIC cxx_std_20)
    target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:plumb_warnings>)
    target_include_directories(${target} PRIVATE "${PROJECT_SOURCE_DIR}/${arg_COMPONENT}/src")
    plumb_precompile(${target} Eigen/Core Eigen/Geometry algorithm cmath functional memory optional
                     span string variant vector)
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  add_library(plumb::${name} ALIAS ${target})
  target_include_directories(${target} ${scope}
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/${arg_COMPONENT}/include>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  install(TARGETS ${target} EXPORT plumb_${arg_COMPONENT} COMPONENT ${arg_COMPONENT}
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  set_property(GLOBAL APPEND PROPERTY PLUMB_INSTALLED_COMPONENTS ${arg_COMPONENT})
endfunction()
