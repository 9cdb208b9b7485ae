# CppHttplib::CppHttplib, the compiled cpp-httplib.
#
# The package has no CMake configuration. Its pkg-config flags are not a convenience: the macros for TLS and
# compression change the layout of httplib's classes, and a program built without them corrupts its memory.

find_package(PkgConfig REQUIRED)
pkg_check_modules(CppHttplib QUIET IMPORTED_TARGET cpp-httplib)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(
  CppHttplib
  REQUIRED_VARS CppHttplib_LINK_LIBRARIES CppHttplib_CFLAGS
  VERSION_VAR CppHttplib_VERSION)

if(CppHttplib_FOUND AND NOT TARGET CppHttplib::CppHttplib)
  add_library(CppHttplib::CppHttplib ALIAS PkgConfig::CppHttplib)
endif()
