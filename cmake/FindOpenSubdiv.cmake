# OpenSubdiv::osdCPU, the shared library with Far, Bfr and Sdc.
#
# Debian's libosd-dev installs a CMake configuration that names static libraries which the package does not
# contain and no include directory, so it fails or misleads: look for the two things that matter instead.

find_path(OpenSubdiv_INCLUDE_DIR opensubdiv/version.h)
find_library(OpenSubdiv_CPU_LIBRARY osdCPU)
mark_as_advanced(OpenSubdiv_INCLUDE_DIR OpenSubdiv_CPU_LIBRARY)

if(OpenSubdiv_INCLUDE_DIR)
  file(STRINGS ${OpenSubdiv_INCLUDE_DIR}/opensubdiv/version.h line
       REGEX "^#define +OPENSUBDIV_VERSION_NUMBER +[0-9]+")
  if(line MATCHES "([0-9]+)([0-9][0-9])([0-9][0-9])$")
    math(EXPR major "${CMAKE_MATCH_1}")
    math(EXPR minor "${CMAKE_MATCH_2}")
    math(EXPR patch "${CMAKE_MATCH_3}")
    set(OpenSubdiv_VERSION ${major}.${minor}.${patch})
  endif()
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(
  OpenSubdiv
  REQUIRED_VARS OpenSubdiv_CPU_LIBRARY OpenSubdiv_INCLUDE_DIR
  VERSION_VAR OpenSubdiv_VERSION)

if(OpenSubdiv_FOUND AND NOT TARGET OpenSubdiv::osdCPU)
  add_library(OpenSubdiv::osdCPU SHARED IMPORTED)
  set_target_properties(
    OpenSubdiv::osdCPU PROPERTIES IMPORTED_LOCATION ${OpenSubdiv_CPU_LIBRARY}
                                  INTERFACE_INCLUDE_DIRECTORIES ${OpenSubdiv_INCLUDE_DIR})
endif()
