# mill_library(name [NUMBERS] [EXTRA sources...] [PUBLIC targets...] [PRIVATE targets...])
# The library of one folder: every source below it, mill::<name>.
# NUMBERS   compiled with -O3; everything else makes text, tables and pages and takes half the time at -O1.
# A release build joins sources to units of several files (MILLSTAND_UNITY), because half of each compile is headers;
# names in anonymous namespaces are therefore unique in a folder, which the compiler says and tests/rules keeps.
function(mill_library name)
  cmake_parse_arguments(L "NUMBERS" "" "EXCLUDE;EXTRA;PUBLIC;PRIVATE" ${ARGN})
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
    set_target_properties(mill_${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 6)
  endif()
endfunction()

function(mill_quick_to_compile target)
  if(CMAKE_BUILD_TYPE STREQUAL "Release")
    target_compile_options(${target} PRIVATE -O1)
  endif()
endfunction()

# Headers of others that most files of a kind read, parsed once for all libraries of that kind (kinds: numbers, text,
# test).  Nothing of our own is in them: a file still includes what it uses.
function(mill_precompile kind)
  file(WRITE ${PROJECT_BINARY_DIR}/precompiled_${kind}.cpp.in "// Carries the precompiled headers of this kind.\n")
  configure_file(${PROJECT_BINARY_DIR}/precompiled_${kind}.cpp.in ${PROJECT_BINARY_DIR}/precompiled_${kind}.cpp COPYONLY)
  add_library(mill_headers_${kind} OBJECT ${PROJECT_BINARY_DIR}/precompiled_${kind}.cpp)
  target_link_libraries(mill_headers_${kind} PRIVATE mill_options Eigen3::Eigen fmt::fmt nlohmann_json::nlohmann_json)
  target_precompile_headers(mill_headers_${kind} PRIVATE ${ARGN})
  if(NOT kind STREQUAL "numbers")
    mill_quick_to_compile(mill_headers_${kind})
  endif()
endfunction()

function(mill_share_headers target kind)
  if(MILLSTAND_PRECOMPILE)
    target_precompile_headers(${target} REUSE_FROM mill_headers_${kind})
  endif()
endfunction()
