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

# lorica_add_widget_module(NAME SOURCES ... HEADERS ... [PUBLIC targets] [PRIVATE targets])
# One module of widgets/, laid out as core's are. HEADERS are those with Q_OBJECT, for moc.
function(lorica_add_widget_module name)
  cmake_parse_arguments(ARG "" "" "SOURCES;HEADERS;PUBLIC;PRIVATE" ${ARGN})
  lorica_add_module(${name} SOURCES ${ARG_SOURCES} ${ARG_HEADERS} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  set_target_properties(lorica_${name} PROPERTIES AUTOMOC ON)
  target_compile_definitions(lorica_${name} PUBLIC QT_NO_KEYWORDS QT_NO_CAST_TO_ASCII)
endfunction()

# lorica_add_window_test(NAME SOURCES ... LINK targets)
# A GoogleTest program with a QApplication; without a display it starts an X server of its own. Label: window.
function(lorica_add_window_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${ARG_SOURCES} ${PROJECT_SOURCE_DIR}/tests/widgets/window_main.cpp)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests/support)
  set_target_properties(${name} PROPERTIES AUTOMOC ON)
  target_link_libraries(${name} PRIVATE lorica_warnings lorica_numerics lorica_sanitizers ${ARG_LINK} Qt6::Widgets
    Qt6::Test GTest::gtest)
  target_compile_definitions(${name} PRIVATE LORICA_SOURCE_DIR="${PROJECT_SOURCE_DIR}" QT_NO_KEYWORDS)
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 300 LABELS window)
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
