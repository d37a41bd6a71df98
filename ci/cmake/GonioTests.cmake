# How a test program of gonio is built and found by ctest.
if(GONIO_BUILD_TESTS)
  find_package(GTest 1.12 REQUIRED)
  include(GoogleTest)
endif()

# gonio_unit_test(<module> [LINK <target>...])
# One program from all *_test.cpp of the current folder; one ctest entry per test.
function(gonio_unit_test module)
  cmake_parse_arguments(arg "" "" "LINK" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*_test.cpp)
  add_executable(test_${module} ${sources})
  gonio_warnings(test_${module})
  target_link_libraries(test_${module} PRIVATE ${arg_LINK} GTest::gmock GTest::gtest_main)
  target_compile_definitions(test_${module} PRIVATE GONIO_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  gtest_discover_tests(test_${module} PROPERTIES TIMEOUT 600 LABELS unit DISCOVERY_TIMEOUT 60)
endfunction()
