# mill_embed_files(output HEADER header NAMESPACE namespace [name file]... [SOURCES files...])
# Writes a C++ source that carries files as they are, by the assembler (.incbin): names[] of {name, begin, end}, those of
# SOURCES in a list of their own with the name of the file.  Declared in the header: `named_files` and `source_files`.
function(mill_embed_files output)
  cmake_parse_arguments(E "" "HEADER;NAMESPACE" "SOURCES" ${ARGN})
  set(text "#include \"${E_HEADER}\"\n\n")
  set(named "")
  set(listed "")
  set(files "")
  set(count 0)
  set(pairs ${E_UNPARSED_ARGUMENTS})
  while(pairs)
    list(POP_FRONT pairs name file)
    mill_embed_one("${file}" "${name}" named)
  endwhile()
  foreach(file ${E_SOURCES})
    get_filename_component(name ${file} NAME)
    mill_embed_one("${file}" "${name}" listed)
  endforeach()
  string(APPEND text "\nnamespace ${E_NAMESPACE} {\n"
    "const std::vector<EmbeddedFile> &named_files()\n{\n  static const std::vector<EmbeddedFile> all{\n${named}  };\n  return all;\n}\n"
    "const std::vector<EmbeddedFile> &source_files()\n{\n  static const std::vector<EmbeddedFile> all{\n${listed}  };\n  return all;\n}\n}\n")
  file(GENERATE OUTPUT ${output} CONTENT "${text}")
  set_source_files_properties(${output} PROPERTIES GENERATED ON OBJECT_DEPENDS "${files}")
endfunction()

macro(mill_embed_one file name into)
  string(MAKE_C_IDENTIFIER "mill_embedded_${E_NAMESPACE}_${count}" symbol)
  string(APPEND text "__asm__(\".section .rodata\\n${symbol}:\\n.incbin \\\"${file}\\\"\\n${symbol}_end:\\n.byte 0\\n.previous\\n\"\n"
    "        \".global ${symbol}\\n.hidden ${symbol}\\n.global ${symbol}_end\\n.hidden ${symbol}_end\\n\");\n"
    "extern \"C\" const char ${symbol}[], ${symbol}_end[];\n")
  string(APPEND ${into} "      {\"${name}\", ${symbol}, ${symbol}_end},\n")
  if(NOT "${file}" MATCHES "[$]<")  # what is only known when building is named by the caller
    list(APPEND files "${file}")
  endif()
  math(EXPR count "${count} + 1")
endmacro()
