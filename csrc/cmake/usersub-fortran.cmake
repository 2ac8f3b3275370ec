# SPDX-License-Identifier: MIT

# Target usersub::fortran: the module `usersub`, from source, since module files fit one compiler
# version only. It is compiled once in a project that has enabled Fortran before
# find_package(usersub). Otherwise every target that links usersub::fortran compiles the source
# itself, which serves one target a folder.
get_property(usersub_languages GLOBAL PROPERTY ENABLED_LANGUAGES)
if(NOT TARGET usersub::fortran)
  set(usersub_module "${USERSUB_INCLUDE_DIR}/usersub/usersub.f90")
  if(";${usersub_languages};" MATCHES ";Fortran;")
    add_library(usersub_fortran STATIC EXCLUDE_FROM_ALL "${usersub_module}")
    set(usersub_module_dir "${CMAKE_CURRENT_BINARY_DIR}/usersub_fortran_module")
    set_target_properties(
      usersub_fortran PROPERTIES Fortran_MODULE_DIRECTORY "${usersub_module_dir}"
                                 POSITION_INDEPENDENT_CODE ON)
    target_include_directories(usersub_fortran INTERFACE "${usersub_module_dir}")
    target_link_libraries(usersub_fortran PUBLIC usersub::usersub)
    # The project's own flags may ask for an older standard.
    target_compile_options(
      usersub_fortran PRIVATE "$<$<COMPILE_LANG_AND_ID:Fortran,GNU>:-std=f2018>")
    add_library(usersub::fortran ALIAS usersub_fortran)
  else()
    add_library(usersub::fortran INTERFACE IMPORTED)
    set_target_properties(
      usersub::fortran PROPERTIES INTERFACE_SOURCES "${usersub_module}"
                                  INTERFACE_LINK_LIBRARIES usersub::usersub)
  endif()
endif()
