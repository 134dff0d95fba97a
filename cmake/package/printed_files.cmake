# What the program prints about itself is installed as files: page of the manual, completions, schema.
set(printed ${PROJECT_BINARY_DIR}/installed)
file(MAKE_DIRECTORY ${printed}/completions)
add_custom_command(OUTPUT ${printed}/millstand.1.gz ${printed}/millstand.schema.json ${printed}/completions/millstand
                          ${printed}/completions/_millstand ${printed}/completions/millstand.fish
  COMMAND sh -c "'$<TARGET_FILE:millstand>' help --manual-page | gzip -9n >millstand.1.gz"
  COMMAND sh -c "'$<TARGET_FILE:millstand>' schema >millstand.schema.json"
  COMMAND sh -c "'$<TARGET_FILE:millstand>' completion bash >completions/millstand"
  COMMAND sh -c "'$<TARGET_FILE:millstand>' completion zsh >completions/_millstand"
  COMMAND sh -c "'$<TARGET_FILE:millstand>' completion fish >completions/millstand.fish"
  DEPENDS millstand WORKING_DIRECTORY ${printed} VERBATIM)
add_custom_target(installed_files ALL DEPENDS ${printed}/millstand.1.gz)

install(FILES ${printed}/millstand.1.gz DESTINATION share/man/man1 COMPONENT programs)
install(FILES ${printed}/millstand.schema.json DESTINATION share/millstand COMPONENT programs)
install(FILES ${printed}/completions/millstand DESTINATION share/bash-completion/completions COMPONENT programs)
install(FILES ${printed}/completions/_millstand DESTINATION share/zsh/vendor-completions COMPONENT programs)
install(FILES ${printed}/completions/millstand.fish DESTINATION share/fish/vendor_completions.d COMPONENT programs)
# The documents as a site (scripts/site), where it was made.
install(DIRECTORY ${PROJECT_BINARY_DIR}/site/ DESTINATION share/doc/millstand/html COMPONENT programs OPTIONAL)
