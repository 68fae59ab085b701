# Proves that a program links against the installed library with a copy of its headers, and that the
# change of one comment in that copy, with the tag that goes with it, makes a link error that names
# the cause.
#   cmake -DINSTALLED=... -DOTHER_HEADERS=... -DBUILD=... -DABI_TAG=... -P CheckStaleLibrary.cmake
include("${ABI_TAG}")

# Builds the program with the headers as they lie in OTHER_HEADERS.
function(build_with_other_headers)
  file(GLOB headers "${OTHER_HEADERS}/plumb/*.h")
  list(REMOVE_ITEM headers "${OTHER_HEADERS}/plumb/abi_tag.h")
  plumb_write_abi_tag("${OTHER_HEADERS}/plumb/abi_tag.h" ${headers})
  execute_process(
    COMMAND ${CMAKE_COMMAND} --build "${BUILD}" --target drop_ball_other_headers
    RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  set(result "${result}" PARENT_SCOPE)
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(GLOB installed "${INSTALLED}/plumb/*.h")
file(REMOVE_RECURSE "${OTHER_HEADERS}")
file(COPY ${installed} DESTINATION "${OTHER_HEADERS}/plumb")
build_with_other_headers()
if(NOT result EQUAL 0)
  message(FATAL_ERROR "the library's own headers do not link with it:\n${output}")
endif()

file(APPEND "${OTHER_HEADERS}/plumb/ids.h" "// Another version.\n")
build_with_other_headers()
if(result EQUAL 0)
  message(FATAL_ERROR "headers of another version link")
endif()
if(NOT output MATCHES "plumb_headers_and_library_differ_[0-9a-f]+")
  message(FATAL_ERROR "the error does not name the cause:\n${output}")
endif()
message(STATUS "refused: ${CMAKE_MATCH_0}")
