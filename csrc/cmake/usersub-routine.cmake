# SPDX-License-Identifier: MIT

# The caller of the function may be in another scope than find_package(usersub).
set_property(GLOBAL PROPERTY USERSUB_INCLUDE_DIR "${USERSUB_INCLUDE_DIR}")

# Builds user code, unchanged, into a shared library that `usub_routine_open` loads.
#
#   usersub_add_routine(<name> <source>... [SINGLE])
#
# The sources are C, C++ or Fortran (fixed form unless the suffix says otherwise); the languages
# have to be enabled in the project. A Fortran file that uses a module may stand beside the module's
# file. SINGLE builds for single precision (explicit interfaces). Include folders and further
# options are added to the target <name> as usual. STOP, exit and abort in the sources return to the
# driver instead of ending the program. A C law that defines USUB_LAW_DUAL is compiled once more, as
# C++, for its derivatives.
function(usersub_add_routine name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "SINGLE" "" "")
  set(sources ${arg_UNPARSED_ARGUMENTS})
  if(NOT sources)
    message(FATAL_ERROR "usersub_add_routine(${name}) needs at least one source file")
  endif()
  usersub_check_languages(${name} ${sources})
  set(readings "")
  if(NOT arg_SINGLE)
    usersub_second_readings(readings ${name} ${sources})
  endif()
  add_library(${name} MODULE ${sources} ${readings})
  if(readings AND NOT sources MATCHES "\\.(cpp|cc|cxx|c\\+\\+)(;|$)")
    # They need nothing of the C++ library.
    usersub_link_language(language ${sources})
    set_target_properties(${name} PROPERTIES LINKER_LANGUAGE ${language})
  endif()
  set(precision double)
  if(arg_SINGLE)
    set(precision single)
    target_compile_definitions(${name} PRIVATE USUB_SINGLE)
  endif()
  get_property(include_dir GLOBAL PROPERTY USERSUB_INCLUDE_DIR)
  set(field "${include_dir}/usersub/field")
  target_include_directories(${name} PRIVATE "${field}/${precision}" "${field}")
  target_link_libraries(${name} PRIVATE usersub::usersub)
  # Two users' files may each have a module of the same name.
  set_target_properties(
    ${name} PROPERTIES Fortran_MODULE_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}/${name}_modules"
                       Fortran_PREPROCESS ON)
  target_compile_options(
    ${name}
    PRIVATE
      -ffp-contract=off
      -fno-semantic-interposition
      "$<$<CONFIG:>:-O2>"
      "$<$<COMPILE_LANG_AND_ID:Fortran,GNU>:-cpp;-std=legacy;-fcray-pointer;-frecursive>"
      "$<$<COMPILE_LANG_AND_ID:Fortran,GNU>:-fallow-argument-mismatch;-fallow-invalid-boz>"
      "$<$<COMPILE_LANG_AND_ID:Fortran,GNU>:-fdollar-ok;-ffree-line-length-none>")
  foreach(source IN LISTS sources)
    if(source MATCHES "\\.(f|for|F|FOR)$")
      set_property(SOURCE "${source}" PROPERTY Fortran_FORMAT FIXED)
      set_property(
        SOURCE "${source}"
        APPEND
        PROPERTY COMPILE_OPTIONS
                 "$<$<COMPILE_LANG_AND_ID:Fortran,GNU>:-ffixed-line-length-132>")
    endif()
  endforeach()

  file(STRINGS "${include_dir}/usersub/wrap.txt" wrapped REGEX "^[A-Za-z_]")
  list(TRANSFORM wrapped PREPEND "LINKER:--wrap=")
  # The library of gfortran is needed even if all that is called of it is wrapped.
  target_link_options(
    ${name} PRIVATE "LINKER:-Bsymbolic" ${wrapped}
    "$<$<LINK_LANGUAGE:Fortran>:LINKER:--no-as-needed>")
endfunction()

# In `result` the files that read laws which define USUB_LAW_DUAL a second time.
function(usersub_second_readings result name)
  set(made "")
  foreach(source IN LISTS ARGN)
    get_filename_component(path "${source}" ABSOLUTE)
    if(NOT source MATCHES "\\.(c|cpp|cc|cxx|c\\+\\+)$" OR NOT EXISTS "${path}")
      continue()
    endif()
    # The line may come and go.
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${path}")
    file(STRINGS "${path}" found REGEX "^[ \t]*#[ \t]*define[ \t]+USUB_LAW_DUAL" LIMIT_COUNT 1)
    if(NOT found)
      continue()
    endif()
    get_property(enabled GLOBAL PROPERTY ENABLED_LANGUAGES)
    if(NOT "CXX" IN_LIST enabled)
      message(
        FATAL_ERROR "usersub_add_routine(${name}): ${source} defines USUB_LAW_DUAL, so its "
                    "derivatives need the language CXX; write enable_language(CXX) before, or name "
                    "it in project()")
    endif()
    get_filename_component(stem "${source}" NAME)
    set(reading "${CMAKE_CURRENT_BINARY_DIR}/${name}_dual/${stem}.cpp")
    file(
      CONFIGURE
      OUTPUT "${reading}"
      CONTENT "#define USUB_DUAL_PASS\n#include \"@path@\"\n"
      @ONLY)
    set_property(
      SOURCE "${reading}"
      PROPERTY COMPILE_OPTIONS -std=gnu++17 -fno-exceptions -fno-rtti)
    list(APPEND made "${reading}")
  endforeach()
  set(${result} "${made}" PARENT_SCOPE)
endfunction()

# In `result` the language whose compiler links C and Fortran sources.
function(usersub_link_language result)
  set(${result} C PARENT_SCOPE)
  if("${ARGN}" MATCHES "\\.(f|for|ftn|f77|f90|f95|f03|f08|F|FOR|F77|F90|F95|F03|F08)(;|$)")
    set(${result} Fortran PARENT_SCOPE)
  endif()
endfunction()

# Says which language a source needs; CMake itself would only say that it knows no link language.
function(usersub_check_languages name)
  get_property(enabled GLOBAL PROPERTY ENABLED_LANGUAGES)
  foreach(source IN LISTS ARGN)
    set(language "")
    if(source MATCHES "\\.(f|for|ftn|f77|f90|f95|f03|f08|F|FOR|F77|F90|F95|F03|F08)$")
      set(language Fortran)
    elseif(source MATCHES "\\.(cpp|cc|cxx|c\\+\\+)$")
      set(language CXX)
    elseif(source MATCHES "\\.c$")
      set(language C)
    endif()
    if(language AND NOT ";${enabled};" MATCHES ";${language};")
      message(
        FATAL_ERROR "usersub_add_routine(${name}): ${source} needs the language ${language}; write "
                    "enable_language(${language}) before, or name it in project()")
    endif()
  endforeach()
endfunction()
