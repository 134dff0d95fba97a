# cmake -DINPUT=FILE -DOUTPUT=FILE -DNAME=IDENTIFIER [-DHEADER=FILE -DNAMESPACE=NAME] -P embed_text.cmake
# Writes a C++ source that holds a text file as the constant NAMESPACE::IDENTIFIER, declared in HEADER.
# Without INPUT the constant is the empty string: what is not there at build time is left out at run time.
if(NOT HEADER)
  set(HEADER "report/page/embedded.h")
  set(NAMESPACE "mill::report::embedded")
endif()
set(content "")
if(INPUT)
  file(READ "${INPUT}" content)
endif()
file(WRITE "${OUTPUT}" "#include \"${HEADER}\"\n\nconst char *const ${NAMESPACE}::${NAME} = R\"embedded(${content})embedded\";\n")
