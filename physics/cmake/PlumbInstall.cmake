# Installs headers and the package description: find_package(plumb COMPONENTS physics assets ...).
include(CMakePackageConfigHelpers)

get_property(plumb_components GLOBAL PROPERTY PLUMB_INSTALLED_COMPONENTS)
list(REMOVE_DUPLICATES plumb_components)
set(plumb_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/plumb)

foreach(component IN LISTS plumb_components)
  if(EXISTS "${PROJECT_SOURCE_DIR}/${component}/include")
    install(DIRECTORY "${PROJECT_SOURCE_DIR}/${component}/include/"
            DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT ${component}
            FILES_MATCHING PATTERN "*.h")
  endif()
  install(EXPORT plumb_${component} NAMESPACE plumb:: FILE plumb-${component}.cmake
          DESTINATION ${plumb_package_dir} COMPONENT ${component})
endforeach()

configure_package_config_file(
  "${CMAKE_CURRENT_LIST_DIR}/plumbConfig.cmake.in" "${PROJECT_BINARY_DIR}/plumbConfig.cmake"
  INSTALL_DESTINATION ${plumb_package_dir} PATH_VARS CMAKE_INSTALL_LIBDIR)
write_basic_package_version_file(
  "${PROJECT_BINARY_DIR}/plumbConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/plumbConfig.cmake"
              "${PROJECT_BINARY_DIR}/plumbConfigVersion.cmake"
        DESTINATION ${plumb_package_dir} COMPONENT physics)
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION ${CMAKE_INSTALL_DOCDIR}
        COMPONENT physics)
