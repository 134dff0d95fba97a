# Readers of foreign text, one target each: programs of libFuzzer (CMakeLists.txt, preset fuzz), and the suite's test that
# every input of corpus/ is read (tests/unit/readers).  Only libraries that need neither deal.II nor Gmsh.

# mill_reader(name source [SOURCES more..] [LINK libraries..] [DEFINE definitions..])
function(mill_reader name source)
  cmake_parse_arguments(R "" "" "SOURCES;LINK;DEFINE" ${ARGN})
  set(mill_readers ${mill_readers} ${name} PARENT_SCOPE)
  set(source_of_${name} ${PROJECT_SOURCE_DIR}/tests/fuzz/${source}.cpp PARENT_SCOPE)
  foreach(kind SOURCES LINK DEFINE)
    set(${kind}_of_${name} ${R_${kind}} PARENT_SCOPE)
  endforeach()
endfunction()

find_package(SQLite3 REQUIRED)
find_package(ZLIB REQUIRED)
find_package(Threads REQUIRED)
set(store ${PROJECT_SOURCE_DIR}/app/study/store)

mill_reader(case case_target LINK mill::core)
mill_reader(edit edit_target LINK mill::core)
mill_reader(quantity quantity_target LINK mill::core mill::records)
mill_reader(sheet sheet_target LINK mill::core)
mill_reader(catalogue catalogue_target LINK mill::core)
foreach(format csv npy npz uff mat wav lvm)
  mill_reader(${format} record_target LINK mill::records DEFINE MILL_FORMAT=${format} MILL_READER=read_${format}_record)
endforeach()
mill_reader(time_zone time_zone_target LINK mill::records)
mill_reader(cache cache_target LINK mill::core)
mill_reader(run run_target LINK mill::report)
mill_reader(model_files model_files_target LINK mill::core)
mill_reader(unit_model unit_model_target LINK mill::fmu)
mill_reader(unit_state unit_state_target LINK mill::fmu DEFINE MILL_UNIT_FOLDER="${PROJECT_SOURCE_DIR}/tests/fuzz/unit/")
mill_reader(line line_target LINK mill::live)
mill_reader(live_state live_state_target LINK mill::live nlohmann_json::nlohmann_json)
mill_reader(command command_target LINK mill::live)
mill_reader(request request_target LINK mill::web Threads::Threads)
mill_reader(study_rows study_rows_target SOURCES ${store}/database.cpp ${store}/row_files.cpp
  LINK mill::core SQLite::SQLite3 ZLIB::ZLIB)

# mill_readers_source(result): a source with all readers as functions, read_<name>_input, and the list of them,
# all_readers() of readers.h.  Each stands in a namespace of its own, its headers before (as tests are joined, mill_test).
function(mill_readers_source result)
  set(headers "")
  set(bodies "")
  set(list "")
  foreach(name ${mill_readers})
    file(STRINGS ${source_of_${name}} includes REGEX "^#include")
    string(REPLACE ";" "\n" includes "${includes}")
    string(APPEND headers "${includes}\n")
    string(APPEND bodies "namespace in_${name}_target {\n#define LLVMFuzzerTestOneInput read_${name}_input\n")
    set(undone "#undef LLVMFuzzerTestOneInput\n")
    foreach(definition ${DEFINE_of_${name}})
      string(REGEX REPLACE "^([A-Z_]+)=(.*)$" "#define \\1 \\2\n" line "${definition}")
      string(REGEX REPLACE "=.*" "" macro "${definition}")
      string(APPEND bodies "${line}")
      string(APPEND undone "#undef ${macro}\n")
    endforeach()
    string(APPEND bodies "#include \"${source_of_${name}}\"\n${undone}}\n")
    string(APPEND list "    {\"${name}\", in_${name}_target::read_${name}_input},\n")
  endforeach()
  set(${result} ${PROJECT_BINARY_DIR}/tests/joined/readers.cpp)
  file(GENERATE OUTPUT ${${result}} CONTENT "#include \"tests/fuzz/readers.h\"\n${headers}${bodies}
const std::vector<Reader> &all_readers()
{
  static const std::vector<Reader> all = {
${list}  };
  return all;
}
")
  set(${result} ${${result}} PARENT_SCOPE)
endfunction()
