# How a test program of gonio is built and found by ctest.
if(GONIO_BUILD_TESTS)
  find_package(GTest 1.12 REQUIRED)
  find_package(benchmark 1.7 REQUIRED)
  include(GoogleTest)
  add_custom_target(sanitized_tests) # what AddressSanitizer and UndefinedBehaviorSanitizer watch
  add_custom_target(parallel_tests)  # what ThreadSanitizer watches
  # The same in `ci/test --thorough`.
  add_custom_target(thorough_sanitized_tests DEPENDS sanitized_tests)
  add_custom_target(thorough_parallel_tests DEPENDS parallel_tests)
endif()

# What a test program is built like: its own sources with no more optimisation than saves time. With
# so little of it gcc 12 takes arrays of Eigen for uninitialised.
function(gonio_test_program target)
  gonio_warnings(${target})
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1;-Wno-maybe-uninitialized>)
endfunction()

# gonio_unit_test(<module> [PARALLEL] [THOROUGH] [LINK <target>...])
# One program from all *_test.cpp of the current folder; one ctest entry per test, label unit.
# THOROUGH: sanitizers watch it in `ci/test --thorough` only, since that takes them minutes.
# PARALLEL: code that runs threads; label unit_parallel, which `-L unit` and `-L parallel` both find
# and ThreadSanitizer runs.
function(gonio_unit_test module)
  cmake_parse_arguments(arg "PARALLEL;THOROUGH" "" "LINK" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*_test.cpp)
  add_executable(test_${module} ${sources})
  gonio_test_program(test_${module})
  target_link_libraries(test_${module} PRIVATE ${arg_LINK} GTest::gmock GTest::gtest_main)
  target_compile_definitions(test_${module} PRIVATE GONIO_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  set(label unit)
  set(thorough "")
  if(arg_THOROUGH)
    set(thorough thorough_)
  endif()
  add_dependencies(${thorough}sanitized_tests test_${module})
  if(arg_PARALLEL)
    set(label unit_parallel)
    add_dependencies(${thorough}parallel_tests test_${module})
  endif()
  gtest_discover_tests(test_${module} PROPERTIES TIMEOUT 600 LABELS ${label}
                       FAIL_REGULAR_EXPRESSION "0 tests from 0 test suites ran" DISCOVERY_TIMEOUT 60)
endfunction()

# gonio_benchmark(<name> [LINK <target>...])
# The program bench_<name> from <name>_benchmark.cpp. ctest, label bench, only shows that it runs.
function(gonio_benchmark name)
  cmake_parse_arguments(arg "" "" "LINK" ${ARGN})
  add_executable(bench_${name} ${name}_benchmark.cpp)
  gonio_warnings(bench_${name})
  target_link_libraries(bench_${name} PRIVATE ${arg_LINK} benchmark::benchmark_main)
  target_compile_definitions(bench_${name} PRIVATE GONIO_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  add_test(NAME bench_${name} COMMAND bench_${name} --benchmark_min_time=0.01)
  set_tests_properties(bench_${name} PROPERTIES LABELS bench TIMEOUT 600)
endfunction()
