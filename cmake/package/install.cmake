# What an installation has, by component; a component is a package (packages.cmake).
#   programs  millstand and what it hands over to, cases, page of the manual, completions, schema, documents
#   fem       the opened library of finite elements and the verification manual, which is linked with deal.II
#   dev       headers, static libraries, find_package(millstand)
#   python    the module, where it is built
include(CMakePackageConfigHelpers)
set(own_folder lib/millstand)  # of the programs: each finds the others in its own folder

if(TARGET millstand)
  install(TARGETS millstand millstand-all millstand-study RUNTIME DESTINATION ${own_folder} COMPONENT programs)
  install(TARGETS millstand-verify RUNTIME DESTINATION ${own_folder} COMPONENT fem)
  install(TARGETS millstand-fem LIBRARY DESTINATION ${own_folder} COMPONENT fem)
  if(MILLSTAND_V3)
    install(TARGETS millstand-fem-v3 LIBRARY DESTINATION ${own_folder}/glibc-hwcaps/x86-64-v3 COMPONENT fem)
  endif()
  # The link on the path; the loader and the program follow it to their folder.
  set(link ${PROJECT_BINARY_DIR}/installed/bin/millstand)
  file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/installed/bin)
  file(CREATE_LINK ../${own_folder}/millstand ${link} SYMBOLIC)
  install(FILES ${link} DESTINATION bin COMPONENT programs)

  install(DIRECTORY cases/ DESTINATION share/millstand/cases COMPONENT programs
          PATTERN make_records.cpp EXCLUDE PATTERN CMakeLists.txt EXCLUDE)
  include(${CMAKE_CURRENT_LIST_DIR}/printed_files.cmake)
  include(${CMAKE_CURRENT_LIST_DIR}/library.cmake)
endif()
include(${CMAKE_CURRENT_LIST_DIR}/packages.cmake)
