# SPDX-License-Identifier: MIT

# Builds user code, unchanged, into a shared library that `usub_routine_open` loads.
#
#   usersub_add_routine(<name> <source>... [SINGLE])
#
# The sources are C, C++ or Fortran (fixed form unless the suffix says otherwise); the languages
# have to be enabled in the project. SINGLE builds for single precision (explicit interfaces).
# STOP, exit and abort in the sources return to the driver instead of ending the program.
function(usersub_add_routine name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "SINGLE" "" "")
  if(NOT arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "usersub_add_routine(${name}) needs at least one source file")
  endif()
  add_library(${name} MODULE ${arg_UNPARSED_ARGUMENTS})
  set(precision double)
  if(arg_SINGLE)
    set(precision single)
    target_compile_definitions(${name} PRIVATE USUB_SINGLE)
  endif()
  set(field "${USERSUB_INCLUDE_DIR}/usersub/field")
  target_include_directories(${name} PRIVATE "${field}/${precision}" "${field}")
  target_link_libraries(${name} PRIVATE usersub::usersub)
  target_compile_options(
    ${name}
    PRIVATE
      -ffp-contract=off -fno-semantic-interposition
      "$<$<COMPILE_LANGUAGE:Fortran>:-cpp;-std=legacy;-fcray-pointer;-fallow-argument-mismatch;-frecursive>"
  )
  foreach(source IN LISTS arg_UNPARSED_ARGUMENTS)
    if(source MATCHES "\\.(f|for|F|FOR)$")
      set_property(
        SOURCE "${source}"
        APPEND
        PROPERTY COMPILE_OPTIONS "-ffixed-form;-ffixed-line-length-132")
    endif()
  endforeach()

  file(STRINGS "${USERSUB_INCLUDE_DIR}/usersub/wrap.txt" wrapped REGEX "^[A-Za-z_]")
  list(TRANSFORM wrapped PREPEND "LINKER:--wrap=")
  target_link_options(${name} PRIVATE "LINKER:-Bsymbolic" ${wrapped})
endfunction()
