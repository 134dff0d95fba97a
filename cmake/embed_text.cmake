# cmake -DINPUT=FILE -DOUTPUT=FILE -DNAME=IDENTIFIER -P embed.cmake
# Writes a C++ source that holds a text file as the constant mill::report::embedded::IDENTIFIER.
# Without INPUT the constant is the empty string: what is not there at build time is left out at run time.
set(content "")
if(INPUT)
  file(READ "${INPUT}" content)
endif()
file(WRITE "${OUTPUT}" "#include \"report/page/embedded.h\"\n\nconst char *const mill::report::embedded::${NAME} = R\"embedded(${content})embedded\";\n")
