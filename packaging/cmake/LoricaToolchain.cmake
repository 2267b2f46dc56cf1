# Compiler settings shared by every target: language level, warnings, sanitizers, the fast tools when they are present.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

option(LORICA_TESTS "Build the tests and benchmarks" ON)
set(LORICA_SANITIZE "" CACHE STRING "Sanitizers to build with: address;undefined or thread")

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

find_program(LORICA_CCACHE ccache)
if(LORICA_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_C_COMPILER_LAUNCHER ${LORICA_CCACHE})
  set(CMAKE_CXX_COMPILER_LAUNCHER ${LORICA_CCACHE})
endif()
find_program(LORICA_MOLD mold)
if(LORICA_MOLD)
  add_link_options(-fuse-ld=mold)
endif()

add_library(lorica_warnings INTERFACE)
target_compile_options(lorica_warnings INTERFACE -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion
  -Wnon-virtual-dtor -Wold-style-cast -Woverloaded-virtual -Werror)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # GCC 12 warns of overlaps in std::string's own operator+ that cannot happen.
  target_compile_options(lorica_warnings INTERFACE -Wno-restrict)
endif()
if(LORICA_SANITIZE)
  # The optimiser sees paths through the instrumentation that cannot be taken and warns about them.
  target_compile_options(lorica_warnings INTERFACE -Wno-maybe-uninitialized)
endif()

# The same study gives the same bytes: no fused multiply-add that one compiler makes and another does not.
add_library(lorica_numerics INTERFACE)
target_compile_options(lorica_numerics INTERFACE -ffp-contract=off -fno-math-errno)

add_library(lorica_sanitizers INTERFACE)
if(LORICA_SANITIZE)
  list(JOIN LORICA_SANITIZE "," LORICA_SANITIZE_LIST)
  target_compile_options(lorica_sanitizers INTERFACE -fsanitize=${LORICA_SANITIZE_LIST} -fno-omit-frame-pointer
    -fno-sanitize-recover=all)
  target_link_options(lorica_sanitizers INTERFACE -fsanitize=${LORICA_SANITIZE_LIST})
  if("thread" IN_LIST LORICA_SANITIZE)
    # TBB is not built for the thread sanitizer, so parallelFor falls back to plain threads.
    target_compile_definitions(lorica_sanitizers INTERFACE LORICA_PLAIN_THREADS)
  endif()
endif()
