# crevice_add_plugin(name sources…): a shared library of stages, libNAME.so, for `crevice --plugin`.
function(crevice_add_plugin name)
  add_library(${name} MODULE ${ARGN})
  target_link_libraries(${name} PRIVATE Crevice::crevice)
  set_target_properties(${name} PROPERTIES PREFIX "lib" CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  # A program refuses plugins of another build type; without one of its own, the plugin takes the program's.
  if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES AND NOT Crevice_BUILD_TYPE STREQUAL "Debug")
    target_compile_options(${name} PRIVATE -O2 -DNDEBUG)
  endif()
endfunction()
