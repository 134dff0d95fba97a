# mill_library(name [NUMBERS] [ACROSS] [UNIT_KB size] [EXTRA sources...] [PUBLIC targets...] [PRIVATE targets...])
# The library of one folder: every source below it, mill::<name>.
# NUMBERS   compiled with -O2; everything else makes text, tables and pages and takes half the time at -O1.
# ACROSS    joins files of different folders too: names in anonymous namespaces are then unique in the whole library.
# UNIT_KB   text of the sources of one unit at most, 100 if not said: what is worked on often takes less (mill_join).
# A release build joins sources to units of several files (MILLSTAND_UNITY), because half of each compile is headers;
# names in anonymous namespaces are therefore unique in a folder, which the compiler says and tests/rules keeps.
function(mill_library name)
  cmake_parse_arguments(L "NUMBERS;ACROSS" "UNIT_KB" "EXCLUDE;EXTRA;PUBLIC;PRIVATE" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  foreach(pattern ${L_EXCLUDE})
    list(FILTER sources EXCLUDE REGEX "${pattern}")
  endforeach()
  add_library(mill_${name} STATIC ${sources} ${L_EXTRA})
  add_library(mill::${name} ALIAS mill_${name})
  target_link_libraries(mill_${name} PUBLIC ${L_PUBLIC} PRIVATE ${L_PRIVATE} mill_options)
  if(L_NUMBERS)
    mill_share_headers(mill_${name} numbers)
  else()
    mill_quick_to_compile(mill_${name})
    mill_share_headers(mill_${name} text)
  endif()
  if(MILLSTAND_UNITY)
    if(NOT L_UNIT_KB)
      set(L_UNIT_KB 100)
    endif()
    mill_join(mill_${name} "${sources}" ${L_UNIT_KB} ${L_ACROSS})
  endif()
endfunction()

# Joins the sources of each folder, or across folders, to units of at most so many kB of text: what the files of a folder have in common
# (instances of templates, headers) is then compiled once and not in every unit.  The price is a longer wait after one
# file has changed, so a library that is worked on often says a smaller size.  Those that read JSON stand apart: its
# header takes a unit two seconds whatever it uses of it (a literal operator in it is no template and needs the whole
# parser).
function(mill_join target sources unit_kb across)
  math(EXPR most "1000 * ${unit_kb}")
  foreach(source ${sources})
    get_filename_component(folder ${source} DIRECTORY)
    file(RELATIVE_PATH unit ${PROJECT_SOURCE_DIR} ${folder})
    if(across)
      set(unit ${target})
    endif()
    mill_reads_json(${source} json)
    if(json)
      string(APPEND unit "_json")
    endif()
    string(MAKE_C_IDENTIFIER ${unit} key)
    file(SIZE ${source} bytes)
    if(NOT DEFINED number_${key})
      set(number_${key} 0)
      set(size_${key} 0)
    endif()
    math(EXPR size_${key} "${size_${key}} + ${bytes}")
    if(size_${key} GREATER most)
      math(EXPR number_${key} "${number_${key}} + 1")
      set(size_${key} ${bytes})
    endif()
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP "${unit}_${number_${key}}")
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()

# Whether a source includes the JSON library, itself or by a header of tests/support.
function(mill_reads_json source result)
  set(${result} FALSE PARENT_SCOPE)
  file(STRINGS ${source} includes REGEX "^#include ([<]nlohmann/json.hpp[>]|\"tests/support/)")
  foreach(line ${includes})
    if(line MATCHES "json.hpp")
      set(${result} TRUE PARENT_SCOPE)
    elseif(line MATCHES "\"(tests/support/[a-z_]+[.]h)\"")
      mill_reads_json(${PROJECT_SOURCE_DIR}/${CMAKE_MATCH_1} it_does)
      if(it_does)
        set(${result} TRUE PARENT_SCOPE)
      endif()
    endif()
  endforeach()
endfunction()

# The Python module is a shared library of the same objects that the programs have.  clang, which compiles for an
# executable at any address, makes objects that a module can take, but for variables of a thread: a source with those
# is compiled for a library, without the precompiled headers of the others.  g++ compiles everything so (MILLSTAND_PYTHON).
function(mill_thread_variables)
  set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS -fPIC SKIP_PRECOMPILE_HEADERS ON SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

function(mill_quick_to_compile target)
  if(CMAKE_BUILD_TYPE STREQUAL "Release")
    # clang's -O1 inlines what g++'s does not, and takes half as long again for nothing that text would gain from.
    target_compile_options(${target} PRIVATE -O1 $<$<CXX_COMPILER_ID:Clang>:SHELL:-mllvm -inline-threshold=10>)
  endif()
endfunction()

# What runs once and briefly: clang takes 0.4 of the time without optimising, g++ hardly less than with -O1.
function(mill_not_optimised target)
  if(CMAKE_BUILD_TYPE STREQUAL "Release" AND CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    target_compile_options(${target} PRIVATE -O0)
  else()
    mill_quick_to_compile(${target})
  endif()
endfunction()

# Headers of others that most files of a kind read, parsed once for all libraries of that kind (kinds: numbers, text,
# test).  Of our own only the list of what is compiled once is in them
# (core/numerics/eigen_instances.h): a file still includes what it uses.
# mill_precompile(kind HEADERS headers... [LINK targets whose definitions the users share])
function(mill_precompile kind)
  cmake_parse_arguments(P "" "" "HEADERS;LINK" ${ARGN})
  file(WRITE ${PROJECT_BINARY_DIR}/precompiled_${kind}.cpp.in "// Carries the precompiled headers of this kind.\n")
  configure_file(${PROJECT_BINARY_DIR}/precompiled_${kind}.cpp.in ${PROJECT_BINARY_DIR}/precompiled_${kind}.cpp COPYONLY)
  add_library(mill_headers_${kind} OBJECT ${PROJECT_BINARY_DIR}/precompiled_${kind}.cpp)
  target_link_libraries(mill_headers_${kind} PRIVATE mill_options Eigen3::Eigen fmt::fmt nlohmann_json::nlohmann_json ${P_LINK})
  target_precompile_headers(mill_headers_${kind} PRIVATE ${P_HEADERS})
  if(kind STREQUAL "test")
    mill_not_optimised(mill_headers_${kind})
  elseif(NOT kind STREQUAL "numbers")
    mill_quick_to_compile(mill_headers_${kind})
  endif()
endfunction()

function(mill_share_headers target kind)
  if(MILLSTAND_PRECOMPILE)
    target_precompile_headers(${target} REUSE_FROM mill_headers_${kind})
  endif()
endfunction()
