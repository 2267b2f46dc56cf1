# lorica_add_module(NAME SOURCES ... [PUBLIC targets] [PRIVATE targets])
# One core module: folder = target = namespace = include root.
function(lorica_add_module name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(lorica_${name} STATIC ${ARG_SOURCES})
  add_library(lorica::${name} ALIAS lorica_${name})
  target_include_directories(lorica_${name} PUBLIC ${CMAKE_CURRENT_SOURCE_DIR}/include PRIVATE src)
  target_link_libraries(lorica_${name}
    PUBLIC lorica_numerics lorica_sanitizers ${ARG_PUBLIC}
    PRIVATE lorica_warnings ${ARG_PRIVATE})
endfunction()

# lorica_add_test(NAME SOURCES ... LINK targets [LABELS unit|property|cli|data])
# One GoogleTest program; every TEST in it becomes a ctest entry with the given labels.
function(lorica_add_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK;LABELS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests/support)
  target_link_libraries(${name} PRIVATE lorica_warnings lorica_numerics lorica_sanitizers ${ARG_LINK}
    GTest::gtest GTest::gtest_main)
  target_compile_definitions(${name} PRIVATE LORICA_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 600)
  # Of a list of labels gtest_discover_tests keeps the first and spoils what follows, so they are set afterwards.
  file(CONFIGURE OUTPUT ${name}_labels.cmake @ONLY
    CONTENT "set_tests_properties(\${@name@_TESTS} PROPERTIES LABELS \"@ARG_LABELS@\")\n")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${CMAKE_CURRENT_BINARY_DIR}/${name}_labels.cmake)
endfunction()
