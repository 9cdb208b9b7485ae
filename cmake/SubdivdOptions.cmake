# Flags that every target of this project shares: link to `subdivd_options`.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_CXX_SCAN_FOR_MODULES OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)  # clang-tidy reads it

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()

find_program(CCACHE ccache)
if(CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
endif()

add_library(subdivd_options INTERFACE)
target_include_directories(subdivd_options INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_definitions(subdivd_options INTERFACE SUBDIVD_VERSION="${PROJECT_VERSION}")
# -Wall holds g++'s -Wsequence-point; what only clang sees, `./dev lint` asks clang.
target_compile_options(
  subdivd_options
  INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wnon-virtual-dtor
            # The same request gives the same bits on every machine: a*b+c is never fused.
            -ffp-contract=off
            -fstack-protector-strong
            # g++ 12 at -O3 sees overlaps in "literal" + std::string that are none (GCC bug 105329).
            $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
target_link_options(subdivd_options INTERFACE -Wl,-z,relro,-z,now)
if(SUBDIVD_WERROR)
  target_compile_options(subdivd_options INTERFACE -Werror)
endif()

if(CMAKE_BUILD_TYPE STREQUAL "Debug")
  # An index out of a vector's range stops the program where the sanitizers would see only heap.
  target_compile_definitions(subdivd_options INTERFACE _GLIBCXX_ASSERTIONS)
elseif(NOT SUBDIVD_SANITIZE AND NOT SUBDIVD_FUZZ)
  target_compile_definitions(subdivd_options INTERFACE _FORTIFY_SOURCE=2)
endif()

if(SUBDIVD_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    message(FATAL_ERROR "SUBDIVD_FUZZ needs clang: cmake --preset fuzz")
  endif()
  set(sanitize fuzzer-no-link,address,undefined)
else()
  set(sanitize ${SUBDIVD_SANITIZE})
endif()
if(sanitize)
  # A finding ends the program: a report that scrolls by is not a failure.
  set(flags -fsanitize=${sanitize} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_compile_options(
    subdivd_options
    INTERFACE ${flags}
              # g++ 12 believes that instrumented code of its own library reads what is not set.
              $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  target_link_options(subdivd_options INTERFACE ${flags})
endif()

if(SUBDIVD_COVERAGE)
  target_compile_options(subdivd_options INTERFACE --coverage -fprofile-update=atomic)
  target_link_options(subdivd_options INTERFACE --coverage)
endif()
