# The only file that knows how deal.II 9.4.1 is linked.  Debian's package exports two targets, deal.ii and deal.ii.g.
# Its macro deal_ii_setup_target() links without PUBLIC/PRIVATE keywords, knows only Debug and Release and hands
# Debian's compile flags to everything downstream; so what is needed is stated here.
find_package(deal.II 9.4.1 REQUIRED)
include(${DEAL_II_TARGET_CONFIG})
add_library(mill_dealii INTERFACE)
target_include_directories(mill_dealii SYSTEM INTERFACE ${DEAL_II_INCLUDE_DIRS})
target_compile_definitions(mill_dealii INTERFACE ${DEAL_II_USER_DEFINITIONS} $<$<CONFIG:Debug>:DEBUG>)
target_link_libraries(mill_dealii INTERFACE $<IF:$<CONFIG:Debug>,deal.ii.g,deal.ii>)
# Debian's target names 150 libraries of Trilinos beside the ten that deal.II itself asks for; the loader takes six tenths
# of a second for them in every start.
target_link_options(mill_dealii INTERFACE LINKER:--as-needed)
