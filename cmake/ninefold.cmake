# Compiler settings and the two functions that every folder uses. A folder is one library (or one
# program) and its sources are the folder's .cpp files; what it may link is the layer table of
# docs/architecture.md, held by scripts/check_layers.

find_package(Threads REQUIRED)
find_program(NINEFOLD_CCACHE ccache)
if(NINEFOLD_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${NINEFOLD_CCACHE})
endif()
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()

# x86-64-v3 for our own code everywhere; Embree picks AVX-512 at run time. No fast-math, and no
# contraction: the same source expression must give the same bits in every function it is inlined to.
add_library(ninefold_options INTERFACE)
target_compile_options(ninefold_options INTERFACE
  -march=x86-64-v3 -ffp-contract=off -fno-math-errno -fno-trapping-math -Wall -Wextra -Wconversion -Werror
  # Clang knows no "GCC ivdep", and its -Wconversion warns of signs, too, which GCC's does not in C++.
  "$<$<CXX_COMPILER_ID:Clang>:-Wno-unknown-pragmas;-Wno-sign-conversion>"
  # Boost 1.74 takes Clang's coroutines for an experiment, and forgets a header that GCC's standard one brings.
  "$<$<CXX_COMPILER_ID:Clang>:-DBOOST_ASIO_HAS_CO_AWAIT=1;-DBOOST_ASIO_HAS_STD_COROUTINE=1;SHELL:-include utility>"
  # GCC warns falsely inside std::string (12, bug 105329) and inside moved std::variants (14).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_GREATER_EQUAL:$<CXX_COMPILER_VERSION>,14>>:-Wno-maybe-uninitialized>)
# A program loads the shared libraries that it really uses: OpenImageIO alone brings 250 more, half a
# second of every start.
# And first of all fmt's: OpenImageIO's headers leave copies of fmt's functions in our archives, and a program
# that finds them before the library takes them, with all that stands beside them.
target_link_options(ninefold_options INTERFACE
  -Wl,--push-state,--no-as-needed,-lfmt,--pop-state -Wl,--as-needed)
target_include_directories(ninefold_options INTERFACE ${CMAKE_SOURCE_DIR})
target_link_libraries(ninefold_options INTERFACE Threads::Threads)
if(NINEFOLD_TEST_METHODS)
  target_compile_definitions(ninefold_options INTERFACE NINEFOLD_TEST_METHODS)
endif()
if(NINEFOLD_SANITIZE)
  target_compile_options(ninefold_options INTERFACE
    -fsanitize=${NINEFOLD_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer
    # Instrumented, GCC loses track of variants; and it warns of the fences inside Asio.
    "$<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized;-Wno-tsan>")
  target_link_options(ninefold_options INTERFACE -fsanitize=${NINEFOLD_SANITIZE})
endif()

# ninefold_library(NAME [PUBLIC targets...] [PRIVATE targets...]): the .cpp files of this folder.
# A folder with headers only becomes an interface library.
function(ninefold_library name)
  cmake_parse_arguments(ARG "" "" "PUBLIC;PRIVATE" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  list(FILTER sources EXCLUDE REGEX "/main\\.cpp$")
  if(sources)
    add_library(${name} STATIC ${sources})
    target_link_libraries(${name} PUBLIC ninefold_options ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  else()
    add_library(${name} INTERFACE)
    target_link_libraries(${name} INTERFACE ninefold_options ${ARG_PUBLIC} ${ARG_PRIVATE})
  endif()
endfunction()

# ninefold_program(NAME SOURCE LINK...): one executable in build/.../bin.
function(ninefold_program name source)
  if(EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/${source})
    add_executable(${name} ${source})
    target_link_libraries(${name} PRIVATE ${ARGN})
  endif()
endfunction()
