# Debian packages by CPack, one for each component; scripts/package builds what is in them.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME millstand)
set(CPACK_PACKAGE_CONTACT "millstand developers <millstand@example.org>")
# The day of the sources, so that the same sources give the same package.
execute_process(COMMAND git log -1 --format=%aD WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE MILLSTAND_DATE
                OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT MILLSTAND_DATE)
  set(MILLSTAND_DATE "Thu, 01 Jan 1970 00:00:00 +0000")
endif()
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL programs fem dev)
if(TARGET millstand-python)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_ARCHITECTURE amd64)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS OFF)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_VERBATIM_VARIABLES ON)

# mill_debian_package(component name section TITLE text DESCRIPTION text [DEPENDS text] [RECOMMENDS text])
function(mill_debian_package component name section)
  cmake_parse_arguments(P "" "TITLE;DESCRIPTION;DEPENDS;RECOMMENDS" "" ${ARGN})
  string(TOUPPER ${component} C)
  set(CPACK_DEBIAN_${C}_PACKAGE_NAME ${name} PARENT_SCOPE)
  set(CPACK_DEBIAN_${C}_PACKAGE_SECTION ${section} PARENT_SCOPE)
  set(CPACK_DEBIAN_${C}_PACKAGE_DEPENDS "${P_DEPENDS}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${C}_PACKAGE_RECOMMENDS "${P_RECOMMENDS}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${C}_DESCRIPTION "${P_TITLE}\n${P_DESCRIPTION}" PARENT_SCOPE)
  # Each package has its licence and its changes where Debian's rules want them.
  set(doc ${PROJECT_BINARY_DIR}/installed/doc/${name})
  configure_file(${PROJECT_SOURCE_DIR}/cmake/package/changelog.in ${doc}/changelog @ONLY)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/package/copyright.in ${doc}/copyright @ONLY)
  execute_process(COMMAND gzip -9nkf changelog WORKING_DIRECTORY ${doc} COMMAND_ERROR_IS_FATAL ANY)
  install(FILES ${doc}/copyright ${doc}/changelog.gz DESTINATION share/doc/${name} COMPONENT ${component})
endfunction()

mill_debian_package(programs millstand science
  TITLE "vibration of rolling-mill stands from their drawings"
  DESCRIPTION "Springs, masses, modes, chatter and forced vibration of the rolls of a mill
stand, each number with its source, error and check; records of a mill,
calibration, a twin next to the running mill, export to other programs.
What needs finite elements is in the package millstand-fem."
  DEPENDS "libopenblas0-openmp"
  RECOMMENDS "millstand-fem (= ${PROJECT_VERSION})")
mill_debian_package(fem millstand-fem science
  TITLE "finite elements of millstand"
  DESCRIPTION "The part of millstand that is linked with deal.II and Gmsh: meshes and
stiffness of rolls, bearings and housing, opened with the first mesh; and the
verification manual, which the command 'millstand verify' runs."
  DEPENDS "millstand (= ${PROJECT_VERSION})")
mill_debian_package(dev libmillstand-dev libdevel
  TITLE "libraries of millstand for programs in C++"
  DESCRIPTION "Headers and static libraries of millstand: contact of rolls, roller bearings,
roll bite, condensed rolls, springs and masses of a stand, vibration and
chatter. With find_package(millstand) of CMake."
  DEPENDS "g++, libeigen3-dev, libfmt-dev, nlohmann-json3-dev, libtbb-dev, libsuitesparse-dev, libmetis-dev, libopenblas-openmp-dev, libsundials-dev"
  RECOMMENDS "millstand-fem (= ${PROJECT_VERSION})")
if(TARGET millstand-python)
  # The module has the interface of one Python alone.
  set(Python3_EXECUTABLE ${MILLSTAND_PYTHON_PROGRAM})
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
  math(EXPR python_after "${Python3_VERSION_MINOR} + 1")
  set(python_after ${Python3_VERSION_MAJOR}.${python_after})
  mill_debian_package(python python3-millstand python
    TITLE "millstand from Python"
    DESCRIPTION "The module millstand: cases, runs, results with units, contact and bearing
models, sweeps and records, for scripts and notebooks."
    DEPENDS "millstand (= ${PROJECT_VERSION}), python3 (>= ${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR}), python3 (<< ${python_after}), python3-numpy"
    RECOMMENDS "millstand-fem (= ${PROJECT_VERSION}), python3-matplotlib")
endif()
include(CPack)
