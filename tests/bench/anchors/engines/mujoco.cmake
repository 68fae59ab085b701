# MuJoCo's wheel holds its C library and headers. It is fetched once a build tree, by pip, and only
# unpacked: no Python is run with it.
set(PLUMB_MUJOCO_VERSION 4.0.0)
set(wheel_folder "${CMAKE_CURRENT_BINARY_DIR}/mujoco-${PLUMB_MUJOCO_VERSION}")
set(mujoco_library "${wheel_folder}/mujoco/libmujoco.so.${PLUMB_MUJOCO_VERSION}")

if(NOT EXISTS "${mujoco_library}")
  find_program(PLUMB_PYTHON python3)
  set(complaint "there is no python3")
  if(PLUMB_PYTHON)
    message(STATUS "Plumb: fetching MuJoCo ${PLUMB_MUJOCO_VERSION} with pip (10 MB)")
    execute_process(
      COMMAND "${PLUMB_PYTHON}" -m pip download "mujoco-core==${PLUMB_MUJOCO_VERSION}" --no-deps
              --only-binary=:all: --disable-pip-version-check --timeout 20 --retries 1
              --dest "${wheel_folder}"
      OUTPUT_QUIET ERROR_VARIABLE complaint RESULT_VARIABLE failed)
    file(GLOB wheel "${wheel_folder}/*.whl")
    if(NOT failed AND wheel)
      file(ARCHIVE_EXTRACT INPUT "${wheel}" DESTINATION "${wheel_folder}"
           PATTERNS mujoco/include/* mujoco/libmujoco*)
    endif()
  endif()
endif()

if(EXISTS "${mujoco_library}")
  add_library(plumb_peer_mujoco SHARED IMPORTED)
  set_target_properties(plumb_peer_mujoco PROPERTIES IMPORTED_LOCATION "${mujoco_library}")
  plumb_peer(mujoco LIBRARIES plumb_peer_mujoco INCLUDES "${wheel_folder}/mujoco/include")
else()
  string(STRIP "${complaint}" complaint)
  string(REGEX REPLACE ".*\n" "" complaint "${complaint}")  # pip's last word
  message(STATUS "Plumb: no MuJoCo (pip cannot fetch mujoco-core ${PLUMB_MUJOCO_VERSION}), so it is "
                 "not compared: ${complaint}")
endif()
