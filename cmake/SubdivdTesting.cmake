# How tests, fuzz targets and benchmarks join the build. tests/README.md says what each kind is for.

include(GoogleTest)

# subdivd_add_test(NAME SOURCES file... [LIBRARIES target...] [LABELS label...] [TIMEOUT seconds] [WHOLE])
# A GoogleTest program. Each of its tests is one ctest entry, named NAME.Suite.test; WHOLE makes the program
# one entry, for tests that share a costly beginning.
function(subdivd_add_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "WHOLE" "TIMEOUT" "SOURCES;LIBRARIES;LABELS")
  if(arg_UNPARSED_ARGUMENTS OR NOT arg_SOURCES)
    message(FATAL_ERROR "subdivd_add_test(${name}): SOURCES missing or unknown words: ${arg_UNPARSED_ARGUMENTS}")
  endif()
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 120)
  endif()
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE ${arg_LIBRARIES} subdivd_options GTest::gmock GTest::gtest_main)
  target_compile_definitions(${name} PRIVATE SUBDIVD_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
                                             SUBDIVD_BINARY_DIR="${PROJECT_BINARY_DIR}")
  set(properties TIMEOUT ${arg_TIMEOUT} LABELS "${arg_LABELS}")
  if(arg_WHOLE)
    add_test(NAME ${name} COMMAND ${name})
    set_tests_properties(${name} PROPERTIES ${properties})
  else()
    gtest_discover_tests(${name} TEST_PREFIX ${name}. PROPERTIES ${properties} DISCOVERY_TIMEOUT 60)
  endif()
endfunction()

# subdivd_add_fuzzer(NAME SOURCES file... [LIBRARIES target...])
# A libFuzzer target fuzz_NAME. Its seeds are tests/fuzz/corpus/NAME/, its past findings
# tests/fuzz/regressions/NAME/. In the fuzz build it is run by `./dev fuzz`; in every other build the same
# entry point is linked to a driver that replays seeds, findings and every truncation of them, as a test.
function(subdivd_add_fuzzer name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;LIBRARIES")
  if(arg_UNPARSED_ARGUMENTS OR NOT arg_SOURCES)
    message(FATAL_ERROR "subdivd_add_fuzzer(${name}): SOURCES missing or unknown words: ${arg_UNPARSED_ARGUMENTS}")
  endif()
  add_executable(fuzz_${name} ${arg_SOURCES})
  target_link_libraries(fuzz_${name} PRIVATE ${arg_LIBRARIES} subdivd_options)
  if(SUBDIVD_FUZZ)
    target_link_options(fuzz_${name} PRIVATE -fsanitize=fuzzer)
    set_property(GLOBAL APPEND PROPERTY SUBDIVD_FUZZERS fuzz_${name})
  else()
    target_sources(fuzz_${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests/support/fuzz_replay_main.cpp)
    set(inputs ${PROJECT_SOURCE_DIR}/tests/fuzz/corpus/${name})
    if(EXISTS ${PROJECT_SOURCE_DIR}/tests/fuzz/regressions/${name})
      list(APPEND inputs ${PROJECT_SOURCE_DIR}/tests/fuzz/regressions/${name})
    endif()
    add_test(NAME fuzz.${name}.answers_every_kept_input COMMAND fuzz_${name} ${inputs})
    set_tests_properties(fuzz.${name}.answers_every_kept_input PROPERTIES TIMEOUT 300 LABELS fuzz)
  endif()
endfunction()

# subdivd_add_benchmark(NAME SOURCES file... [LIBRARIES target...])
# A Google Benchmark program bench_NAME, run by `./dev bench`.
function(subdivd_add_benchmark name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;LIBRARIES")
  add_executable(bench_${name} ${arg_SOURCES})
  target_link_libraries(bench_${name} PRIVATE ${arg_LIBRARIES} subdivd_options benchmark::benchmark_main)
  set_property(GLOBAL APPEND PROPERTY SUBDIVD_BENCHMARKS bench_${name})
endfunction()

# subdivd_add_script_test(NAME COMMAND word... [LABELS label...] [TIMEOUT seconds])
# Any other program as a test: it fails by a non-zero exit code. SUBDIVD_SOURCE_DIR, SUBDIVD_BINARY_DIR and
# SUBDIVD_DAEMON (the program) are in its environment.
function(subdivd_add_script_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "TIMEOUT" "COMMAND;LABELS")
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 120)
  endif()
  add_test(NAME ${name} COMMAND ${arg_COMMAND} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  set_tests_properties(
    ${name}
    PROPERTIES
      TIMEOUT ${arg_TIMEOUT}
      LABELS "${arg_LABELS}"
      ENVIRONMENT
      "SUBDIVD_SOURCE_DIR=${PROJECT_SOURCE_DIR};SUBDIVD_BINARY_DIR=${PROJECT_BINARY_DIR};SUBDIVD_DAEMON=${PROJECT_BINARY_DIR}/subdivd"
  )
endfunction()

# subdivd_add_node_test(NAME SCRIPT file.mjs [ARGUMENTS word...] [LABELS label...] [TIMEOUT seconds])
# A script for Node. Packages resolve to tests/node_modules, which `./dev test` fills from tests/package-lock.json.
function(subdivd_add_node_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "SCRIPT;TIMEOUT" "ARGUMENTS;LABELS")
  find_program(NODE node REQUIRED)
  subdivd_add_script_test(
    ${name}
    COMMAND ${NODE} ${arg_SCRIPT} ${arg_ARGUMENTS}
    LABELS ${arg_LABELS}
    TIMEOUT ${arg_TIMEOUT})
endfunction()

# Writes fuzzers.txt and benchmarks.txt into the build folder, one path to a program a line, for `dev`.
function(subdivd_write_program_lists)
  foreach(kind IN ITEMS FUZZERS BENCHMARKS)
    get_property(programs GLOBAL PROPERTY SUBDIVD_${kind})
    string(TOLOWER ${kind} file)
    set(lines "")
    foreach(program IN LISTS programs)
      string(APPEND lines "$<TARGET_FILE:${program}>\n")
    endforeach()
    file(GENERATE OUTPUT ${PROJECT_BINARY_DIR}/${file}.txt CONTENT "${lines}")
    add_custom_target(${file} DEPENDS ${programs})
  endforeach()
endfunction()
