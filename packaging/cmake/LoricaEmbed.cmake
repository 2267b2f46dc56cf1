# lorica_embed(TARGET FUNCTION namespace::name FILES ...)
# Puts files into a target at build time, any bytes, in the order given. The target's code declares
#   std::span<const std::pair<std::string_view, std::string_view>> name();
# in that namespace; it gives the pairs (file name up to its first dot, bytes).
#
# The same file, run as a script (cmake -P), writes the source.

if(CMAKE_SCRIPT_MODE_FILE STREQUAL CMAKE_CURRENT_LIST_FILE)
  string(REGEX MATCH "^(.*)::([^:]+)$" _ "${LORICA_EMBED_FUNCTION}")
  set(namespace "${CMAKE_MATCH_1}")
  set(function "${CMAKE_MATCH_2}")
  set(arrays "")
  set(entries "")
  set(index 0)
  foreach(file IN LISTS LORICA_EMBED_FILES)
    get_filename_component(name "${file}" NAME_WE)
    file(READ "${file}" bytes HEX)
    string(REGEX REPLACE "([0-9a-f][0-9a-f])" "'\\\\x\\1'," bytes "${bytes}")
    # Short lines: 20 bytes of 7 characters each.
    string(REPEAT "." 140 line)
    string(REGEX REPLACE "(${line})" "\\1\n" bytes "${bytes}")
    string(APPEND arrays "constexpr char file${index}[] = {\n${bytes}'\\0'};\n")
    string(APPEND entries "    {\"${name}\", {file${index}, sizeof(file${index}) - 1}},\n")
    math(EXPR index "${index} + 1")
  endforeach()
  file(WRITE "${LORICA_EMBED_OUTPUT}" "\
#include <span>
#include <string_view>
#include <utility>

namespace ${namespace} {

std::span<const std::pair<std::string_view, std::string_view>> ${function}();

namespace {

${arrays}
constexpr std::pair<std::string_view, std::string_view> files[] = {
${entries}};

}  // namespace

std::span<const std::pair<std::string_view, std::string_view>> ${function}() { return files; }

}  // namespace ${namespace}
")
  return()
endif()

set(LORICA_EMBED_SCRIPT ${CMAKE_CURRENT_LIST_FILE})

function(lorica_embed target)
  cmake_parse_arguments(ARG "" "FUNCTION" "FILES" ${ARGN})
  string(REPLACE "::" "_" stem "${ARG_FUNCTION}")
  set(output ${CMAKE_CURRENT_BINARY_DIR}/${stem}.cpp)
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} "-DLORICA_EMBED_FUNCTION=${ARG_FUNCTION}" "-DLORICA_EMBED_FILES=${ARG_FILES}"
      "-DLORICA_EMBED_OUTPUT=${output}" -P ${LORICA_EMBED_SCRIPT}
    DEPENDS ${ARG_FILES} ${LORICA_EMBED_SCRIPT}
    COMMENT "Embedding ${stem}"
    VERBATIM)
  target_sources(${target} PRIVATE ${output})
endfunction()
