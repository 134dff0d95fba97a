# libmillstand-dev: static libraries, headers and find_package(millstand) of the rooms that a program of others uses.
set(exported contact bearing bite fem meshes reduce dynamics)
list(TRANSFORM exported PREPEND mill:: OUTPUT_VARIABLE aliases)
mill_static_libraries("${aliases}" libraries)

# The opened finite elements are objects in the programs of this tree, which choose between two; here an archive.
add_library(mill_opened_finite_elements STATIC $<TARGET_OBJECTS:mill_fem_opened>)
target_link_libraries(mill_opened_finite_elements PUBLIC mill_core)
list(APPEND libraries mill_opened_finite_elements)

foreach(library ${libraries})
  string(REGEX REPLACE "^mill_" "" name ${library})
  set_target_properties(${library} PROPERTIES EXPORT_NAME ${name})
  set_property(TARGET ${library} APPEND PROPERTY INTERFACE_COMPILE_FEATURES cxx_std_17)
endforeach()
set_target_properties(mill_options PROPERTIES EXPORT_NAME options)
install(TARGETS ${libraries} mill_options EXPORT millstand-targets
        ARCHIVE DESTINATION lib/${CMAKE_LIBRARY_ARCHITECTURE} COMPONENT dev INCLUDES DESTINATION include/millstand)
install(EXPORT millstand-targets NAMESPACE mill:: DESTINATION lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/millstand COMPONENT dev)

# Vectors and matrices of Eigen are in the interfaces: both sides must align and allocate them alike.
if(MILLSTAND_NATIVE)
  set(MILLSTAND_INTERFACE_OPTIONS "-march=native")
else()
  list(TRANSFORM MILL_EIGEN_ALIGNMENT PREPEND "-D" OUTPUT_VARIABLE MILLSTAND_INTERFACE_OPTIONS)
endif()
set(config ${PROJECT_BINARY_DIR}/installed/cmake)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/millstand-config.cmake.in ${config}/millstand-config.cmake
  INSTALL_DESTINATION lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/millstand)
write_basic_package_version_file(${config}/millstand-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${config}/millstand-config.cmake ${config}/millstand-config-version.cmake
        DESTINATION lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/millstand COMPONENT dev)

foreach(room core reduce meshes fem dynamics)
  install(DIRECTORY ${room} DESTINATION include/millstand COMPONENT dev FILES_MATCHING PATTERN "*.h"
          PATTERN gmsh EXCLUDE PATTERN dealii EXCLUDE PATTERN fmu EXCLUDE PATTERN cluster EXCLUDE
          PATTERN tandem EXCLUDE PATTERN exchange EXCLUDE)
endforeach()
install(DIRECTORY docs/examples/consumer DESTINATION share/doc/libmillstand-dev/examples COMPONENT dev)
